//! Numbers that the five papers print, for the tables that show ours beside them.
//!
//! `assets/reproduce/printed.toml` has an `[[item]]` for each table and figure that is reproduced: `paper`, `id`, `name` and
//! `place` in the paper, `title`, and `values`, which are empty for a picture without printed numbers. A value has an `id`, a
//! `name`, the `printed` number as a string with its digits, a `unit` if it has one, the `tolerance` up to which another
//! number counts as equal, and a `note` if the paper contradicts itself there.

use std::collections::BTreeSet;

use serde::Deserialize;

const TEXT: &str = include_str!("../../../assets/reproduce/printed.toml");

/// A paper whose procedure the program repeats.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Deserialize)]
pub enum Paper {
    /// The authoring space from sorts, ratings and vibrations.
    S0,
    /// Textures from texts, by way of pictures.
    S1,
    /// Attributes from strokes by a CNN-LSTM.
    S2,
    /// Predicted quality of compressed signals.
    S3,
    /// Spatial spectrograms.
    S4,
}

impl Paper {
    /// All papers, in order.
    pub const ALL: [Self; 5] = [Self::S0, Self::S1, Self::S2, Self::S3, Self::S4];

    /// Identifier on the command line and in file names.
    pub fn id(self) -> &'static str {
        match self {
            Self::S0 => "S0",
            Self::S1 => "S1",
            Self::S2 => "S2",
            Self::S3 => "S3",
            Self::S4 => "S4",
        }
    }

    /// Title of the publication.
    pub fn title(self) -> &'static str {
        match self {
            Self::S0 => {
                "Authoring New Haptic Textures Based on Interpolation of Real Textures in Affective Space"
            }
            Self::S1 => "Text-Driven Generative Framework for Multimodal Visual and Haptic Texture Synthesis",
            Self::S2 => {
                "Predicting Perceptual Haptic Attributes of Textured Surface from Tactile Data Based on Deep CNN-LSTM Network"
            }
            Self::S3 => "Objective Quality Prediction for Haptic Texture Signal Compression",
            Self::S4 => {
                "Modeling and Synthesis of Tactile Texture with Spatial Spectrograms for Display on Variable Friction Surfaces"
            }
        }
    }
}

/// A table or figure of a paper.
#[derive(Clone, Debug, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct PrintedItem {
    /// The paper.
    pub paper: Paper,
    /// Identifier, unique in its paper; it serves for file names.
    pub id: String,
    /// Name in the paper.
    pub name: String,
    /// Where it stands in the paper.
    pub place: String,
    /// What it shows.
    pub title: String,
    /// Its printed numbers, in order.
    pub values: Vec<PrintedValue>,
}

/// A printed number.
#[derive(Clone, Debug, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct PrintedValue {
    /// Identifier, unique in its item.
    pub id: String,
    /// What it is.
    pub name: String,
    /// The number, with the digits that are printed.
    pub printed: String,
    /// Unit of the number; empty for none.
    #[serde(default)]
    pub unit: String,
    /// Difference up to which another number counts as equal, in the unit, 0 or more.
    pub tolerance: f64,
    /// What is contradictory in print; empty for nothing.
    #[serde(default)]
    pub note: String,
}

/// Why the printed numbers are unavailable.
#[derive(Clone, Debug, thiserror::Error)]
#[non_exhaustive]
pub enum PrintedResultsError {
    /// Not TOML, or a key is missing, unknown or of the wrong type.
    #[error("the printed results of the papers are damaged: {0}; reinstall the program")]
    Damaged(#[from] toml::de::Error),
    /// Two items of a paper, or two values of an item, have the same identifier.
    #[error("the printed results of the papers have \"{id}\" twice; reinstall the program")]
    Twice {
        /// The identifier.
        id: String,
    },
    /// A printed number is no number, or its tolerance is negative.
    #[error("the printed value \"{id}\" of the papers is no number with a tolerance; reinstall the program")]
    Number {
        /// Identifier of the value.
        id: String,
    },
}

impl PrintedValue {
    /// The number; not finite if the text is none, which [`printed_results`] excludes.
    pub fn value(&self) -> f64 {
        self.printed.parse().unwrap_or(f64::NAN)
    }

