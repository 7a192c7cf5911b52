//! The numbers of a HaTT file, checked individually and against each other.

use roxmltree::Node;
use shagreen_core::dsp::lsf::{ar_from_lsf, lsf_from_ar};

use crate::hatt::HattError;
use crate::hatt::xml::{is_named, line_of, list, named, numbers, scalar, text};

/// The contents of a file, in the units of the file.
pub(super) struct HattFile {
    pub(super) index: Option<u32>,
    pub(super) material: Option<String>,
    pub(super) created_by: Option<String>,
    pub(super) rate_hz: f64,
    pub(super) friction: Option<f64>,
    pub(super) speed_max_mm_per_s: Option<f64>,
    pub(super) force_max_n: Option<f64>,
    pub(super) models: Vec<HattModel>,
    /// Three model numbers per triangle, as the file counts them.
    pub(super) triangles: Vec<[f64; 3]>,
}

/// A model at one speed and force.
pub(super) struct HattModel {
    /// Model number in the file, usually from one.
    pub(super) number: f64,
    pub(super) speed_mm_per_s: f64,
    pub(super) force_n: f64,
    pub(super) ar_lsf: Vec<f64>,
    pub(super) ma_lsf: Vec<f64>,
    pub(super) variance: f64,
    pub(super) gain: f64,
}

/// Elements inside a model do not describe the whole file.
const MODEL: &str = "model";
/// Units of the format, by the element that states them, with accepted spellings.
const UNITS: [(&str, &str, &[&str]); 3] = [
    ("AccelUnits", "m/s^2", &["m/s^2", "m/s2", "m/s²", "m/s**2", "m.s^-2", "m*s^-2"]),
    ("SpeedUnits", "mm/s", &["mm/s", "mm.s^-1", "mm*s^-1"]),
    ("ForceUnits", "N", &["n", "newton", "newtons"]),
];
/// Largest difference between filter coefficients and those from the line spectral frequencies that raises no warning:
/// fifty times the effect of rounding to six decimals in published models.
const COEFFICIENT_TOLERANCE: f64 = 1e-3;
/// Largest difference between two statements of one speed (mm/s) or force (N) that raises no warning; decimals are
/// rounded.
const LIST_TOLERANCE: f64 = 1e-3;

/// Reads the numbers below the root element of a document.
pub(super) fn read_file(root: Node<'_, '_>, warnings: &mut Vec<String>) -> Result<HattFile, HattError> {
    if !is_named(root, "modelSet") {
        return Err(HattError::Format { found: root.tag_name().name().chars().take(40).collect() });
    }
    for (element, unit, spellings) in UNITS {
        match text(root, element, MODEL) {
            Some(found) if spellings.contains(&found.replace(' ', "").to_lowercase().as_str()) => {}
            Some(found) => {
                let found = found.chars().take(40).collect();
                return Err(HattError::Unit { element, found, expected: unit });
            }
            None => {
                warnings.push(format!("{element} is missing; {unit} is assumed, as the format specifies"));
            }
        }
    }
    let of_root = |name: &'static str| scalar(root, name, MODEL);
    let rate_hz = of_root("SampleRate")?.ok_or(HattError::Missing { element: "SampleRate", line: 1 })?;
    let friction = of_root("mu")?;
    if friction.is_none() {
        warnings.push("mu is missing: the texture has no friction".into());
    }
    let models = models(root, warnings)?;
    check_count("numMod", of_root("numMod")?, models.len(), warnings);
    check_count("numARCoeff", of_root("numARCoeff")?, models[0].ar_lsf.len(), warnings);
    check_count("numMACoeff", of_root("numMACoeff")?, models[0].ma_lsf.len(), warnings);
    let triangles = triangles(root, warnings)?;
    check_count("numTri", of_root("numTri")?, triangles.len(), warnings);
    Ok(HattFile {
        // The number is only used in the origin text, so an invalid one is ignored.
        index: root.attribute("texture").and_then(|value| value.trim().parse().ok()),
        material: text(root, "material", MODEL).map(str::to_owned),
        created_by: text(root, super::CREATED_BY, MODEL).map(str::to_owned),
        rate_hz,
        friction,
        speed_max_mm_per_s: of_root("maxSpeed")?,
        force_max_n: of_root("maxForce")?,
        models,
        triangles,
    })
}

/// Warns if a stated count differs from the actual one.
fn check_count(element: &str, stated: Option<f64>, found: usize, warnings: &mut Vec<String>) {
    if let Some(stated) = stated.filter(|stated| *stated != found as f64) {
        warnings.push(format!("{element} states {stated}, but the file holds {found}; the latter is used"));
    }
}

