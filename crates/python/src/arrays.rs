//! Columns of numbers from arrays, and arrays from columns of numbers.

use std::ops::RangeInclusive;

use numpy::ndarray::{Array2, Dimension};
use numpy::{
    Element, IntoPyArray as _, PyArray, PyArray1, PyArray2, PyArray3, PyArrayDescr, PyArrayDescrMethods as _,
    PyArrayMethods as _, PyUntypedArray, PyUntypedArrayMethods as _, dtype,
};
use pyo3::exceptions::PyTypeError;
use pyo3::types::PyAnyMethods as _;
use pyo3::{Bound, PyAny, PyErr, PyResult, Python};

use crate::arguments::{number, type_name};
use crate::errors::refused;

/// Returns a one-dimensional array of `float64` or `float32` as numbers.
pub(crate) fn column(value: &Bound<'_, PyAny>, name: &str) -> PyResult<Vec<f64>> {
    if let Ok(array) = value.cast::<PyArray1<f64>>() {
        return values(array, name);
    }
    if let Ok(array) = value.cast::<PyArray1<f32>>() {
        return Ok(values(array, name)?.into_iter().map(f64::from).collect());
    }
    Err(no_array(value, name, "a one-dimensional array of float64 or float32"))
}

/// Returns the columns of a one-dimensional array, or those of a two-dimensional one of the shape (rows, columns), of `float64` or
/// `float32`.
pub(crate) fn columns(value: &Bound<'_, PyAny>, name: &str) -> PyResult<Vec<Vec<f64>>> {
    if let Ok(array) = value.cast::<PyArray2<f64>>() {
        return columns_of(array, name);
    }
    if let Ok(array) = value.cast::<PyArray2<f32>>() {
        return columns_of(array, name);
    }
    if let Ok(array) = value.cast::<PyUntypedArray>()
        && array.ndim() != 1
    {
        return Err(no_array(value, name, "an array of float64 or float32 with one or two dimensions"));
    }
    Ok(vec![column(value, name)?])
}

fn columns_of<T: Element + Copy + Into<f64>>(
    array: &Bound<'_, PyArray2<T>>,
    name: &str,
) -> PyResult<Vec<Vec<f64>>> {
    let array = array.try_readonly()?;
    if !array.is_aligned() {
        return Err(not_contiguous(name));
    }
    let columns = array.as_array();
    Ok(columns.columns().into_iter().map(|column| column.iter().map(|x| (*x).into()).collect()).collect())
}

/// Returns the rows of a two-dimensional array of `float64`.
pub(crate) fn rows(value: &Bound<'_, PyAny>, name: &str) -> PyResult<Vec<Vec<f64>>> {
    let Ok(array) = value.cast::<PyArray2<f64>>() else {
        return Err(no_array(value, name, "a two-dimensional array of float64"));
    };
    let array = array.try_readonly()?;
    if !array.is_aligned() {
        return Err(not_contiguous(name));
    }
    Ok(array.as_array().rows().into_iter().map(|row| row.to_vec()).collect())
}

/// Width, height and pixels of an array of the shape (height, width, 3) of `uint8`.
pub(crate) fn pixels(value: &Bound<'_, PyAny>, name: &str) -> PyResult<(usize, usize, Vec<u8>)> {
    const WANTED: &str = "a path, or an array of uint8 of the shape (height, width, 3)";
    let Ok(array) = value.cast::<PyArray3<u8>>() else { return Err(no_array(value, name, WANTED)) };
    let &[height, width, 3] = array.shape() else { return Err(no_array(value, name, WANTED)) };
    if !array.is_c_contiguous() {
        return Err(not_contiguous(name));
    }
    Ok((width, height, values(array, name)?))
}

/// A quantity of a stroke: the same all the time, or one number for each row.
pub(crate) enum Track {
    /// Constant.
    Constant(f64),
    /// One number for each row.
    Column(Vec<f64>),
}

