//! Features: textures as rows of numbers, each with a name that people can read.
//!
//! Either the cepstrum of the patterns that [`crate::patterns`] strokes, or a few quantities of physics.

mod error;
mod physical;

use ndarray::Array2;

use crate::mfcc::{MfccOptions, MfccPlan};
use crate::patterns::{PatternPlan, Patterns, pattern_name, render_patterns};
use crate::rng::derive_seed;
use crate::texture::TextureModel;
use crate::words::listed;

pub use crate::features::error::{FeatureError, FeatureWarning};
pub use crate::features::physical::{PHYSICAL_BAND, Physical, centroid, level_db, physical, physical_table};

/// A texture and what it is called.
#[derive(Clone, Copy, Debug)]
pub struct NamedTexture<'a> {
    /// Its name, which seeds its noise too: textures of one table have different ones.
    pub name: &'a str,
    /// What it does to a tip.
    pub model: &'a TextureModel,
}

/// Patterns and what is taken from them.
#[derive(Clone, Copy, Debug)]
pub struct FeaturePlan<'a> {
    /// The strokes; every texture has noise of its own that follows from the seed and its name.
    pub patterns: PatternPlan<'a>,
    /// How coefficients are taken of each pattern by itself: no frame lies across two patterns.
    pub mfcc: &'a MfccOptions,
}

/// What stands for the frames of a pattern.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Statistic {
    /// The mean of each coefficient.
    Mean,
    /// The mean and the standard deviation (over `n`, not `n - 1` frames) of each coefficient.
    MeanAndDeviation,
}

/// Features of textures.
#[derive(Clone, Debug, PartialEq)]
pub struct FeatureTable {
    /// How they came about, for whoever reads them.
    pub label: String,
    /// Names of the textures, one a row.
    pub textures: Vec<String>,
    /// Names of the features, one a column.
    pub names: Vec<String>,
    /// `textures × features`, all finite.
    pub values: Array2<f64>,
    /// What is not quite as asked.
    pub warnings: Vec<FeatureWarning>,
}

