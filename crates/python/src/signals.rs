//! Comparison of signals and of textures.

use std::path::PathBuf;
use std::sync::Arc;

use pyo3::types::{PyDict, PyDictMethods as _};
use pyo3::{Bound, PyAny, PyResult, Python, pyfunction};
use shagreen_core::dsp::filter::resample;
use shagreen_core::signals::quality::{Feature, Features, PAPER_RATE, Relation};
use shagreen_core::units::Hertz;
use shagreen_formats::signal::RATES_HZ;
use shagreen_formats::thresholds::ThresholdKind;
use shagreen_studio::quality_model::load_quality_model;
use shagreen_studio::signal_quality::compare_signals;
use shagreen_studio::texture_difference::texture_difference;

use crate::arguments::number;
use crate::arrays::column;
use crate::errors::{refused, run};
use crate::texture::PyTexture;

/// Name of a column of features, and its value.
type Column = (&'static str, fn(Features) -> f64);

/// Compares a signal with a reference, as `shagreen quality` does: features, predicted discriminability d', ST-SIM, SPQI and
/// signal-to-noise ratio.
///
/// Both are accelerations in m/s², arrays of the shape (n,) at `rate_hz`, compared sample by sample in segments of 0.8 s.
/// `threshold` is "held-tool", "pacinian" or "composite", by default that of the model. `model` is a file of `shagreen quality
/// fit`, by default the built-in model. `d_prime` is a prediction for a processed version of the reference, which no person
/// rated: use it only where `d_prime_applies`. Returns a dictionary; `features` has two numbers each, of the reference and of
/// the other signal.
#[pyfunction]
#[pyo3(signature = (reference, test, rate_hz, *, threshold=None, model=None))]
pub(crate) fn quality<'py>(
    py: Python<'py>,
    reference: &Bound<'py, PyAny>,
    test: &Bound<'py, PyAny>,
    rate_hz: &Bound<'py, PyAny>,
    threshold: Option<&str>,
    model: Option<PathBuf>,
) -> PyResult<Bound<'py, PyDict>> {
    let (reference, test) = (column(reference, "reference")?, column(test, "test")?);
    for (name, signal) in [("reference", &reference), ("test", &test)] {
        if let Some(index) = signal.iter().position(|value| !value.is_finite()) {
            return Err(refused(format!("{name}[{index}] is not a finite number; cut it out")));
        }
    }
    let rate = Hertz(number(rate_hz, "rate_hz", &RATES_HZ, " Hz")?);
    let kind = |threshold: &str| {
        ThresholdKind::from_id(threshold).ok_or_else(|| {
            let known = ThresholdKind::ALL.map(ThresholdKind::id).join(", ");
            refused(format!("there is no threshold \"{threshold}\"; choose one of {known}"))
        })
    };
    let kind = threshold.map(kind).transpose()?;
    let quality = run(py, move |reporter| {
        let at_rate = |signal: Vec<f64>| {
            if rate == PAPER_RATE { signal } else { resample(&signal, rate, PAPER_RATE) }
        };
        let model = load_quality_model(model.as_deref())?;
        if let Some(doubt) = model.doubt() {
            reporter.warn(&doubt);
        }
        let kind = kind.unwrap_or(model.threshold());
        compare_signals(&at_rate(reference), &at_rate(test), kind, &model.file.model, reporter)
    })?;
    let result = PyDict::new(py);
    let relation = quality.agreement.relation();
    result.set_item("d_prime", quality.d_prime)?;
    result.set_item("d_prime_applies", relation == Relation::Processed)?;
    result.set_item("waveform_correlation", quality.agreement.correlation)?;
    result.set_item("octave_levels_differ_db", quality.agreement.spectra_db)?;
    result.set_item("st_sim", quality.st_sim)?;
    result.set_item("spqi", quality.spqi)?;
    result.set_item("snr_db", quality.snr_db)?;
    result.set_item("seconds", quality.seconds)?;
    result.set_item("rate_hz", PAPER_RATE.0)?;
    let distances = PyDict::new(py);
    for feature in Feature::ALL {
        distances.set_item(feature.id(), quality.distances.by(feature))?;
    }
    result.set_item("distances", distances)?;
    let features = PyDict::new(py);
    let columns: [Column; 4] = [
        ("roughness", |of| of.roughness),
        ("brightness_hz", |of| of.brightness_hz),
        ("regularity", |of| of.regularity),
        ("asymmetry", |of| of.asymmetry),
    ];
    for (name, of) in columns {
        let [reference, test] = quality.features.map(of);
        features.set_item(name, (reference, test))?;
    }
    result.set_item("features", features)?;
    Ok(result)
}

/// Measures the spectral difference of two textures, as the leave-one-out evaluation does: at nine speeds and forces, in 40
/// frequency channels from 20 to 480 Hz.
///
/// Returns a dictionary: `error_db` (root mean square of the channel levels), `level_error_db` (mean of the total level) and
/// `shape_error_db` (what remains of the first with one gain for all channels). It is measured on signals; no person rated it.
#[pyfunction]
pub(crate) fn difference<'py>(py: Python<'py>, a: &PyTexture, b: &PyTexture) -> PyResult<Bound<'py, PyDict>> {
    let [a, b] = [a, b].map(|texture| Arc::clone(&texture.0));
    let difference = run(py, move |reporter| texture_difference(&a.entry()?, &b.entry()?, reporter))?;
    let result = PyDict::new(py);
    result.set_item("error_db", difference.error_db)?;
    result.set_item("level_error_db", difference.level_error_db)?;
    result.set_item("shape_error_db", difference.shape_error_db)?;
    Ok(result)
}
