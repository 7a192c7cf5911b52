use std::f64::consts::TAU;

use super::co_occurrence::co_occurrence;
use super::spectrum::spectral;
use super::wavelets::haar_energies;
use super::{N_FEATURES, PictureError, SIDE, features, square, views};
use crate::maths::rng::lcg_noise;
use crate::surfaces::shading::Picture;

fn picture(width: usize, height: usize, color: impl Fn(usize, usize) -> [u8; 3]) -> Picture {
    let rgb = (0..width * height).flat_map(|i| color(i % width, i / width)).collect();
    Picture { width, height, rgb, millimeters: 20.0 }
}

fn gray(side: usize, value: impl Fn(f64, f64) -> f64) -> Vec<f64> {
    (0..side * side).map(|i| value((i % side) as f64, (i / side) as f64)).collect()
}

#[test]
fn a_square_is_the_mean_of_what_it_covers() {
    // Twice the resolution, and wider than high: only the central square is used.
    let fine = picture(700, 448, |x, y| [(x % 256) as u8, (y % 256) as u8, 77]);
    let small = square(&fine).unwrap();
    assert_eq!(small.rgb.len(), 3 * SIDE * SIDE);
    let left = (700 - 448) / 2;
    for (x, y) in [(0, 0), (17, 99), (223, 223)] {
        let mean = |of: fn(usize, usize) -> usize| {
            let pixels = [(0, 0), (1, 0), (0, 1), (1, 1)];
            let at = |(dx, dy): (usize, usize)| (of(left + 2 * x + dx, 2 * y + dy) % 256) as f32;
            pixels.into_iter().map(at).sum::<f32>() / (4.0 * 255.0)
        };
        let pixel = &small.rgb[3 * (y * SIDE + x)..][..3];
        assert!((pixel[0] - mean(|x, _| x)).abs() < 1e-5 && (pixel[1] - mean(|_, y| y)).abs() < 1e-5);
        assert!((pixel[2] - 77.0 / 255.0).abs() < 1e-6);
    }
    // Non-integer scale factors keep values in range.
    let odd = square(&picture(61, 97, |x, y| [((x * 7 + y * 3) % 256) as u8; 3])).unwrap();
    assert!(odd.rgb.iter().all(|x| (0.0..=1.0).contains(x)));
    assert_eq!(
        square(&picture(15, 99, |_, _| [0; 3])),
        Err(PictureError::TooSmall { width: 15, height: 99 })
    );
    let mut cut = picture(16, 16, |_, _| [0; 3]);
    cut.rgb.pop();
    assert_eq!(square(&cut), Err(PictureError::Bytes { n: 767, expected: 768 }));
}

#[test]
fn views_are_the_square_and_its_quarters() {
    // 500 x 448: each quarter has exactly the size of a view, so nothing is resampled.
    let large = picture(500, 448, |x, y| [(x % 256) as u8, (y % 256) as u8, ((x + y) % 256) as u8]);
    let [whole, quarters @ ..] = views(&large).unwrap();
    assert_eq!(whole, square(&large).unwrap());
    for (quarter, (left, top)) in quarters.iter().zip([(26, 0), (250, 0), (26, 224), (250, 224)]) {
        for (x, y) in [(0, 0), (100, 7), (223, 223)] {
            let expected = [left + x, top + y, left + x + top + y].map(|value| (value % 256) as f32 / 255.0);
            let pixel = &quarter.rgb[3 * (y * SIDE + x)..][..3];
            assert!(pixel.iter().zip(expected).all(|(a, b)| (a - b).abs() < 1e-6), "{pixel:?} {expected:?}");
        }
    }
    // Few pixels are interpolated: a linear ramp stays linear between the centers of the outer pixels.
    let [small, ..] = views(&picture(100, 100, |x, _| [2 * x as u8; 3])).unwrap();
    for x in 2..SIDE - 2 {
        let expected = 2.0 * ((x as f32 + 0.5) * 100.0 / SIDE as f32 - 0.5) / 255.0;
        assert!((small.rgb[3 * (50 * SIDE + x)] - expected).abs() < 1e-5, "{x}");
    }
    let tiny = views(&picture(17, 16, |_, _| [9, 90, 200])).unwrap();
    for view in &tiny {
        assert!(view.rgb.chunks_exact(3).all(|pixel| (pixel[1] - 90.0 / 255.0).abs() < 1e-6));
    }
    assert_eq!(views(&picture(15, 99, |_, _| [0; 3])), Err(PictureError::TooSmall { width: 15, height: 99 }));
}

