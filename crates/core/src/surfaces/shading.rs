//! Picture of a material, lit from the upper left, rendered from the same tile that strokes use.
//!
//! True slopes are too small to see, as heights are only micrometers. All slopes of a picture are therefore scaled by
//! one factor, chosen so that a steeper relief still looks steeper ([`display_slope`]). The picture invents only two
//! things: color flecks ([`Material::mottle`]), and the room that glossy surfaces mirror.

mod light;

use crate::maths::rng::{derive_seed, lattice_uniform};
use crate::surfaces::height_field::{HeightField, height_m};
use crate::surfaces::material::Material;
use crate::surfaces::shading::light::{Rgb, lerp};

/// Rendered points per pixel along each axis, averaged to one pixel.
const SUPERSAMPLING: usize = 3;

/// Neighborhood radii for the darkening of hollows (ambient occlusion).
const CAVITY_RADII_M: [f64; 2] = [0.2e-3, 0.9e-3];

/// Pixel count and surface length of a picture.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Framing {
    /// Pixels per side, at least 8.
    pub n_pixels: usize,
    /// Surface length per side, above 0; beyond one tile the surface repeats.
    pub millimeters: f64,
}

/// A square picture.
#[derive(Clone, Debug, PartialEq)]
pub struct Picture {
    /// Pixels per row.
    pub width: usize,
    /// Number of rows.
    pub height: usize,
    /// sRGB bytes of each pixel, row by row from the upper left.
    pub rgb: Vec<u8>,
    /// Surface length across the width.
    pub millimeters: f64,
}

/// Returns the picture of a material's tile, seen from above.
///
/// x of the tile points to the right and y down. `field` must be the tile of the same material.
pub fn shade(field: &HeightField, material: &Material, framing: &Framing) -> Picture {
    picture(field, material, framing, Edges::Open)
}

/// Returns a seamless picture of a whole tile.
///
/// Every point is seen from directly above, and neighborhoods wrap around the edges.
pub fn shade_tile(field: &HeightField, material: &Material, n_pixels: usize) -> Picture {
    let framing = Framing { n_pixels, millimeters: field.tile().side_m() * 1e3 };
    picture(field, material, &framing, Edges::Seamless)
}

/// Boundary condition at the edges of a picture.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Edges {
    /// Neighborhoods end at the edges.
    Open,
    /// Neighborhoods wrap around: the picture repeats.
    Seamless,
}

fn picture(field: &HeightField, material: &Material, framing: &Framing, edges: Edges) -> Picture {
    assert!(framing.n_pixels >= 8, "a picture needs 8 pixels a side, got {}", framing.n_pixels);
    let n_points = framing.n_pixels * SUPERSAMPLING;
    let relief = Relief::new(field, framing.millimeters * 1e-3, n_points);
    let points = shade_points(&relief, material, edges);
    let mut rgb = Vec::with_capacity(3 * framing.n_pixels * framing.n_pixels);
    for row in 0..framing.n_pixels {
        for column in 0..framing.n_pixels {
            let mut sum = [0.0; 3];
            for y in row * SUPERSAMPLING..(row + 1) * SUPERSAMPLING {
                for x in column * SUPERSAMPLING..(column + 1) * SUPERSAMPLING {
                    let point = points[y * n_points + x];
                    sum = [0, 1, 2].map(|c| sum[c] + point[c]);
                }
            }
            let share = 1.0 / (SUPERSAMPLING * SUPERSAMPLING) as f64;
            rgb.extend(sum.map(|linear| light::srgb_byte(linear * share)));
        }
    }
    let n = framing.n_pixels;
    Picture { width: n, height: n, rgb, millimeters: framing.millimeters }
}

/// Returns the RMS slope at which a picture shows a relief with this true RMS slope.
///
/// It grows with the true slope, but far less than in proportion. Higher gloss (0 to 1) lowers it, since mirrors reveal
/// slopes that matte surfaces hide.
pub fn display_slope(slope: f64, gloss: f64) -> f64 {
    0.9 * slope.max(0.0).powf(0.4) * (1.0 - 0.8 * gloss * gloss)
}

/// Heights and slopes at the rendered points of a picture.
struct Relief {
    n_points: usize,
    spacing_m: f64,
    heights_m: Vec<f64>,
    slopes: Vec<[f64; 2]>,
    height_rms_m: f64,
    slope_rms: f64,
}

