//! Rated pairs with the distances of their signals.

use std::path::{Path, PathBuf};

use anyhow::{Context as _, bail, ensure};
use shagreen_core::signals::quality::{
    Agreement, Distances, Feature, MOST_PAIRS, PAPER_RATE, QualityMeter, RatedPair, Relation,
};
use shagreen_core::words::counted;
use shagreen_formats::bounded_file::FileKind;
use shagreen_formats::project::sha256_hex;
use shagreen_formats::rated_pairs_csv::{RatedRow, read_rated_pairs};
use shagreen_formats::thresholds::ThresholdKind;

use crate::file::{file_name, in_file, read_file};
use crate::report::Reporter;

/// Rated pairs with the distances of their signals, and where they come from.
#[derive(Clone, Debug)]
pub struct RatedPairs {
    /// Name of the table's file.
    pub table: String,
    /// SHA-256 of the table, in hexadecimal digits.
    pub sha256: String,
    /// Rows of the table.
    pub rows: Vec<RatedRow>,
    /// The pairs, in the order of the rows; their textures are indices of [`RatedPairs::textures`].
    pub rated: Vec<RatedPair>,
    /// Names of the textures, in the order of their first rows.
    pub textures: Vec<String>,
    /// Features whose distances are known.
    pub features: Vec<Feature>,
    /// Detection threshold of the distances; `None` if the table states the distances.
    pub threshold: Option<ThresholdKind>,
}

impl RatedPairs {
    /// Whether simulated participants rated any of the pairs.
    pub fn is_simulated(&self) -> bool {
        self.rows.iter().any(|row| row.is_simulated)
    }
}

/// Reads a table of rated pairs, and the signals that it names unless it states their distances.
///
/// `load` returns the signal of a name in the table, in m/s² at [`PAPER_RATE`]. `threshold` is that of the distances. `on_step`
/// receives the number of pairs that are compared and the number of all, and returns whether to continue.
///
/// # Errors
/// The table or a signal cannot be used, or `on_step` ended the work; the message names the line.
pub fn load_pairs(
    path: &Path,
    threshold: ThresholdKind,
    load: &mut dyn FnMut(&str) -> anyhow::Result<Vec<f64>>,
    reporter: &dyn Reporter,
    on_step: &mut dyn FnMut(usize, usize) -> bool,
) -> anyhow::Result<RatedPairs> {
    let bytes = read_file(path, FileKind::Table)?;
    let read = read_rated_pairs(&bytes).with_context(|| in_file(path))?;
    for warning in &read.warnings {
        reporter.warn(warning);
    }
    let (rows, stated) = (read.value.rows, read.value.features);
    let n_rows = rows.len();
    // Before their signals are read.
    ensure!(
        n_rows <= MOST_PAIRS,
        "{n_rows} pairs are too many; use at most {MOST_PAIRS}: {}",
        path.display()
    );
    let mut comparer = Comparer::new(threshold)?;
    let mut textures: Vec<String> = Vec::new();
    let mut rated = Vec::with_capacity(n_rows);
    for (n_done, row) in rows.iter().enumerate() {
        if !on_step(n_done, n_rows) {
            bail!("no model was fitted: the work was ended");
        }
        let distances = match row.distances {
            Some(distances) => distances,
            None => comparer
                .distances(row, load)
                .with_context(|| format!("the pair of line {}", row.line))
                .with_context(|| in_file(path))?,
        };
        let texture = textures.iter().position(|name| *name == row.texture).unwrap_or_else(|| {
            textures.push(row.texture.clone());
            textures.len() - 1
        });
        rated.push(RatedPair { texture, distances, d_prime: row.d_prime, weight: row.weight });
    }
    on_step(n_rows, n_rows);
    comparer.report(reporter);
    Ok(RatedPairs {
        table: file_name(path),
        sha256: sha256_hex(&bytes),
        rows,
        rated,
        textures,
        threshold: stated.is_empty().then_some(threshold),
        features: if stated.is_empty() { Feature::ALL.to_vec() } else { stated },
    })
}

/// Returns the file of a signal that a table names: a file of this name in `folder`, or with the ending `.wav`.
///
/// # Errors
/// There is no such file.
pub fn signal_file(folder: &Path, name: &str) -> anyhow::Result<PathBuf> {
    let named = folder.join(name);
    let mut with_ending = named.clone().into_os_string();
    with_ending.push(".wav");
    for path in [named.as_path(), Path::new(&with_ending)] {
        if path.is_file() {
            return Ok(path.to_owned());
        }
    }
    bail!(
        "there is no signal \"{name}\" or \"{name}.wav\" in the folder {}; give the folder of the signals with --signals, or the plan of the study with --plan",
        folder.display()
    );
}

/// Computes distances of pairs, and remembers what was not quite as wanted.
struct Comparer {
    meter: QualityMeter,
    /// The last reference: the pairs of one reference usually stand one below the other.
    reference: Option<(String, Vec<f64>)>,
    /// Lines of pairs whose waveforms do not correlate.
    unlike: Vec<u64>,
    /// Lines of pairs with signals of different lengths.
    cut: Vec<u64>,
}

impl Comparer {
    fn new(threshold: ThresholdKind) -> anyhow::Result<Self> {
        let meter = QualityMeter::new(PAPER_RATE, &threshold.read()?)?;
        Ok(Self { meter, reference: None, unlike: Vec::new(), cut: Vec::new() })
    }

    fn distances(
        &mut self,
        row: &RatedRow,
        load: &mut dyn FnMut(&str) -> anyhow::Result<Vec<f64>>,
    ) -> anyhow::Result<Distances> {
        let comparison = load(&row.comparison)?;
        let known = self.reference.take().filter(|(name, _)| *name == row.reference);
        let reference = match known {
            Some((_, samples)) => samples,
            None => load(&row.reference)?,
        };
        let n_samples = reference.len().min(comparison.len());
        if reference.len() != comparison.len() {
            self.cut.push(row.line);
        }
        let [a, b] = [&reference[..n_samples], &comparison[..n_samples]];
        let distances = self.meter.distances(a, b)?;
        if distances.0.iter().any(|distance| !distance.is_finite()) {
            bail!("the levels of the signals are too large or too small; check their units (m/s²)");
        }
        if Agreement::of(a, b, PAPER_RATE).relation() != Relation::Processed {
            self.unlike.push(row.line);
        }
        self.reference = Some((row.reference.clone(), reference));
        Ok(distances)
    }

    fn report(&self, reporter: &dyn Reporter) {
        let first = |lines: &[u64]| lines.first().copied().unwrap_or_default();
        if !self.unlike.is_empty() {
            reporter.warn(&format!(
                "the waveforms of {} do not correlate (first in line {}); d' is then predicted mainly from their noise, and the model is no use for other such pairs",
                counted(self.unlike.len(), "pair"),
                first(&self.unlike)
            ));
        }
        if !self.cut.is_empty() {
            reporter.warn(&format!(
                "the signals of {} have different lengths (first in line {}); their common beginnings are compared",
                counted(self.cut.len(), "pair"),
                first(&self.cut)
            ));
        }
    }
}
