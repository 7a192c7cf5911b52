//! Heat maps: a quantity of the interpolated texture over the whole space.
//!
//! Values are computed from models at one speed and force; nothing is rendered, and no person judges.

use crate::dsp::spectrum::centroid;
use crate::maths::least_squares::least_squares;
use crate::space::SpacePoint;
use crate::space::authoring::{Authoring, Blending, Voice};
use crate::space::fidelity::mixture_level_mps2;
use crate::texture::blend::mixture_psd;
use crate::texture::plane::Plane;
use crate::units::{Contact, Hertz};

/// Frequency range for centroids, in Hz; limited to half the sample rate of the textures.
const BAND_HZ: (f64, f64) = (20.0, 500.0);
/// Frequency step, in Hz.
const STEP_HZ: f64 = 4.0;
/// Minimum number of textures for a prediction: twice the number of its coefficients.
const LEAST_PREDICTED: usize = 6;

/// Quantity shown in a heat map.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Quantity {
    /// Level of the interpolated texture, in dB re 1 m/s².
    Level,
    /// Spectral centroid of the interpolated texture, in Hz.
    Centroid,
    /// First coordinate (rough-smooth) predicted from level and spectral centroid, in points of the axis: an estimate
    /// of roughness from vibration alone.
    Roughness,
    /// Distance from the nearest texture of the space, in points of the axes; large values mark sparse regions.
    Distance,
}

impl Quantity {
    /// All quantities.
    pub const ALL: [Self; 4] = [Self::Level, Self::Centroid, Self::Roughness, Self::Distance];
}

/// Computes a quantity at single points of the space.
#[derive(Clone, Debug)]
pub struct HeatMapper<'a> {
    /// Reliefs are disabled, because the quantities do not depend on them.
    authoring: Authoring,
    /// Planes of the textures, by library index.
    planes: &'a [&'a Plane],
    blending: &'a Blending,
    contact: Contact,
    quantity: Quantity,
    /// Regression coefficients for the first coordinate: constant, level and logarithm of the centroid.
    prediction: Option<[f64; 3]>,
}

impl<'a> HeatMapper<'a> {
    /// Maps one quantity at one contact. `authoring` interpolates the textures; `planes` holds the planes of the
    /// library textures, by library index.
    pub fn new(
        authoring: &Authoring,
        planes: &'a [&'a Plane],
        blending: &'a Blending,
        contact: Contact,
        quantity: Quantity,
    ) -> Self {
        let authoring = authoring.clone().without_reliefs();
        let mapper = Self { authoring, planes, blending, contact, quantity, prediction: None };
        let prediction = if quantity == Quantity::Roughness { mapper.prediction() } else { None };
        Self { prediction, ..mapper }
    }

    /// Value at a point. `None` if the texture is silent there, or if there are too few textures for a prediction.
    ///
    /// In a space with a triangulation, a point outside the interpolated region has no value either: the convex hull shows where
    /// the region ends. With more axes, most of a slice may be outside, and nothing shows the hull. There, the value is that of the
    /// texture that plays instead, at the nearest point of the region.
    pub fn at(&self, point: SpacePoint) -> Option<f64> {
        if self.quantity == Quantity::Distance {
            let distances = self.authoring.space().sites().iter().map(|(_, at)| at.distance(point));
            return distances.min_by(f64::total_cmp);
        }
        let authored = self.authoring.author(point, self.blending)?;
        if authored.location.clamped && self.authoring.space().is_triangulated() {
            return None;
        }
        let made: Vec<(Option<Plane>, usize, f64)> = authored
            .voices()
            .into_iter()
            .map(|(voice, share)| match voice {
                Voice::Texture(index) => (None, index, share),
                Voice::Made(model) => (Some(Plane::new(model)), 0, share),
            })
            .collect();
        let voices: Vec<(&Plane, f64)> = made
            .iter()
            .map(|(plane, index, share)| (plane.as_ref().unwrap_or(self.planes[*index]), *share))
            .collect();
        let level = mixture_level_mps2(&voices, authored.mixing(), self.contact);
        if level <= 0.0 {
            return None;
        }
        let level_db = 20.0 * level.log10();
        if self.quantity == Quantity::Level {
            return Some(level_db);
        }
        let frequencies = frequencies(voices[0].0.rate());
        let density = mixture_psd(&voices, authored.mixing(), self.contact, &frequencies);
        let centroid = centroid_of(&frequencies, &density);
        match self.quantity {
            Quantity::Roughness => {
                let [constant, of_level, of_centroid] = self.prediction?;
                Some(constant + of_level * level_db + of_centroid * centroid.0.ln())
            }
            _ => Some(centroid.0),
        }
    }

    /// Linear regression of the textures' first coordinate on their level in dB and the logarithm of their centroid.
    fn prediction(&self) -> Option<[f64; 3]> {
        let mut columns = [Vec::new(), Vec::new(), Vec::new()];
        let mut target = Vec::new();
        for (texture, at) in self.authoring.space().sites() {
            let plane = self.planes[*texture];
            let grain = plane.at(self.contact);
            if grain.level_mps2 > 0.0 {
                let frequencies = frequencies(plane.rate());
                let centroid = centroid_of(&frequencies, &grain.psd(&frequencies));
                for (column, value) in
                    columns.iter_mut().zip([1.0, 20.0 * grain.level_mps2.log10(), centroid.0.ln()])
                {
                    column.push(value);
                }
                target.push(at.x());
            }
        }
        if target.len() < LEAST_PREDICTED {
            return None;
        }
        // If all textures are equal, the regression has no unique solution.
        let fit = least_squares(&columns, &target).ok()?;
        fit.coefficients.try_into().ok()
    }
}

