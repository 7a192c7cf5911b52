//! Height maps from pictures: brightness becomes height, on a square tile without seams.
//!
//! The central square of the picture is averaged to a power of two of heights along a side. If its opposite edges fit
//! together, as in a picture made to be tiled, it is the tile. Otherwise, the plane of best fit is subtracted, and a border
//! of a ninth of the side is faded into the opposite edge: the tile has 8/9 of the side of the square.
//!
//! Row 0 of a picture is its top, the side of positive y, and the tile begins at the left and lower edges of the square:
//! a tip at (x, y) is at the pixel of the picture at (x, y), to half a height. The picture of a [`PictureTile`] is cut and
//! faded as its heights are.

use std::f64::consts::FRAC_PI_2;

use shagreen_core::maths::statistics::{is_constant, mean};
use shagreen_core::texture::height_map::{HeightMap, HeightMapError, HeightMapOptions};

use crate::picture::{Brightness, Picture, PictureError, Rgb, brightness_and_colors, encode_jpeg};

/// Most heights along a side. More of them rarely pass the contact patch, and the renderer needs memory for all of them.
const MOST_HEIGHTS: usize = 256;
/// Fewest heights along a side, and the fewest pixels: heights and border.
const LEAST_HEIGHTS: usize = 16;
const LEAST_PIXELS: usize = 18;
/// Largest rms step across the edges of a seamless tile, relative to that inside.
const MOST_SEAM: f64 = 1.5;

/// Size of the surface in a picture.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct HeightScale {
    /// Side of the surface in the central square of the picture, in m.
    pub side_m: f64,
    /// Height of white above black, in m. If the picture [is stretched](PictureTile::is_stretched), that of its highest
    /// pixel above its lowest one.
    pub height_m: f64,
}

/// Why a picture is no height map.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum HeightPictureError {
    /// The picture cannot be read.
    #[error(transparent)]
    Picture(#[from] PictureError),
    /// The picture is too small.
    #[error(
        "the picture has {pixels} pixels along its shorter side; a height map needs {LEAST_PIXELS} or more"
    )]
    Small {
        /// Pixels along the shorter side.
        pixels: usize,
    },
    /// All pixels have the same brightness.
    #[error("the picture has the same brightness everywhere; a height map needs heights that vary")]
    Flat,
    /// The height of white above black is not positive.
    #[error("the height of white above black must be above 0, got {height_m} m")]
    Height {
        /// Height in m.
        height_m: f64,
    },
    /// Side, heights or options are out of range.
    #[error(transparent)]
    Map(#[from] HeightMapError),
}

/// The tile of a picture: read once, for height maps of any size.
#[derive(Clone, Debug, PartialEq)]
pub struct PictureTile {
    /// Brightness, 0 to 1, minus its mean, in the order of the heights of a height map.
    brightness: Vec<f64>,
    /// Side of the tile relative to that of the central square.
    side_share: f64,
    /// Pixels of the tile.
    pixels: Rgb,
    /// Whether the edges of the picture fit together, so that nothing was changed there.
    pub is_seamless: bool,
    /// Whether the picture has colors: it is a photo rather than a measured height map.
    pub is_colored: bool,
    /// Whether black and white are the lowest and the highest number in the file
    /// ([`Brightness::is_stretched`]).
    pub is_stretched: bool,
}

impl PictureTile {
    /// Reads the bytes of a photo or height map, of which brightness (up to 16 bits) will be the height.
    ///
    /// # Errors
    /// [`HeightPictureError::Picture`], [`HeightPictureError::Small`] and [`HeightPictureError::Flat`].
    pub fn read(bytes: &[u8]) -> Result<Self, HeightPictureError> {
        let (picture, colors) = brightness_and_colors(bytes)?;
        let pixels = picture.width.min(picture.height);
        if pixels < LEAST_PIXELS {
            return Err(HeightPictureError::Small { pixels });
        }
        let gray = gray_of(&picture);
        let whole = gray.square(power_of_two_up_to(pixels));
        if is_constant(&whole) {
            return Err(HeightPictureError::Flat);
        }
        let is_seamless = is_seamless(&whole);
        let (mut tile, side_share, n) = if is_seamless {
            (whole, 1.0, power_of_two_up_to(pixels))
        } else {
            let n = power_of_two_up_to(pixels * 8 / 9);
            let mut wide = gray.square(n + n / 8);
            subtract_plane(&mut wide);
            (faded(&wide, n), 8.0 / 9.0, n)
        };
        let mean = mean(&tile);
        for brightness in &mut tile {
            *brightness -= mean;
        }
        let pixels = colors.as_ref().map_or_else(
            || pixels_of(&[gray.tile(n, is_seamless)], n),
            |rgb| pixels_of(&channels_of(rgb).map(|channel| channel.tile(n, is_seamless)), n),
        );
        let Brightness { is_colored, is_stretched, .. } = picture;
        Ok(Self { brightness: tile, side_share, pixels, is_seamless, is_colored, is_stretched })
    }

