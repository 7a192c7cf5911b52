//! Power spectrum of a picture: slope, level, deviation from the fitted line and directionality.

use std::f64::consts::{PI, TAU};

use rustfft::FftPlanner;
use rustfft::num_complex::Complex;

use super::decibels;
use crate::dsp::square_transform::{transpose, wave_number};
use crate::maths::statistics::mean;

/// Number of features: slope, level, deviation from the line, directionality.
pub(super) const N_OF_SPECTRUM: usize = 4;

/// Number of rings in the spectrum, with logarithmic frequency spacing.
const N_RINGS: usize = 16;
/// Number of directions over half a circle; opposite directions are the same.
const N_DIRECTIONS: usize = 12;
/// Lowest frequency used, in periods per picture: lower frequencies show the scene lighting, not the surface.
const LOWEST: f64 = 3.0;

/// Returns four features of the power spectral density.
///
/// They are the slope in dB per octave, the level in dB at 16 periods per picture, the RMS deviation in dB of the rings
/// from that line, and the strongest direction in dB above the mean of all directions.
pub(super) fn spectral(gray: &[f64], side: usize) -> [f64; N_OF_SPECTRUM] {
    let power = power(gray, side);
    let highest = 0.5 * side as f64;
    let octaves = (highest / LOWEST).log2();
    let (mut rings, mut directions) = ([(0.0, 0.0); N_RINGS], [(0.0, 0.0); N_DIRECTIONS]);
    for (index, power) in power.iter().enumerate() {
        let signed = |i: usize| wave_number(i, side) as f64;
        let (fx, fy) = (signed(index % side), signed(index / side));
        let frequency = fx.hypot(fy);
        if !(LOWEST..highest).contains(&frequency) {
            continue;
        }
        let ring = ((frequency / LOWEST).log2() / octaves * N_RINGS as f64) as usize;
        let angle = fy.atan2(fx).rem_euclid(PI);
        let direction = (angle / PI * N_DIRECTIONS as f64) as usize;
        for (sum, n) in [&mut rings[ring.min(N_RINGS - 1)], &mut directions[direction.min(N_DIRECTIONS - 1)]]
        {
            *sum += power;
            *n += 1.0;
        }
    }
    let level = |(sum, n): &(f64, f64)| decibels(sum / f64::max(*n, 1.0));
    let filled = rings.iter().enumerate().filter(|(_, (_, n))| *n > 0.0);
    let points: Vec<(f64, f64)> = filled
        .map(|(ring, of_ring)| {
            let octave = (ring as f64 + 0.5) / N_RINGS as f64 * octaves + (LOWEST / 16.0).log2();
            (octave, level(of_ring))
        })
        .collect();
    let (slope, height) = line(&points);
    let off = points.iter().map(|(x, y)| (y - height - slope * x).powi(2)).sum::<f64>() / points.len() as f64;
    let all: Vec<f64> = directions.iter().map(|(sum, n)| sum / n.max(1.0)).collect();
    let strongest = all.iter().copied().fold(0.0, f64::max);
    [slope, height, off.sqrt(), decibels(strongest) - decibels(mean(&all))]
}

/// Returns slope and intercept of the least-squares line.
fn line(points: &[(f64, f64)]) -> (f64, f64) {
    let n = points.len() as f64;
    let (x, y) = (points.iter().map(|p| p.0).sum::<f64>() / n, points.iter().map(|p| p.1).sum::<f64>() / n);
    let products: f64 = points.iter().map(|p| (p.0 - x) * (p.1 - y)).sum();
    let squares: f64 = points.iter().map(|p| (p.0 - x).powi(2)).sum();
    let slope = products / squares;
    (slope, y - slope * x)
}

/// Power spectrum of the picture after removal of its weighted mean and a Hann window.
fn power(gray: &[f64], side: usize) -> Vec<f64> {
    let window: Vec<f64> =
        (0..side).map(|i| 0.5 - 0.5 * (TAU * (i as f64 + 0.5) / side as f64).cos()).collect();
    let weight = |i: usize| window[i % side] * window[i / side];
    let total: f64 = (0..side * side).map(weight).sum();
    let middle = gray.iter().enumerate().map(|(i, x)| weight(i) * x).sum::<f64>() / total;
    let mut values: Vec<Complex<f64>> =
        gray.iter().enumerate().map(|(i, x)| Complex::new(weight(i) * (x - middle), 0.0)).collect();
    let fft = FftPlanner::new().plan_fft_forward(side);
    fft.process(&mut values);
    transpose(&mut values, side);
    fft.process(&mut values);
    transpose(&mut values, side);
    // Normalized so that resolution does not change the power of a picture with the same contrast.
    let squares: f64 = (0..side * side).map(|i| weight(i).powi(2)).sum();
    values.iter().map(|value| value.norm_sqr() / squares).collect()
}