fn frequencies(rate: Hertz) -> Vec<Hertz> {
    let high = BAND_HZ.1.min(0.5 * rate.0);
    let n = ((high - BAND_HZ.0) / STEP_HZ).floor() as usize;
    (0..=n).map(|i| Hertz(BAND_HZ.0 + i as f64 * STEP_HZ)).collect()
}

fn centroid_of(frequencies: &[Hertz], density: &[f64]) -> Hertz {
    let pairs: Vec<(Hertz, f64)> = frequencies.iter().copied().zip(density.iter().copied()).collect();
    centroid(&pairs, Hertz(BAND_HZ.0), Hertz(BAND_HZ.1))
}

#[cfg(test)]
mod tests {
    use super::{HeatMapper, Quantity};
    use std::sync::Arc;

    use crate::dsp::lsf::lsf_from_ar;
    use crate::space::authoring::{Authoring, Blending, Layers, Models};
    use crate::space::features::{centroid, level_db};
    use crate::space::{Space, SpacePoint};
    use crate::texture::blend::Mode;
    use crate::texture::plane::Plane;
    use crate::texture::{GrainNode, TextureModel};
    use crate::units::{Contact, Hertz};

    const CONTACT: (f64, f64) = (100.0, 1.0);

    fn contact() -> Contact {
        Contact::from_mm_per_s_and_n(CONTACT.0, CONTACT.1)
    }

    fn at(rough_smooth: f64, hard_soft: f64) -> SpacePoint {
        SpacePoint::plane(rough_smooth, hard_soft)
    }

    /// A texture with one resonance and the same level everywhere.
    fn texture(level_mps2: f64, angle: f64) -> TextureModel {
        let lsf = lsf_from_ar(&[-1.6 * angle.cos(), 0.64]).unwrap();
        let node = |mm_per_s: f64, n: f64| {
            let Contact { speed, force } = Contact::from_mm_per_s_and_n(mm_per_s, n);
            GrainNode { speed, force, lsf: lsf.clone(), level_mps2 }
        };
        let nodes = vec![node(50.0, 0.5), node(200.0, 0.5), node(50.0, 2.0), node(200.0, 2.0)];
        TextureModel::new(Hertz(1000.0), nodes, None).unwrap()
    }

    /// Seven textures with different resonances; the level rises by 3 dB for each 10 points towards rough.
    fn seven() -> (Authoring, Vec<Plane>) {
        let places = [
            (10.0, 10.0),
            (90.0, 10.0),
            (50.0, 90.0),
            (50.0, 40.0),
            (30.0, 30.0),
            (70.0, 30.0),
            (40.0, 60.0),
        ];
        let level = |rough: f64| 10.0_f64.powf(-0.3 * rough / 20.0);
        let planes = places
            .iter()
            .enumerate()
            .map(|(i, (rs, _))| Plane::new(&texture(level(*rs), 0.5 + 0.2 * i as f64)));
        let space = Space::new(&places.map(|(rs, hs)| Some(at(rs, hs)))).unwrap();
        (Authoring::new(space), planes.collect())
    }

