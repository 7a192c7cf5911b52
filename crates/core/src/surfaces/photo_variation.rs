//! Random variations of a photo, as training examples: other crops, light, colors, sharpness and noise of the same surface.
//!
//! A variation is applied at the input size of image networks, [`SIDE`] pixels, so that blur and noise have the same size
//! in the eyes of a network, whatever the size of the photo. The caller compresses the result as JPEG with
//! [`Variation::jpeg_quality`].

use std::f64::consts::TAU;

use crate::maths::rng::{Random, derive_seed};
use crate::surfaces::picture_features::{Patch, PictureError, SIDE, Square, central_patch, resampled};
use crate::surfaces::shading::Picture;

/// Smaller side in pixels below which a crop keeps at least [`LEAST_OF_SMALL`] of a photo.
const SMALL: usize = 200;
/// Smallest crop, as a share of the smaller side.
const LEAST_CROP: f64 = 0.35;
/// Smallest crop of a small photo, as a share of the smaller side.
const LEAST_OF_SMALL: f64 = 0.6;
/// Range of the standard deviation of Gaussian blur, in pixels.
const BLUR_PX: [f64; 2] = [0.3, 1.6];
/// Range of the factor on saturation.
const SATURATION: [f64; 2] = [0.1, 1.2];
/// Range of the exponent on the color values.
const GAMMA: [f64; 2] = [0.7, 1.4];
/// Range of the factor on the difference from middle gray.
const CONTRAST: [f64; 2] = [0.7, 1.3];
/// Range of the factors on red and on blue.
const WHITE: [f64; 2] = [0.85, 1.18];
/// Largest relative change of light from the center to the edge.
const MOST_SLOPE: f64 = 0.3;
/// Largest relative loss of light in the corners.
const MOST_VIGNETTE: f64 = 0.35;
/// Largest standard deviation of the noise, 0 to 1.
const MOST_NOISE: f64 = 0.02;
/// Range of the JPEG quality.
const JPEG_QUALITY: [u8; 2] = [50, 92];

/// Random variation of a photo.
#[derive(Clone, Debug, PartialEq)]
pub struct Variation {
    /// Side of the crop as a share of the smaller side of the photo, 0 to 1.
    pub crop: f64,
    /// Place of the crop within the photo along each axis, 0 to 1.
    pub place: [f64; 2],
    /// Number of quarter turns clockwise, 0 to 3.
    pub n_turns: usize,
    /// Whether left and right are exchanged, after the turns.
    pub is_mirrored: bool,
    /// Standard deviation of Gaussian blur, in pixels of the result.
    pub blur_px: f64,
    /// Factor on saturation.
    pub saturation: f64,
    /// Exponent on the color values.
    pub gamma: f64,
    /// Factor on the difference from middle gray.
    pub contrast: f64,
    /// Factor on red, green and blue.
    pub white: [f64; 3],
    /// Relative change of light from the center to the right and to the lower edge.
    pub light_slope: [f64; 2],
    /// Relative loss of light in the corners, 0 to 1.
    pub vignette: f64,
    /// Standard deviation of the noise of each color value, which is 0 to 1.
    pub noise: f64,
    /// Seed of the noise.
    pub noise_seed: u64,
    /// JPEG quality, 1 to 100.
    pub jpeg_quality: u8,
}

impl Variation {
    /// Returns the variation that changes nothing but the size, of the central square.
    pub fn none() -> Self {
        Self {
            crop: 1.0,
            place: [0.5; 2],
            n_turns: 0,
            is_mirrored: false,
            blur_px: 0.0,
            saturation: 1.0,
            gamma: 1.0,
            contrast: 1.0,
            white: [1.0; 3],
            light_slope: [0.0; 2],
            vignette: 0.0,
            noise: 0.0,
            noise_seed: 0,
            jpeg_quality: 100,
        }
    }

    /// Returns the random variation with this seed, for a photo whose smaller side has `smaller_side` pixels.
    pub fn draw(seed: u64, smaller_side: usize) -> Self {
        let mut random = Random::new(derive_seed(seed, "photo variation"));
        let least = if smaller_side < SMALL { LEAST_OF_SMALL } else { LEAST_CROP };
        let crop = between(&mut random, [least, 1.0]);
        let place = [random.uniform(), random.uniform()];
        let n_turns = random.below(4);
        let is_mirrored = random.below(2) == 1;
        let blur_px = between(&mut random, BLUR_PX);
        let saturation = between(&mut random, SATURATION);
        let gamma = between(&mut random, GAMMA.map(f64::ln)).exp();
        let contrast = between(&mut random, CONTRAST);
        let white = [between(&mut random, WHITE), 1.0, between(&mut random, WHITE)];
        let (slope, angle) = (MOST_SLOPE * random.uniform(), TAU * random.uniform());
        let [low, high] = JPEG_QUALITY;
        Self {
            crop,
            place,
            n_turns,
            is_mirrored,
            blur_px,
            saturation,
            gamma,
            contrast,
            white,
            light_slope: [slope * angle.cos(), slope * angle.sin()],
            vignette: MOST_VIGNETTE * random.uniform(),
            noise: MOST_NOISE * random.uniform(),
            noise_seed: random.next_u64(),
            jpeg_quality: low + random.below(usize::from(high - low) + 1) as u8,
        }
    }