impl Relief {
    fn new(field: &HeightField, side_m: f64, n_points: usize) -> Self {
        let spacing_m = side_m / n_points as f64;
        // One extra point on each side for the central differences.
        let wide = n_points + 2;
        let sampled: Vec<f64> = (0..wide * wide)
            .map(|i| height_m(field, (i % wide) as f64 * spacing_m, (i / wide) as f64 * spacing_m))
            .collect();
        let at = |x: usize, y: usize| sampled[y * wide + x];
        let inner = (0..n_points * n_points).map(|i| (i % n_points + 1, i / n_points + 1));
        let heights_m: Vec<f64> = inner.clone().map(|(x, y)| at(x, y)).collect();
        let slopes: Vec<[f64; 2]> = inner
            .map(|(x, y)| {
                [at(x + 1, y) - at(x - 1, y), at(x, y + 1) - at(x, y - 1)]
                    .map(|rise| rise / (2.0 * spacing_m))
            })
            .collect();
        let n = heights_m.len() as f64;
        let mean = heights_m.iter().sum::<f64>() / n;
        let variance = heights_m.iter().map(|h| (h - mean).powi(2)).sum::<f64>() / n;
        let slope_variance = slopes.iter().map(|[x, y]| x * x + y * y).sum::<f64>() / n;
        Self {
            n_points,
            spacing_m,
            heights_m: heights_m.iter().map(|h| h - mean).collect(),
            slopes,
            height_rms_m: variance.sqrt(),
            slope_rms: slope_variance.sqrt(),
        }
    }

    /// Returns the depth of each point below its neighborhood mean, relative to the RMS height.
    fn depth_below_neighbors(&self, radius_m: f64, edges: Edges) -> Vec<f64> {
        let radius = (radius_m / self.spacing_m).round().max(1.0) as usize;
        let mean = match edges {
            Edges::Open => box_mean(&self.heights_m, self.n_points, radius),
            Edges::Seamless => box_mean_around(&self.heights_m, self.n_points, radius),
        };
        let unit = self.height_rms_m.max(f64::MIN_POSITIVE);
        mean.iter().zip(&self.heights_m).map(|(mean, height)| (mean - height) / unit).collect()
    }
}

/// Returns the linear color of every rendered point.
fn shade_points(relief: &Relief, material: &Material, edges: Edges) -> Vec<Rgb> {
    let n = relief.n_points;
    let depth = display_slope(relief.slope_rms, material.gloss);
    let exaggeration = depth / relief.slope_rms.max(f64::MIN_POSITIVE);
    let valley = light::linear(material.valley_srgb);
    let peak = light::linear(material.peak_srgb);
    let flecks = Flecks::new(material, relief, edges);
    let hollows = CAVITY_RADII_M.map(|radius_m| relief.depth_below_neighbors(radius_m, edges));

    (0..n * n)
        .map(|i| {
            let (x, y) = (i % n, i / n);
            let standing = relief.heights_m[i] / relief.height_rms_m.max(f64::MIN_POSITIVE);
            let mut albedo = lerp(valley, peak, 0.5 + 0.5 * (0.8 * standing).tanh());
            albedo = lerp(albedo, valley, flecks.at(x, y));
            let hollow: f64 = hollows.iter().map(|depths| depths[i].max(0.0)).sum();
            // The darkening of hollows follows the displayed slope.
            let open = 1.0 / (1.0 + 0.9 * depth * hollow);
            let normal =
                light::unit([-exaggeration * relief.slopes[i][0], -exaggeration * relief.slopes[i][1], 1.0]);
            let place = match edges {
                Edges::Open => [x, y].map(|k| (k as f64 + 0.5) / n as f64),
                Edges::Seamless => [0.5; 2],
            };
            light::reflect(material, albedo, normal, place, open)
        })
        .collect()
}

/// Color variation without relief: two octaves of smooth lattice noise.
struct Flecks {
    strength: f64,
    octaves: [Octave; 2],
    seed: u64,
}

/// One octave of lattice noise.
#[derive(Clone, Copy)]
struct Octave {
    /// Lattice cells per rendered point.
    cells_per_point: f64,
    /// Offset of the lattice, in cells.
    shift: [f64; 2],
    /// Repeat length in cells; `None` without repetition.
    period: Option<i64>,
    /// Weight of the octave.
    weight: f64,
}

impl Flecks {
    fn new(material: &Material, relief: &Relief, edges: Edges) -> Self {
        let points_per_fleck = (material.mottle_scale_m / relief.spacing_m).max(1.0);
        let octave = |finer: f64, shift: [f64; 2], weight: f64| {
            let cells = finer * relief.n_points as f64 / points_per_fleck;
            let (cells_per_point, period) = match edges {
                Edges::Open => (finer / points_per_fleck, None),
                Edges::Seamless => {
                    let cells = cells.round().max(1.0);
                    (cells / relief.n_points as f64, Some(cells as i64))
                }
            };
            Octave { cells_per_point, shift, period, weight }
        };
        Self {
            strength: material.mottle,
            octaves: [octave(1.0, [0.0; 2], 0.65), octave(2.3, [0.37, 0.71], 0.35)],
            seed: derive_seed(0, &material.id),
        }
    }

