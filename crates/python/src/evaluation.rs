//! The leave-one-out evaluation of a library, as a dictionary of arrays.

use std::sync::Arc;

use numpy::IntoPyArray as _;
use pyo3::exceptions::PyTypeError;
use pyo3::types::{PyAnyMethods as _, PyDict, PyDictMethods as _};
use pyo3::{Bound, PyAny, PyErr, PyResult, Python};
use shagreen_core::space::authoring::Blending;
use shagreen_core::space::leave_one_out::{LeaveOneOut, LeftOut, Outcome, Plan, SignalPlan, Summary};
use shagreen_core::texture::blend::Mode;
use shagreen_formats::evaluation_report::{MEASURED, best, method_id, position_caveat};
use shagreen_formats::library::Library;
use shagreen_studio::evaluation::{evaluate_interpolation, supported};

use crate::arguments::{mode_of, type_name};
use crate::arrays::table;
use crate::errors::run;

/// Word for all modes.
const ALL: &str = "all";

/// What is evaluated.
pub(crate) struct Wanted {
    /// Modes.
    pub(crate) modes: Vec<Mode>,
    /// Number of textures that are rendered.
    pub(crate) n_signals: usize,
    /// Duration of each rendered signal, in s.
    pub(crate) seconds: f64,
    /// Random seed of the noise.
    pub(crate) seed: u64,
}

/// Reads a mode, a list of modes, or the word for all of them. Without a value, it is the default mode.
pub(crate) fn modes_of(value: Option<&Bound<'_, PyAny>>) -> PyResult<Vec<Mode>> {
    let Some(value) = value else { return Ok(vec![Mode::default()]) };
    if let Ok(id) = value.extract::<String>() {
        return if id == ALL { Ok(Mode::ALL.to_vec()) } else { Ok(vec![mode_of(&id)?]) };
    }
    let ids = value.extract::<Vec<String>>().map_err(|_| {
        PyTypeError::new_err(format!("modes must be a mode or a list of modes, not {}", type_name(value)))
    })?;
    ids.iter().map(|id| mode_of(id)).collect()
}

/// Evaluates the interpolation of a library. Ctrl-C stops it.
pub(crate) fn evaluated<'py>(
    py: Python<'py>,
    library: &Arc<Library>,
    wanted: Wanted,
) -> PyResult<Bound<'py, PyDict>> {
    let mut interrupt: Option<PyErr> = None;
    let measured = run(py, |reporter| {
        let blendings = wanted.modes.into_iter().map(Blending::from).collect();
        let signals = SignalPlan { n_textures: wanted.n_signals, seconds: wanted.seconds, seed: wanted.seed };
        let plan = Plan {
            blendings: supported(blendings, library.axis_names().len(), reporter),
            signals: (wanted.n_signals > 0).then_some(signals),
        };
        evaluate_interpolation(library, &plan, &mut |_, _| {
            interrupt = Python::attach(|py| py.check_signals().err());
            interrupt.is_none()
        })
    });
    match interrupt {
        Some(interrupt) => Err(interrupt),
        None => result(py, library, &measured?),
    }
}

fn result<'py>(py: Python<'py>, library: &Library, measured: &LeaveOneOut) -> PyResult<Bound<'py, PyDict>> {
    let id = |texture: usize| library.textures[texture].id.as_str();
    let ids =
        |of: fn(&LeftOut) -> usize| measured.textures.iter().map(|left| id(of(left))).collect::<Vec<&str>>();
    let n_axes = library.axis_names().len();
    let at = measured.textures.iter().map(|left| left.at.coordinates().to_vec()).collect();
    let result = PyDict::new(py);
    let methods: Vec<&str> = measured.methods.iter().map(|summary| method_id(&summary.method)).collect();
    result.set_item("methods", methods)?;
    result.set_item("best", best(measured).map(|summary| method_id(&summary.method)))?;
    result.set_item("measured", MEASURED)?;
    result.set_item("position_caveat", position_caveat(library))?;
    result.set_item("reach_db", measured.reach_db)?;
    result.set_item("ids", ids(|left| left.texture))?;
    result.set_item("nearest", ids(|left| left.nearest))?;
    result.set_item("at", table::<f64>(py, n_axes, at)?)?;
    result.set_item("on_hull", measured.on_hull.iter().map(|texture| id(*texture)).collect::<Vec<_>>())?;
    let columns: [Column<Outcome>; 5] = [
        ("error_db", |outcome| outcome.error_db),
        ("level_error_db", |outcome| outcome.level_error_db),
        ("shape_error_db", |outcome| outcome.shape_error_db),
        ("nrs", |outcome| outcome.nrs.unwrap_or(f64::NAN)),
        ("signal_error_db", |outcome| outcome.signal_error_db.unwrap_or(f64::NAN)),
    ];
    for (name, of) in columns {
        result.set_item(name, table(py, measured.textures.len(), by_method(measured, of))?)?;
    }
    let ranks = by_method(measured, |outcome| outcome.rank as u64);
    result.set_item("rank", table(py, measured.textures.len(), ranks)?)?;
    result.set_item("summary", summary(py, measured)?)?;
    Ok(result)
}

/// One row for each method, with one value for each texture.
fn by_method<T>(measured: &LeaveOneOut, of: impl Fn(&Outcome) -> T) -> Vec<Vec<T>> {
    let row = |method: usize| measured.textures.iter().map(|left| of(&left.outcomes[method])).collect();
    (0..measured.methods.len()).map(row).collect()
}

/// Name of a column, and its value for a row.
type Column<T> = (&'static str, fn(&T) -> f64);

/// The means of each method as arrays.
fn summary<'py>(py: Python<'py>, measured: &LeaveOneOut) -> PyResult<Bound<'py, PyDict>> {
    let result = PyDict::new(py);
    let columns: [Column<Summary>; 8] = [
        ("error_db_mean", |summary| summary.error_db_mean),
        ("error_db_median", |summary| summary.error_db_median),
        ("level_error_db_mean", |summary| summary.level_error_db_mean),
        ("shape_error_db_mean", |summary| summary.shape_error_db_mean),
        ("rank1", |summary| summary.rank1),
        ("top5", |summary| summary.top5),
        ("nrs_mean", |summary| summary.nrs_mean.unwrap_or(f64::NAN)),
        ("signal_error_db_mean", |summary| summary.signals.map_or(f64::NAN, |check| check.error_db_mean)),
    ];
    for (name, of) in columns {
        let values: Vec<f64> = measured.methods.iter().map(of).collect();
        result.set_item(name, values.into_pyarray(py))?;
    }
    Ok(result)
}
