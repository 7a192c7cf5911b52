//! Icon of the program: shagreen, the leather of a stingray, with its round pebbles lit from the authored point.

use egui::{Color32, IconData};
use shagreen_core::maths::rng::lattice_uniform;

use crate::look::theme::DARK;

/// Samples of a pixel along each side, averaged to one pixel.
const SUPERSAMPLING: usize = 4;
/// Approximate width of a pebble in pixels, within the numbers of pebbles from side to side.
const PIXELS_A_PEBBLE: usize = 6;
const MIN_ACROSS: usize = 4;
const MAX_ACROSS: usize = 8;
/// Radius of the corners, as a share of the side.
const CORNER: f64 = 0.22;
/// Center and radius of the authored point, and its height above the leather, as shares of the side.
const POINT: [f64; 2] = [0.66, 0.34];
const POINT_RADIUS: f64 = 0.1;
const POINT_HEIGHT: f64 = 0.28;
/// Displacement of a pebble from its place in the lattice, as a share of the distance to its neighbors.
const JITTER: f64 = 0.14;
/// Color of the leather in full light, and of the gaps between pebbles.
const LEATHER: [f64; 3] = [74.0, 168.0, 148.0];
const GAP: [f64; 3] = [9.0, 30.0, 27.0];

/// Number of pebbles over the height of the splash picture.
const PEBBLES_OF_SPLASH: usize = 14;

/// Icon with this number of pixels along each side, the same every time.
pub fn icon(side: usize) -> IconData {
    let n_across = (side / PIXELS_A_PEBBLE).clamp(MIN_ACROSS, MAX_ACROSS);
    drawn([side, side], n_across, is_inside)
}

/// Wide picture of the same leather and point, for packages and pages, the same every time.
pub fn splash(width: usize, height: usize) -> IconData {
    drawn([width, height], PEBBLES_OF_SPLASH, |_| true)
}

/// Picture with `n_across` pebbles over its height. Places are in shares of the height, and those that `is_inside` refuses
/// are transparent.
fn drawn([width, height]: [usize; 2], n_across: usize, is_inside: impl Fn([f64; 2]) -> bool) -> IconData {
    let mut rgba = Vec::with_capacity(4 * width * height);
    let n_samples = SUPERSAMPLING * SUPERSAMPLING;
    for pixel in 0..width * height {
        let (mut sum, mut n_inside) = ([0.0; 3], 0_u32);
        for sample in 0..n_samples {
            let at = |pixel: usize, sample: usize| {
                (pixel as f64 + (sample as f64 + 0.5) / SUPERSAMPLING as f64) / height as f64
            };
            let place =
                [at(pixel % width, sample % SUPERSAMPLING), at(pixel / width, sample / SUPERSAMPLING)];
            if is_inside(place) {
                let color = color(place, n_across);
                sum.iter_mut().zip(color).for_each(|(sum, channel)| *sum += channel);
                n_inside += 1;
            }
        }
        let channel = |sum: f64| (sum / f64::from(n_inside.max(1))).clamp(0.0, 255.0) as u8;
        rgba.extend(sum.map(channel));
        rgba.push((255.0 * f64::from(n_inside) / n_samples as f64).round() as u8);
    }
    IconData { rgba, width: width as u32, height: height as u32 }
}

/// Whether a place, in shares of the side, is within the rounded square.
fn is_inside(place: [f64; 2]) -> bool {
    let [x, y] = place.map(|share| ((share - 0.5).abs() - (0.5 - CORNER)).max(0.0));
    x.hypot(y) <= CORNER
}

/// Color at a place, from 0 to 255.
fn color([x, y]: [f64; 2], n_across: usize) -> [f64; 3] {
    let from_point = (x - POINT[0]).hypot(y - POINT[1]);
    if from_point < POINT_RADIUS {
        return if from_point < 0.72 * POINT_RADIUS { channels(DARK.accent) } else { channels(DARK.text) };
    }
    let Some(normal) = pebble_normal([x, y], n_across) else { return GAP };
    let to_light = unit([POINT[0] - x, POINT[1] - y, POINT_HEIGHT]);
    let facing = dot(normal, to_light).max(0.0);
    // The light is near, so that it fades toward the far corner.
    let near = 1.0 / (1.0 + 1.6 * from_point * from_point);
    let halfway = unit([to_light[0], to_light[1], to_light[2] + 1.0]);
    let gloss = 150.0 * near * dot(normal, halfway).max(0.0).powi(24);
    let light = 0.14 + 0.98 * near * facing;
    LEATHER.map(|channel| channel * light + gloss)
}

