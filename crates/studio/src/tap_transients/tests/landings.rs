//! Landings on all starter materials, rendered as `shagreen render` does, at three impact speeds.
//!
//! The table in `docs/notes/starter-library.md` is the output of
//! `cargo test -p shagreen-studio landings -- --nocapture`.
#![allow(clippy::print_stdout, reason = "the test prints the table of the notes")]

use std::f64::consts::TAU;

use shagreen_core::maths::statistics::correlation;
use shagreen_device::synth::tap::{HIGHEST_SHARE, MAX_AMPLITUDE_MPS2};
use shagreen_device::track::{PenSample, Track};
use shagreen_formats::starter::starter_library;

use super::{Tap, add_tap_transients};

/// Impact speeds, in m/s; the second is the one for which tap transients are stated.
const IMPACTS_MPS: [f64; 3] = [0.05, 0.1, 0.2];
/// Length of the analyzed signal: all transients have decayed by 100 dB.
const ANALYZED_SECS: f64 = 0.2;
/// Lowest frequency at which a spectrum is evaluated, and the ratio of neighboring frequencies.
const GRID: (f64, f64) = (5.0, 1.02);
/// Lower limit of the band in which hard landings are compared by energy, in Hz.
const HARD_FROM_HZ: f64 = 100.0;

/// What the signal of one landing contains.
#[derive(Clone, Copy, Debug)]
struct Landing {
    dominant_hz: f64,
    peak_mps2: f64,
    /// Energy above [`HARD_FROM_HZ`], in (m/s²)²·s.
    hard_energy: f64,
}

/// Landings of one material at [`IMPACTS_MPS`].
struct Material {
    id: String,
    stiffness_log10_n_per_m: f64,
    landings: [Landing; 3],
}

/// A pen that comes down at this speed after 50 ms and stays.
fn stroke(impact_mps: f64) -> Track {
    let sample = |i: u32| {
        let touching = i >= 50;
        let impact_mps = (i == 50).then_some(impact_mps);
        PenSample {
            time_secs: 1e-3 * f64::from(i),
            force_n: 1.0,
            touching,
            impact_mps,
            ..PenSample::default()
        }
    };
    Track::new(&(0..=400).map(sample).collect::<Vec<_>>()).unwrap()
}

/// Power of a signal at a frequency, by the recursion of Goertzel.
fn power(signal: &[f64], rate_hz: f64, hz: f64) -> f64 {
    let twice_cos = 2.0 * (TAU * hz / rate_hz).cos();
    let (mut last, mut before) = (0.0, 0.0);
    for x in signal {
        (last, before) = (x + twice_cos * last - before, last);
    }
    last * last + before * before - twice_cos * last * before
}

/// Frequency of the highest point of the spectrum, between the points of the grid by a parabola.
fn dominant_hz(signal: &[f64], rate_hz: f64) -> f64 {
    let (lowest_hz, ratio) = GRID;
    let hz_at = |position: f64| lowest_hz * ratio.powf(position);
    let ln_power: Vec<f64> = (0..1000)
        .map(|i| hz_at(f64::from(i)))
        .take_while(|hz| *hz < (0.5 * rate_hz).min(2000.0))
        .map(|hz| power(signal, rate_hz, hz).ln())
        .collect();
    let inner = 1..ln_power.len() - 1;
    let best = inner.max_by(|a, b| ln_power[*a].total_cmp(&ln_power[*b])).unwrap();
    let [low, middle, high] = [ln_power[best - 1], ln_power[best], ln_power[best + 1]];
    hz_at(best as f64 + 0.5 * (low - high) / (low - 2.0 * middle + high))
}

/// Energy above [`HARD_FROM_HZ`]: that of all samples without that of the lower bins of the Fourier transform.
fn hard_energy(signal: &[f64], rate_hz: f64) -> f64 {
    let n = signal.len() as f64;
    let n_lower = (HARD_FROM_HZ * n / rate_hz) as u32;
    let bin = |k: u32| power(signal, rate_hz, f64::from(k) * rate_hz / n) / n;
    let lower: f64 = bin(0) + 2.0 * (1..n_lower).map(bin).sum::<f64>();
    (signal.iter().map(|x| x * x).sum::<f64>() - lower) / rate_hz
}

fn landed(rate_hz: u32, model_rate_hz: f64, tap: Tap, impact_mps: f64) -> Landing {
    let mut samples = vec![0.0; (0.4 * f64::from(rate_hz)) as usize];
    add_tap_transients(&mut samples, rate_hz, model_rate_hz, stroke(impact_mps), tap).unwrap();
    let begin = samples.iter().position(|x| *x != 0.0).unwrap();
    let n = (ANALYZED_SECS * f64::from(rate_hz)) as usize;
    let signal: Vec<f64> = samples[begin..begin + n].iter().map(|x| f64::from(*x)).collect();
    let rate_hz = f64::from(rate_hz);
    Landing {
        dominant_hz: dominant_hz(&signal, rate_hz),
        peak_mps2: signal.iter().fold(0.0, |peak, x| x.abs().max(peak)),
        hard_energy: hard_energy(&signal, rate_hz),
    }
}