fn models(root: Node<'_, '_>, warnings: &mut Vec<String>) -> Result<Vec<HattModel>, HattError> {
    let nodes = named(root, MODEL, "");
    if nodes.is_empty() {
        return Err(HattError::Missing { element: MODEL, line: line_of(root) });
    }
    let speeds = list(root, "speedList", MODEL)?;
    let forces = list(root, "forceList", MODEL)?;
    let (mut models, mut coefficients_off) = (Vec::with_capacity(nodes.len()), Off::default());
    let (mut speeds_off, mut forces_off) = (Off::default(), Off::default());
    for (index, node) in nodes.iter().enumerate() {
        let number = scalar(*node, "modNum", "")?.unwrap_or((index + 1) as f64);
        let required =
            |element: &'static str, value: Option<f64>| value.ok_or_else(|| missing(element, *node));
        let place = |element, listed: Option<&f64>, off: &mut Off| {
            let own = scalar(*node, element, "")?;
            if let (Some(own), Some(listed)) = (own, listed) {
                off.add((own - listed).abs(), LIST_TOLERANCE, number);
            }
            required(element, own.or(listed.copied()))
        };
        models.push(HattModel {
            number,
            speed_mm_per_s: place("speedMod", speeds.get(index), &mut speeds_off)?,
            force_n: place("forceMod", forces.get(index), &mut forces_off)?,
            ar_lsf: frequencies(*node, ["ARlsf", "ARcoeff"], number, &mut coefficients_off)?
                .filter(|lsf| !lsf.is_empty())
                .ok_or_else(|| missing("ARlsf", *node))?,
            // A model without a moving average is a pure AR model.
            ma_lsf: frequencies(*node, ["MAlsf", "MAcoeff"], number, &mut coefficients_off)?
                .unwrap_or_default(),
            variance: required("var", scalar(*node, "var", "")?)?,
            gain: required("gain", scalar(*node, "gain", "")?)?,
        });
    }
    for (element, listed, off) in [("speedList", &speeds, speeds_off), ("forceList", &forces, forces_off)] {
        if !listed.is_empty() {
            check_count(element, Some(listed.len() as f64), models.len(), warnings);
        }
        off.warn(warnings, |n, most, first| {
            format!("{element} differs from {n} models by up to {most:.3}, first from model {first}; the values of the models are used")
        });
    }
    coefficients_off.warn(warnings, |n, most, first| {
        format!(
            "coefficients of {n} filters differ from their line spectral frequencies by up to {most:.4}, first in model {first}; the line spectral frequencies are used"
        )
    });
    let mut seen: Vec<f64> = models.iter().map(|model| model.number).collect();
    seen.sort_by(f64::total_cmp);
    if seen.windows(2).any(|pair| pair[0] == pair[1]) {
        warnings.push("two models have the same modNum".into());
    }
    Ok(models)
}

fn missing(element: &'static str, node: Node<'_, '_>) -> HattError {
    HattError::Missing { element, line: line_of(node) }
}

/// Returns the line spectral frequencies of a filter, computed from its coefficients if the file has none; `None` if
/// there are no coefficients either.
fn frequencies(
    model: Node<'_, '_>,
    [lsf_name, coefficient_name]: [&'static str; 2],
    number: f64,
    off: &mut Off,
) -> Result<Option<Vec<f64>>, HattError> {
    let lsf = list(model, lsf_name, "")?;
    let mut coefficients = list(model, coefficient_name, "")?;
    // A leading coefficient of one is common and carries no information.
    if coefficients.first() == Some(&1.0) && (lsf.is_empty() || coefficients.len() > lsf.len()) {
        coefficients.remove(0);
    }
    if !lsf.is_empty() {
        // Longer filters are rejected later with the model, so their coefficients are not compared.
        if !coefficients.is_empty() && lsf.len() <= super::MAX_ORDER {
            let of_lsf = ar_from_lsf(&lsf);
            let at = |filter: &[f64], k: usize| filter.get(k).copied().unwrap_or(0.0);
            let n = of_lsf.len().max(coefficients.len());
            let most = (0..n).map(|k| (at(&of_lsf, k) - at(&coefficients, k)).abs()).fold(0.0, f64::max);
            off.add(most, COEFFICIENT_TOLERANCE, number);
        }
        return Ok(Some(lsf));
    }
    if coefficients.is_empty() {
        return Ok(None);
    }
    // Finding each root takes a grid search, so filters above the maximum order are skipped.
    let found = Some(&coefficients).filter(|c| c.len() <= super::MAX_ORDER).and_then(|c| lsf_from_ar(c));
    found.map(Some).ok_or_else(|| HattError::Unstable {
        element: coefficient_name,
        line: line_of(model),
        order: coefficients.len(),
    })
}

/// Number of differences, their maximum, and the number of the first model with one.
#[derive(Default)]
struct Off {
    n: usize,
    most: f64,
    first: f64,
}

impl Off {
    fn add(&mut self, difference: f64, tolerance: f64, model: f64) {
        if difference > tolerance {
            if self.n == 0 {
                self.first = model;
            }
            self.n += 1;
            self.most = self.most.max(difference);
        }
    }

    fn warn(&self, warnings: &mut Vec<String>, sentence: impl Fn(usize, f64, f64) -> String) {
        if self.n > 0 {
            warnings.push(sentence(self.n, self.most, self.first));
        }
    }
}

fn triangles(root: Node<'_, '_>, warnings: &mut Vec<String>) -> Result<Vec<[f64; 3]>, HattError> {
    let mut corners = Vec::new();
    for node in named(root, "tri", MODEL) {
        corners.extend(numbers(node)?);
    }
    let (triangles, rest) = corners.as_chunks::<3>();
    if !rest.is_empty() {
        warnings.push("the last triangle has fewer than three models; it is ignored".into());
    }
    Ok(triangles.to_vec())
}
