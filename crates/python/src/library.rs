//! The class `Library`: textures with their positions, and the space that they span.

use std::path::PathBuf;
use std::sync::Arc;

use numpy::PyArray2;
use pyo3::types::{PyAnyMethods as _, PyDict, PyIterator, PyList};
use pyo3::{Bound, PyAny, PyResult, Python, pyclass, pyfunction, pymethods};
use shagreen_core::space::LabelSource;
use shagreen_core::space::authoring::{Outside, Weights};
use shagreen_core::texture::blend::Mode;
use shagreen_core::texture::shape::Shape;
use shagreen_formats::library::{Library, TextureEntry};
use shagreen_studio::axes::{known_axes, placed_on};
use shagreen_studio::blend_options::BlendOptions;
use shagreen_studio::library::load;
use shagreen_studio::sound::Sound;

use crate::arguments::{Coordinates, mode_of, number, seed_of, shape_of, whole};
use crate::arrays::table;
use crate::errors::run;
use crate::evaluation::{Wanted, evaluated, modes_of};
use crate::sounding::Sounding;
use crate::texture::{PyTexture, provenance_word};

/// Name of the starter library, which the command line uses by default.
const STARTER: &str = "starter";

/// Textures with positions in a space.
///
/// `library["cork"]` is the texture with this id, `len(library)` the number of textures, and a loop goes over their ids. A library
/// never changes.
#[pyclass(frozen, name = "Library", module = "shagreen")]
pub(crate) struct PyLibrary(pub(crate) Arc<Library>);

impl PyLibrary {
    fn of_each<T>(&self, of: impl Fn(&TextureEntry) -> T) -> Vec<T> {
        self.0.textures.iter().map(of).collect()
    }
}

#[pymethods]
impl PyLibrary {
    /// Name of the library.
    #[getter]
    fn name(&self) -> &str {
        &self.0.name
    }

    /// Description in a sentence or two.
    #[getter]
    fn description(&self) -> &str {
        &self.0.description
    }

    /// Terms of use of the library. A texture may have its own (`licenses`).
    #[getter]
    fn license(&self) -> &str {
        &self.0.license
    }

    /// Ids of the textures.
    #[getter]
    fn ids(&self) -> Vec<String> {
        self.of_each(|texture| texture.id.clone())
    }

    /// Names of the textures.
    #[getter]
    fn names(&self) -> Vec<String> {
        self.of_each(|texture| texture.name.clone())
    }

    /// Terms of use of each texture.
    #[getter]
    fn licenses(&self) -> Vec<String> {
        self.of_each(|texture| self.0.license_of(texture).to_owned())
    }

