//! Conversion of the numbers of a HaTT file to a texture.

use std::f64::consts::PI;

use shagreen_core::texture::{MIN_NODE_DISTANCE, PublishedNode, TextureModel};
use shagreen_core::units::{Contact, Hertz, MetersPerSecond, Newtons};

use crate::hatt::boundary::{close, is_closed};
use crate::hatt::file::{HattFile, HattModel, read_file};
use crate::hatt::{HattError, HattTexture, xml};
use crate::imported::Imported;
use crate::library::Provenance;

/// Fraction of the speed-force plane that the file's triangles may miss without a warning; corners have rounded
/// decimals.
const COVERAGE_TOLERANCE: f64 = 1e-3;
/// Maximum speed in mm/s below which the file is probably in another unit.
const SLOW_MM_PER_S: f64 = 1.0;
/// Largest change of a frequency by rounding to six decimals.
const SIX_DECIMALS: f64 = 1e-6;

/// Reads a texture. The pictures that a file names are ignored.
///
/// Line spectral frequencies take precedence; coefficients are used only without them. The triangulation is computed
/// again. A file without boundary models gets them by the published rule. Inconsistencies in the file become warnings.
///
/// # Errors
/// See [`HattError`].
pub fn read_hatt(bytes: &[u8]) -> Result<Imported<HattTexture>, HattError> {
    let mut warnings = Vec::new();
    let (text, is_latin) = xml::decode(bytes)?;
    if is_latin {
        warnings.push("the file is not valid UTF-8; its text is read as Latin-1".to_owned());
    }
    let document = xml::parse(&text)?;
    let mut file = read_file(document.root_element(), &mut warnings)?;
    drop_neutral_moving_average(&mut file.models);
    let mut nodes: Vec<PublishedNode> = file.models.iter().map(node).collect();
    let highest = highest(&file, &nodes, &mut warnings);
    check_triangles(&file, highest, &mut warnings);
    let fastest_mm_per_s = highest.speed.mm_per_s();
    if fastest_mm_per_s < SLOW_MM_PER_S {
        warnings.push(format!(
            "the highest speed is {fastest_mm_per_s:.3} mm/s, too slow for a stroke; if the speeds are in m/s, convert them to mm/s"
        ));
    }
    if !is_closed(&nodes, highest) {
        let n_before = nodes.len();
        close(&mut nodes, highest);
        warnings.push(format!(
            "the file does not cover speeds and forces from zero to its maximum; {} boundary models are added",
            nodes.len() - n_before
        ));
    }
    let model = TextureModel::published(Hertz(file.rate_hz), nodes, file.friction)?;
    let provenance = if file.created_by.is_some() { Provenance::Free } else { Provenance::Restricted };
    let name = file.material.unwrap_or_default();
    if name.is_empty() {
        warnings.push("the file has no material name".to_owned());
    }
    let value = HattTexture { name, index: file.index, provenance, created_by: file.created_by, model };
    Ok(Imported { value, warnings })
}

fn node(model: &HattModel) -> PublishedNode {
    PublishedNode {
        speed: MetersPerSecond::from_mm_per_s(model.speed_mm_per_s),
        force: Newtons(model.force_n),
        ar_lsf: model.ar_lsf.clone(),
        ma_lsf: model.ma_lsf.clone(),
        variance: model.variance,
        gain: model.gain,
    }
}

/// Returns the maximum speed and force: those of the models, or the stated ones if higher.
fn highest(file: &HattFile, nodes: &[PublishedNode], warnings: &mut Vec<String>) -> Contact {
    let of_nodes = Contact {
        speed: MetersPerSecond(nodes.iter().map(|node| node.speed.0).fold(0.0, f64::max)),
        force: Newtons(nodes.iter().map(|node| node.force.0).fold(0.0, f64::max)),
    };
    let mut decide = |element: &str, stated: Option<f64>, found: f64| match stated {
        Some(stated) if stated > found * (1.0 + MIN_NODE_DISTANCE) => stated,
        Some(stated) if stated < found * (1.0 - MIN_NODE_DISTANCE) => {
            warnings
                .push(format!("{element} states {stated}, but the models reach {found}; the latter is used"));
            found
        }
        _ => found,
    };
    let speed_mm_per_s = decide("maxSpeed", file.speed_max_mm_per_s, of_nodes.speed.mm_per_s());
    let force_n = decide("maxForce", file.force_max_n, of_nodes.force.0);
    Contact {
        // The model's own value is kept unchanged, because converting units twice adds rounding errors.
        speed: if speed_mm_per_s == of_nodes.speed.mm_per_s() {
            of_nodes.speed
        } else {
            MetersPerSecond::from_mm_per_s(speed_mm_per_s)
        },
        force: Newtons(force_n),
    }
}

/// Line spectral frequencies of the neutral moving average `B(z) = 1`: evenly spaced.
pub(super) fn neutral_moving_average(order: usize) -> Vec<f64> {
    (1..=order).map(|k| PI * k as f64 / (order + 1) as f64).collect()
}

/// Removes the moving averages if all are neutral: published files contain them, and rendering them costs time.
fn drop_neutral_moving_average(models: &mut [HattModel]) {
    let is_neutral = |model: &HattModel| {
        let neutral = neutral_moving_average(model.ma_lsf.len());
        model.ma_lsf.iter().zip(neutral).all(|(w, n)| (w - n).abs() <= SIX_DECIMALS)
    };
    if models.iter().all(is_neutral) {
        for model in models {
            model.ma_lsf.clear();
        }
    }
}

/// Checks the triangles of the file. They are not used: the published triangulation deviates slightly from Delaunay.
fn check_triangles(file: &HattFile, highest: Contact, warnings: &mut Vec<String>) {
    if file.triangles.is_empty() {
        return;
    }
    // Sorted once, because a file may have many triangles.
    let mut models: Vec<_> = file.models.iter().collect();
    models.sort_by(|a, b| a.number.total_cmp(&b.number));
    let place = |number: f64| {
        let model = models[models.binary_search_by(|model| model.number.total_cmp(&number)).ok()?];
        Some([1e-3 * model.speed_mm_per_s / highest.speed.0, model.force_n / highest.force.0])
    };
    let (mut covered, mut n_bad) = (0.0, 0);
    for [a, b, c] in &file.triangles {
        match (place(*a), place(*b), place(*c)) {
            (Some(a), Some(b), Some(c)) => {
                covered += 0.5 * ((b[0] - a[0]) * (c[1] - a[1]) - (c[0] - a[0]) * (b[1] - a[1])).abs();
            }
            _ => n_bad += 1,
        }
    }
    if n_bad > 0 {
        warnings
            .push(format!("{n_bad} triangles refer to missing models; the triangulation is computed again"));
    } else if (covered - 1.0).abs() > COVERAGE_TOLERANCE {
        warnings.push(format!(
            "the triangles cover {:.1} % of the speed-force plane; the triangulation is computed again",
            100.0 * covered
        ));
    }
}
