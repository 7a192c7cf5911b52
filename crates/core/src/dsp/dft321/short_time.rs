//! DFT321 in short overlapping windows, for signals whose level or spectrum changes with time.
//!
//! DFT321 changes the magnitudes of a spectrum but not its phases, which spreads energy over the whole transform. In a
//! recording with quiet and loud strokes, the quiet ones would get the energy of the loud ones. In windows of 0.1 s, it
//! spreads over 0.1 s only.
//!
//! The windows are square roots of a periodic Hann window, for analysis and synthesis, and overlap by half. Neighboring
//! windows of independent axes do not add up coherently, which costs up to 0.3 dB. A gain, smoothed by the same windows,
//! restores the energy of the axes above 10 Hz; slower changes are gravity and hand motion.

use crate::dsp::dft321::{Dft321Error, dft321};
use crate::dsp::filter::{butterworth_high_pass, filter};
use crate::dsp::spectrum::hann;
use crate::units::Hertz;

/// Window length in seconds: that of the shortest segment that a texture is fitted to.
const WINDOW_SECS: f64 = 0.1;
/// Cutoff and order of the high-pass filter for the gain.
const CUTOFF: Hertz = Hertz(10.0);
const ORDER: usize = 4;

/// Combines the axes of a recording into one signal with the same unit; one slice for each axis, usually one to three.
/// A single axis is returned as it is. Recordings shorter than a window are combined by [`dft321`] as a whole.
///
/// # Errors
/// As [`dft321`].
pub fn dft321_short_time(axes: &[&[f64]], rate: Hertz) -> Result<Vec<f64>, Dft321Error> {
    let half = ((0.5 * WINDOW_SECS * rate.0).round() as usize).max(2);
    let window = 2 * half;
    let n_samples = axes.first().map_or(0, |axis| axis.len());
    if let [axis] = axes {
        return Ok(axis.to_vec());
    }
    if n_samples <= window || axes.iter().any(|axis| axis.len() != n_samples) {
        return dft321(axes);
    }
    let means: Vec<f64> = axes.iter().map(|axis| axis.iter().sum::<f64>() / n_samples as f64).collect();
    let starts: Vec<usize> = (0..=n_samples.div_ceil(half)).map(|block| block * half).collect();
    let n_padded = (starts.len() + 1) * half;
    // Half a window before the first sample, so that every sample lies in two windows.
    let padded = |(axis, mean): (&&[f64], &f64)| -> Vec<f64> {
        let mut values = vec![0.0; half];
        values.extend(axis.iter().map(|x| x - mean));
        values.resize(n_padded, 0.0);
        values
    };
    let axes: Vec<Vec<f64>> = axes.iter().zip(&means).map(padded).collect();
    let hann = hann(window);
    let root: Vec<f64> = hann.iter().map(|w| w.sqrt()).collect();
    let mut combined = vec![0.0; n_padded];
    for start in &starts {
        let inside = *start..*start + window;
        let windowed = |axis: &Vec<f64>| -> Vec<f64> {
            axis[inside.clone()].iter().zip(&root).map(|(x, w)| x * w).collect()
        };
        let parts: Vec<Vec<f64>> = axes.iter().map(windowed).collect();
        let made = dft321(&parts.iter().map(Vec::as_slice).collect::<Vec<_>>())?;
        for ((sum, x), w) in combined[inside.clone()].iter_mut().zip(made).zip(&root) {
            *sum += w * x;
        }
    }
    let gains = gains(&axes, &combined, &starts, &hann, rate);
    // As in the transform of the whole, the mean has the sign of the sum of the axes.
    let mean = means.iter().map(|mean| mean * mean).sum::<f64>().sqrt();
    let mean = if means.iter().sum::<f64>() < 0.0 { -mean } else { mean };
    let samples = combined.iter().zip(&gains).skip(half).take(n_samples);
    Ok(samples.map(|(x, gain)| gain * x + mean).collect())
}

/// Gain of each sample that gives the combined signal the energy of the axes in every window.
fn gains(axes: &[Vec<f64>], combined: &[f64], starts: &[usize], hann: &[f64], rate: Hertz) -> Vec<f64> {
    let high_pass = butterworth_high_pass(ORDER, CUTOFF, rate);
    let squares = |values: &[f64]| -> Vec<f64> {
        let mut values = values.to_vec();
        filter(&high_pass, &mut values);
        values.iter().map(|x| x * x).collect()
    };
    let mut wanted = vec![0.0; combined.len()];
    for axis in axes {
        for (sum, square) in wanted.iter_mut().zip(squares(axis)) {
            *sum += square;
        }
    }
    let made = squares(combined);
    let mut gains = vec![0.0; combined.len()];
    for start in starts {
        let inside = *start..*start + hann.len();
        let energy =
            |of: &[f64]| of[inside.clone()].iter().zip(hann).map(|(square, w)| square * w).sum::<f64>();
        let (wanted, made) = (energy(&wanted), energy(&made));
        let gain = if made > 0.0 { (wanted / made).sqrt() } else { 1.0 };
        for (sum, w) in gains[inside.clone()].iter_mut().zip(hann) {
            *sum += w * gain;
        }
    }
    gains
}

