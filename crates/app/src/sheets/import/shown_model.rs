//! Selection among the textures of an imported file.

use std::collections::BTreeMap;

/// Texture and nodes that are selected.
#[derive(Clone, Debug, Default)]
pub struct ShownModel {
    /// Index of the texture.
    pub(super) texture: usize,
    /// Index of the selected node, by index of the texture.
    pub(super) nodes: BTreeMap<usize, usize>,
    /// Spectrum of that texture at that node, computed once: evaluating a plane takes too long for every frame.
    pub(super) spectrum: Option<((usize, usize), Vec<f64>)>,
}