    /// Returns the fleck intensity at a point, 0 to `strength`.
    fn at(&self, x: usize, y: usize) -> f64 {
        let noise: f64 = self.octaves.iter().map(|octave| octave.weight * octave.at(self.seed, x, y)).sum();
        self.strength * light::smoothstep(0.42, 0.72, noise)
    }
}

impl Octave {
    fn at(&self, seed: u64, x: usize, y: usize) -> f64 {
        let u = x as f64 * self.cells_per_point + self.shift[0];
        let v = y as f64 * self.cells_per_point + self.shift[1];
        let (i, j) = (u.floor(), v.floor());
        let [s, t] = [u - i, v - j].map(|t| light::smoothstep(0.0, 1.0, t));
        let cell = |k: f64, step: i64| {
            let cell = k as i64 + step;
            self.period.map_or(cell, |period| cell.rem_euclid(period))
        };
        let at = |di: i64, dj: i64| lattice_uniform(seed, cell(i, di), cell(j, dj));
        let row = |dj: i64| at(0, dj) + s * (at(1, dj) - at(0, dj));
        row(0) + t * (row(1) - row(0))
    }
}

/// Returns the mean over the square of side `2 radius + 1` around each cell, with periodic boundaries.
fn box_mean_around(values: &[f64], n: usize, radius: usize) -> Vec<f64> {
    // A larger radius would count some cells twice.
    let radius = radius.min((n - 1) / 2);
    let wide = n + 2 * radius;
    let at = |i: usize| ((i / wide + n - radius) % n) * n + (i % wide + n - radius) % n;
    let around: Vec<f64> = (0..wide * wide).map(|i| values[at(i)]).collect();
    let means = box_mean(&around, wide, radius);
    (0..n * n).map(|i| means[(i / n + radius) * wide + i % n + radius]).collect()
}

/// Returns the mean over the square of side `2 radius + 1` around each cell, cut off at the edges.
fn box_mean(values: &[f64], n: usize, radius: usize) -> Vec<f64> {
    // Summed-area table: each square then needs four look-ups.
    let stride = n + 1;
    let mut sums = vec![0.0; stride * stride];
    for y in 0..n {
        let mut row = 0.0;
        for x in 0..n {
            row += values[y * n + x];
            sums[(y + 1) * stride + x + 1] = sums[y * stride + x + 1] + row;
        }
    }
    (0..n * n)
        .map(|i| {
            let range = |k: usize| (k.saturating_sub(radius), (k + radius + 1).min(n));
            let ((left, right), (top, bottom)) = (range(i % n), range(i / n));
            let total =
                sums[bottom * stride + right] - sums[top * stride + right] - sums[bottom * stride + left]
                    + sums[top * stride + left];
            total / ((right - left) * (bottom - top)) as f64
        })
        .collect()
}

#[cfg(test)]
mod tests {
    use super::{
        Framing, Material, Picture, box_mean, box_mean_around, display_slope, light, shade, shade_tile,
    };
    use crate::maths::rng::lcg_noise;
    use crate::surfaces::height_field::{Tile, synthesize};
    use crate::surfaces::material::tests::plain;

    const TILE: Tile = Tile { n_cells: 128, spacing_m: 40e-6 };
    const FRAMING: Framing = Framing { n_pixels: 32, millimeters: 5.0 };

    fn picture(material: &Material) -> Picture {
        shade(&synthesize(material, TILE, 1), material, &FRAMING)
    }

    #[test]
    fn box_mean_matches_its_definition() {
        let n = 13;
        let values = lcg_noise(n * n, 3);
        for radius in [1, 2, 5, 20] {
            let means = box_mean(&values, n, radius);
            for (i, got) in means.iter().enumerate() {
                let near: Vec<f64> = (0..n * n)
                    .filter(|j| (i % n).abs_diff(j % n) <= radius && (i / n).abs_diff(j / n) <= radius)
                    .map(|j| values[j])
                    .collect();
                let expected = near.iter().sum::<f64>() / near.len() as f64;
                assert!((got - expected).abs() < 1e-12);
            }
        }
    }

