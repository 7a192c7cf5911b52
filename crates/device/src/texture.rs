//! A prepared texture that owns its data and lends them to the audio callback.

use shagreen_synth::height_map::HeightMap;
use shagreen_synth::relief::Relief;
use shagreen_synth::stick_slip::Friction;
use shagreen_synth::texture::{self, Along, Excitation, Node, Parts, Texture, Triangle};

/// Reason why data do not form a valid texture, with the sizes involved.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
#[error(
    "a texture of order {order} at {rate_hz} Hz with {n_nodes} nodes and {n_triangles} triangles \
     cannot be played: {}", explain(*.reason)
)]
pub struct TextureError {
    /// The violated rule.
    pub reason: texture::TextureError,
    /// Given order.
    pub order: usize,
    /// Given sample rate, in Hz.
    pub rate_hz: f32,
    /// Number of given nodes.
    pub n_nodes: usize,
    /// Number of given triangles.
    pub n_triangles: usize,
}

fn explain(reason: texture::TextureError) -> &'static str {
    match reason {
        texture::TextureError::Order => {
            "the AR order is zero or too high, the moving-average order is too high, or a moving average has no excitation"
        }
        texture::TextureError::Range => "the rate, maximum speed or maximum force is not positive and finite",
        texture::TextureError::Triangle => {
            "there are no or too many triangles, or one refers to a node or neighbor that does not exist"
        }
        texture::TextureError::Excitation => "the number of excitations differs from the number of nodes",
        texture::TextureError::Along => "a published texture has a grain along its lay",
        texture::TextureError::Layer => "its rotation or friction is negative or not finite",
        texture::TextureError::Number => "a value is negative or not finite, or frequencies do not ascend",
        _ => "it violates a rule of the renderer",
    }
}

/// A prepared texture: nodes over (speed, force) and their triangulation, validated once.
#[derive(Clone, Debug, PartialEq)]
pub struct OwnedTexture {
    rate_hz: f32,
    order: usize,
    ma_order: usize,
    speed_max_mps: f32,
    force_max_n: f32,
    nodes: Box<[Node]>,
    excitations: Box<[Excitation]>,
    triangles: Box<[Triangle]>,
    along: Option<OwnedAlong>,
    turn_rad: f32,
    relief: Option<Box<OwnedRelief>>,
    height_map: Option<Box<OwnedHeightMap>>,
    friction: Option<Friction>,
}

/// Owned data of an [`Along`].
#[derive(Clone, Debug, PartialEq)]
struct OwnedAlong {
    nodes: Box<[Node]>,
    triangles: Box<[Triangle]>,
}

/// Owned data of a [`Relief`].
#[derive(Clone, Debug, PartialEq)]
struct OwnedRelief {
    step_m: f32,
    force_n: f32,
    n: usize,
    octaves: Box<[f32]>,
}

impl OwnedRelief {
    fn of(relief: &Relief<'_>) -> Self {
        let octaves = relief.octaves().into();
        Self { step_m: relief.step_m(), force_n: relief.force_n(), n: relief.n(), octaves }
    }

    fn view(&self) -> Relief<'_> {
        Relief::checked_before(self.step_m, self.force_n, self.n, &self.octaves)
    }
}

/// Owned data of a [`HeightMap`].
#[derive(Clone, Debug, PartialEq)]
struct OwnedHeightMap {
    side_m: f64,
    force_n: f32,
    speed_exponent: f32,
    n: usize,
    octaves: Box<[f32]>,
}

impl OwnedHeightMap {
    fn of(map: &HeightMap<'_>) -> Self {
        Self {
            side_m: map.side_m(),
            force_n: map.force_n(),
            speed_exponent: map.speed_exponent(),
            n: map.n(),
            octaves: map.octaves().into(),
        }
    }

    fn view(&self) -> HeightMap<'_> {
        HeightMap::checked_before(self.side_m, self.force_n, self.speed_exponent, self.n, &self.octaves)
    }
}

