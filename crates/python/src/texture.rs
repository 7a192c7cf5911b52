//! The class `Texture`: a texture of a library, an authored one, or a mixture of signals.

use std::sync::Arc;

use numpy::IntoPyArray as _;
use pyo3::types::{PyDict, PyDictMethods as _};
use pyo3::{Bound, PyAny, PyResult, Python, pyclass, pymethods};
use shagreen_core::dsp::ar::comparison_frequencies;
use shagreen_core::texture::tap::Tap;
use shagreen_core::units::{Hertz, Radians};
use shagreen_formats::library::{Provenance, TextureEntry, id_from_name};
use shagreen_studio::export::shaped;
use shagreen_studio::render::SampleFormat;
use shagreen_studio::sound_entry::terms_of_sound;

use crate::arguments::{any_number, number, seed_of, shape_of, whole, within};
use crate::arrays::{SampleType, column, samples_array};
use crate::errors::{refused, run};
use crate::nodes::{Nodes, nodes_array};
use crate::sounding::Sounding;
use crate::strokes::{Motion, contact_of};

/// Highest sample rate of a signal, in Hz.
const MAX_RATE_HZ: f64 = 768_000.0;

/// A texture: what a surface does to a tip at every speed and force.
///
/// Textures come from a library (`library["cork"]`, `library.author(...)`), from `blend`, `fit` and `Texture.from_nodes`. They
/// never change.
#[pyclass(frozen, name = "Texture", module = "shagreen")]
pub(crate) struct PyTexture(pub(crate) Arc<Sounding>);

impl PyTexture {
    pub(crate) fn new(sounding: Sounding) -> Self {
        Self(Arc::new(sounding))
    }

    fn entry(&self, py: Python<'_>) -> PyResult<TextureEntry> {
        let sounding = Arc::clone(&self.0);
        run(py, move |_| sounding.entry())
    }

    fn rate(&self, py: Python<'_>) -> PyResult<Hertz> {
        let sounding = Arc::clone(&self.0);
        run(py, move |_| sounding.rate())
    }
}

#[pymethods]
impl PyTexture {
    /// Creates a texture from nodes: a structured array with the fields of `Texture.nodes`, or a dictionary of arrays.
    ///
    /// `speed_mps` (m/s), `force_n` (N) and `level_mps2` (root mean square, m/s²) have the shape (n,), and `lsf_rad` (n, order):
    /// line spectral frequencies in rad, ascending in (0, π). `rate_hz` is the model rate, 200 to 4000 Hz. `friction` is the
    /// kinetic friction coefficient. `tap` is a dictionary with `frequency_hz`, `decay_per_s` and `amplitude_mps2`.
    #[staticmethod]
    #[pyo3(signature = (name, rate_hz, nodes, *, friction=None, tap=None, license=""))]
    fn from_nodes(
        py: Python<'_>,
        name: &str,
        rate_hz: &Bound<'_, PyAny>,
        nodes: &Bound<'_, PyAny>,
        friction: Option<&Bound<'_, PyAny>>,
        tap: Option<&Bound<'_, PyDict>>,
        license: &str,
    ) -> PyResult<Self> {
        // The ranges are those of a texture model.
        let rate = Hertz(any_number(rate_hz, "rate_hz")?);
        let friction = friction.map(|value| any_number(value, "friction")).transpose()?;
        let tap = tap.map(tap_of).transpose()?;
        let nodes = Nodes::of(nodes)?;
        let (name, license) = (name.to_owned(), license.to_owned());
        let sounding = run(py, move |_| {
            let model = nodes.into_model(rate, friction)?.with_tap(tap);
            let entry = TextureEntry::new(id_from_name(&name), name, model);
            Sounding::of_entry(TextureEntry { license, ..entry })
        })?;
        Ok(Self::new(sounding))
    }

    /// Name to show.
    #[getter]
    fn name(&self) -> &str {
        &self.0.name
    }

    /// Identifier: that of the library, or one that is made from the name.
    #[getter]
    fn id(&self) -> String {
        self.0.sound.texture.clone().unwrap_or_else(|| id_from_name(&self.0.name))
    }

    /// Terms of use, of all contributing textures; empty if nobody stated any.
    #[getter]
    fn license(&self) -> String {
        terms_of_sound(&self.0.library, &self.0.sound).0
    }

    /// Where the texture comes from. A mixture of signals has no origin of its own (`ShagreenError`).
    #[getter]
    fn origin(&self, py: Python<'_>) -> PyResult<String> {
        Ok(self.entry(py)?.origin)
    }

