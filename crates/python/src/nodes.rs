//! Nodes of a texture as a structured array, and a texture from such an array.

use numpy::IntoPyArray as _;
use pyo3::types::{PyAnyMethods as _, PyList, PyListMethods as _};
use pyo3::{Bound, PyAny, PyResult, Python};
use shagreen_core::texture::{GrainNode, PublishedNode, TextureModel, TextureModelError};
use shagreen_core::units::{Hertz, MetersPerSecond, Newtons};

use crate::arrays::{column, rows, table};
use crate::errors::refused;

const SPEED: &str = "speed_mps";
const FORCE: &str = "force_n";
const LEVEL: &str = "level_mps2";
const LSF: &str = "lsf_rad";
/// Line spectral frequencies of the moving-average part of a published texture.
const MA_LSF: &str = "ma_lsf_rad";
/// Variance of the excitation of a published texture, in (m/s²)².
const VARIANCE: &str = "variance";
/// Gain of a published texture.
const GAIN: &str = "gain";

/// Returns the nodes of a texture: one row each, with the fields of measured or published nodes.
pub(crate) fn nodes_array<'py>(py: Python<'py>, model: &TextureModel) -> PyResult<Bound<'py, PyAny>> {
    let contacts = || model.contacts();
    let mut numbers = vec![
        (SPEED, contacts().map(|c| c.speed.0).collect()),
        (FORCE, contacts().map(|c| c.force.0).collect()),
    ];
    let measured = model.nodes();
    if !measured.is_empty() {
        numbers.push((LEVEL, measured.iter().map(|node| node.level_mps2).collect()));
        let lsf = measured.iter().map(|node| node.lsf.clone()).collect();
        return structured(py, numbers, vec![(LSF, model.order(), lsf)]);
    }
    let published = model.published_nodes();
    numbers.push((VARIANCE, published.iter().map(|node| node.variance).collect()));
    numbers.push((GAIN, published.iter().map(|node| node.gain).collect()));
    let mut tables = vec![(LSF, model.order(), published.iter().map(|node| node.ar_lsf.clone()).collect())];
    if model.ma_order() > 0 {
        let ma_lsf = published.iter().map(|node| node.ma_lsf.clone()).collect();
        tables.push((MA_LSF, model.ma_order(), ma_lsf));
    }
    structured(py, numbers, tables)
}

/// Returns a structured array: fields with one number for each row, then fields with several.
fn structured<'py>(
    py: Python<'py>,
    numbers: Vec<(&str, Vec<f64>)>,
    tables: Vec<(&str, usize, Vec<Vec<f64>>)>,
) -> PyResult<Bound<'py, PyAny>> {
    let n_rows = numbers.first().map_or(0, |(_, values)| values.len());
    let fields = PyList::empty(py);
    for (name, _) in &numbers {
        fields.append((*name, "f8"))?;
    }
    for (name, n_columns, _) in &tables {
        fields.append((*name, "f8", (*n_columns,)))?;
    }
    let array = py.import("numpy")?.call_method1("zeros", (n_rows, fields))?;
    for (name, values) in numbers {
        array.set_item(name, values.into_pyarray(py))?;
    }
    for (name, n_columns, rows) in tables {
        array.set_item(name, table(py, n_columns, rows)?)?;
    }
    Ok(array)
}

/// Nodes that an array states.
pub(crate) enum Nodes {
    /// Measured nodes.
    Measured(Vec<GrainNode>),
    /// Published nodes.
    Published(Vec<PublishedNode>),
}

impl Nodes {
    /// Reads a structured array with the fields of [`nodes_array`], or a dictionary of arrays with these names. The field
    /// `variance` makes the nodes published ones.
    pub(crate) fn of(nodes: &Bound<'_, PyAny>) -> PyResult<Self> {
        let speeds = numbers(nodes, SPEED, None)?;
        let n_rows = Some(speeds.len());
        let forces = numbers(nodes, FORCE, n_rows)?;
        let lsf = lists(nodes, LSF, n_rows)?;
        let speeds = speeds.into_iter().map(MetersPerSecond);
        let contacts = speeds.zip(forces.into_iter().map(Newtons)).zip(lsf);
        if field(nodes, VARIANCE)?.is_none() {
            let levels = numbers(nodes, LEVEL, n_rows)?;
            let node = |(((speed, force), lsf), level_mps2)| GrainNode { speed, force, lsf, level_mps2 };
            return Ok(Self::Measured(contacts.zip(levels).map(node).collect()));
        }
        let (variances, gains) = (numbers(nodes, VARIANCE, n_rows)?, numbers(nodes, GAIN, n_rows)?);
        let ma_lsf = match field(nodes, MA_LSF)? {
            Some(_) => lists(nodes, MA_LSF, n_rows)?,
            None => vec![Vec::new(); variances.len()],
        };
        let node = |((((speed, force), ar_lsf), ma_lsf), (variance, gain))| PublishedNode {
            speed,
            force,
            ar_lsf,
            ma_lsf,
            variance,
            gain,
        };
        let rows = contacts.zip(ma_lsf).zip(variances.into_iter().zip(gains));
        Ok(Self::Published(rows.map(node).collect()))
    }

    /// Returns the texture with these nodes.
    pub(crate) fn into_model(
        self,
        rate: Hertz,
        friction: Option<f64>,
    ) -> Result<TextureModel, TextureModelError> {
        match self {
            Self::Measured(nodes) => TextureModel::new(rate, nodes, friction),
            Self::Published(nodes) => TextureModel::published(rate, nodes, friction),
        }
    }
}

/// Returns a field as a contiguous array of `float64`; `None` if there is none of this name.
fn field<'py>(nodes: &Bound<'py, PyAny>, name: &str) -> PyResult<Option<Bound<'py, PyAny>>> {
    let Ok(value) = nodes.get_item(name) else { return Ok(None) };
    let numpy = nodes.py().import("numpy")?;
    match numpy.call_method1("ascontiguousarray", (value, "f8")) {
        Ok(array) => Ok(Some(array)),
        Err(error) => Err(refused(format!("the field {name} of the nodes holds no numbers: {error}"))),
    }
}

fn required<'py>(nodes: &Bound<'py, PyAny>, name: &str) -> PyResult<Bound<'py, PyAny>> {
    field(nodes, name)?.ok_or_else(|| {
        refused(format!(
            "the nodes have no field {name}; give a structured array, or a dictionary of arrays, with the fields {SPEED}, {FORCE}, {LEVEL} and {LSF}"
        ))
    })
}

/// Returns a field with one number for each row.
fn numbers(nodes: &Bound<'_, PyAny>, name: &str, n_rows: Option<usize>) -> PyResult<Vec<f64>> {
    let values = column(&required(nodes, name)?, name)?;
    check_rows(name, values.len(), n_rows)?;
    Ok(values)
}

/// Returns a field with several numbers for each row.
fn lists(nodes: &Bound<'_, PyAny>, name: &str, n_rows: Option<usize>) -> PyResult<Vec<Vec<f64>>> {
    let values = rows(&required(nodes, name)?, name)?;
    check_rows(name, values.len(), n_rows)?;
    Ok(values)
}

fn check_rows(name: &str, n: usize, expected: Option<usize>) -> PyResult<()> {
    match expected.filter(|expected| *expected != n) {
        Some(expected) => Err(refused(format!("the field {name} has {n} rows, but {SPEED} has {expected}"))),
        None => Ok(()),
    }
}