    /// Number of printed decimals.
    pub fn n_decimals(&self) -> usize {
        self.printed.split_once('.').map_or(0, |(_, decimals)| decimals.len())
    }
}

/// Returns the tables and figures of a paper with their printed numbers, in the order of the paper.
///
/// # Errors
/// Fails only if the embedded file is damaged, which a test excludes.
pub fn printed_results(paper: Paper) -> Result<Vec<PrintedItem>, PrintedResultsError> {
    Ok(read(TEXT)?.into_iter().filter(|item| item.paper == paper).collect())
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct FileV1 {
    item: Vec<PrintedItem>,
}

fn read(text: &str) -> Result<Vec<PrintedItem>, PrintedResultsError> {
    let FileV1 { item: items } = toml::from_str(text)?;
    let mut ids = BTreeSet::new();
    for item in &items {
        if !ids.insert((item.paper, item.id.as_str())) {
            return Err(PrintedResultsError::Twice { id: item.id.clone() });
        }
        let mut of_values = BTreeSet::new();
        for value in &item.values {
            if !of_values.insert(value.id.as_str()) {
                return Err(PrintedResultsError::Twice { id: value.id.clone() });
            }
            // NaN fails both comparisons.
            if !(value.value().is_finite() && value.tolerance >= 0.0) {
                return Err(PrintedResultsError::Number { id: value.id.clone() });
            }
        }
    }
    drop(ids);
    Ok(items)
}

#[cfg(test)]
mod tests {
    use super::{Paper, PrintedResultsError, printed_results, read};

    #[test]
    fn the_committed_file_is_sound() {
        for paper in Paper::ALL {
            let items = printed_results(paper).unwrap();
            assert!(items.iter().any(|item| !item.values.is_empty()), "{}", paper.id());
            for item in &items {
                assert!(!item.name.is_empty() && !item.place.is_empty() && !item.title.is_empty());
                // Identifiers are parts of file names.
                let is_plain = |c: char| c.is_ascii_lowercase() || c.is_ascii_digit() || c == '-';
                assert!(item.id.chars().all(is_plain), "{}", item.id);
            }
        }
        let table = &printed_results(Paper::S0).unwrap()[2];
        let first = &table.values[0];
        assert_eq!((table.id.as_str(), first.value(), first.n_decimals()), ("table-1", -0.7565, 4));
    }

    #[test]
    fn a_damaged_file_says_what_is_wrong() {
        let item = |values: &str| {
            format!(
                "[[item]]\npaper = \"S0\"\nid = \"a\"\nname = \"n\"\nplace = \"p\"\ntitle = \"t\"\nvalues = [{values}]\n"
            )
        };
        let value = |id: &str, printed: &str, tolerance: &str| {
            format!("{{ id = \"{id}\", name = \"n\", printed = \"{printed}\", tolerance = {tolerance} }}")
        };
        assert!(read(&item(&value("x", "7", "0.0"))).is_ok());
        let twice = [item(""), item("")].concat();
        assert!(matches!(read(&twice), Err(PrintedResultsError::Twice { id }) if id == "a"));
        let values = [value("x", "7", "0.0"), value("x", "8", "0.0")].join(", ");
        assert!(matches!(read(&item(&values)), Err(PrintedResultsError::Twice { id }) if id == "x"));
        for (printed, tolerance) in [("seven", "0.0"), ("7", "-1.0"), ("7", "nan")] {
            let error = read(&item(&value("x", printed, tolerance))).unwrap_err();
            assert!(matches!(error, PrintedResultsError::Number { .. }), "{error}");
        }
        assert!(matches!(read("[[item]]\nother = 1\n"), Err(PrintedResultsError::Damaged(_))));
    }
}
