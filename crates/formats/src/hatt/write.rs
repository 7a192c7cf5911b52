//! Conversion of a texture to a HaTT file.

use std::fmt::Write as _;

use shagreen_core::dsp::ar::power_gain;
use shagreen_core::dsp::lsf::ar_from_lsf;
use shagreen_core::maths::triangulation::{Triangulation, TriangulationError};
use shagreen_core::texture::{Grain, GrainNode, Interpolation, PublishedNode, TextureModel};
use shagreen_core::units::Contact;

use crate::hatt::boundary::close;
use crate::hatt::read::neutral_moving_average;
use crate::hatt::{CREATED_BY, RESTRICTED_TERMS};
use crate::library::{Provenance, TextureEntry, frequencies};
use crate::texture_parts::lost_parts;

/// Why a texture cannot be written.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum HattWriteError {
    /// The nodes cannot be triangulated.
    #[error("cannot triangulate the speeds and forces of texture \"{id}\" ({source}); correct its nodes")]
    Triangles {
        /// Identifier of the texture.
        id: String,
        /// Why the triangulation failed.
        source: TriangulationError,
    },
}

/// Serializes a texture. `created_by` is the program with its version; a reader takes it as the mark of a file that is
/// not one of the published ones. A restricted texture gets its terms of use in a comment and no such mark, so it stays
/// restricted when it is read again.
///
/// A measured texture is converted to what the published renderer expects: a neutral moving average (`B(z) = 1`) two
/// orders below the AR order, gain 1, the variance of the excitation, and the boundary models. Spectra and levels at
/// the nodes stay the same. Between nodes the published renderer interpolates variances, whereas Shagreen interpolates
/// levels. The format has no tap transients, and no direction: the grain across the lay is written. The published
/// renderer assumes 1000 Hz and at most 24 coefficients; rate and order are written unchanged.
///
/// Coefficients have 20 decimals. Line spectral frequencies have 6, or more if two are close. Model numbers start at
/// one.
///
/// # Errors
/// See [`HattWriteError`].
pub fn write_hatt(entry: &TextureEntry, created_by: &str) -> Result<Vec<u8>, HattWriteError> {
    let model = &entry.model;
    let highest = Contact { speed: model.speed_max(), force: model.force_max() };
    let nodes = match model.grain() {
        Grain::Published { nodes } => nodes.iter().map(with_moving_average).collect(),
        Grain::Measured { nodes, .. } => {
            let mut nodes: Vec<PublishedNode> = nodes.iter().map(published).collect();
            close(&mut nodes, highest);
            nodes
        }
    };
    let places: Vec<[f64; 2]> =
        nodes.iter().map(|n| [n.speed.0 / highest.speed.0, n.force.0 / highest.force.0]).collect();
    let triangulation = Triangulation::new(&places)
        .map_err(|source| HattWriteError::Triangles { id: entry.id.clone(), source })?;
    let mut out = Lines::new();
    head(&mut out, entry, created_by, &nodes, triangulation.triangles().len());
    for triangle in triangulation.triangles() {
        out.list("tri", triangle.iter().map(|index| (index + 1).to_string()));
    }
    for (index, node) in nodes.iter().enumerate() {
        write_model(&mut out, index + 1, node);
    }
    Ok(out.finish())
}

/// Lists the properties of a texture that [`write_hatt`] cannot store.
pub fn lost_in_hatt(entry: &TextureEntry) -> Vec<String> {
    let mut lost = Vec::new();
    if let Some(interpolation) = entry.model.interpolation() {
        let between = match interpolation {
            Interpolation::Barycentric => "levels",
            Interpolation::RadialBasis => "radial basis functions",
        };
        lost.push(format!(
            "the interpolation of {between} between nodes: the format interpolates variances, which can raise the level there by some dB"
        ));
    }
    lost.extend(lost_parts(entry, &[]));
    lost
}

fn published(node: &GrainNode) -> PublishedNode {
    PublishedNode {
        speed: node.speed,
        force: node.force,
        ar_lsf: node.lsf.clone(),
        ma_lsf: neutral_moving_average(node.lsf.len().saturating_sub(2)),
        variance: node.level_mps2 * node.level_mps2 / power_gain(&ar_from_lsf(&node.lsf)),
        gain: 1.0,
    }
}