    /// The height map of the tile in this size, with zero mean.
    ///
    /// # Errors
    /// [`HeightPictureError::Height`] and [`HeightPictureError::Map`].
    pub fn height_map(
        &self,
        scale: HeightScale,
        options: HeightMapOptions,
    ) -> Result<HeightMap, HeightPictureError> {
        let HeightScale { side_m, height_m } = scale;
        if !(height_m.is_finite() && height_m > 0.0) {
            return Err(HeightPictureError::Height { height_m });
        }
        let heights_m = self.brightness.iter().map(|brightness| height_m * brightness).collect();
        Ok(HeightMap::new(heights_m, side_m * self.side_share, options)?)
    }

    /// The picture of the tile, which repeats as its heights do; `side_m` is the side of the central square.
    ///
    /// # Errors
    /// [`HeightPictureError::Picture`] if it cannot be compressed.
    pub fn picture(&self, side_m: f64) -> Result<Picture, HeightPictureError> {
        Ok(encode_jpeg(&self.pixels, 1e3 * side_m * self.side_share)?)
    }
}

/// The largest number of heights along a side that is a power of two and at most `pixels`.
fn power_of_two_up_to(pixels: usize) -> usize {
    let mut n = LEAST_HEIGHTS;
    while n < MOST_HEIGHTS && 2 * n <= pixels {
        n *= 2;
    }
    n
}

/// One value of each pixel of a picture, such as its brightness.
struct Channel<V> {
    width: usize,
    height: usize,
    /// Value of the pixel with this index, row by row from the upper left.
    value: V,
    /// Value of white.
    white: f64,
}

fn gray_of(picture: &Brightness) -> Channel<impl Fn(usize) -> f64> {
    let Brightness { width, height, values, .. } = picture;
    let value = move |pixel: usize| f64::from(values[pixel]);
    Channel { width: *width, height: *height, value, white: f64::from(u16::MAX) }
}

/// Red, green and blue.
fn channels_of(rgb: &Rgb) -> [Channel<impl Fn(usize) -> f64>; 3] {
    let (width, height) = (rgb.width as usize, rgb.height as usize);
    [0, 1, 2].map(|color| {
        let value = move |pixel: usize| f64::from(rgb.pixels[3 * pixel + color]);
        Channel { width, height, value, white: f64::from(u8::MAX) }
    })
}

impl<V: Fn(usize) -> f64> Channel<V> {
    /// Means from 0 to 1 over `n` × `n` equal cells of the central square; the first row is the lowest one.
    fn square(&self, n: usize) -> Vec<f64> {
        let side = self.width.min(self.height);
        let (left, top) = ((self.width - side) / 2, (self.height - side) / 2);
        let overlaps: Vec<_> = (0..side).map(|pixel| overlaps(pixel, side, n)).collect();
        let mut cells = vec![0.0; n * n];
        for (row, overlapped_rows) in overlaps.iter().enumerate() {
            let begin = (top + row) * self.width + left;
            let mut row_cells = vec![0.0; n];
            for (column, overlapped) in overlaps.iter().enumerate() {
                let value = (self.value)(begin + column);
                for (cell, share) in overlapped {
                    row_cells[*cell] += share * value / self.white;
                }
            }
            for (row_from_top, share) in overlapped_rows {
                let begin = (n - 1 - row_from_top) * n;
                for (cell, value) in cells[begin..begin + n].iter_mut().zip(&row_cells) {
                    *cell += share * value;
                }
            }
        }
        cells
    }

