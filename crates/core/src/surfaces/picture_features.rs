//! Texture features of a surface picture, computed without a network.
//!
//! They are gray-level co-occurrence features, wavelet energies, spectral slope, and brightness and color statistics.
//! Each picture is first cropped to its central square and resampled to [`SIDE`] pixels.

mod co_occurrence;
mod resampling;
mod spectrum;
mod wavelets;

use crate::maths::statistics::{mean, standard_deviation};
use crate::surfaces::picture_features::co_occurrence::{N_OF_DISTANCE, co_occurrence};
use crate::surfaces::picture_features::resampling::by_area;
use crate::surfaces::picture_features::spectrum::{N_OF_SPECTRUM, spectral};
use crate::surfaces::picture_features::wavelets::{N_LEVELS, haar_energies};
use crate::surfaces::shading::Picture;

pub(crate) use crate::surfaces::picture_features::resampling::{Patch, central_patch, resampled};

/// Side of the resampled square in pixels, a usual input size of image networks.
pub const SIDE: usize = 224;

/// Pixel distances of the gray-level co-occurrence matrices.
const DISTANCES: [usize; 4] = [1, 2, 5, 12];

/// Number of brightness and color features.
const N_OF_LIGHT: usize = 7;

/// Number of features per picture.
pub const N_FEATURES: usize =
    DISTANCES.len() * N_OF_DISTANCE + N_LEVELS + N_LEVELS + N_OF_SPECTRUM + N_OF_LIGHT;

/// Luma above which a pixel is a highlight, 0 to 1.
const HIGHLIGHT: f64 = 0.93;

/// Reasons why a picture has no features.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
#[non_exhaustive]
pub enum PictureError {
    /// The picture is too small.
    #[error("the picture has {width} x {height} pixels; use one of at least 16 x 16 pixels")]
    TooSmall {
        /// Pixels per row.
        width: usize,
        /// Number of rows.
        height: usize,
    },
    /// The number of bytes is not three per pixel.
    #[error("the picture has {n} bytes, needs {expected}: three per pixel")]
    Bytes {
        /// Given number of bytes.
        n: usize,
        /// Required number of bytes.
        expected: usize,
    },
}

/// A square of [`SIDE`] × [`SIDE`] pixels; red, green and blue from 0 to 1, row by row.
#[derive(Clone, Debug, PartialEq)]
pub struct Square {
    /// `3 SIDE²` numbers.
    pub rgb: Vec<f32>,
}

/// Returns the central square of a picture, resampled by area averaging.
///
/// # Errors
/// [`PictureError::TooSmall`] below 16 × 16 pixels, [`PictureError::Bytes`] unless there are three bytes per pixel.
pub fn square(picture: &Picture) -> Result<Square, PictureError> {
    let center = central_patch(picture)?;
    Ok(by_area(picture, center))
}

/// Number of views that [`views`] returns.
pub const N_VIEWS: usize = 5;

/// Returns the whole central square of a picture, then its upper left, upper right, lower left and lower right quarter.
///
/// A view with fewer than [`SIDE`] pixels per side is interpolated linearly; others are averaged by area. From [`SIDE`]
/// pixels on, the first view is therefore that of [`square`].
///
/// # Errors
/// As [`square`].
pub fn views(picture: &Picture) -> Result<[Square; N_VIEWS], PictureError> {
    let whole = central_patch(picture)?;
    let half = whole.side / 2;
    let rest = whole.side - half;
    let quarter = |x: usize, y: usize| Patch { left: whole.left + x, top: whole.top + y, side: half };
    let patches = [whole, quarter(0, 0), quarter(rest, 0), quarter(0, rest), quarter(rest, rest)];
    Ok(patches.map(|patch| resampled(picture, patch)))
}

/// Returns the energy of the details of each size, finest first: 2, 4, … 32 pixels. Their sum is four times the part of
/// the variance of luma that these details make up.
pub(crate) fn detail_energies(square: &Square) -> Vec<f64> {
    let gray: Vec<f64> = square.rgb.chunks_exact(3).map(brightness).collect();
    haar_energies(&gray, SIDE).iter().map(|energies| energies.iter().sum()).collect()
}

/// Returns the texture features of a picture, [`N_FEATURES`] numbers in this order:
///
/// * for each distance of 1, 2, 5 and 12 pixels: contrast, correlation, homogeneity, uniformity and entropy of the
///   gray-level co-occurrence matrix;
/// * wavelet energy per level in dB, finest level first;
/// * wavelet anisotropy per level: absolute difference in dB between the two axes;
/// * slope, level, deviation from the fitted line, and direction of the spectrum;
/// * mean, standard deviation and skewness of luma, fraction of highlights, mean and standard deviation of saturation,
///   and warmth (mean red minus blue).
pub fn features(square: &Square) -> Vec<f64> {
    let gray: Vec<f64> = square.rgb.chunks_exact(3).map(brightness).collect();
    let mut features = Vec::with_capacity(N_FEATURES);
    for distance in DISTANCES {
        features.extend(co_occurrence(&gray, SIDE, distance));
    }
    let energies = haar_energies(&gray, SIDE);
    features.extend(energies.iter().map(|energy| decibels(energy.iter().sum())));
    features
        .extend(energies.iter().map(|[across, along, _]| decibels(*across) - decibels(*along)).map(f64::abs));
    features.extend(spectral(&gray, SIDE));
    features.extend(light(square, &gray));
    features
}

/// Rec. 709 luma of one pixel.
fn brightness(pixel: &[f32]) -> f64 {
    0.2126 * f64::from(pixel[0]) + 0.7152 * f64::from(pixel[1]) + 0.0722 * f64::from(pixel[2])
}

/// Power in dB, with a floor at one 8-bit step on one pixel in a hundred.
fn decibels(power: f64) -> f64 {
    10.0 * power.max(1.5e-7).log10()
}

fn light(square: &Square, gray: &[f64]) -> [f64; N_OF_LIGHT] {
    let (middle, deviation) = (mean(gray), standard_deviation(gray));
    let cubes = gray.iter().map(|x| (x - middle).powi(3)).sum::<f64>() / gray.len() as f64;
    // A picture of uniform brightness has zero skewness.
    let skewness = if deviation > 1e-4 { cubes / deviation.powi(3) } else { 0.0 };
    let highlights = gray.iter().filter(|x| **x > HIGHLIGHT).count() as f64 / gray.len() as f64;
    let saturation: Vec<f64> = square
        .rgb
        .chunks_exact(3)
        .map(|pixel| {
            let most = pixel.iter().copied().fold(0.0, f32::max);
            let least = pixel.iter().copied().fold(1.0, f32::min);
            f64::from(if most > 0.0 { (most - least) / most } else { 0.0 })
        })
        .collect();
    let warmth = square.rgb.chunks_exact(3).map(|pixel| f64::from(pixel[0] - pixel[2])).sum::<f64>();
    [
        middle,
        deviation,
        skewness,
        highlights,
        mean(&saturation),
        standard_deviation(&saturation),
        warmth / gray.len() as f64,
    ]
}

#[cfg(test)]
mod tests;