    fn value(quantity: Quantity, point: SpacePoint) -> Option<f64> {
        let (authoring, planes) = seven();
        let planes: Vec<&Plane> = planes.iter().collect();
        let blending = Blending::from(Mode::Shared);
        HeatMapper::new(&authoring, &planes, &blending, contact(), quantity).at(point)
    }

    /// At the position of a texture, modes that mix signals give that texture, and the values equal those of its
    /// features.
    #[test]
    fn at_a_texture_the_values_are_its_own() {
        let (_, planes) = seven();
        let here = at(50.0, 40.0);
        let level = level_db(&planes[3], &[contact()]).unwrap();
        assert!((value(Quantity::Level, here).unwrap() - level).abs() < 1e-6);
        let known = centroid(&planes[3], &[contact()]).unwrap().0;
        let found = value(Quantity::Centroid, here).unwrap();
        assert!((found - known).abs() < 0.03 * known, "{found} for {known}");
        assert_eq!(value(Quantity::Distance, here), Some(0.0));
        // The levels determine the coordinate exactly.
        assert!((value(Quantity::Roughness, here).unwrap() - 50.0).abs() < 1e-6);
    }

    #[test]
    fn beyond_the_textures_only_the_distance_is_known() {
        let beyond = at(0.0, 100.0);
        for quantity in [Quantity::Level, Quantity::Centroid, Quantity::Roughness] {
            assert_eq!(value(quantity, beyond), None);
        }
        let nearest = at(50.0, 90.0).distance(beyond).min(at(40.0, 60.0).distance(beyond));
        assert!((value(Quantity::Distance, beyond).unwrap() - nearest).abs() < 1e-12);
    }

    /// On three axes, the map shows what plays: the texture at the nearest point of the hull.
    #[test]
    fn beyond_a_hull_without_triangles_the_nearest_point_counts() {
        let place = |i: u32| {
            let along = |factor: u32, range: u32| f64::from(10 + (factor * i) % range);
            SpacePoint::of(&[along(37, 80), along(53, 70), along(29, 60)]).unwrap()
        };
        let places: Vec<SpacePoint> = (0..12).map(place).collect();
        let textures: Vec<TextureModel> =
            places.iter().map(|at| texture(10.0_f64.powf(-0.3 * at.x() / 20.0), 0.9)).collect();
        let planes: Vec<Plane> = textures.iter().map(Plane::new).collect();
        let layers: Vec<Option<Layers<'_>>> =
            textures.iter().zip(&planes).map(|(model, plane)| Some(Layers::of(model, plane))).collect();
        let space = Space::new(&places.iter().map(|at| Some(*at)).collect::<Vec<_>>()).unwrap();
        let models = Models::new(&space, &layers).unwrap();
        let authoring = Authoring::new(space).with_models(Arc::new(models));
        let planes: Vec<&Plane> = planes.iter().collect();
        let blending = Blending::default();
        let beyond = SpacePoint::of(&[95.0, 95.0, 5.0]).unwrap();
        let nearest = authoring.space().locate(beyond).unwrap();
        assert!(nearest.clamped && nearest.at.distance(beyond) > 10.0, "{nearest:?}");
        for quantity in [Quantity::Level, Quantity::Centroid] {
            let mapper = HeatMapper::new(&authoring, &planes, &blending, contact(), quantity);
            let [outside, on_hull] = [beyond, nearest.at].map(|at| mapper.at(at).unwrap());
            assert!((outside - on_hull).abs() < 1e-6, "{outside} for {on_hull}");
        }
    }

    #[test]
    fn few_textures_predict_nothing() {
        let (_, planes) = seven();
        let places = [Some(at(10.0, 10.0)), Some(at(90.0, 10.0)), Some(at(50.0, 90.0))];
        let authoring = Authoring::new(Space::new(&places).unwrap());
        let planes: Vec<&Plane> = planes.iter().collect();
        let blending = Blending::from(Mode::Shared);
        let mapper = HeatMapper::new(&authoring, &planes, &blending, contact(), Quantity::Roughness);
        assert_eq!(mapper.at(at(50.0, 40.0)), None);
        let level = HeatMapper::new(&authoring, &planes, &blending, contact(), Quantity::Level);
        assert!(level.at(at(50.0, 40.0)).is_some(), "the control");
    }
}
