//! Shagreen from Python: the module `shagreen`, with NumPy arrays.
//!
//! # Conventions
//!
//! - Each class and function calls a function of `shagreen_studio`, as the command line does. What is computed here is the
//!   conversion of arguments and results.
//! - Quantities are in SI units, which the names of arguments and results state: `speed_mps`, `force_n`.
//! - Arrays that are returned own their memory on the Rust side, and are not copied. Arrays that are given are read once, while
//!   Python waits; no other thread of Python can change them meanwhile.
//! - Errors are `ShagreenError`, with the text of the command line; a value of another type is a `TypeError`. No panic
//!   reaches Python ([`errors::run`]). Work runs while other threads of Python go on.
#![forbid(unsafe_code)]
#![allow(clippy::needless_pass_by_value, reason = "Python hands arguments over by value")]
#![allow(clippy::too_many_arguments, reason = "arguments of Python functions have names and defaults")]

mod arguments;
mod arrays;
mod blends;
mod errors;
mod evaluation;
mod exports;
mod library;
mod nodes;
mod predictions;
mod project;
mod recordings;
mod signals;
mod sounding;
mod strokes;
mod texture;

/// Shagreen: haptic textures, authored, rendered, evaluated and exported.
///
/// Quantities are in SI units, which the names of arguments and results state. Positions in a space are from 0 to 100.
#[pyo3::pymodule]
mod shagreen {
    use numpy::get_array_module;
    use pyo3::types::{PyModule, PyModuleMethods as _};
    use pyo3::{Bound, PyResult};

    #[pymodule_export]
    use crate::blends::blend;
    #[pymodule_export]
    use crate::errors::{ShagreenError, ShagreenWarning};
    #[pymodule_export]
    use crate::exports::{export, export_formats};
    #[pymodule_export]
    use crate::library::{PyLibrary, load_library};
    #[pymodule_export]
    use crate::predictions::{predict_attributes, predict_photo, predict_prompt};
    #[pymodule_export]
    use crate::project::{PyProject, load_project};
    #[pymodule_export]
    use crate::recordings::fit;
    #[pymodule_export]
    use crate::signals::{difference, quality};
    #[pymodule_export]
    use crate::texture::PyTexture;

    #[pymodule_init]
    fn init(module: &Bound<'_, PyModule>) -> PyResult<()> {
        // Without NumPy, arrays would fail later, and not with an error.
        get_array_module(module.py())?;
        module.add("__version__", env!("CARGO_PKG_VERSION"))
    }
}
