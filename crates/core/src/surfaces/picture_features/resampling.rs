//! Square parts of a picture, resampled to the input size of image networks.

use super::{PictureError, SIDE, Square};
use crate::surfaces::shading::Picture;

/// Smallest side of a picture, in pixels.
const LEAST_SIDE: usize = 16;

/// Square part of a picture, in pixels from the upper left.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Patch {
    pub(crate) left: usize,
    pub(crate) top: usize,
    /// At least 1; the patch lies within the picture.
    pub(crate) side: usize,
}

/// Returns the largest central square of a picture.
///
/// # Errors
/// As [`super::square`].
pub(crate) fn central_patch(picture: &Picture) -> Result<Patch, PictureError> {
    let Picture { width, height, ref rgb, .. } = *picture;
    let side = width.min(height);
    if side < LEAST_SIDE {
        return Err(PictureError::TooSmall { width, height });
    }
    if rgb.len() != 3 * width * height {
        return Err(PictureError::Bytes { n: rgb.len(), expected: 3 * width * height });
    }
    Ok(Patch { left: (width - side) / 2, top: (height - side) / 2, side })
}

/// Returns a patch, averaged by area, or interpolated linearly if it has fewer pixels than the result.
pub(crate) fn resampled(picture: &Picture, patch: Patch) -> Square {
    if patch.side < SIDE { weighted(picture, patch, neighbors) } else { by_area(picture, patch) }
}

/// Returns a patch, averaged by area at any size; pixels of a small patch become blocks.
pub(super) fn by_area(picture: &Picture, patch: Patch) -> Square {
    weighted(picture, patch, cover)
}

/// Returns a patch in which each output pixel is the sum of source pixels with the weights of `parts(pixel, side)`, along
/// each axis.
fn weighted(picture: &Picture, patch: Patch, parts: fn(usize, usize) -> Vec<(usize, f32)>) -> Square {
    let Picture { width, ref rgb, .. } = *picture;
    let Patch { left, top, side } = patch;
    let covers: Vec<Vec<(usize, f32)>> = (0..SIDE).map(|pixel| parts(pixel, side)).collect();
    // Rows first, then columns.
    let mut rows = vec![0.0_f32; side * SIDE * 3];
    for y in 0..side {
        for (x, cover) in covers.iter().enumerate() {
            for channel in 0..3 {
                let at = |from: usize| f32::from(rgb[3 * ((top + y) * width + left + from) + channel]);
                rows[3 * (y * SIDE + x) + channel] =
                    cover.iter().map(|(from, share)| share * at(*from)).sum();
            }
        }
    }
    let mut square = vec![0.0; 3 * SIDE * SIDE];
    for (y, cover) in covers.iter().enumerate() {
        for x in 0..3 * SIDE {
            let sum: f32 = cover.iter().map(|(from, share)| share * rows[3 * SIDE * from + x]).sum();
            square[3 * SIDE * y + x] = sum / 255.0;
        }
    }
    Square { rgb: square }
}

/// Source pixels of `side` that one of [`SIDE`] output pixels covers, each with its area fraction.
fn cover(pixel: usize, side: usize) -> Vec<(usize, f32)> {
    let scale = side as f64 / SIDE as f64;
    let (begin, end) = (pixel as f64 * scale, (pixel + 1) as f64 * scale);
    let parts = begin.floor() as usize..(end.ceil() as usize).min(side);
    let share = |from: usize| (end.min(from as f64 + 1.0) - begin.max(from as f64)) / scale;
    parts.map(|from| (from, share(from) as f32)).filter(|(_, share)| *share > 0.0).collect()
}

/// The two source pixels of `side` nearest to the center of an output pixel, each with its linear weight.
fn neighbors(pixel: usize, side: usize) -> Vec<(usize, f32)> {
    let last = side - 1;
    let center = (pixel as f64 + 0.5) * side as f64 / SIDE as f64 - 0.5;
    let center = center.clamp(0.0, last as f64);
    let first = center.floor() as usize;
    let share = center.fract() as f32;
    vec![(first, 1.0 - share), ((first + 1).min(last), share)]
}
