//! DFT321: combines three axes of acceleration into one signal (Landin, Romano, McMahan and Kuchenbecker 2010).
//!
//! The magnitude is `|A(f)|² = |X|² + |Y|² + |Z|²`: it preserves energy and does not depend on the sensor's
//! orientation. The phase is `∠A = ∠(X + Y + Z)`, which does depend on the orientation.

mod short_time;

pub use crate::dsp::dft321::short_time::dft321_short_time;

use realfft::RealFftPlanner;
use realfft::num_complex::Complex;

/// Magnitude of the summed axes, relative to the largest combined magnitude, below which the phase is undefined and set
/// to 0.
const UNDEFINED_PHASE_SHARE: f64 = 1e-12;

/// Error of combining axes.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
#[non_exhaustive]
pub enum Dft321Error {
    /// The input has no axes.
    #[error("DFT321 needs at least one axis, got none")]
    NoAxes,
    /// The axes differ in length.
    #[error("all axes need the same length, got {first} and {other} samples")]
    UnequalLengths {
        /// Number of samples of the first axis.
        first: usize,
        /// Number of samples of the differing axis.
        other: usize,
    },
}

/// Combines the axes of a whole segment into one signal with the same unit; one slice for each axis, usually one to
/// three.
///
/// # Errors
/// [`Dft321Error::NoAxes`] if `axes` is empty, [`Dft321Error::UnequalLengths`] if the axes differ in length.
pub fn dft321(axes: &[&[f64]]) -> Result<Vec<f64>, Dft321Error> {
    let Some(first_axis) = axes.first() else { return Err(Dft321Error::NoAxes) };
    let first = first_axis.len();
    if let Some(axis) = axes.iter().find(|axis| axis.len() != first) {
        return Err(Dft321Error::UnequalLengths { first, other: axis.len() });
    }
    if first == 0 {
        return Ok(Vec::new());
    }

    let mut planner = RealFftPlanner::<f64>::new();
    let forward = planner.plan_fft_forward(first);
    let mut power = vec![0.0; first / 2 + 1];
    let mut sum = vec![Complex::new(0.0, 0.0); first / 2 + 1];
    let mut spectrum = forward.make_output_vec();
    for axis in axes {
        let mut buffer = axis.to_vec();
        check_run(&forward.process(&mut buffer, &mut spectrum));
        for ((power, sum), value) in power.iter_mut().zip(&mut sum).zip(&spectrum) {
            *power += value.norm_sqr();
            *sum += value;
        }
    }

    let floor = UNDEFINED_PHASE_SHARE * power.iter().copied().fold(0.0, f64::max).sqrt();
    let mut combined: Vec<Complex<f64>> =
        power.iter().zip(&sum).map(|(power, sum)| power.sqrt() * unit_phase(*sum, floor)).collect();
    // The bins at zero and at the Nyquist frequency of a real signal are real; this removes rounding errors.
    combined[0].im = 0.0;
    if first.is_multiple_of(2) {
        combined[first / 2].im = 0.0;
    }

    let inverse = planner.plan_fft_inverse(first);
    let mut signal = inverse.make_output_vec();
    check_run(&inverse.process(&mut combined, &mut signal));
    for value in &mut signal {
        *value /= first as f64;
    }
    Ok(signal)
}

fn unit_phase(value: Complex<f64>, floor: f64) -> Complex<f64> {
    let norm = value.norm();
    if norm > floor { value / norm } else { Complex::new(1.0, 0.0) }
}

/// Panics on a failed transform, which is impossible: a transform rejects only buffers of another length.
pub(crate) fn check_run(outcome: &Result<(), realfft::FftError>) {
    assert!(outcome.is_ok(), "the buffers have the lengths of the transform's plan: {outcome:?}");
}

#[cfg(test)]
mod tests {
    use super::{Dft321Error, dft321};
    use crate::dsp::spectrum::hann;
    use crate::maths::rng::lcg_noise;
    use proptest::prelude::{Strategy as _, any, proptest};
    use std::f64::consts::TAU;

    const GOLDEN: &str = include_str!("../../../../vectors/c_dft321/dft321_vectors.json");

    type Frames = Vec<[f64; 3]>;

    fn combine(frames: &[[f64; 3]]) -> Vec<f64> {
        let axes: [Vec<f64>; 3] = [0, 1, 2].map(|axis| frames.iter().map(|frame| frame[axis]).collect());
        dft321(&[&axes[0], &axes[1], &axes[2]]).expect("axes of equal length")
    }

    fn energy(values: impl IntoIterator<Item = f64>) -> f64 {
        values.into_iter().map(|v| v * v).sum()
    }

    fn magnitudes(signal: &[f64]) -> Vec<f64> {
        let n = signal.len();
        (0..=n / 2)
            .map(|k| {
                let turn = |i: usize| TAU * ((k * i) % n) as f64 / n as f64;
                let re: f64 = signal.iter().enumerate().map(|(i, v)| v * turn(i).cos()).sum();
                let im: f64 = signal.iter().enumerate().map(|(i, v)| v * turn(i).sin()).sum();
                re.hypot(im)
            })
            .collect()
    }