impl Track {
    /// Reads a number or a one-dimensional array. All numbers must be within a range; `unit` begins with a space.
    pub(crate) fn of(
        value: &Bound<'_, PyAny>,
        name: &str,
        range: &RangeInclusive<f64>,
        unit: &str,
    ) -> PyResult<Self> {
        if !value.is_instance_of::<PyUntypedArray>() {
            return Ok(Self::Constant(number(value, name, range, unit)?));
        }
        let column = column(value, name)?;
        if let Some((row, value)) = column.iter().enumerate().find(|(_, value)| !range.contains(value)) {
            return Err(refused(format!(
                "{name}[{row}] is {value}; it must be from {} to {}{unit}",
                range.start(),
                range.end()
            )));
        }
        Ok(Self::Column(column))
    }

    /// Returns the number at a row, which must exist.
    pub(crate) fn at(&self, row: usize) -> f64 {
        match self {
            Self::Constant(value) => *value,
            Self::Column(column) => column[row],
        }
    }

    /// Returns the number of rows; `None` for a constant.
    pub(crate) fn n_rows(&self) -> Option<usize> {
        match self {
            Self::Constant(_) => None,
            Self::Column(column) => Some(column.len()),
        }
    }
}

/// Returns samples as an array of this type, `float32` by default, which takes them over without a copy.
pub(crate) fn samples_array(py: Python<'_>, samples: Vec<f32>, wanted: SampleType) -> Bound<'_, PyAny> {
    match wanted {
        SampleType::Float32 => samples.into_pyarray(py).into_any(),
        SampleType::Float64 => {
            samples.into_iter().map(f64::from).collect::<Vec<f64>>().into_pyarray(py).into_any()
        }
    }
}

/// Type of returned samples.
#[derive(Clone, Copy)]
pub(crate) enum SampleType {
    /// That of the renderer.
    Float32,
    /// Wider, with the same values.
    Float64,
}

impl SampleType {
    /// Reads a type of NumPy, or its name.
    pub(crate) fn of(value: Option<&Bound<'_, PyAny>>) -> PyResult<Self> {
        let Some(value) = value else { return Ok(Self::Float32) };
        let py = value.py();
        let wanted = PyArrayDescr::new(py, value)?;
        if wanted.is_equiv_to(&dtype::<f32>(py)) {
            Ok(Self::Float32)
        } else if wanted.is_equiv_to(&dtype::<f64>(py)) {
            Ok(Self::Float64)
        } else {
            Err(PyTypeError::new_err(format!("dtype must be float32 or float64, not {wanted}")))
        }
    }
}

/// Returns rows of the same length as a two-dimensional array, without a copy. `n_columns` is their length.
pub(crate) fn table<T: Element>(
    py: Python<'_>,
    n_columns: usize,
    rows: Vec<Vec<T>>,
) -> PyResult<Bound<'_, PyArray2<T>>> {
    let shape = (rows.len(), n_columns);
    let table = Array2::from_shape_vec(shape, rows.into_iter().flatten().collect());
    Ok(table.map_err(|error| refused(error.to_string()))?.into_pyarray(py))
}

fn values<T: Element + Copy, D: Dimension>(array: &Bound<'_, PyArray<T, D>>, name: &str) -> PyResult<Vec<T>> {
    let array = array.try_readonly()?;
    let values = array.as_slice().map_err(|_| not_contiguous(name))?;
    Ok(values.to_vec())
}

fn not_contiguous(name: &str) -> PyErr {
    refused(format!("{name} is not contiguous in memory; pass numpy.ascontiguousarray({name})"))
}

fn no_array(value: &Bound<'_, PyAny>, name: &str, wanted: &str) -> PyErr {
    let is = match value.cast::<PyUntypedArray>() {
        Ok(array) => format!("an array of {} with {} dimensions", array.dtype(), array.ndim()),
        Err(_) => type_name(value),
    };
    PyTypeError::new_err(format!("{name} must be {wanted}, not {is}"))
}