    /// Returns the varied photo, a square of [`SIDE`] pixels, before its compression.
    ///
    /// # Errors
    /// As [`crate::surfaces::picture_features::square`].
    pub fn apply(&self, photo: &Picture) -> Result<Picture, PictureError> {
        let smaller = central_patch(photo)?.side;
        let side = ((self.crop * smaller as f64).round() as usize).clamp(1, smaller);
        let begin = |share: f64, room: usize| ((share * room as f64) as usize).min(room);
        let patch = Patch {
            left: begin(self.place[0], photo.width - side),
            top: begin(self.place[1], photo.height - side),
            side,
        };
        let mut rgb = turned(&resampled(photo, patch), self.n_turns, self.is_mirrored);
        if self.blur_px > 0.0 {
            rgb = blurred(&rgb, self.blur_px);
        }
        self.expose(&mut rgb);
        if self.noise > 0.0 {
            let mut random = Random::new(self.noise_seed);
            for x in &mut rgb {
                *x += (self.noise * random.normal()) as f32;
            }
        }
        let bytes = rgb.iter().map(|x| (255.0 * x.clamp(0.0, 1.0)).round() as u8).collect();
        let millimeters = photo.millimeters * side as f64 / photo.width.max(1) as f64;
        Ok(Picture { width: SIDE, height: SIDE, rgb: bytes, millimeters })
    }

    /// Changes colors and light.
    fn expose(&self, rgb: &mut [f32]) {
        let Self { saturation, gamma, contrast, white, light_slope, vignette, .. } = *self;
        // From -1 at the first pixel to 1 at the last.
        let along = |i: usize| 2.0 * i as f64 / (SIDE - 1) as f64 - 1.0;
        for (i, pixel) in rgb.chunks_exact_mut(3).enumerate() {
            let (x, y) = (along(i % SIDE), along(i / SIDE));
            let light =
                (1.0 + light_slope[0] * x + light_slope[1] * y) * (1.0 - 0.5 * vignette * (x * x + y * y));
            let mut color = [0.0; 3];
            for ((color, value), white) in color.iter_mut().zip(&*pixel).zip(white) {
                *color = white * f64::from(*value);
            }
            let gray = 0.2126 * color[0] + 0.7152 * color[1] + 0.0722 * color[2];
            for (value, color) in pixel.iter_mut().zip(color) {
                let colored = (gray + saturation * (color - gray)).max(0.0).powf(gamma);
                *value = (light * (0.5 + contrast * (colored - 0.5))) as f32;
            }
        }
    }
}

fn between(random: &mut Random, [low, high]: [f64; 2]) -> f64 {
    low + (high - low) * random.uniform()
}

/// Returns the pixels after quarter turns clockwise, then mirrored.
fn turned(square: &Square, n_turns: usize, is_mirrored: bool) -> Vec<f32> {
    let last = SIDE - 1;
    let source = |i: usize| {
        let (x, y) = (i % SIDE, i / SIDE);
        let x = if is_mirrored { last - x } else { x };
        let (x, y) = match n_turns % 4 {
            0 => (x, y),
            1 => (y, last - x),
            2 => (last - x, last - y),
            _ => (last - y, x),
        };
        3 * (y * SIDE + x)
    };
    (0..SIDE * SIDE).flat_map(|i| square.rgb[source(i)..].iter().take(3).copied()).collect()
}

/// Returns the pixels after Gaussian blur; pixels at the edges are repeated beyond them.
fn blurred(rgb: &[f32], blur_px: f64) -> Vec<f32> {
    let radius = (3.0 * blur_px).ceil() as usize;
    let mut kernel: Vec<f32> = (0..=2 * radius)
        .map(|i| (-0.5 * ((i as f64 - radius as f64) / blur_px).powi(2)).exp() as f32)
        .collect();
    let sum: f32 = kernel.iter().sum();
    for share in &mut kernel {
        *share /= sum;
    }
    let along = |rgb: &[f32], step: usize, position: fn(usize) -> usize| -> Vec<f32> {
        (0..rgb.len())
            .map(|i| {
                let at = position(i / 3);
                let taps = kernel.iter().enumerate();
                taps.map(|(tap, share)| {
                    let from = (at + tap).saturating_sub(radius).min(SIDE - 1);
                    share * rgb[i - at * step + from * step]
                })
                .sum()
            })
            .collect()
    };
    let rows = along(rgb, 3, |pixel| pixel % SIDE);
    along(&rows, 3 * SIDE, |pixel| pixel / SIDE)
}

#[cfg(test)]
mod tests;
