//! Feature extraction: describes each texture by a row of named numbers.
//!
//! Features are either mel-frequency cepstral coefficients (MFCC) of rendered stroke patterns
//! ([`crate::texture::patterns`]) or a few physical quantities.

mod error;
mod physical;

use ndarray::Array2;
use rayon::iter::{IntoParallelRefIterator, ParallelIterator};

use crate::dsp::mfcc::{MfccOptions, MfccPlan};
use crate::maths::rng::derive_seed;
use crate::texture::TextureModel;
use crate::texture::patterns::{PatternPlan, Patterns, pattern_name, render_patterns};
use crate::words::listed;

pub use crate::space::features::error::{FeatureError, FeatureWarning};
pub use crate::space::features::physical::{
    PHYSICAL_BAND, Physical, centroid, level_db, physical, physical_table,
};

/// A texture model and its name.
#[derive(Clone, Copy, Debug)]
pub struct NamedTexture<'a> {
    /// Name of the texture. The seed of the noise also depends on it, so the textures of one table have different
    /// noise.
    pub name: &'a str,
    /// Model of the texture.
    pub model: &'a TextureModel,
}

/// Stroke patterns and the coefficients to compute from them.
#[derive(Clone, Copy, Debug)]
pub struct FeaturePlan<'a> {
    /// Stroke patterns; the noise of each texture depends on the seed and on its name.
    pub patterns: PatternPlan<'a>,
    /// MFCC options, applied to each pattern separately: no frame spans two patterns.
    pub mfcc: &'a MfccOptions,
}

/// Summary statistic over the frames of a pattern.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Statistic {
    /// Mean of each coefficient.
    Mean,
    /// Mean and standard deviation (divided by `n`, not `n - 1` frames) of each coefficient.
    MeanAndDeviation,
}

/// Features of a set of textures.
#[derive(Clone, Debug, PartialEq)]
pub struct FeatureTable {
    /// Description of how the features were computed, for display.
    pub label: String,
    /// Names of the textures, one per row.
    pub textures: Vec<String>,
    /// Names of the features, one per column.
    pub names: Vec<String>,
    /// Feature values, `textures × features`, all finite.
    pub values: Array2<f64>,
    /// Deviations from the requested patterns and options.
    pub warnings: Vec<FeatureWarning>,
}

/// Every coefficient of every frame of every pattern, as in the authoring paper ([`crate::space`]).
///
/// The vibration is noise: except for the first few coefficients, a single frame carries no information about the
/// texture. For 25 textures, a selection from tens of thousands of such features is a selection by chance. Use
/// [`per_pattern`] instead. `go_on` is called before every texture; returning `false` stops the computation.
///
/// # Errors
/// See [`FeatureError`].
pub fn per_frame(
    textures: &[NamedTexture<'_>],
    plan: &FeaturePlan<'_>,
    go_on: &(dyn Fn() -> bool + Sync),
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

/// Mean, or mean and standard deviation, of every coefficient over the frames of each pattern. `go_on` is called before
/// every texture; returning `false` stops the computation.
///
/// # Errors
/// See [`FeatureError`].
pub fn per_pattern(
    textures: &[NamedTexture<'_>],
    plan: &FeaturePlan<'_>,
    statistic: Statistic,
    go_on: &(dyn Fn() -> bool + Sync),
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
    /// Concatenates the columns of this table and of `other`, for the same textures.
    ///
    /// # Panics
    /// If the two tables have different textures.
    #[must_use]
    pub fn beside(&self, other: &Self) -> Self {
        assert_eq!(self.textures, other.textures, "both feature tables must have the same textures");
        let rows = self.values.rows().into_iter().zip(other.values.rows());
        let values = rows.flat_map(|(a, b)| a.iter().chain(b).copied().collect::<Vec<_>>()).collect();
        let names: Vec<String> = self.names.iter().chain(&other.names).cloned().collect();
        Self {
            label: format!("{}; {}", self.label, other.label),
            textures: self.textures.clone(),
            values: table(self.textures.len(), names.len(), values),
            names,
            // Patterns outside the range of a texture produce the same warning in both tables.
            warnings: self
                .warnings
                .iter()
                .chain(other.warnings.iter().filter(|warning| !self.warnings.contains(warning)))
                .cloned()
                .collect(),
        }
    }

    /// Warnings as sentences; equal warnings about several textures are merged into one sentence.
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

/// Feature table from the coefficients of each pattern. `values` computes the features of a pattern; `names` returns
/// their names from the name of the pattern, the number of frames and the number of coefficients.
fn cepstral(
    textures: &[NamedTexture<'_>],
    plan: &FeaturePlan<'_>,
    how: &str,
    names: &dyn Fn(&str, usize, usize) -> Vec<String>,
    values: &(dyn Fn(&Array2<f64>) -> Vec<f64> + Sync),
    go_on: &(dyn Fn() -> bool + Sync),
) -> Result<FeatureTable, FeatureError> {
    check_names(textures)?;
    let PatternPlan { contacts, seconds, rate, seed } = plan.patterns;
    let mfcc = MfccPlan::new(plan.mfcc, rate)?;
    let mut warnings = Vec::new();
    if mfcc.n_empty_filters() > 0 {
        let (n, n_filters) = (mfcc.n_empty_filters(), plan.mfcc.n_filters);
        warnings.push(FeatureWarning::EmptyFilters { n, n_filters });
    }
    let of_texture = |texture: &NamedTexture<'_>| {
        if !go_on() {
            return Err(FeatureError::Stopped);
        }
        let patterns = PatternPlan { seed: derive_seed(seed, texture.name), ..plan.patterns };
        let in_texture = |source| FeatureError::Patterns { texture: texture.name.to_owned(), source };
        let Patterns { signals, warnings } = render_patterns(texture.model, &patterns).map_err(in_texture)?;
        let mut row = Vec::new();
        for (signal, contact) in signals.iter().zip(contacts) {
            let coefficients = mfcc.coefficients(signal).map_err(|source| FeatureError::Coefficients {
                texture: texture.name.to_owned(),
                pattern: pattern_name(*contact),
                source,
            })?;
            row.extend(values(&coefficients));
        }
        let named = |warning| FeatureWarning::Pattern { texture: texture.name.to_owned(), warning };
        Ok((row, warnings.into_iter().map(named).collect::<Vec<_>>()))
    };
    // All results are collected before the first error is returned, so that the returned error does not depend on the
    // order of the threads.
    let of_textures: Vec<Result<_, FeatureError>> = textures.par_iter().map(of_texture).collect();
    let mut all = Vec::new();
    for of_texture in of_textures {
        let (row, found) = of_texture?;
        all.extend(row);
        warnings.extend(found);
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
