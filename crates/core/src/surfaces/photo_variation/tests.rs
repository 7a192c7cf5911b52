use super::{BLUR_PX, LEAST_CROP, LEAST_OF_SMALL, SATURATION, SIDE, Variation, blurred, turned};
use crate::maths::rng::lcg_noise;
use crate::surfaces::picture_features::{PictureError, Square, square};
use crate::surfaces::shading::Picture;

fn photo(width: usize, height: usize) -> Picture {
    let of = |i: usize| [(i % width * 3 % 256) as u8, (i / width * 5 % 256) as u8, (i * 7 % 256) as u8];
    Picture { width, height, rgb: (0..width * height).flat_map(of).collect(), millimeters: 30.0 }
}

fn gray(value: u8) -> Picture {
    Picture { width: 300, height: 300, rgb: vec![value; 3 * 300 * 300], millimeters: 30.0 }
}

#[test]
fn no_variation_gives_the_central_square() {
    let photo = photo(500, 300);
    let same = Variation::none().apply(&photo).unwrap();
    let expected: Vec<u8> = square(&photo).unwrap().rgb.iter().map(|x| (255.0 * x).round() as u8).collect();
    assert_eq!((same.width, same.height, &same.rgb), (SIDE, SIDE, &expected));
    assert!((same.millimeters - 18.0).abs() < 1e-12);
    assert_eq!(
        Variation::none().apply(&Picture { rgb: Vec::new(), ..photo }),
        Err(PictureError::Bytes { n: 0, expected: 450_000 })
    );
}

#[test]
fn a_seed_gives_the_same_variation_and_another_seed_another() {
    let photo = photo(320, 240);
    let of = |seed| Variation::draw(seed, 240).apply(&photo).unwrap();
    assert_eq!(of(1), of(1));
    assert_ne!(of(1), of(2));
}

#[test]
fn variations_are_drawn_from_their_ranges() {
    let (mut least, mut least_of_small) = (1.0_f64, 1.0_f64);
    for seed in 0..400 {
        let varied = Variation::draw(seed, 512);
        least = least.min(varied.crop);
        least_of_small = least_of_small.min(Variation::draw(seed, 128).crop);
        assert!((BLUR_PX[0]..=BLUR_PX[1]).contains(&varied.blur_px));
        assert!((SATURATION[0]..=SATURATION[1]).contains(&varied.saturation));
        assert!((50..=92).contains(&varied.jpeg_quality) && varied.n_turns < 4);
    }
    // The smallest of 400 draws lies within 2 % of the range from its end, save one time in 3,000.
    assert!((LEAST_CROP..LEAST_CROP + 0.013).contains(&least), "{least}");
    assert!((LEAST_OF_SMALL..LEAST_OF_SMALL + 0.008).contains(&least_of_small), "{least_of_small}");
}

#[test]
fn four_quarter_turns_and_two_mirrors_change_nothing() {
    let before = Square { rgb: lcg_noise(3 * SIDE * SIDE, 4).iter().map(|x| *x as f32).collect() };
    let mut rgb = before.rgb.clone();
    for _ in 0..4 {
        rgb = turned(&Square { rgb }, 1, false);
    }
    assert_eq!(rgb, before.rgb);
    let twice = turned(&Square { rgb: turned(&before, 0, true) }, 0, true);
    assert_eq!(twice, before.rgb);
    assert_eq!(turned(&Square { rgb: turned(&before, 1, false) }, 2, false), turned(&before, 3, false));
    // A clockwise turn moves the upper left pixel to the upper right.
    let turned = turned(&before, 1, false);
    assert_eq!(turned[3 * (SIDE - 1)..3 * SIDE], before.rgb[..3]);
}

#[test]
fn blur_spreads_a_point_as_its_standard_deviation_says_and_keeps_the_sum() {
    let mut point = vec![0.0; 3 * SIDE * SIDE];
    let (x0, y0) = (100, 90);
    point[3 * (y0 * SIDE + x0) + 1] = 1.0;
    let after = blurred(&point, 1.6);
    let (mut sum, mut squares) = (0.0, 0.0);
    for (i, pixel) in after.chunks_exact(3).enumerate() {
        let value = f64::from(pixel[1]);
        sum += value;
        squares += value * ((i % SIDE) as f64 - x0 as f64).powi(2);
        assert!(pixel[0] == 0.0 && pixel[2] == 0.0);
    }
    assert!((sum - 1.0).abs() < 1e-5, "{sum}");
    // The kernel ends at five pixels, which makes the variance 0.6 % smaller.
    assert!((squares / 1.6_f64.powi(2) - 0.994).abs() < 0.002, "{squares}");
    let plain = blurred(&vec![0.25; 3 * SIDE * SIDE], 1.0);
    assert!(plain.iter().all(|x| (x - 0.25).abs() < 1e-6));
}

#[test]
fn colors_and_light_have_their_closed_forms() {
    let of = |variation: Variation, value: u8| variation.apply(&gray(value)).unwrap().rgb;
    let middle = 3 * (SIDE / 2 * SIDE + SIDE / 2);
    let doubled = of(Variation { gamma: 2.0, ..Variation::none() }, 128);
    assert_eq!(doubled[middle], (255.0 * (128.0_f64 / 255.0).powi(2)).round() as u8);
    let flat = of(Variation { contrast: 0.5, ..Variation::none() }, 0);
    // Half way between black and middle gray.
    assert!(flat.iter().all(|x| *x == 64));
    let warm = of(Variation { white: [1.1, 1.0, 0.9], ..Variation::none() }, 100);
    assert_eq!(warm[..3], [110, 100, 90]);
    // Without saturation, every color becomes its luma: 0.2126, 0.7152 and 0.0722 of red, green and blue.
    let colorless = Variation { saturation: 0.0, white: [1.1, 1.0, 0.9], ..Variation::none() };
    let luma = 0.2126 * 110.0 + 0.7152 * 100.0 + 0.0722 * 90.0_f64;
    assert!(of(colorless, 100).iter().all(|x| *x == luma.round() as u8));
    let lit = of(Variation { light_slope: [0.3, 0.0], ..Variation::none() }, 100);
    assert_eq!((lit[0], lit[3 * (SIDE - 1)]), (70, 130));
    let dark = of(Variation { vignette: 0.4, ..Variation::none() }, 100);
    assert_eq!((dark[0], dark[dark.len() - 1]), (60, 60));
    assert_eq!(dark[middle], 100);
}

#[test]
fn noise_has_its_standard_deviation() {
    let noisy = Variation { noise: 0.02, noise_seed: 5, ..Variation::none() }.apply(&gray(128)).unwrap();
    let n = noisy.rgb.len() as f64;
    let variance = noisy.rgb.iter().map(|x| (f64::from(*x) - 128.0).powi(2)).sum::<f64>() / n;
    // Rounding to bytes adds 1/12. With 150,000 values the standard error is 0.4 %.
    let expected = (0.02_f64 * 255.0).powi(2) + 1.0 / 12.0;
    assert!((variance / expected - 1.0).abs() < 0.02, "{variance} {expected}");
}