#[test]
fn co_occurrence_of_simple_pictures_is_known() {
    // One gray level: every pair is equal.
    let [contrast, correlation, homogeneity, uniformity, entropy] =
        co_occurrence(&gray(16, |_, _| 0.4), 16, 1);
    assert_eq!((contrast, correlation, homogeneity, uniformity, entropy), (0.0, 1.0, 1.0, 1.0, 0.0));
    // Columns of black and white: horizontal and diagonal neighbors differ, vertical neighbors are equal.
    let columns = gray(16, |x, _| x % 2.0);
    let [contrast, correlation, .., entropy] = co_occurrence(&columns, 16, 1);
    let (beside, above, across) = (2.0 * 15.0 * 16.0, 2.0 * 15.0 * 16.0, 4.0 * 15.0 * 15.0);
    let other = (beside + across) / (beside + above + across);
    assert!((contrast - other * 31.0 * 31.0 / 1024.0).abs() < 1e-12);
    assert!((correlation - (1.0 - 2.0 * other)).abs() < 1e-12);
    let term = |p: f64| -p * (0.5 * p).log2();
    assert!((entropy - term(other) - term(1.0 - other)).abs() < 1e-12);
    // At a distance of two columns, all pairs are equal.
    assert!(co_occurrence(&columns, 16, 2)[0] == 0.0);
    let noise: Vec<f64> = lcg_noise(64 * 64, 5).iter().map(|x| 0.5 + 0.14 * x).collect();
    assert!(co_occurrence(&noise, 64, 3)[1].abs() < 0.05);
}

#[test]
fn wavelets_share_out_the_energy() {
    let noise = lcg_noise(64 * 64, 9);
    let energies = haar_energies(&noise, 64);
    // Parseval: the variance is the sum over all details and over the remaining means.
    let mean_square = noise.iter().map(|x| x * x).sum::<f64>() / 4096.0;
    let of_details: f64 = energies.iter().map(|of| of.iter().sum::<f64>() / 4.0).sum();
    let coarse: Vec<f64> = (0..4)
        .map(|i| {
            let cells = (0..32 * 32).map(|j| noise[(i / 2 * 32 + j / 32) * 64 + i % 2 * 32 + j % 32]);
            cells.sum::<f64>() / 1024.0
        })
        .collect();
    let of_means = coarse.iter().map(|x| x * x).sum::<f64>() / 4.0;
    assert!((mean_square - of_details - of_means).abs() < 1e-9, "{mean_square} {of_details} {of_means}");
    let stripes = haar_energies(&gray(64, |x, _| x % 2.0), 64);
    assert!(stripes[0][0] > 0.9 && stripes[0][1] == 0.0 && stripes[1] == [0.0; 3]);
}

#[test]
fn the_spectrum_has_the_slope_and_the_direction_that_were_made() {
    let side = 128;
    // A sum of waves with amplitude 1/f: -6 dB per octave in all directions.
    let mut image = vec![0.0; side * side];
    let phases = lcg_noise(4000, 3);
    let mut index = 0;
    for fx in -24_i32..=24 {
        for fy in 0..=24_i32 {
            let f = f64::from(fx).hypot(f64::from(fy));
            if !(2.0..=24.0).contains(&f) {
                continue;
            }
            index += 1;
            for (i, x) in image.iter_mut().enumerate() {
                let (px, py) = ((i % side) as f64, (i / side) as f64);
                *x += (TAU * (f64::from(fx) * px + f64::from(fy) * py) / side as f64 + 9.0 * phases[index])
                    .cos()
                    / f;
            }
        }
    }
    let band_limited = spectral(&image, side);
    // No power above 24 periods, which only steepens the slope.
    assert!(band_limited[0] < -5.0, "{band_limited:?}");
    let noise: Vec<f64> = lcg_noise(side * side, 2).iter().map(|x| 0.5 + 0.1 * x).collect();
    let [slope, _, off, direction] = spectral(&noise, side);
    assert!(slope.abs() < 0.5 && off < 1.0 && direction < 1.0, "{slope} {off} {direction}");
    let stripes = spectral(&gray(side, |x, _| 0.5 + 0.3 * (TAU * x / 8.0).sin()), side);
    assert!(stripes[3] > 8.0 && stripes[2] > 5.0, "{stripes:?}");
}

#[test]
fn features_are_as_many_as_said_finite_and_the_same_for_a_turned_picture() {
    let colored = picture(300, 300, |x, y| [(x * 3 % 250) as u8, (y * 5 % 240) as u8, (x * y % 200) as u8]);
    let of = features(&square(&colored).unwrap());
    assert_eq!(of.len(), N_FEATURES);
    assert!(of.iter().all(|x| x.is_finite()));
    // A quarter turn changes no feature, as none depends on absolute direction.
    let at = |x: usize, y: usize| -> [u8; 3] { colored.rgb[3 * (y * 300 + x)..][..3].try_into().unwrap() };
    let turned = picture(300, 300, |x, y| at(y, 299 - x));
    for (a, b) in of.iter().zip(features(&square(&turned).unwrap())) {
        // Ring boundaries may round differently after the turn.
        assert!((a - b).abs() < 1e-3 * (1.0 + a.abs()), "{a} {b}");
    }
    for plain in [0, 255] {
        let flat = features(&square(&picture(32, 32, |_, _| [plain; 3])).unwrap());
        assert!(flat.iter().all(|x| x.is_finite()), "{flat:?}");
    }
}