    /// Provenance of each texture: "free" if its license decides on redistribution, "restricted" if it must not be
    /// redistributed.
    #[getter]
    fn provenance(&self) -> Vec<&'static str> {
        self.of_each(|texture| provenance_word(texture.provenance))
    }

    /// Names of the axes of the positions, one to six.
    #[getter]
    fn axes(&self) -> Vec<String> {
        self.0.axis_names().into_iter().map(str::to_owned).collect()
    }

    /// Positions of the textures, 0 to 100: an array of float64 of the shape (textures, axes). A texture without a position has
    /// NaN.
    #[getter]
    fn positions<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyArray2<f64>>> {
        let n_axes = self.0.axis_names().len();
        let row = |texture: &TextureEntry| {
            texture.at().map_or_else(|| vec![f64::NAN; n_axes], |at| at.on(n_axes).coordinates().to_vec())
        };
        table(py, n_axes, self.of_each(row))
    }

    /// What each position was derived from: "human", "simulated", "physical" or "estimated"; `None` without a position.
    #[getter]
    fn label_sources(&self) -> Vec<Option<&'static str>> {
        self.of_each(|texture| texture.label_source().map(LabelSource::id))
    }

    /// Returns the names of all axes that the library knows: those of its positions, its other attributes, and features of the
    /// vibration.
    fn known_axes(&self, py: Python<'_>) -> PyResult<Vec<String>> {
        let library = Arc::clone(&self.0);
        run(py, move |_| Ok(known_axes(&library).into_iter().map(|axis| axis.name).collect()))
    }

    /// Returns the library with positions on these axes, one to six names of `known_axes`.
    fn placed_on(&self, py: Python<'_>, axes: Vec<String>) -> PyResult<Self> {
        let library = Arc::clone(&self.0);
        run(py, move |_| Ok(Self(Arc::new(placed_on(&library, &axes)?))))
    }

    /// Authors the texture at a point of the space, as `shagreen render --at` does.
    ///
    /// `point` has one coordinate for each axis, 0 to 100, or is a dictionary of coordinates by the names of axes; an axis that is
    /// not named has its local mean. `mode` is "field", "parametric", "shared", "power" or "paper". `natural` selects
    /// natural-neighbor weights (mode parametric), `extrapolate` extrapolates outside the convex hull, and `pinned` are ids of
    /// textures that the field passes through (mode field). `shape` is a dictionary with the controls of `Texture.shaped`.
    #[pyo3(signature = (
        point, *, mode="field", natural=false, extrapolate=false, pinned=None, shape=None, name="Authored"
    ))]
    fn author(
        &self,
        py: Python<'_>,
        point: &Bound<'_, PyAny>,
        mode: &str,
        natural: bool,
        extrapolate: bool,
        pinned: Option<Vec<String>>,
        shape: Option<&Bound<'_, PyDict>>,
        name: &str,
    ) -> PyResult<PyTexture> {
        let (point, mode, shape) = (Coordinates::of(point)?, mode_of(mode)?, shape_of(shape)?);
        let weights = if natural { Weights::Natural } else { Weights::default() };
        let outside = if extrapolate { Outside::Extrapolated } else { Outside::default() };
        let (library, pinned, name) = (Arc::clone(&self.0), pinned.unwrap_or_default(), name.to_owned());
        let sounding = run(py, move |reporter| {
            let options = BlendOptions { mode, weights, outside, pinned: &pinned };
            let blending = options.in_library(&library, reporter)?;
            let at = point.in_space(&library, reporter)?;
            let sound = Sound::of_point(&library, at, (&blending, &shape), reporter)?;
            Ok(Sounding { library, sound, name })
        })?;
        Ok(PyTexture::new(sounding))
    }

    /// Measures the leave-one-out error of the interpolation, as `shagreen evaluate leave-one-out` does.
    ///
    /// `modes` is a mode, a list of modes, or "all". `signals` textures are also rendered, for `seconds` each. Returns a
    /// dictionary. `methods` are the modes after "nearest", the copy of the nearest texture, which they should beat. `ids`, `at`
    /// and `nearest` describe the evaluated textures. `error_db`, `level_error_db`, `shape_error_db`, `rank`, `nrs` and
    /// `signal_error_db` are arrays of the shape (methods, textures), with NaN where nothing was measured. `summary` has arrays
    /// of the shape (methods,). The errors are measured on signals; no person rated anything.
    #[pyo3(signature = (modes=None, *, signals=None, seconds=None, seed=None))]
    fn evaluate<'py>(
        &self,
        py: Python<'py>,
        modes: Option<&Bound<'py, PyAny>>,
        signals: Option<&Bound<'py, PyAny>>,
        seconds: Option<&Bound<'py, PyAny>>,
        seed: Option<&Bound<'py, PyAny>>,
    ) -> PyResult<Bound<'py, PyDict>> {
        let n_signals = signals.map_or(Ok(0), |value| whole(value, "signals", 0..=1000))?;
        let range = shagreen_studio::evaluation::SIGNAL_SECS;
        let wanted = Wanted {
            modes: modes_of(modes)?,
            n_signals: n_signals as usize,
            seconds: seconds.map_or(Ok(16.0), |value| number(value, "seconds", &range, " s"))?,
            seed: seed_of(seed)?,
        };
        evaluated(py, &self.0, wanted)
    }

    fn __len__(&self) -> usize {
        self.0.textures.len()
    }

    fn __contains__(&self, id: &Bound<'_, PyAny>) -> bool {
        id.extract::<String>().is_ok_and(|id| self.0.index_of(&id).is_some())
    }

    fn __getitem__(&self, py: Python<'_>, id: &str) -> PyResult<PyTexture> {
        let (library, id) = (Arc::clone(&self.0), id.to_owned());
        let sounding = run(py, move |_| {
            let sound = Sound::of_texture(&library, &id, Mode::default(), &Shape::default())?;
            let name =
                library.index_of(&id).map_or_else(String::new, |index| library.textures[index].name.clone());
            Ok(Sounding { library, sound, name })
        })?;
        Ok(PyTexture::new(sounding))
    }

    fn __iter__<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyIterator>> {
        PyList::new(py, self.ids())?.try_iter()
    }

    fn __repr__(&self) -> String {
        format!(
            "<shagreen.Library \"{}\": {} textures on {}>",
            self.0.name,
            self.0.textures.len(),
            self.0.axis_names().join(", ")
        )
    }
}

/// Loads a library: a file, a folder of library files, or a name.
///
/// Without an argument, it is the starter library, as with the name "starter". "simulated" is the starter library with positions
/// from the sorts and ratings of simulated raters.
#[pyfunction]
#[pyo3(signature = (path=None))]
pub(crate) fn load_library(py: Python<'_>, path: Option<PathBuf>) -> PyResult<PyLibrary> {
    // A file of this name comes first, as for the other built-in library.
    let path = path.filter(|path| path.to_str() != Some(STARTER) || path.exists());
    run(py, move |reporter| load(path.as_deref(), reporter)).map(|library| PyLibrary(Arc::new(library)))
}