    #[test]
    fn golden_vectors_of_even_and_odd_length() {
        let golden: serde_json::Value = serde_json::from_str(GOLDEN).expect("valid JSON");
        for n in [8, 7] {
            let frames: Frames = serde_json::from_value(golden[format!("in{n}")].clone()).expect("frames");
            let expected: Vec<f64> =
                serde_json::from_value(golden[format!("out{n}")].clone()).expect("samples");
            let got = combine(&frames);
            // Two FFT libraries differ by a few roundings of numbers near 10.
            for (got, expected) in got.iter().zip(&expected) {
                assert!((got - expected).abs() < 1e-13, "got {got}, expected {expected}");
            }
            assert_eq!(got.len(), expected.len());
        }
    }

    #[test]
    fn golden_energies_turns_and_overlapping_windows() {
        let golden: serde_json::Value = serde_json::from_str(GOLDEN).expect("valid JSON");
        let pair = |name: &str| [0, 1].map(|i| golden[name][i].as_f64().expect("a number"));
        let eight: Frames = serde_json::from_value(golden["in8"].clone()).expect("frames");
        let thousand: Frames = lcg_noise(3000, 777).chunks_exact(3).map(|c| [c[0], c[1], c[2]]).collect();
        for (frames, [before, after]) in [(&eight, pair("energy8")), (&thousand, pair("energy1000"))] {
            // About a hundred roundings of sums of up to 3000 terms.
            assert!((energy(frames.iter().flatten().copied()) / before - 1.0).abs() < 1e-13);
            assert!((energy(combine(frames)) / after - 1.0).abs() < 1e-13);
        }
        // The reference differs by 7e-16 of the largest magnitude after a rotation; this test uses a plain sum, not an
        // FFT.
        let turned: Frames = thousand.iter().map(|frame| turn(*frame, [0.7, 0.3])).collect();
        let (straight, turned) = (magnitudes(&combine(&thousand)), magnitudes(&combine(&turned)));
        let largest = straight.iter().copied().fold(0.0, f64::max);
        let allowed = golden["rotation_mag_maxrel"].as_f64().expect("a number") + 1e-12;
        assert!(straight.iter().zip(&turned).all(|(a, b)| (a - b).abs() <= allowed * largest));
        // Half-overlapping windows of 256 samples, square root of Hann for analysis and synthesis: energy is not
        // preserved.
        let window: Vec<f64> = hann(256).into_iter().map(f64::sqrt).collect();
        let mut sum = vec![0.0; 1000];
        for start in (0..=1000 - 256).step_by(128) {
            let part: Frames =
                thousand[start..start + 256].iter().zip(&window).map(|(f, w)| f.map(|x| x * w)).collect();
            for ((sum, x), w) in sum[start..].iter_mut().zip(combine(&part)).zip(&window) {
                *sum += w * x;
            }
        }
        let inside = 256..1000 - 256;
        let ratio =
            energy(sum[inside.clone()].iter().copied()) / energy(thousand[inside].iter().flatten().copied());
        assert!((ratio - golden["ola_energy_ratio"].as_f64().expect("a number")).abs() < 1e-12, "{ratio}");
    }

    #[test]
    fn one_axis_comes_back_unchanged() {
        let axis = lcg_noise(101, 3);
        let same = dft321(&[&axis]).expect("one axis");
        assert!(axis.iter().zip(&same).all(|(a, b)| (a - b).abs() < 1e-12));
    }

    #[test]
    fn axes_that_cancel_keep_their_energy() {
        let axis = lcg_noise(64, 5);
        let negated: Vec<f64> = axis.iter().map(|v| -v).collect();
        let combined = dft321(&[&axis, &negated]).expect("equal lengths");
        assert!((energy(combined) - 2.0 * energy(axis)).abs() < 1e-10);
    }

    #[test]
    fn what_cannot_be_combined_is_refused() {
        assert_eq!(dft321(&[]), Err(Dft321Error::NoAxes));
        assert_eq!(dft321(&[&[1.0, 2.0], &[1.0]]), Err(Dft321Error::UnequalLengths { first: 2, other: 1 }));
        assert_eq!(dft321(&[&[], &[]]), Ok(Vec::new()));
    }

    proptest! {
        #[test]
        fn energy_is_preserved_and_magnitude_does_not_turn(
            n in 2_usize..120,
            seed in any::<u64>(),
            angles in [0.0..TAU, 0.0..TAU].prop_map(|angles| angles),
        ) {
            let noise = lcg_noise(3 * n, seed);
            let frames: Frames = noise.chunks_exact(3).map(|c| [c[0], c[1], c[2]]).collect();
            let turned: Frames = frames.iter().map(|frame| turn(*frame, angles)).collect();
            let combined = combine(&frames);
            let total = energy(frames.iter().flatten().copied());
            proptest::prop_assert!((energy(combined.iter().copied()) - total).abs() < 1e-11 * total);
            let scale = total.sqrt() * (n as f64).sqrt();
            for (a, b) in magnitudes(&combined).iter().zip(magnitudes(&combine(&turned))) {
                proptest::prop_assert!((a - b).abs() < 1e-11 * scale, "got {}, rotated {}", a, b);
            }
        }
    }

    fn turn([x, y, z]: [f64; 3], [about_z, about_x]: [f64; 2]) -> [f64; 3] {
        let (sin, cos) = about_z.sin_cos();
        let (x, y) = (cos * x - sin * y, sin * x + cos * y);
        let (sin, cos) = about_x.sin_cos();
        [x, cos * y - sin * z, sin * y + cos * z]
    }
}
