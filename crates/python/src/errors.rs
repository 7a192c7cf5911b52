//! Errors and warnings of Python, and the way of work into Rust and back.

use std::any::Any;
use std::ffi::CString;
use std::panic::{AssertUnwindSafe, catch_unwind};

use pyo3::exceptions::{PyUserWarning, PyValueError};
use pyo3::{PyErr, PyResult, Python, create_exception};
use shagreen_studio::file::one_line;
use shagreen_studio::report::{Reporter, Warnings};

create_exception!(
    shagreen,
    ShagreenError,
    PyValueError,
    "A file, a value or a request that cannot be used; the text says why, and what to do."
);
create_exception!(
    shagreen,
    ShagreenWarning,
    PyUserWarning,
    "Something is not quite as requested; the text says what."
);

/// Returns the error with this text.
pub(crate) fn refused(text: impl Into<String>) -> PyErr {
    ShagreenError::new_err(text.into())
}

/// Returns the error for an error of Rust, with its causes on one line.
pub(crate) fn failed(error: &anyhow::Error) -> PyErr {
    refused(one_line(error))
}

/// Runs work while other threads of Python go on, and issues its warnings. Notes are dropped. A panic becomes an error.
pub(crate) fn run<T: Send>(
    py: Python<'_>,
    work: impl FnOnce(&dyn Reporter) -> anyhow::Result<T> + Send,
) -> PyResult<T> {
    let (done, warnings) = py.detach(|| {
        let reporter = Warnings::default();
        let done = catch_unwind(AssertUnwindSafe(|| work(&reporter)));
        (done, reporter.into_vec())
    });
    let value = match done {
        Ok(Ok(value)) => value,
        Ok(Err(error)) => return Err(failed(&error)),
        Err(panic) => return Err(internal(&*panic)),
    };
    warn(py, &warnings)?;
    Ok(value)
}

/// Issues warnings.
pub(crate) fn warn(py: Python<'_>, warnings: &[String]) -> PyResult<()> {
    let category = py.get_type::<ShagreenWarning>();
    for warning in warnings {
        // Names in files may contain zeros, at which a text of C ends.
        let text = CString::new(warning.replace('\0', " ")).unwrap_or_default();
        PyErr::warn(py, &category, &text, 1)?;
    }
    Ok(())
}

fn internal(panic: &(dyn Any + Send)) -> PyErr {
    let text = panic.downcast_ref::<&str>().copied();
    let text = text.or_else(|| panic.downcast_ref::<String>().map(String::as_str)).unwrap_or("unknown");
    refused(format!("this is a fault of Shagreen; please report it: {text}"))
}
