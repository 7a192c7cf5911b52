//! The class `Project`: the textures of a project and its authored textures.

use std::path::PathBuf;
use std::sync::Arc;

use pyo3::types::{PyAnyMethods as _, PyIterator, PyList};
use pyo3::{Bound, Py, PyResult, Python, pyclass, pyfunction, pymethods};
use shagreen_formats::project::Project;
use shagreen_studio::permitted_libraries::Permitted;
use shagreen_studio::project::{find_authored, textures_by_id, textures_on_axes};
use shagreen_studio::sound::Sound;

use crate::errors::run;
use crate::library::PyLibrary;
use crate::sounding::Sounding;
use crate::texture::PyTexture;

/// A project: `project.library` has its textures, and `project["Oak"]` is an authored texture, by name or number.
#[pyclass(frozen, name = "Project", module = "shagreen")]
pub(crate) struct PyProject {
    project: Arc<Project>,
    library: Py<PyLibrary>,
}

#[pymethods]
impl PyProject {
    /// Textures of the project: those of its library, and those that were added to it, on the axes of the project.
    #[getter]
    fn library(&self, py: Python<'_>) -> Py<PyLibrary> {
        self.library.clone_ref(py)
    }

    /// Names of the authored textures.
    #[getter]
    fn names(&self) -> Vec<String> {
        self.project.authored.iter().map(|texture| texture.name.clone()).collect()
    }

    fn __len__(&self) -> usize {
        self.project.authored.len()
    }

    fn __getitem__(&self, py: Python<'_>, name: &str) -> PyResult<PyTexture> {
        let (project, name) = (Arc::clone(&self.project), name.to_owned());
        let sounding = run(py, move |reporter| {
            let authored = find_authored(&project, &name)?;
            let placed = textures_on_axes(&project)?;
            let library = project.with_places_of(&placed, |id| authored.blend.locked.contains(id));
            let sound = Sound::of_authored(&library, authored, &authored.shape, reporter)?;
            Ok(Sounding { library: Arc::new(library), sound, name: authored.name.clone() })
        })?;
        Ok(PyTexture::new(sounding))
    }

    fn __iter__<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyIterator>> {
        PyList::new(py, self.names())?.try_iter()
    }

    fn __repr__(&self) -> String {
        format!("<shagreen.Project: {}>", self.names().join(", "))
    }
}

/// Loads a project. A library outside its folder is read with a warning.
#[pyfunction]
pub(crate) fn load_project(py: Python<'_>, path: PathBuf) -> PyResult<PyProject> {
    let (project, library) = run(py, move |reporter| {
        let permitted = Permitted::AllWarned(Vec::new());
        let project = shagreen_studio::project::load_project(&path, &permitted, reporter)?;
        let library = textures_by_id(&project, reporter)?;
        Ok((project, library))
    })?;
    Ok(PyProject { project: Arc::new(project), library: Py::new(py, PyLibrary(Arc::new(library)))? })
}