#[cfg(test)]
mod tests {
    use super::dft321_short_time;
    use crate::dsp::ar::test_signals::from_resonances;
    use crate::dsp::dft321::{Dft321Error, dft321};
    use crate::maths::rng::lcg_noise;
    use crate::units::Hertz;

    const RATE: Hertz = Hertz(2000.0);
    /// Samples of each part of the test signals: one second.
    const N_PART: usize = 2000;

    /// Three axes with different resonances: a part at full level between two quiet parts, 30 dB below.
    fn axes() -> Vec<Vec<f64>> {
        let axis = |(seed, hz): (u64, f64)| {
            let ar = from_resonances(RATE, &[(Hertz(hz), 0.96)]);
            let mut x = lcg_noise(3 * N_PART, seed);
            let n = x.len();
            for i in 0..n {
                x[i] -= (1..=ar.len().min(i)).map(|k| ar[k - 1] * x[i - k]).sum::<f64>();
            }
            let level = |i: usize| if i / N_PART == 1 { 1.0 } else { 10.0_f64.powf(-1.5) };
            x.iter().enumerate().map(|(i, x)| level(i) * x).collect()
        };
        [(1, 120.0), (2, 200.0), (3, 80.0)].map(axis).to_vec()
    }

    fn slices(axes: &[Vec<f64>]) -> Vec<&[f64]> {
        axes.iter().map(Vec::as_slice).collect()
    }

    /// Level of a signal relative to that of the axes, in dB, in each part without its ends.
    fn level_errors_db(signal: &[f64], axes: &[Vec<f64>]) -> Vec<f64> {
        let energy = |values: &[f64], part: usize| -> f64 {
            values[part * N_PART + 200..(part + 1) * N_PART - 200].iter().map(|x| x * x).sum()
        };
        let of_axes = |part: usize| -> f64 { axes.iter().map(|axis| energy(axis, part)).sum() };
        (0..3).map(|part| 10.0 * (energy(signal, part) / of_axes(part)).log10()).collect()
    }

    #[test]
    fn quiet_parts_keep_their_level_beside_loud_ones() {
        let axes = axes();
        let combined = dft321_short_time(&slices(&axes), RATE).unwrap();
        let errors = level_errors_db(&combined, &axes);
        assert!(errors.iter().all(|error| error.abs() < 0.3), "{errors:?}");
        // The control: the transform of the whole puts the energy of the loud part into the quiet ones.
        let errors = level_errors_db(&dft321(&slices(&axes)).unwrap(), &axes);
        assert!(errors[0] > 3.0 && errors[2] > 3.0, "{errors:?}");
    }

    #[test]
    fn gravity_keeps_its_size_and_changes_no_level() {
        let shifted = |axis: &Vec<f64>, to: f64| -> Vec<f64> {
            let mean = axis.iter().sum::<f64>() / axis.len() as f64;
            axis.iter().map(|x| x - mean + to).collect()
        };
        let with_means = |means: [f64; 3]| {
            let axes: Vec<Vec<f64>> = axes().iter().zip(means).map(|(axis, to)| shifted(axis, to)).collect();
            dft321_short_time(&slices(&axes), RATE).unwrap()
        };
        let without = with_means([0.0; 3]);
        for (means, size) in [([0.0, 6.0, 8.0], 10.0), ([0.0, -6.0, -8.0], -10.0)] {
            let with = with_means(means);
            // Rounding of sums of 6000 numbers near 10.
            assert!(with.iter().zip(&without).all(|(a, b)| (a - size - b).abs() < 1e-9), "{means:?}");
        }
    }

    #[test]
    fn one_axis_is_kept_and_a_short_recording_is_combined_as_a_whole() {
        let axes = axes();
        assert_eq!(dft321_short_time(&slices(&axes[..1]), RATE).unwrap(), axes[0]);
        let short: Vec<&[f64]> = axes.iter().map(|axis| &axis[..150]).collect();
        assert_eq!(dft321_short_time(&short, RATE), dft321(&short));
        assert_eq!(dft321_short_time(&[], RATE), Err(Dft321Error::NoAxes));
        let unequal = [&axes[0][..], &axes[1][..500]];
        let error = Dft321Error::UnequalLengths { first: 3 * N_PART, other: 500 };
        assert_eq!(dft321_short_time(&unequal, RATE), Err(error));
    }
}