/// Direction of the surface at a place on a pebble; `None` between the pebbles. The pebbles are spheres on a hexagonal
/// lattice.
fn pebble_normal([x, y]: [f64; 2], n_across: usize) -> Option<[f64; 3]> {
    let spacing = 1.0 / n_across as f64;
    let row_height = spacing * 0.75_f64.sqrt();
    let row = (y / row_height).floor() as i64;
    let mut nearest = (f64::INFINITY, [0.0; 2]);
    for j in row - 1..=row + 1 {
        let shift = if j.rem_euclid(2) == 0 { 0.25 } else { 0.75 };
        let column = (x / spacing - shift).round() as i64;
        for i in column - 1..=column + 1 {
            let jitter = |seed: u64| JITTER * (lattice_uniform(seed, i, j) - 0.5);
            let center = [
                (i as f64 + shift + jitter(1)) * spacing,
                (j as f64 + 0.5) * row_height + jitter(2) * spacing,
            ];
            // Some pebbles are larger than others.
            let radius = spacing * (0.44 + 0.1 * lattice_uniform(3, i, j));
            let offset = [(x - center[0]) / radius, (y - center[1]) / radius];
            let distance = offset[0].hypot(offset[1]);
            if distance < nearest.0 {
                nearest = (distance, offset);
            }
        }
    }
    let (distance, [u, v]) = nearest;
    (distance < 1.0).then(|| [u, v, (1.0 - distance * distance).sqrt()])
}

fn channels(color: Color32) -> [f64; 3] {
    [color.r(), color.g(), color.b()].map(f64::from)
}

fn dot(a: [f64; 3], b: [f64; 3]) -> f64 {
    a.iter().zip(b).map(|(a, b)| a * b).sum()
}

fn unit(vector: [f64; 3]) -> [f64; 3] {
    let length = dot(vector, vector).sqrt();
    vector.map(|component| component / length)
}

#[cfg(test)]
mod tests {
    use super::{POINT, icon, splash};
    use egui::IconData;

    /// Pixel at a place in shares of the side.
    fn pixel(icon: &IconData, x: f64, y: f64) -> [u8; 4] {
        let at = |share: f64, n: u32| ((share * f64::from(n)) as usize).min(n as usize - 1);
        let index = at(y, icon.height) * icon.width as usize + at(x, icon.width);
        icon.rgba.as_chunks::<4>().0[index]
    }

    #[test]
    fn the_icon_has_transparent_corners_and_an_opaque_center_in_every_size() {
        for side in [16, 24, 32, 48, 64, 128, 256, 512] {
            let drawn = icon(side);
            assert_eq!((drawn.width as usize, drawn.height as usize), (side, side));
            assert_eq!(drawn.rgba.len(), 4 * side * side);
            for (x, y) in [(0.0, 0.0), (1.0, 0.0), (0.0, 1.0), (1.0, 1.0)] {
                assert_eq!(pixel(&drawn, x, y)[3], 0, "corner {x}, {y} of {side}");
            }
            for (x, y) in [(0.5, 0.5), (0.5, 0.0), (1.0, 0.5)] {
                assert_eq!(pixel(&drawn, x, y)[3], 255, "{x}, {y} of {side}");
            }
            let [red, green, blue, _] = pixel(&drawn, POINT[0], POINT[1]);
            assert!(green > red && green > blue, "the point has the accent color");
        }
        assert_eq!(icon(64).rgba, icon(64).rgba);
    }

    #[test]
    fn the_splash_is_opaque_and_shows_the_point_once() {
        let drawn = splash(160, 80);
        assert_eq!((drawn.width, drawn.height, drawn.rgba.len()), (160, 80, 4 * 160 * 80));
        assert!(drawn.rgba.as_chunks::<4>().0.iter().all(|pixel| pixel[3] == 255));
        // Places are in shares of the height.
        let [red, green, blue, _] = pixel(&drawn, 0.5 * POINT[0], POINT[1]);
        assert!(green > red && green > blue, "the point has the accent color");
        assert_eq!(splash(160, 80).rgba, drawn.rgba);
    }

    /// The leather is lighter near the point than in the far corner.
    #[test]
    fn the_light_comes_from_the_point() {
        let drawn = icon(128);
        let mean = |[left, top]: [usize; 2]| {
            let pixels = (0..32 * 32).map(|i| 4 * ((top + i / 32) * 128 + left + i % 32) + 1);
            pixels.map(|green| f64::from(drawn.rgba[green])).sum::<f64>() / 1024.0
        };
        assert!(mean([88, 8]) > 1.5 * mean([8, 88]), "{} {}", mean([88, 8]), mean([8, 88]));
    }
}
