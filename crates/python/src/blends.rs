//! Weighted blends of a few textures.

use std::sync::Arc;

use pyo3::types::PyDict;
use pyo3::{Bound, PyRef, PyResult, Python, pyfunction};
use shagreen_studio::weighted_blend::weighted_blend;

use crate::arguments::{mode_of, shape_of};
use crate::errors::run;
use crate::sounding::Sounding;
use crate::texture::PyTexture;

/// Interpolates one to three textures with weights, without positions in a space.
///
/// `weights` are 0 or more, and are divided by their sum. `mode` is "parametric" (one texture with the mean spectral envelope and
/// level), "shared" (mixed signals with one noise) or "power" (mixed independent signals, at the mean level). `shape` is a
/// dictionary with the controls of `Texture.shaped`.
#[pyfunction]
#[pyo3(signature = (textures, weights, *, mode="parametric", shape=None, name="Blend"))]
pub(crate) fn blend(
    py: Python<'_>,
    textures: Vec<PyRef<'_, PyTexture>>,
    weights: Vec<f64>,
    mode: &str,
    shape: Option<&Bound<'_, PyDict>>,
    name: &str,
) -> PyResult<PyTexture> {
    let (mode, shape, name) = (mode_of(mode)?, shape_of(shape)?, name.to_owned());
    let soundings: Vec<Arc<Sounding>> = textures.iter().map(|texture| Arc::clone(&texture.0)).collect();
    drop(textures);
    let sounding = run(py, move |reporter| {
        let entries = soundings.iter().map(|sounding| sounding.entry()).collect::<anyhow::Result<_>>()?;
        let (library, sound) = weighted_blend(entries, &weights, (mode, &shape), reporter)?;
        Ok(Sounding { library: Arc::new(library), sound, name })
    })?;
    Ok(PyTexture::new(sounding))
}