    #[test]
    fn around_the_edges_the_mean_is_that_of_the_torus() {
        let n = 9;
        let values = lcg_noise(n * n, 4);
        for radius in [1, 3, 50] {
            let near = |a: usize, b: usize| a.abs_diff(b).min(n - a.abs_diff(b)) <= radius;
            for (i, got) in box_mean_around(&values, n, radius).iter().enumerate() {
                let around = (0..n * n).filter(|j| near(i % n, j % n) && near(i / n, j / n));
                let around: Vec<f64> = around.map(|j| values[j]).collect();
                assert!((got - around.iter().sum::<f64>() / around.len() as f64).abs() < 1e-12);
            }
        }
    }

    #[test]
    fn a_tile_beside_itself_has_no_seam_and_a_photo_has() {
        let material = Material {
            gloss: 0.8,
            mottle: 1.0,
            mottle_scale_m: 0.7e-3,
            height_rms_m: 5e-6,
            valley_srgb: [90, 20, 20],
            ..plain()
        };
        let field = synthesize(&material, TILE, 3);
        // Ratio of the pixel differences across the seam to those inside, over rows and columns.
        let seam = |picture: &Picture| {
            let n = picture.width;
            let at = |x: usize, y: usize, c: usize| f64::from(picture.rgb[3 * ((y % n) * n + x % n) + c]);
            let step = |x: usize| {
                let differences = (0..n * 3).map(|i| {
                    let (k, c) = (i / 3, i % 3);
                    (at(x, k, c) - at(x + 1, k, c)).abs() + (at(k, x, c) - at(k, x + 1, c)).abs()
                });
                differences.sum::<f64>()
            };
            let within: f64 = (0..n - 1).map(step).sum::<f64>() / (n - 1) as f64;
            step(n - 1) / within
        };
        let tile = shade_tile(&field, &material, 64);
        assert!((tile.millimeters - 1e3 * TILE.side_m()).abs() < 1e-9);
        let photo = shade(&field, &material, &Framing { n_pixels: 64, millimeters: tile.millimeters });
        assert!(seam(&tile) < 1.4, "{}", seam(&tile));
        assert!(seam(&photo) > 1.5 * seam(&tile), "{}", seam(&photo));
    }

    #[test]
    fn a_picture_has_its_size_and_is_a_function_of_its_inputs() {
        let once = picture(&plain());
        assert_eq!((once.width, once.height, once.rgb.len()), (32, 32, 3 * 32 * 32));
        assert_eq!(once.millimeters, 5.0);
        assert_eq!(once, picture(&plain()));
    }

    #[test]
    fn slopes_toward_the_upper_left_are_lighter() {
        let mut material = plain();
        material.gloss = 0.0;
        material.valley_srgb = [128, 128, 128];
        material.peak_srgb = [128, 128, 128];
        let lit = light::reflect(&material, [0.3; 3], light::unit([-0.3, -0.3, 1.0]), [0.5; 2], 1.0);
        let flat = light::reflect(&material, [0.3; 3], [0.0, 0.0, 1.0], [0.5; 2], 1.0);
        let away = light::reflect(&material, [0.3; 3], light::unit([0.3, 0.3, 1.0]), [0.5; 2], 1.0);
        assert!(lit[0] > flat[0] && flat[0] > away[0]);
        let hollow = light::reflect(&material, [0.3; 3], [0.0, 0.0, 1.0], [0.5; 2], 0.4);
        assert!(hollow[0] < flat[0]);
    }

    #[test]
    fn a_rougher_relief_shows_more_contrast_and_a_flat_one_none() {
        let contrast = |height_rms_m: f64| {
            let gray = [150, 150, 150];
            let material =
                Material { height_rms_m, gloss: 0.0, valley_srgb: gray, peak_srgb: gray, ..plain() };
            let rgb = picture(&material).rgb;
            let mean = rgb.iter().map(|v| f64::from(*v)).sum::<f64>() / rgb.len() as f64;
            rgb.iter().map(|v| (f64::from(*v) - mean).abs()).sum::<f64>() / rgb.len() as f64
        };
        let [flat, fine, coarse] = [0.0, 1e-6, 3e-5].map(contrast);
        assert!(flat < 2.0 && fine > 2.0 * flat && coarse > 1.5 * fine, "{flat} {fine} {coarse}");
    }

    #[test]
    fn display_slope_grows_with_slope() {
        let shown: Vec<f64> =
            [0.0, 1e-4, 1e-3, 1e-2, 1e-1, 1.0].map(|slope| display_slope(slope, 0.5)).to_vec();
        assert!(shown.is_sorted_by(|a, b| a < b) && shown[0] == 0.0);
    }
}