impl OwnedTexture {
    /// A copy of prepared data.
    ///
    /// # Errors
    /// [`TextureError`] if the renderer would reject them.
    pub fn new(parts: Parts<'_>) -> Result<Self, TextureError> {
        let Parts {
            rate_hz,
            order,
            ma_order,
            speed_max_mps,
            force_max_n,
            nodes,
            excitations,
            triangles,
            along,
            turn_rad,
            relief,
            height_map,
            friction,
        } = parts;
        Texture::new(parts).map_err(|reason| TextureError {
            reason,
            order,
            rate_hz,
            n_nodes: nodes.len(),
            n_triangles: triangles.len(),
        })?;
        Ok(Self {
            rate_hz,
            order,
            ma_order,
            speed_max_mps,
            force_max_n,
            nodes: nodes.into(),
            excitations: excitations.into(),
            triangles: triangles.into(),
            along: along
                .map(|along| OwnedAlong { nodes: along.nodes.into(), triangles: along.triangles.into() }),
            turn_rad,
            relief: relief.as_ref().map(|relief| Box::new(OwnedRelief::of(relief))),
            height_map: height_map.as_ref().map(|map| Box::new(OwnedHeightMap::of(map))),
            friction,
        })
    }

    /// Sample rate of the model, in Hz.
    pub fn rate_hz(&self) -> f32 {
        self.rate_hz
    }

    /// View of the texture for the renderer; the data were validated at construction.
    pub fn view(&self) -> Texture<'_> {
        Texture::checked_before(Parts {
            rate_hz: self.rate_hz,
            order: self.order,
            ma_order: self.ma_order,
            speed_max_mps: self.speed_max_mps,
            force_max_n: self.force_max_n,
            nodes: &self.nodes,
            excitations: &self.excitations,
            triangles: &self.triangles,
            along: self
                .along
                .as_ref()
                .map(|along| Along { nodes: &along.nodes, triangles: &along.triangles }),
            turn_rad: self.turn_rad,
            relief: self.relief.as_deref().map(OwnedRelief::view),
            height_map: self.height_map.as_deref().map(OwnedHeightMap::view),
            friction: self.friction,
        })
    }
}

#[cfg(test)]
pub(crate) mod tests {
    use super::OwnedTexture;
    use shagreen_synth::contact::Contact;
    use shagreen_synth::direction::Direction;
    use shagreen_synth::height_map::{self, HeightMap};
    use shagreen_synth::relief::Relief;
    use shagreen_synth::stick_slip::Friction;
    use shagreen_synth::texture::{self, Along, MAX_ORDER, NO_NEIGHBOR, Node, Parts, Texture, Triangle};

    /// White noise of `level_mps2` at 1 m/s and 1 N; the level scales with the smaller of the normalized speed and
    /// force.
    pub(crate) fn white(level_mps2: f32) -> OwnedTexture {
        white_at(1000.0, level_mps2).unwrap()
    }

    /// A relief without noise: a wave of 0.64 mm along x, with sixteen periods.
    pub(crate) fn wavy() -> OwnedTexture {
        let mut octaves = Vec::new();
        for n in (2..=10).rev().map(|octave| 1_usize << octave) {
            let value = |i: usize| (core::f32::consts::TAU * 16.0 * i as f32 / n as f32).sin();
            octaves.extend((0..n).map(|i| if n >= 64 { value(i) } else { 0.0 }));
        }
        let relief = Relief::new(1e-5, 1.0, 1024, &octaves).unwrap();
        let silent = white(0.0);
        OwnedTexture::new(Parts { relief: Some(relief), ..parts_of(&silent) }).unwrap()
    }

    /// A texture with this kinetic friction coefficient, on which a tip slides steadily.
    pub(crate) fn rubbed(texture: OwnedTexture, kinetic: f32) -> OwnedTexture {
        let friction = Some(Friction { kinetic, static_ratio: 1.0, stribeck_speed_mps: 0.02 });
        OwnedTexture { friction, ..texture }
    }

    /// The texture with the same grain along its lay, a wavy height map and friction. The numbers are its rotation in rad,
    /// the height of the waves in m, the kinetic coefficient and the static ratio.
    pub(crate) fn layered(
        texture: &OwnedTexture,
        [turn_rad, height_m, kinetic, static_ratio]: [f32; 4],
    ) -> Result<OwnedTexture, super::TextureError> {
        let n = height_map::PATCH_FORCES.len() * height_map::length(16);
        let octaves: Vec<f32> = (0..n).map(|i| if i % 4 < 2 { height_m } else { -height_m }).collect();
        let along = Along { nodes: &texture.nodes, triangles: &texture.triangles };
        OwnedTexture::new(Parts {
            along: Some(along),
            turn_rad,
            height_map: HeightMap::new(0.01, 1.0, 2.0, 16, &octaves).ok(),
            friction: Some(Friction { kinetic, static_ratio, stribeck_speed_mps: 0.02 }),
            ..parts_of(texture)
        })
    }