    /// The same as a tile: the square itself, or a larger one with faded borders.
    fn tile(&self, n: usize, is_seamless: bool) -> Vec<f64> {
        if is_seamless { self.square(n) } else { faded(&self.square(n + n / 8), n) }
    }
}

/// Pixels of `n` × `n` cells, of which the first row is the lowest one, with one channel for all colors or three.
fn pixels_of(channels: &[Vec<f64>], n: usize) -> Rgb {
    let level = |share: f64| (255.0 * share).round() as u8;
    let pixel = |index: usize| {
        let cell = (n - 1 - index / n) * n + index % n;
        [0, 1, 2].map(|color: usize| level(channels[color.min(channels.len() - 1)][cell]))
    };
    Rgb { width: n as u32, height: n as u32, pixels: (0..n * n).flat_map(pixel).collect() }
}

/// The cells that a pixel overlaps when `side` pixels are divided into `n` cells, at most as many, and by how much in
/// cells. The shares of one cell sum to 1.
fn overlaps(pixel: usize, side: usize, n: usize) -> [(usize, f64); 2] {
    let (begin, end) = (pixel * n, (pixel + 1) * n);
    let cell = begin / side;
    let border = (cell + 1) * side;
    let share = |from: usize, to: usize| to.saturating_sub(from) as f64 / side as f64;
    [(cell, share(begin, end.min(border))), ((cell + 1).min(n - 1), share(border, end))]
}

/// Whether neighbors across opposite edges of a square differ about as much as neighbors inside.
fn is_seamless(cells: &[f64]) -> bool {
    let n = cells.len().isqrt();
    let across_columns = |row: usize, column: usize| cells[row * n + column];
    let across_rows = |row: usize, column: usize| cells[column * n + row];
    let fits = |at: &dyn Fn(usize, usize) -> f64| {
        let step = |from: usize, to: usize| -> f64 {
            (0..n).map(|line| (at(line, to) - at(line, from)).powi(2)).sum()
        };
        let inside: f64 = (1..n).map(|to| step(to - 1, to)).sum::<f64>() / (n - 1) as f64;
        step(n - 1, 0) <= MOST_SEAM * MOST_SEAM * inside
    };
    fits(&across_columns) && fits(&across_rows)
}

/// Subtracts the plane of least squares from a square.
fn subtract_plane(cells: &mut [f64]) {
    let n = cells.len().isqrt();
    let middle = 0.5 * (n - 1) as f64;
    let from_middle = |index: usize| [(index % n) as f64 - middle, (index / n) as f64 - middle];
    // On a full grid, the two coordinates are orthogonal and have the same sum of squares.
    let squares: f64 = (0..n * n).map(|index| from_middle(index)[0].powi(2)).sum();
    let slope = |axis: usize| -> f64 {
        cells.iter().enumerate().map(|(index, cell)| from_middle(index)[axis] * cell).sum::<f64>() / squares
    };
    let (slopes, mean) = ([slope(0), slope(1)], mean(cells));
    for (index, cell) in cells.iter_mut().enumerate() {
        let [x, y] = from_middle(index);
        *cell -= mean + slopes[0] * x + slopes[1] * y;
    }
}

/// The first `n` × `n` cells of a larger square, where the first columns and rows are faded into those behind the last
/// ones: across the edge, the tile continues as the square did.
fn faded(wide: &[f64], n: usize) -> Vec<f64> {
    let width = wide.len().isqrt();
    let border = width - n;
    // Raised cosine.
    let share = |i: usize| (FRAC_PI_2 * (i as f64 + 0.5) / border as f64).sin().powi(2);
    let mix = |i: usize, own: f64, behind: f64| {
        if i < border { behind + share(i) * (own - behind) } else { own }
    };
    let at = |row: usize, column: usize| {
        let behind = wide[row * width + (column + n).min(width - 1)];
        mix(column, wide[row * width + column], behind)
    };
    (0..n * n)
        .map(|index| {
            let (row, column) = (index / n, index % n);
            mix(row, at(row, column), at((row + n).min(width - 1), column))
        })
        .collect()
}

#[cfg(test)]
mod tests;