fn with_moving_average(node: &PublishedNode) -> PublishedNode {
    let order = node.ar_lsf.len().saturating_sub(2);
    let ma_lsf = if node.ma_lsf.is_empty() { neutral_moving_average(order) } else { node.ma_lsf.clone() };
    PublishedNode { ma_lsf, ..node.clone() }
}

fn head(
    out: &mut Lines,
    entry: &TextureEntry,
    created_by: &str,
    nodes: &[PublishedNode],
    n_triangles: usize,
) {
    let model: &TextureModel = &entry.model;
    let one = |text: &str| [escaped(text)];
    let count = |n: usize| [n.to_string()];
    out.line("material", one(&entry.name));
    match entry.provenance {
        Provenance::Free => out.line(CREATED_BY, one(created_by)),
        Provenance::Restricted => out.comment(RESTRICTED_TERMS),
    }
    out.line("AccelUnits", one("m/s^2"));
    out.line("SpeedUnits", one("mm/s"));
    out.line("ForceUnits", one("N"));
    out.line("SampleRate", [model.rate().0.to_string()]);
    out.line("mu", model.friction().map(|mu| mu.to_string()));
    out.line("numMod", count(nodes.len()));
    out.line("numTri", count(n_triangles));
    out.line("maxSpeed", [model.speed_max().mm_per_s().to_string()]);
    out.line("maxForce", [model.force_max().0.to_string()]);
    out.list("speedList", nodes.iter().map(|node| node.speed.mm_per_s().to_string()));
    out.list("forceList", nodes.iter().map(|node| node.force.0.to_string()));
    out.line("numARCoeff", count(model.order()));
    out.line("numMACoeff", count(nodes.first().map_or(0, |node| node.ma_lsf.len())));
}

fn write_model(out: &mut Lines, number: usize, node: &PublishedNode) {
    out.open("model");
    out.line("modNum", [number.to_string()]);
    for (name, lsf) in [("AR", &node.ar_lsf), ("MA", &node.ma_lsf)] {
        let lsf = frequencies(lsf);
        let coefficients = [1.0].into_iter().chain(ar_from_lsf(&lsf));
        out.list(&format!("{name}coeff"), coefficients.map(|c| format!("{c:.20}")));
        out.list(&format!("{name}lsf"), lsf.iter().map(f64::to_string));
    }
    out.line("var", [node.variance.to_string()]);
    out.line("gain", [node.gain.to_string()]);
    out.line("speedMod", [node.speed.mm_per_s().to_string()]);
    out.line("forceMod", [node.force.0.to_string()]);
    out.close("model");
}

/// The text of an XML file, one element per line.
struct Lines {
    text: String,
}

impl Lines {
    fn new() -> Self {
        Self { text: "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<modelSet>\n".to_owned() }
    }

    /// Writes an element per text; none if there is no text.
    fn line(&mut self, element: &str, text: impl IntoIterator<Item = String>) {
        for text in text {
            // Writing to a string cannot fail.
            let _ = writeln!(self.text, "<{element}>{text}</{element}>");
        }
    }

    /// Writes a list of numbers with one element `value` per number, as published files do.
    fn list(&mut self, element: &str, numbers: impl IntoIterator<Item = String>) {
        let values: Vec<String> =
            numbers.into_iter().map(|number| format!("<value>{number}</value>")).collect();
        let values = values.concat();
        let _ = writeln!(self.text, "<{element}>{values}</{element}>");
    }

    /// Writes a comment; `text` must not contain two hyphens in a row.
    fn comment(&mut self, text: &str) {
        let _ = writeln!(self.text, "<!-- {text} -->");
    }

    fn open(&mut self, element: &str) {
        let _ = writeln!(self.text, "<{element}>");
    }

    fn close(&mut self, element: &str) {
        let _ = writeln!(self.text, "</{element}>");
    }

    fn finish(mut self) -> Vec<u8> {
        self.text.push_str("</modelSet>\n");
        self.text.into_bytes()
    }
}

/// Escapes text for XML; characters that XML forbids become spaces.
fn escaped(text: &str) -> String {
    let spelled = |c: char| match c {
        '&' => "&amp;".to_owned(),
        '<' => "&lt;".to_owned(),
        '>' => "&gt;".to_owned(),
        c if c.is_control() || matches!(c, '\u{FFFE}' | '\u{FFFF}') => " ".to_owned(),
        c => c.to_string(),
    };
    text.chars().map(spelled).collect()
}
