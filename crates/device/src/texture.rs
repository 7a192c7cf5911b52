//! A prepared texture that owns its numbers and lends them to the callback.

use shagreen_synth::texture::{self, Node, Texture, Triangle};

/// Why numbers do not make a texture.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
#[error(
    "a texture of order {order} at {rate_hz} Hz with {n_nodes} nodes and {n_triangles} triangles \
     cannot be played: {}", explain(*.reason)
)]
pub struct TextureError {
    /// The rule that is broken.
    pub reason: texture::TextureError,
    /// Order that was given.
    pub order: usize,
    /// Rate that was given, in Hz.
    pub rate_hz: f32,
    /// Nodes that were given.
    pub n_nodes: usize,
    /// Triangles that were given.
    pub n_triangles: usize,
}

fn explain(reason: texture::TextureError) -> &'static str {
    match reason {
        texture::TextureError::Order => "the order is zero or too high",
        texture::TextureError::Range => "the rate, or the largest speed or force, is not a positive number",
        texture::TextureError::Triangle => "there is no triangle, or one names a node that does not exist",
        texture::TextureError::Number => "a number is not finite, or frequencies do not ascend",
        _ => "it breaks a rule of the renderer",
    }
}

/// A prepared texture: nodes over (speed, force) and their triangulation, checked once.
#[derive(Clone, Debug, PartialEq)]
pub struct OwnedTexture {
    rate_hz: f32,
    order: usize,
    speed_max_mps: f32,
    force_max_n: f32,
    nodes: Box<[Node]>,
    triangles: Box<[Triangle]>,
}

impl OwnedTexture {
    /// A texture at `rate_hz` with predictors of `order`, measured up to `speed_max_mps` and `force_max_n`.
    ///
    /// # Errors
    /// [`TextureError`] where the renderer would refuse it.
    pub fn new(
        rate_hz: f32,
        order: usize,
        speed_max_mps: f32,
        force_max_n: f32,
        nodes: Box<[Node]>,
        triangles: Box<[Triangle]>,
    ) -> Result<Self, TextureError> {
        match Texture::new(rate_hz, order, speed_max_mps, force_max_n, &nodes, &triangles) {
            Ok(_) => Ok(Self { rate_hz, order, speed_max_mps, force_max_n, nodes, triangles }),
            Err(reason) => Err(TextureError {
                reason,
                order,
                rate_hz,
                n_nodes: nodes.len(),
                n_triangles: triangles.len(),
            }),
        }
    }

    /// Samples a second of the model, in Hz.
    pub fn rate_hz(&self) -> f32 {
        self.rate_hz
    }

    /// The texture as the renderer sees it: checked when it was made, and unchanged since.
    pub fn view(&self) -> Texture<'_> {
        Texture::checked_before(
            self.rate_hz,
            self.order,
            self.speed_max_mps,
            self.force_max_n,
            &self.nodes,
            &self.triangles,
        )
    }
}

#[cfg(test)]
pub(crate) mod tests {
    use super::OwnedTexture;
    use shagreen_synth::contact::Contact;
    use shagreen_synth::texture::{self, MAX_ORDER, NO_NEIGHBOR, Node, Triangle};

    /// White noise of `level_mps2` at 1 m/s and 1 N, in proportion to the smaller of speed and force below that.
    pub(crate) fn white(level_mps2: f32) -> OwnedTexture {
        white_at(1000.0, level_mps2).unwrap()
    }

    pub(crate) fn white_at(rate_hz: f32, level_mps2: f32) -> Result<OwnedTexture, super::TextureError> {
        // Evenly spread frequencies make a predictor of zeros, with a gain of one.
        let mut lsf = [0.0; MAX_ORDER];
        (lsf[0], lsf[1]) = (core::f32::consts::PI / 3.0, core::f32::consts::PI * 2.0 / 3.0);
        let node = |level_mps2| Node { level_mps2, lsf };
        let nodes = [node(0.0), node(0.0), node(level_mps2), node(0.0)];
        let triangle = |nodes, neighbors, weights| Triangle { nodes, neighbors, weights, ln_gain: [0.0; 6] };
        let triangles = [
            triangle([0, 1, 2], [NO_NEIGHBOR, 1, NO_NEIGHBOR], [-1.0, 0.0, 1.0, 1.0, -1.0, 0.0]),
            triangle([0, 2, 3], [NO_NEIGHBOR, NO_NEIGHBOR, 0], [0.0, -1.0, 1.0, 1.0, 0.0, 0.0]),
        ];
        OwnedTexture::new(rate_hz, 2, 1.0, 1.0, nodes.into(), triangles.into())
    }

    #[test]
    fn lends_what_it_was_given() {
        let texture = white(2.0);
        let view = texture.view();
        assert_eq!((view.rate_hz(), view.order()), (1000.0, 2));
        let at = view.evaluate(Contact { speed_mps: 1.0, force_n: 1.0 }, &mut 0);
        assert_eq!(at.level_mps2, 2.0);
    }

    #[test]
    fn refuses_with_the_numbers() {
        let error = white_at(f32::NAN, 1.0).unwrap_err();
        assert_eq!(error.reason, texture::TextureError::Range);
        let text = white_at(1000.0, f32::INFINITY).unwrap_err().to_string();
        assert!(text.contains("order 2") && text.contains("4 nodes") && text.contains("finite"), "{text}");
    }
}
