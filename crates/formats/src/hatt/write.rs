//! From a texture to a file of the toolkit.

use std::fmt::Write as _;

use shagreen_core::ar::power_gain;
use shagreen_core::lsf::ar_from_lsf;
use shagreen_core::texture::{Grain, GrainNode, Interpolation, PublishedNode, TextureModel};
use shagreen_core::triangulation::{Triangulation, TriangulationError};
use shagreen_core::units::Contact;

use crate::hatt::boundary::close;
use crate::hatt::read::neutral_moving_average;
use crate::hatt::{CREATED_BY, RESTRICTED_TERMS};
use crate::library::{Provenance, TextureEntry, frequencies};

/// Why a texture is not written.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum HattWriteError {
    /// The nodes have no triangles.
    #[error("the speeds and forces of texture \"{id}\" have no triangles ({source}); correct its nodes")]
    Triangles {
        /// Identifier of the texture.
        id: String,
        /// What is wrong.
        source: TriangulationError,
    },
}

/// Writes a texture; `created_by` is the program with its version, by which a reader knows that the file is none of the
/// published ones. A restricted texture gets its terms in a comment and no such mark: it stays restricted when it is read
/// again.
///
/// A measured texture becomes what the published renderer expects: a moving average two orders below the predictor,
/// which changes nothing (`B(z) = 1`), gain 1, the variance of the excitation, and the models of the boundary. Spectra and
/// levels at the nodes stay; between them the published renderer interpolates variances where Shagreen interpolates
/// levels, and a landing has no place in the format. The renderer that was published supposes 1000 Hz and at most 24
/// coefficients; rate and order are written as they are.
///
/// Coefficients have 20 decimals, line spectral frequencies 6 (more where two lie close), model numbers count from one.
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

/// Sentences on what of a texture [`write_hatt`] cannot keep.
pub fn lost_in_hatt(entry: &TextureEntry) -> Vec<String> {
    let mut lost = Vec::new();
    if let Some(interpolation) = entry.model.interpolation() {
        let between = match interpolation {
            Interpolation::Barycentric => "levels",
            Interpolation::RadialBasis => "a radial basis",
        };
        lost.push(format!(
            "how {between} are interpolated between nodes: the format interpolates variances, which is up to some dB louder there"
        ));
    }
    if entry.path.is_some() {
        lost.push("how it changes along the stroke: only its beginning is written".to_owned());
    }
    if entry.model.tap().is_some() {
        lost.push("the tap of a landing".to_owned());
    }
    if entry.model.relief().is_some() {
        lost.push("the relief".to_owned());
    }
    if entry.place.is_some() {
        lost.push("the place in the space".to_owned());
    }
    if entry.picture.is_some() {
        lost.push("the picture".to_owned());
    }
    if entry.physical.is_some() {
        lost.push("the physical labels".to_owned());
    }
    let said = [&entry.description, &entry.license, &entry.origin];
    if !(entry.tags.is_empty() && said.iter().all(|text| text.is_empty())) {
        lost.push("tags, description, licence and origin".to_owned());
    }
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

/// The text of an XML file, an element a line.
struct Lines {
    text: String,
}

impl Lines {
    fn new() -> Self {
        Self { text: "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<modelSet>\n".to_owned() }
    }

    /// An element with text, or none where there is no text.
    fn line(&mut self, element: &str, text: impl IntoIterator<Item = String>) {
        for text in text {
            // Memory takes all text.
            let _ = writeln!(self.text, "<{element}>{text}</{element}>");
        }
    }

    /// A list of numbers: one element `value` each, as published files have it.
    fn list(&mut self, element: &str, numbers: impl IntoIterator<Item = String>) {
        let values: Vec<String> =
            numbers.into_iter().map(|number| format!("<value>{number}</value>")).collect();
        let values = values.concat();
        let _ = writeln!(self.text, "<{element}>{values}</{element}>");
    }

    /// `text` has no two hyphens in a row.
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

/// Text for XML: what has a meaning there is spelled out, what cannot stand there is left out.
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