    /// Borrowed data of a texture.
    fn parts_of(texture: &OwnedTexture) -> Parts<'_> {
        Parts {
            rate_hz: texture.rate_hz,
            order: texture.order,
            ma_order: texture.ma_order,
            speed_max_mps: texture.speed_max_mps,
            force_max_n: texture.force_max_n,
            nodes: &texture.nodes,
            excitations: &texture.excitations,
            triangles: &texture.triangles,
            along: None,
            turn_rad: texture.turn_rad,
            relief: None,
            height_map: None,
            friction: texture.friction,
        }
    }

    pub(crate) fn white_at(rate_hz: f32, level_mps2: f32) -> Result<OwnedTexture, super::TextureError> {
        // Evenly spaced LSFs give a predictor with zero coefficients and gain 1.
        with_lsf(rate_hz, level_mps2, &[core::f32::consts::PI / 3.0, core::f32::consts::PI * 2.0 / 3.0])
    }

    /// A texture with one predictor everywhere, whose level scales as that of [`white`].
    pub(crate) fn with_lsf(
        rate_hz: f32,
        level_mps2: f32,
        frequencies: &[f32],
    ) -> Result<OwnedTexture, super::TextureError> {
        let mut lsf = [0.0; MAX_ORDER];
        lsf[..frequencies.len()].copy_from_slice(frequencies);
        let node = |level_mps2| Node { level_mps2, lsf };
        let nodes = [node(0.0), node(0.0), node(level_mps2), node(0.0)];
        let triangle = |nodes, neighbors, weights| Triangle { nodes, neighbors, weights, ln_gain: [0.0; 6] };
        let triangles = [
            triangle([0, 1, 2], [NO_NEIGHBOR, 1, NO_NEIGHBOR], [-1.0, 0.0, 1.0, 1.0, -1.0, 0.0]),
            triangle([0, 2, 3], [NO_NEIGHBOR, NO_NEIGHBOR, 0], [0.0, -1.0, 1.0, 1.0, 0.0, 0.0]),
        ];
        let (nodes, triangles) = (&nodes, &triangles);
        OwnedTexture::new(Parts {
            rate_hz,
            order: frequencies.len(),
            ma_order: 0,
            speed_max_mps: 1.0,
            force_max_n: 1.0,
            nodes,
            excitations: &[],
            triangles,
            along: None,
            turn_rad: 0.0,
            relief: None,
            height_map: None,
            friction: None,
        })
    }

    #[test]
    fn lends_what_it_was_given() {
        let texture = white(2.0);
        let view = texture.view();
        assert_eq!((view.rate_hz(), view.order()), (1000.0, 2));
        let full = Contact { speed_mps: 1.0, force_n: 1.0 };
        let level = |view: Texture<'_>, angle_rad: f32| {
            view.evaluate(full, Direction::at_angle(angle_rad), &mut [0; 2]).level_mps2
        };
        assert_eq!((level(view, 0.0), level(view, 1.0)), (2.0, 2.0));
        // With all layers.
        let stronger = white(6.0);
        let along = Along { nodes: &stronger.nodes, triangles: &stronger.triangles };
        let friction = Friction { kinetic: 0.4, static_ratio: 1.5, stribeck_speed_mps: 0.02 };
        let octaves = vec![0.5; height_map::PATCH_FORCES.len() * height_map::length(16)];
        let map = HeightMap::new(0.01, 1.0, 2.0, 16, &octaves).unwrap();
        let parts = Parts {
            along: Some(along),
            turn_rad: 0.5,
            height_map: Some(map),
            friction: Some(friction),
            ..parts_of(&texture)
        };
        let layered = OwnedTexture::new(parts).unwrap();
        let view = layered.view();
        assert!((level(view, 0.5) - 2.0).abs() < 1e-4);
        assert!((level(view, 0.5 + core::f32::consts::FRAC_PI_2) - 6.0).abs() < 1e-4);
        assert_eq!((view.turn_rad(), view.friction(), view.height_map()), (0.5, Some(friction), Some(map)));
    }

    #[test]
    fn refuses_with_the_numbers() {
        let error = white_at(f32::NAN, 1.0).unwrap_err();
        assert_eq!(error.reason, texture::TextureError::Range);
        let text = white_at(1000.0, f32::INFINITY).unwrap_err().to_string();
        assert!(text.contains("order 2") && text.contains("4 nodes") && text.contains("finite"), "{text}");
    }
}