    /// "free" if its license decides on redistribution, "restricted" if it must not be redistributed.
    #[getter]
    fn provenance(&self) -> &'static str {
        provenance_word(terms_of_sound(&self.0.library, &self.0.sound).1)
    }

    /// Model rate in Hz: the lowest rate of rendered samples.
    #[getter]
    fn rate_hz(&self, py: Python<'_>) -> PyResult<f64> {
        self.rate(py).map(|rate| rate.0)
    }

    /// Interpolation mode: "field", "parametric", "shared", "power" or "paper".
    #[getter]
    fn mode(&self) -> &'static str {
        self.0.sound.mode.id()
    }

    /// Contributing textures by id, with their weights, largest first. Weights of a field may be negative.
    #[getter]
    fn parents<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyDict>> {
        let parents = PyDict::new(py);
        for (index, weight) in &self.0.sound.parents {
            parents.set_item(&self.0.library.textures[*index].id, weight)?;
        }
        Ok(parents)
    }

    /// Authored point, one coordinate for each axis, 0 to 100: the requested one, or the nearest point that can be authored.
    /// `None` for other textures.
    #[getter]
    fn at(&self) -> Option<Vec<f64>> {
        self.0.sound.at_json()
    }

    /// Whether the requested point lies outside the convex hull and another one was authored.
    #[getter]
    fn clamped(&self) -> bool {
        self.0.sound.clamped
    }

    /// Whether the texture is extrapolated, beyond all measurements.
    #[getter]
    fn extrapolated(&self) -> bool {
        self.0.sound.extrapolated
    }

    /// Nodes as a structured array of the shape (n,): `speed_mps`, `force_n`, `level_mps2` and `lsf_rad`. A published texture has
    /// `variance`, `gain` and `ma_lsf_rad` instead of a level. A mixture of signals has no nodes (`ShagreenError`).
    #[getter]
    fn nodes<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        nodes_array(py, &self.entry(py)?.model)
    }

    /// Kinetic friction coefficient; `None` if it is not known.
    #[getter]
    fn friction(&self, py: Python<'_>) -> PyResult<Option<f64>> {
        Ok(self.entry(py)?.model.friction())
    }

    /// Tap transient `A exp(-B t) sin(2π f t)`: a dictionary of `frequency_hz`, `decay_per_s` and `amplitude_mps2`; `None` if it
    /// is not known.
    #[getter]
    fn tap<'py>(&self, py: Python<'py>) -> PyResult<Option<Bound<'py, PyDict>>> {
        let Some(Tap { frequency, decay_per_sec, amplitude_mps2 }) = self.0.sound.tap else {
            return Ok(None);
        };
        let tap = PyDict::new(py);
        tap.set_item("frequency_hz", frequency.0)?;
        tap.set_item("decay_per_s", decay_per_sec)?;
        tap.set_item("amplitude_mps2", amplitude_mps2)?;
        Ok(Some(tap))
    }

    /// Returns the texture in a shape: `level` (dB), `grain`, `brightness` (dB/octave), `softness`, `friction`, `relief` and
    /// `direction` (degrees), as the option `--shape` of the command line has them.
    #[pyo3(signature = (**controls))]
    fn shaped(&self, py: Python<'_>, controls: Option<&Bound<'_, PyDict>>) -> PyResult<Self> {
        let shape = shape_of(controls)?;
        let sounding = Arc::clone(&self.0);
        run(py, move |_| Sounding::of_entry(shaped(&sounding.entry()?, &shape)?)).map(Self::new)
    }

    /// Renders the acceleration at the tip in m/s², as `shagreen render` does: the same samples for the same seed.
    ///
    /// `speed_mps` (m/s) and `force_n` (N) are numbers, with the duration `seconds`, or arrays of the shape (n,) with
    /// `stroke_rate_hz` rows a second (by default `rate_hz`), between which lie straight lines. A stroke lasts from its first row
    /// to its last one, so that n rows give n - 1 samples at their own rate. It has tap transients where the force rises from 0.
    ///
    /// `rate_hz` is a whole number, by default the model rate. Returns an array of float32, or of `dtype` float64.
    #[pyo3(signature = (
        speed_mps, force_n, seconds=None, *, rate_hz=None, stroke_rate_hz=None, seed=None, dtype=None
    ))]
    fn render<'py>(
        &self,
        py: Python<'py>,
        speed_mps: &Bound<'py, PyAny>,
        force_n: &Bound<'py, PyAny>,
        seconds: Option<&Bound<'py, PyAny>>,
        rate_hz: Option<&Bound<'py, PyAny>>,
        stroke_rate_hz: Option<&Bound<'py, PyAny>>,
        seed: Option<&Bound<'py, PyAny>>,
        dtype: Option<&Bound<'py, PyAny>>,
    ) -> PyResult<Bound<'py, PyAny>> {
        let sample_type = SampleType::of(dtype)?;
        let rate_hz = self.whole_rate_hz(py, rate_hz)?;
        let stroke_rate_hz = match stroke_rate_hz {
            Some(value) => number(value, "stroke_rate_hz", &(1e-3..=MAX_RATE_HZ), " Hz")?,
            None => f64::from(rate_hz),
        };
        let motion = Motion::of(speed_mps, force_n, seconds, stroke_rate_hz)?;
        let format = SampleFormat {
            rate: Hertz(f64::from(rate_hz)),
            seconds: motion.seconds(),
            seed: seed_of(seed)?,
            loops: false,
        };
        let sounding = Arc::clone(&self.0);
        let samples = run(py, move |reporter| sounding.rendered(motion, (format, rate_hz), reporter))?;
        Ok(samples_array(py, samples, sample_type))
    }

    /// Power spectral density of the texture's noise at one speed (m/s) and force (N), without relief and stick-slip.
    ///
    /// Returns the frequencies in Hz and the one-sided density in (m/s²)²/Hz, two arrays of the shape (n,). `frequencies_hz` is an
    /// array; by default, there are `bins` frequencies from 5 Hz to just below half of the model rate. `direction_deg` is the
    /// direction of the stroke, counterclockwise from the right.
    #[pyo3(signature = (speed_mps, force_n, *, frequencies_hz=None, bins=None, direction_deg=None))]
    fn psd<'py>(
        &self,
        py: Python<'py>,
        speed_mps: &Bound<'py, PyAny>,
        force_n: &Bound<'py, PyAny>,
        frequencies_hz: Option<&Bound<'py, PyAny>>,
        bins: Option<&Bound<'py, PyAny>>,
        direction_deg: Option<&Bound<'py, PyAny>>,
    ) -> PyResult<(Bound<'py, PyAny>, Bound<'py, PyAny>)> {
        let contact = contact_of(speed_mps, force_n)?;
        let direction = direction_of(direction_deg)?;
        let rate = self.rate(py)?;
        let hz = if let Some(value) = frequencies_hz {
            column(value, "frequencies_hz")?
        } else {
            let bins = bins.map_or(Ok(256), |value| whole(value, "bins", 2..=65_536))?;
            comparison_frequencies(rate, bins as usize).into_iter().map(|frequency| frequency.0).collect()
        };
        for value in &hz {
            within(*value, "a frequency", &(0.0..=0.5 * rate.0), " Hz")?;
        }
        let (sounding, frequencies) =
            (Arc::clone(&self.0), hz.iter().map(|hz| Hertz(*hz)).collect::<Vec<_>>());
        let psd = run(py, move |reporter| sounding.psd(contact, direction, &frequencies, reporter))?;
        Ok((hz.into_pyarray(py).into_any(), psd.into_pyarray(py).into_any()))
    }

    /// Root mean square acceleration of the texture's noise in m/s² at one speed (m/s) and force (N).
    #[pyo3(signature = (speed_mps, force_n, *, direction_deg=None))]
    fn level(
        &self,
        py: Python<'_>,
        speed_mps: &Bound<'_, PyAny>,
        force_n: &Bound<'_, PyAny>,
        direction_deg: Option<&Bound<'_, PyAny>>,
    ) -> PyResult<f64> {
        let (contact, direction) = (contact_of(speed_mps, force_n)?, direction_of(direction_deg)?);
        let sounding = Arc::clone(&self.0);
        run(py, move |reporter| sounding.level_mps2(contact, direction, reporter))
    }

    fn __repr__(&self) -> String {
        format!("<shagreen.Texture \"{}\": {}>", self.0.name, self.0.sound.parents_text(&self.0.library))
    }
}

