//! Textures fitted to recorded strokes.

use anyhow::anyhow;
use pyo3::types::{PyDict, PyDictMethods as _};
use pyo3::{Bound, PyAny, PyResult, Python, pyfunction};
use shagreen_core::recording::fit::{FitOptions, Fitted, HeldOut, fit as fit_model};
use shagreen_core::recording::{
    MAX_RATE_HZ, MIN_RATE_HZ, RawClock, RawMotion, RawRecording, RawTrack, Recording,
};
use shagreen_core::texture::{MAX_ORDER, RATES_HZ};
use shagreen_core::units::Hertz;
use shagreen_formats::library::{TextureEntry, id_from_name};

use crate::arguments::{number, whole};
use crate::arrays::{Track, columns};
use crate::errors::{run, warn};
use crate::sounding::Sounding;
use crate::strokes::{forces, speeds};
use crate::texture::PyTexture;

/// Fits a texture to a recorded stroke, as `shagreen import recording` does.
///
/// `acceleration_mps2` is an array of float64 or float32 of the shape (n,), or (n, axes) with up to three axes, in m/s², and
/// `rate_hz` its sample rate in Hz. `speed_mps` (m/s) and `force_n` (N) are arrays of the shape (n,) or numbers; the tip is lifted where the force is 0. `model_rate_hz` and `order` of the
/// model are selected from the data by default.
///
/// Returns the texture and a dictionary with its `segments`, `rate_hz`, `order`, `coverage` of the plane of speed and force (0 to
/// 1), median goodness of fit `gfc_median` (0 to 1), median level error `level_error_db_median`, and whether both were
/// `held_out` (in blocks of the same strokes if `held_out_blocks`).
#[pyfunction]
#[pyo3(signature = (
    acceleration_mps2, speed_mps, force_n, rate_hz, *, name="Recording", license="", model_rate_hz=None, order=None
))]
pub(crate) fn fit<'py>(
    py: Python<'py>,
    acceleration_mps2: &Bound<'py, PyAny>,
    speed_mps: &Bound<'py, PyAny>,
    force_n: &Bound<'py, PyAny>,
    rate_hz: &Bound<'py, PyAny>,
    name: &str,
    license: &str,
    model_rate_hz: Option<&Bound<'py, PyAny>>,
    order: Option<&Bound<'py, PyAny>>,
) -> PyResult<(PyTexture, Bound<'py, PyDict>)> {
    let recorded_at = number(rate_hz, "rate_hz", &(MIN_RATE_HZ..=MAX_RATE_HZ), " Hz")?;
    let raw = RawRecording {
        clock: RawClock::Rate(Hertz(recorded_at)),
        acceleration_mps2: columns(acceleration_mps2, "acceleration_mps2")?,
        motion: RawMotion::Speed(raw_track(speeds(speed_mps)?)),
        force_n: raw_track(forces(force_n)?),
        full_scale_mps2: None,
    };
    let rate = model_rate_hz.map(|value| number(value, "model_rate_hz", &RATES_HZ, " Hz")).transpose()?;
    let order = order.map(|value| whole(value, "order", 1..=MAX_ORDER as u64)).transpose()?;
    let options =
        FitOptions { rate: rate.map(Hertz), order: order.map(|order| order as usize), ..FitOptions::usual() };
    let (name, license) = (name.to_owned(), license.to_owned());
    let (fitted, warnings) = run(py, move |_| {
        let (recording, findings) = Recording::from_raw(raw).map_err(|error| anyhow!("{error}"))?;
        let fitted = fit_model(&[recording], &options)?;
        let warnings = findings.iter().filter(|finding| !finding.is_ordinary()).map(ToString::to_string);
        let warnings: Vec<String> = warnings.chain(fitted.report.notes.iter().cloned()).collect();
        Ok((fitted, warnings))
    })?;
    warn(py, &warnings)?;
    let Fitted { model, report } = fitted;
    let result = PyDict::new(py);
    result.set_item("segments", report.segments.len())?;
    result.set_item("rate_hz", report.rate.0)?;
    result.set_item("order", report.order)?;
    result.set_item("coverage", report.coverage)?;
    result.set_item("gfc_median", report.gfc_median())?;
    result.set_item("level_error_db_median", report.level_error_db_median())?;
    result.set_item("held_out", report.held_out.is_any())?;
    result.set_item("held_out_blocks", report.held_out == HeldOut::Blocks)?;
    let sounding = run(py, move |_| {
        let origin = "Fitted to a recording that a script gave.".to_owned();
        Sounding::of_entry(TextureEntry {
            license,
            origin,
            ..TextureEntry::new(id_from_name(&name), name, model)
        })
    })?;
    Ok((PyTexture::new(sounding), result))
}

fn raw_track(track: Track) -> RawTrack {
    match track {
        Track::Constant(value) => RawTrack::Constant(value),
        Track::Column(values) => RawTrack::Column(values),
    }
}