/// Every coefficient of every frame of every pattern, as the authoring paper has them.
///
/// Grain is noise: all but the first few coefficients of one frame say nothing about the texture, and what is selected
/// from tens of thousands of them for 25 textures is selected by chance. [`per_pattern`] is the one to use.
/// `go_on` is asked before every texture.
///
/// # Errors
/// See [`FeatureError`].
pub fn per_frame(
    textures: &[NamedTexture<'_>],
    plan: &FeaturePlan<'_>,
    go_on: &mut dyn FnMut() -> bool,
) -> Result<FeatureTable, FeatureError> {
    let names = |pattern: &str, n_frames: usize, n_coefficients: usize| {
        let of_frame = |frame: usize| {
            (0..n_coefficients).map(move |k| format!("c{k} of frame {frame} @ {pattern}")).collect::<Vec<_>>()
        };
        (0..n_frames).flat_map(of_frame).collect()
    };
    let values = |coefficients: &Array2<f64>| coefficients.iter().copied().collect();
    cepstral(textures, plan, "every frame", &names, &values, go_on)
}

/// The mean, or mean and deviation, of every coefficient over the frames of every pattern. `go_on` is asked before every
/// texture.
///
/// # Errors
/// See [`FeatureError`].
pub fn per_pattern(
    textures: &[NamedTexture<'_>],
    plan: &FeaturePlan<'_>,
    statistic: Statistic,
    go_on: &mut dyn FnMut() -> bool,
) -> Result<FeatureTable, FeatureError> {
    let with_deviation = statistic == Statistic::MeanAndDeviation;
    let names = |pattern: &str, _: usize, n_coefficients: usize| {
        let name = |k: usize| {
            let deviation = with_deviation.then(|| format!("s.d. of c{k} @ {pattern}"));
            std::iter::once(format!("c{k} @ {pattern}")).chain(deviation)
        };
        (0..n_coefficients).flat_map(name).collect()
    };
    let values = |coefficients: &Array2<f64>| {
        let n = coefficients.nrows() as f64;
        let value = |column: ndarray::ArrayView1<'_, f64>| {
            let mean = column.sum() / n;
            let square = column.iter().map(|c| (c - mean) * (c - mean)).sum::<f64>() / n;
            std::iter::once(mean).chain(with_deviation.then(|| square.sqrt()))
        };
        coefficients.columns().into_iter().flat_map(value).collect()
    };
    let how = if with_deviation { "mean and s.d. of frames" } else { "mean of frames" };
    cepstral(textures, plan, how, &names, &values, go_on)
}

impl FeatureTable {
    /// These features and then `other`'s, of the same textures.
    ///
    /// # Panics
    /// If the textures are not the same.
    #[must_use]
    pub fn beside(&self, other: &Self) -> Self {
        assert_eq!(self.textures, other.textures, "features of the same textures");
        let rows = self.values.rows().into_iter().zip(other.values.rows());
        let values = rows.flat_map(|(a, b)| a.iter().chain(b).copied().collect::<Vec<_>>()).collect();
        let names: Vec<String> = self.names.iter().chain(&other.names).cloned().collect();
        Self {
            label: format!("{}; {}", self.label, other.label),
            textures: self.textures.clone(),
            values: table(self.textures.len(), names.len(), values),
            names,
            // Patterns beyond a texture are beyond it for both.
            warnings: self
                .warnings
                .iter()
                .chain(other.warnings.iter().filter(|warning| !self.warnings.contains(warning)))
                .cloned()
                .collect(),
        }
    }

    /// The warnings in sentences; what is the same of several textures is said once.
    pub fn findings(&self) -> Vec<String> {
        let mut said: Vec<(String, Vec<&str>)> = Vec::new();
        for warning in &self.warnings {
            let (sentence, texture) = match warning {
                FeatureWarning::Pattern { texture, warning } => (warning.to_string(), Some(texture.as_str())),
                other => (other.to_string(), None),
            };
            match said.iter_mut().find(|(known, _)| *known == sentence) {
                Some((_, textures)) => textures.extend(texture),
                None => said.push((sentence, texture.into_iter().collect())),
            }
        }
        let named = |(sentence, textures): (String, Vec<&str>)| {
            if textures.is_empty() { sentence } else { format!("{}: {sentence}", listed(&textures)) }
        };
        said.into_iter().map(named).collect()
    }
}

/// A table of what `values` makes of the coefficients of each pattern, with the names that `names` makes of the pattern's
/// own, its frames and its coefficients.
fn cepstral(
    textures: &[NamedTexture<'_>],
    plan: &FeaturePlan<'_>,
    how: &str,
    names: &dyn Fn(&str, usize, usize) -> Vec<String>,
    values: &dyn Fn(&Array2<f64>) -> Vec<f64>,
    go_on: &mut dyn FnMut() -> bool,
) -> Result<FeatureTable, FeatureError> {
    check_names(textures)?;
    let PatternPlan { contacts, seconds, rate, seed } = plan.patterns;
    let mfcc = MfccPlan::new(plan.mfcc, rate)?;
    let mut warnings = Vec::new();
    if mfcc.n_empty_filters() > 0 {
        let (n, n_filters) = (mfcc.n_empty_filters(), plan.mfcc.n_filters);
        warnings.push(FeatureWarning::EmptyFilters { n, n_filters });
    }
    let mut all = Vec::new();
    for texture in textures {
        if !go_on() {
            return Err(FeatureError::Stopped);
        }
        let patterns = PatternPlan { seed: derive_seed(seed, texture.name), ..plan.patterns };
        let of_texture = |source| FeatureError::Patterns { texture: texture.name.to_owned(), source };
        let Patterns { signals, warnings: found } =
            render_patterns(texture.model, &patterns).map_err(of_texture)?;
        let named = |warning| FeatureWarning::Pattern { texture: texture.name.to_owned(), warning };
        warnings.extend(found.into_iter().map(named));
        for (signal, contact) in signals.iter().zip(contacts) {
            let coefficients = mfcc.coefficients(signal).map_err(|source| FeatureError::Coefficients {
                texture: texture.name.to_owned(),
                pattern: pattern_name(*contact),
                source,
            })?;
            all.extend(values(&coefficients));
        }
    }
    let n_frames = mfcc.n_frames((seconds * rate.0).round() as usize);
    let of_pattern =
        |contact: &crate::units::Contact| names(&pattern_name(*contact), n_frames, mfcc.n_coefficients());
    let names: Vec<String> = contacts.iter().flat_map(of_pattern).collect();
    Ok(FeatureTable {
        label: format!("{}, {how}, {} patterns of {seconds} s at {rate}", mfcc.label(), contacts.len()),
        values: table(textures.len(), names.len(), all),
        textures: textures.iter().map(|t| t.name.to_owned()).collect(),
        names,
        warnings,
    })
}

fn check_names(textures: &[NamedTexture<'_>]) -> Result<(), FeatureError> {
    if textures.is_empty() {
        return Err(FeatureError::NoTextures);
    }
    for (i, texture) in textures.iter().enumerate() {
        if textures[..i].iter().any(|other| other.name == texture.name) {
            return Err(FeatureError::SameName { name: texture.name.to_owned() });
        }
    }
    Ok(())
}

fn table(n_textures: usize, n_features: usize, values: Vec<f64>) -> Array2<f64> {
    match Array2::from_shape_vec((n_textures, n_features), values) {
        Ok(table) => table,
        Err(error) => unreachable!("every texture has every feature: {error}"),
    }
}

#[cfg(test)]
mod tests;
