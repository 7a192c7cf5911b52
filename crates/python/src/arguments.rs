//! Arguments of Python functions that are no arrays: numbers within a range, points, shapes and modes.

use std::ops::RangeInclusive;
use std::str::FromStr as _;

use pyo3::exceptions::{PyOverflowError, PyTypeError};
use pyo3::types::{PyAnyMethods as _, PyDict, PyDictMethods as _, PyTypeMethods as _};
use pyo3::{Bound, PyAny, PyResult};
use shagreen_core::space::SpacePoint;
use shagreen_core::texture::blend::Mode;
use shagreen_core::texture::shape::Shape;
use shagreen_formats::library::Library;
use shagreen_studio::points::{named_point, point_of};
use shagreen_studio::report::Reporter;

use crate::errors::refused;

/// Returns the name of the type of a value.
pub(crate) fn type_name(value: &Bound<'_, PyAny>) -> String {
    value.get_type().name().map_or_else(|_| "another type".to_owned(), |name| name.to_string())
}

/// Returns a number, which may be any.
pub(crate) fn any_number(value: &Bound<'_, PyAny>, name: &str) -> PyResult<f64> {
    match value.extract::<f64>() {
        Ok(number) => Ok(number),
        // A whole number beyond all floats.
        Err(error) if error.is_instance_of::<PyOverflowError>(value.py()) => Ok(f64::INFINITY),
        Err(_) => Err(PyTypeError::new_err(format!("{name} must be a number, not {}", type_name(value)))),
    }
}

/// Returns a number within a range; `unit` is empty or follows the number as it is.
pub(crate) fn number(
    value: &Bound<'_, PyAny>,
    name: &str,
    range: &RangeInclusive<f64>,
    unit: &str,
) -> PyResult<f64> {
    within(any_number(value, name)?, name, range, unit)
}

/// Checks that a number is within a range.
pub(crate) fn within(value: f64, name: &str, range: &RangeInclusive<f64>, unit: &str) -> PyResult<f64> {
    if range.contains(&value) {
        return Ok(value);
    }
    Err(refused(format!("{name} is {value}; it must be from {} to {}{unit}", range.start(), range.end())))
}

/// Returns a whole number within a range.
pub(crate) fn whole(value: &Bound<'_, PyAny>, name: &str, range: RangeInclusive<u64>) -> PyResult<u64> {
    let number = match value.extract::<u64>() {
        Ok(number) => Some(number),
        // Negative, or beyond 64 bits.
        Err(error) if error.is_instance_of::<PyOverflowError>(value.py()) => None,
        Err(_) => {
            return Err(PyTypeError::new_err(format!(
                "{name} must be a whole number, not {}",
                type_name(value)
            )));
        }
    };
    number.filter(|number| range.contains(number)).ok_or_else(|| {
        refused(format!("{name} must be a whole number from {} to {}", range.start(), range.end()))
    })
}

/// Returns the seed of the noise, by default that of the command line.
pub(crate) fn seed_of(value: Option<&Bound<'_, PyAny>>) -> PyResult<u64> {
    value.map_or(Ok(1), |value| whole(value, "seed", 0..=u64::MAX))
}

/// Returns the interpolation mode with this identifier.
pub(crate) fn mode_of(id: &str) -> PyResult<Mode> {
    Mode::from_id(id).ok_or_else(|| {
        let known = Mode::ALL.map(Mode::id).join(", ");
        refused(format!("there is no mode \"{id}\"; choose one of {known}"))
    })
}

/// Returns the shape with these values of controls; without any, the neutral one.
pub(crate) fn shape_of(controls: Option<&Bound<'_, PyDict>>) -> PyResult<Shape> {
    let Some(controls) = controls.filter(|controls| !controls.is_empty()) else {
        return Ok(Shape::default());
    };
    let mut parts = Vec::new();
    for item in controls.items() {
        let (name, value) = item.extract::<(String, Bound<'_, PyAny>)>()?;
        // The range of each control is checked below.
        parts.push(format!("{name}={}", any_number(&value, &name)?));
    }
    Shape::from_str(&parts.join(",")).map_err(|error| refused(error.to_string()))
}

/// Coordinates of a point whose library is not asked yet.
pub(crate) enum Coordinates {
    /// In the order of the axes.
    Ordered(Vec<f64>),
    /// By the names of the axes.
    Named(Vec<(String, f64)>),
}

impl Coordinates {
    /// Reads a sequence of numbers, or a dictionary of numbers by names.
    pub(crate) fn of(value: &Bound<'_, PyAny>) -> PyResult<Self> {
        let Ok(named) = value.cast::<PyDict>() else {
            let ordered = value.extract::<Vec<f64>>().map_err(|_| {
                PyTypeError::new_err(format!(
                    "a point must be a sequence of numbers or a dictionary of numbers by the names of axes, not {}",
                    type_name(value)
                ))
            })?;
            return Ok(Self::Ordered(ordered));
        };
        let mut pairs = Vec::new();
        for item in named.items() {
            let (name, value) = item.extract::<(String, Bound<'_, PyAny>)>()?;
            let number = any_number(&value, &name)?;
            pairs.push((name, number));
        }
        Ok(Self::Named(pairs))
    }

    /// Returns the point in the space of a library.
    pub(crate) fn in_space(&self, library: &Library, reporter: &dyn Reporter) -> anyhow::Result<SpacePoint> {
        Ok(match self {
            Self::Ordered(coordinates) => point_of(coordinates, library)?,
            Self::Named(named) => named_point(named, library, reporter)?,
        })
    }
}
