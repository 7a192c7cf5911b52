//! Mel filter bank: filters of equal width on a mel scale.

use ndarray::Array2;

use crate::dsp::mfcc::options::{FilterShape, MelScale, MfccOptions};
use crate::units::Hertz;

/// Frequency at which Slaney's scale changes from linear to logarithmic, and its slope below.
const SLANEY_TURN_HZ: f64 = 1000.0;
const SLANEY_HZ_PER_MEL: f64 = 200.0 / 3.0;
const SLANEY_TURN_MEL: f64 = SLANEY_TURN_HZ / SLANEY_HZ_PER_MEL;
/// Above that frequency, 27 mel correspond to a frequency ratio of 6.4.
const SLANEY_STEPS: f64 = 27.0;
const SLANEY_FACTOR: f64 = 6.4;

/// Edge frequencies of the filters, `n_filters + 2` values. Filter `j` rises from edge `j` to `j + 1` and falls to
/// `j + 2`.
pub(super) fn mel_edges(options: &MfccOptions) -> Vec<Hertz> {
    let mel = |f: Hertz| mel_from_hz(options.scale, f.0);
    let (low, high) = (mel(options.low), mel(options.high));
    let n_steps = options.n_filters + 1;
    let edge = |i: usize| low + (high - low) * i as f64 / n_steps as f64;
    (0..=n_steps).map(|i| Hertz(hz_from_mel(options.scale, edge(i)))).collect()
}

/// Filter weights, `n_filters × (n_transform / 2 + 1)`; bin `k` has the frequency `k rate / n_transform`.
pub fn filter_bank(options: &MfccOptions, rate: Hertz, n_transform: usize) -> Array2<f64> {
    let edges = mel_edges(options);
    let n_bins = n_transform / 2 + 1;
    match options.shape {
        FilterShape::FlooredToBins => {
            let bin = |f: &Hertz| ((n_transform + 1) as f64 * f.0 / rate.0).floor();
            let bins: Vec<f64> = edges.iter().map(bin).collect();
            let weight = |(j, k): (usize, usize)| {
                let (left, center, right, at) = (bins[j], bins[j + 1], bins[j + 2], k as f64);
                match at {
                    _ if at >= left && at < center => (at - left) / (center - left),
                    _ if at >= center && at < right => (right - at) / (right - center),
                    _ => 0.0,
                }
            };
            Array2::from_shape_fn((options.n_filters, n_bins), weight)
        }
        FilterShape::Triangle | FilterShape::UnitArea => {
            let is_unit_area = options.shape == FilterShape::UnitArea;
            let weight = |(j, k): (usize, usize)| {
                let [left, center, right] = [0, 1, 2].map(|i| edges[j + i].0);
                let at = k as f64 * rate.0 / n_transform as f64;
                let side = ((at - left) / (center - left)).min((right - at) / (right - center)).max(0.0);
                if is_unit_area { side * 2.0 / (right - left) } else { side }
            };
            Array2::from_shape_fn((options.n_filters, n_bins), weight)
        }
    }
}

fn mel_from_hz(scale: MelScale, hz: f64) -> f64 {
    match scale {
        MelScale::Htk => 2595.0 * (1.0 + hz / 700.0).log10(),
        MelScale::Slaney if hz < SLANEY_TURN_HZ => hz / SLANEY_HZ_PER_MEL,
        MelScale::Slaney => SLANEY_TURN_MEL + SLANEY_STEPS * (hz / SLANEY_TURN_HZ).ln() / SLANEY_FACTOR.ln(),
    }
}

fn hz_from_mel(scale: MelScale, mel: f64) -> f64 {
    match scale {
        MelScale::Htk => 700.0 * (10.0_f64.powf(mel / 2595.0) - 1.0),
        MelScale::Slaney if mel < SLANEY_TURN_MEL => mel * SLANEY_HZ_PER_MEL,
        MelScale::Slaney => SLANEY_TURN_HZ * SLANEY_FACTOR.powf((mel - SLANEY_TURN_MEL) / SLANEY_STEPS),
    }
}

#[cfg(test)]
mod tests {
    use super::{filter_bank, hz_from_mel, mel_edges, mel_from_hz};
    use crate::dsp::mfcc::{FilterShape, MelScale, MfccOptions, recommended};
    use crate::units::Hertz;

    #[test]
    fn scales_turn_back() {
        for scale in [MelScale::Htk, MelScale::Slaney] {
            for hz in [0.0, 10.0, 500.0, 999.0, 1000.0, 1001.0, 4000.0] {
                let back = hz_from_mel(scale, mel_from_hz(scale, hz));
                assert!((back - hz).abs() < 1e-9, "got {back}, expected {hz}");
            }
        }
        // By definition 1000 Hz is 15 mel (Slaney), 6400 Hz is 27 mel more, and 700 Hz is 2595 log10(2) mel (HTK).
        assert!((mel_from_hz(MelScale::Slaney, 1000.0) - 15.0).abs() < 1e-12);
        assert!((mel_from_hz(MelScale::Slaney, 6400.0) - 42.0).abs() < 1e-12);
        assert!((mel_from_hz(MelScale::Htk, 700.0) - 2595.0 * 2.0_f64.log10()).abs() < 1e-10);
    }

    #[test]
    fn triangles_overlap_to_one_and_unit_areas_are_one() {
        let options = recommended();
        let bank = filter_bank(&options, Hertz(1000.0), 4096);
        let edges = mel_edges(&options);
        for (k, column) in bank.columns().into_iter().enumerate() {
            let hz = k as f64 * 1000.0 / 4096.0;
            if hz >= edges[1].0 && hz <= edges[20].0 {
                assert!((column.sum() - 1.0).abs() < 1e-12, "weights at {hz} Hz do not sum to one");
            }
        }
        let options = MfccOptions { shape: FilterShape::UnitArea, ..options };
        for (j, filter) in filter_bank(&options, Hertz(1000.0), 4096).rows().into_iter().enumerate() {
            let area = filter.sum() * 1000.0 / 4096.0;
            // A Riemann sum approximates the integral of a triangle about 70 bins wide.
            assert!((area - 1.0).abs() < 1e-3, "filter {j} has area {area}");
        }
    }
}