impl PyTexture {
    /// Returns the rate of rendered samples: the one that is given, or the model rate.
    fn whole_rate_hz(&self, py: Python<'_>, given: Option<&Bound<'_, PyAny>>) -> PyResult<u32> {
        let rate_hz = match given {
            Some(value) => number(value, "rate_hz", &(1.0..=MAX_RATE_HZ), " Hz")?,
            None => self.rate_hz(py)?,
        };
        if rate_hz.fract() == 0.0 {
            return Ok(rate_hz as u32);
        }
        Err(refused(format!("the rate is {rate_hz} Hz; rate_hz must be a whole number")))
    }
}

/// Reads a direction on the pad, by default to the right.
fn direction_of(value: Option<&Bound<'_, PyAny>>) -> PyResult<Radians> {
    let degrees = value.map_or(Ok(0.0), |value| number(value, "direction_deg", &(-360.0..=360.0), "°"))?;
    Ok(Radians::from_degrees(degrees))
}

/// Reads a tap transient.
fn tap_of(tap: &Bound<'_, PyDict>) -> PyResult<Tap> {
    let value = |name: &str| {
        let value = tap.get_item(name)?.ok_or_else(|| {
            refused(format!(
                "the tap transient has no {name}; state frequency_hz, decay_per_s and amplitude_mps2"
            ))
        })?;
        any_number(&value, name)
    };
    let tap = Tap {
        frequency: Hertz(value("frequency_hz")?),
        decay_per_sec: value("decay_per_s")?,
        amplitude_mps2: value("amplitude_mps2")?,
    };
    tap.checked().map_err(|error| refused(format!("the tap transient is invalid: {error}")))
}

/// Word for a provenance.
pub(crate) fn provenance_word(provenance: Provenance) -> &'static str {
    match provenance {
        Provenance::Free => "free",
        Provenance::Restricted => "restricted",
    }
}