/// Landings on the starter materials at a sample rate, softest material first.
fn materials(rate_hz: u32) -> Vec<Material> {
    let library = starter_library().unwrap();
    let mut all: Vec<Material> = library
        .textures
        .iter()
        .map(|texture| {
            let tap = texture.model.tap().unwrap().into();
            let model_rate_hz = texture.model.rate().0;
            Material {
                id: texture.id.clone(),
                stiffness_log10_n_per_m: texture.physical.unwrap().hardness_log10_n_per_m,
                landings: IMPACTS_MPS.map(|mps| landed(rate_hz, model_rate_hz, tap, mps)),
            }
        })
        .collect();
    all.sort_by(|a, b| a.stiffness_log10_n_per_m.total_cmp(&b.stiffness_log10_n_per_m));
    all
}

/// Ranks of values; equal values share the mean of their ranks.
fn ranks(values: &[f64]) -> Vec<f64> {
    let rank = |value: &f64| {
        let n_below = values.iter().filter(|other| *other < value).count() as f64;
        let n_equal = values.iter().filter(|other| *other == value).count() as f64;
        n_below + 0.5 * (n_equal - 1.0)
    };
    values.iter().map(rank).collect()
}

/// Spearman's rank correlation of stiffness with a quantity of the landings at one impact speed.
fn rank_correlation(all: &[Material], impact: usize, of: impl Fn(&Landing) -> f64) -> f64 {
    let stiffness: Vec<f64> = all.iter().map(|material| material.stiffness_log10_n_per_m).collect();
    let values: Vec<f64> = all.iter().map(|material| of(&material.landings[impact])).collect();
    correlation(&ranks(&stiffness), &ranks(&values)).unwrap()
}

fn print_table(rate_hz: u32, all: &[Material]) {
    println!("Landings at {rate_hz} Hz: dominant frequency in Hz / peak in m/s² / energy above 100 Hz");
    println!("| material | contact stiffness at 1 N, log₁₀ N/m | 50 mm/s | 100 mm/s | 200 mm/s |");
    println!("|---|--:|--:|--:|--:|");
    for Material { id, stiffness_log10_n_per_m, landings } in all {
        let cells = landings.map(|landing| {
            let Landing { dominant_hz, peak_mps2, hard_energy } = landing;
            format!("{dominant_hz:.0} / {peak_mps2:.1} / {hard_energy:.3}")
        });
        println!("| {id} | {stiffness_log10_n_per_m:.2} | {} |", cells.join(" | "));
    }
}

#[test]
fn rendered_landings_rank_the_starter_materials_by_stiffness() {
    let all = materials(48_000);
    print_table(48_000, &all);
    assert_eq!(all.len(), 25);
    for (impact, mps) in IMPACTS_MPS.into_iter().enumerate() {
        let rank = rank_correlation(&all, impact, |landing| landing.dominant_hz);
        println!("rank correlation of dominant frequency with stiffness at {mps} m/s: {rank:.3}");
        assert!(rank >= 0.95, "{rank} at {mps} m/s");
        let by_id = |id: &str| all.iter().find(|material| material.id == id).unwrap().landings[impact];
        let order = ["open-cell-foam", "flat-rubber", "sanded-wood", "glass"].map(by_id);
        assert!(order.is_sorted_by(|a, b| 1.5 * a.dominant_hz < b.dominant_hz), "{order:?}");
        // At the fastest impact, hard materials come near the ceiling of 1000 m/s².
        let below = if mps < 0.2 { &order[..] } else { &order[..3] };
        assert!(below.is_sorted_by(|a, b| 1.5 * a.peak_mps2 < b.peak_mps2), "{order:?}");
    }
    for Material { id, landings: [slow, stated, fast], .. } in &all {
        for (landing, strength) in [(slow, 0.5_f64), (fast, 2.0)] {
            let quickening = landing.dominant_hz / stated.dominant_hz;
            // The spectrum keeps its shape, so its peak moves by this factor; the parabola is exact to half a percent.
            assert!((quickening / strength.powf(0.2) - 1.0).abs() < 0.01, "{id}: {quickening} at {strength}");
            let growth = landing.peak_mps2 / stated.peak_mps2;
            let is_bounded = stated.peak_mps2 * strength.powf(1.2) > 0.8 * MAX_AMPLITUDE_MPS2;
            let is_by_law = (growth / strength.powf(1.2) - 1.0).abs() < 0.01;
            assert!(is_bounded || is_by_law, "{id}: {growth} at {strength}");
        }
    }
}

/// The sample rate of the models cannot hold the frequency of hard materials; their energy remains.
#[test]
fn landings_rank_the_materials_at_the_rate_of_the_models_too() {
    let rate_hz = 1000;
    let all = materials(rate_hz);
    print_table(rate_hz, &all);
    let highest_hz = HIGHEST_SHARE * f64::from(rate_hz);
    let hardness = |landing: &Landing| {
        // Landings at the highest frequency count by energy, and above all others.
        if landing.dominant_hz > 0.95 * highest_hz { 1e6 + landing.hard_energy } else { landing.dominant_hz }
    };
    for (impact, mps) in IMPACTS_MPS.into_iter().enumerate() {
        let rank = rank_correlation(&all, impact, hardness);
        println!("rank correlation of frequency, then energy, with stiffness at {mps} m/s: {rank:.3}");
        // At the fastest impact, the ceiling of 1000 m/s² makes the hardest materials equally strong.
        let least = if mps < 0.2 { 0.95 } else { 0.9 };
        assert!(rank >= least, "{rank} at {mps} m/s");
    }
}
