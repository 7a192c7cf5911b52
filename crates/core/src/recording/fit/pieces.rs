//! Extraction of stationary segments, resampled to the model rate.

use std::ops::Range;

use crate::dsp::filter::{DECIMATION_PASS_SHARE, butterworth_high_pass, filter, resample};
use crate::dsp::spectrum::welch;
use crate::recording::Recording;
use crate::recording::fit::{FitError, HIGH_PASS};
use crate::recording::segment::{MIN_FORCE, MIN_SPEED, Segmentation, segment, smoothed};
use crate::texture::RATES_HZ;
use crate::units::Hertz;

/// Model rates to select from, in Hz, lowest first.
pub const MODEL_RATES_HZ: [f64; 3] = [1000.0, 2000.0, 4000.0];

/// Share of the power above [`HIGH_PASS`] that the model's band must contain.
const BAND_SHARE: f64 = 0.99;

/// Lowest sample rate of a recording, in Hz; its band includes the frequencies of highest tactile sensitivity.
const MIN_RECORDING_HZ: f64 = 500.0;

/// Settling time of the high-pass filter in seconds: one period of its cutoff frequency.
const SETTLE_SECS: f64 = 0.1;

/// Minimum duration of a segment, in seconds.
const MIN_PIECE_SECS: f64 = 0.1;

/// Minimum number of samples of a segment for each coefficient of a usual predictor.
const SAMPLES_A_COEFFICIENT: usize = 5;

/// Highest usual order at a model rate; a band twice as wide has more resonances.
pub(super) fn usual_order(rate: Hertz) -> usize {
    if rate.0 <= 1000.0 { 20 } else { 32 }
}

/// Minimum number of samples of a segment at a model rate; more than the highest order.
pub(super) fn least_samples(rate: Hertz) -> usize {
    SAMPLES_A_COEFFICIENT * usual_order(rate)
}

/// Segment at the model rate, with the data that predictors are estimated from.
#[derive(Clone)]
pub(super) struct Piece {
    pub(super) recording: usize,
    pub(super) start_secs: f64,
    pub(super) seconds: f64,
    pub(super) speed_mps: f64,
    pub(super) force_n: f64,
    pub(super) signal: Vec<f64>,
    /// Smoothed tip speed at each sample of the signal.
    pub(super) speeds_mps: Vec<f64>,
    pub(super) mean_square: f64,
}

/// All segments to be fitted.
pub(super) struct Cut {
    pub(super) pieces: Vec<Piece>,
    pub(super) rate: Hertz,
    pub(super) notes: Vec<String>,
}

/// Recording after the high-pass filter, and its segments.
pub(super) struct Stroked<'a> {
    pub(super) recording: &'a Recording,
    /// Usable ranges and their filtered signals, at the recording's rate.
    pub(super) signals: Vec<(Range<usize>, Vec<f64>)>,
    pub(super) segmentation: Segmentation,
}

/// Segments of all recordings, at `rate` or at the rate selected from their bandwidth.
pub(super) fn cut(recordings: &[Recording], rate: Option<Hertz>) -> Result<Cut, FitError> {
    for (index, recording) in recordings.iter().enumerate() {
        check(index, recording)?;
    }
    let lowest_hz = recordings.iter().map(|r| nominal(r.rate).0).fold(f64::INFINITY, f64::min);
    if let Some(asked) = rate
        && !(RATES_HZ.contains(&asked.0) && asked.0 <= lowest_hz)
    {
        return Err(FitError::RateAsked { rate_hz: asked.0, highest_hz: lowest_hz });
    }
    let stroked: Vec<Stroked<'_>> = recordings.iter().map(filtered).collect();
    if stroked.iter().all(|s| s.segmentation.stretches.is_empty()) {
        return Err(nothing(&stroked));
    }
    let rate = rate.unwrap_or_else(|| rate_by_bandwidth(&stroked, lowest_hz));
    let n_min = least_samples(rate);
    let mut pieces = Vec::new();
    let (mut short_secs, mut silent_secs) = (0.0, 0.0);
    for (index, stroked) in stroked.iter().enumerate() {
        let from = nominal(stroked.recording.rate);
        let lower: Vec<Vec<f64>> =
            stroked.signals.iter().map(|(_, signal)| resample(signal, from, rate)).collect();
        let speeds: Vec<Vec<f64>> = stroked
            .signals
            .iter()
            .map(|(usable, _)| smoothed(&stroked.recording.speed_mps[usable.clone()], from.0))
            .collect();
        for stretch in &stroked.segmentation.stretches {
            let holds = |(usable, _): &(Range<usize>, _)| usable.contains(&stretch.samples.start);
            let Some(at) = stroked.signals.iter().position(holds) else { continue };
            let begin = stroked.signals[at].0.start;
            let sample = |i: usize| ((i - begin) as f64 * rate.0 / from.0).round() as usize;
            let signal = &lower[at];
            let speed_mps = |i: usize| {
                let i = stretch.samples.start - begin + (i as f64 * from.0 / rate.0) as usize;
                speeds[at][i.min(speeds[at].len() - 1)]
            };
            let signal =
                &signal[sample(stretch.samples.start)..sample(stretch.samples.end).min(signal.len())];
            let seconds = signal.len() as f64 / rate.0;
            // Rounding of the ends can cost a sample.
            if signal.len() + 1 < n_min {
                short_secs += seconds;
                continue;
            }
            let mean_square = signal.iter().map(|x| x * x).sum::<f64>() / signal.len() as f64;
            if mean_square == 0.0 {
                silent_secs += seconds;
                continue;
            }
            pieces.push(Piece {
                recording: index,
                start_secs: stretch.samples.start as f64 / from.0,
                seconds,
                speed_mps: stretch.speed.0,
                force_n: stretch.force.0,
                mean_square,
                speeds_mps: (0..signal.len()).map(speed_mps).collect(),
                signal: signal.to_vec(),
            });
        }
    }
    if pieces.is_empty() {
        return Err(if silent_secs > 0.0 { FitError::Silent } else { nothing(&stroked) });
    }
    Ok(Cut { pieces, rate, notes: notes(&stroked, (short_secs, n_min), silent_secs) })
}

/// Checks that the columns satisfy the conditions of [`Recording`].
pub(super) fn check(recording: usize, r: &Recording) -> Result<(), FitError> {
    let n = r.acceleration_mps2.len();
    let columns = [&r.acceleration_mps2, &r.speed_mps, &r.force_n];
    let ascending = r.usable.windows(2).all(|w| w[0].end <= w[1].start);
    let inside = r.usable.iter().all(|u| u.start <= u.end && u.end <= n);
    if columns.iter().any(|c| c.len() != n) || !ascending || !inside {
        return Err(FitError::Columns { recording });
    }
    if !(r.rate.0 >= MIN_RECORDING_HZ && r.rate.0.is_finite()) {
        return Err(FitError::RecordingRate { recording, rate_hz: r.rate.0, lowest_hz: MIN_RECORDING_HZ });
    }
    for (column, values) in ["acceleration", "speed", "force"].into_iter().zip(columns) {
        let mut rows = r.usable.iter().cloned().flatten();
        if let Some(row) = rows.find(|i| !values[*i].is_finite()) {
            return Err(FitError::NotFinite { recording, column, row });
        }
    }
    Ok(())
}

/// High-pass filters every usable range.
pub(super) fn filtered(recording: &Recording) -> Stroked<'_> {
    let n_settle = (SETTLE_SECS * recording.rate.0) as usize;
    let mut settled = recording.clone();
    settled.usable.clear();
    let mut signals = Vec::new();
    for usable in recording.usable.iter().filter(|u| u.len() > n_settle) {
        let signal = high_passed(&recording.acceleration_mps2[usable.clone()], recording.rate);
        signals.push((usable.clone(), signal));
        settled.usable.push(usable.start + n_settle..usable.end);
    }
    Stroked { recording, signals, segmentation: segment(&settled, MIN_PIECE_SECS) }
}

/// Returns a signal without its mean and what lies below [`HIGH_PASS`], filtered in one forward pass. The spectrum does
/// not depend on the phase, and above twice the cutoff the delay is only a few milliseconds.
pub(super) fn high_passed(signal: &[f64], rate: Hertz) -> Vec<f64> {
    let mean = signal.iter().sum::<f64>() / signal.len() as f64;
    let mut signal: Vec<f64> = signal.iter().map(|x| x - mean).collect();
    filter(&butterworth_high_pass(4, HIGH_PASS, rate), &mut signal);
    signal
}

/// Returns the model rate to which a recording's rate agrees within clock error, and otherwise the rate itself. Such a
/// small frequency error is imperceptible.
pub(super) fn nominal(rate: Hertz) -> Hertz {
    const CLOCK_ERROR: f64 = 1e-3;
    let is_near = |model_hz: &f64| (rate.0 / model_hz - 1.0).abs() < CLOCK_ERROR;
    MODEL_RATES_HZ.into_iter().find(is_near).map_or(rate, Hertz)
}

/// Lowest model rate whose band contains [`BAND_SHARE`] of the power of the stronger half of the segments.
fn rate_by_bandwidth(stroked: &[Stroked<'_>], lowest_hz: f64) -> Hertz {
    let possible: Vec<f64> = MODEL_RATES_HZ.into_iter().filter(|r| *r <= lowest_hz).collect();
    let (Some(lowest), Some(highest)) = (possible.first(), possible.last()) else { return Hertz(lowest_hz) };
    let mut densities: Vec<Vec<(Hertz, f64)>> = Vec::new();
    for stroked in stroked {
        let rate = stroked.recording.rate;
        let window = (MIN_PIECE_SECS * rate.0) as usize;
        for stretch in &stroked.segmentation.stretches {
            let of = stroked.signals.iter().find(|(usable, _)| usable.contains(&stretch.samples.start));
            if let Some((usable, signal)) = of {
                let part = &signal[stretch.samples.start - usable.start..stretch.samples.end - usable.start];
                densities.push(welch(part, rate, window.min(part.len())));
            }
        }
    }
    let power = |density: &[(Hertz, f64)], high_hz: f64| -> f64 {
        let step = density.get(1).map_or(0.0, |d| d.0.0);
        let inside = density.iter().filter(|(f, _)| f.0 >= HIGH_PASS.0 && f.0 <= high_hz);
        step * inside.map(|(_, p)| p).sum::<f64>()
    };
    let top_hz = 0.5 * highest;
    densities.sort_by(|a, b| power(b, top_hz).total_cmp(&power(a, top_hz)));
    densities.truncate(densities.len().div_ceil(2));
    let total = |high_hz: f64| densities.iter().map(|d| power(d, high_hz)).sum::<f64>();
    let holds = |rate_hz: f64| total(DECIMATION_PASS_SHARE * 0.5 * rate_hz) >= BAND_SHARE * total(top_hz);
    Hertz(possible.iter().copied().find(|r| holds(*r)).unwrap_or(if total(top_hz) > 0.0 {
        *highest
    } else {
        *lowest
    }))
}

/// Error for recordings without a segment to fit.
pub(super) fn nothing(stroked: &[Stroked<'_>]) -> FitError {
    let most =
        |value: fn(&Segmentation) -> f64| stroked.iter().map(|s| value(&s.segmentation)).fold(0.0, f64::max);
    let usable_secs: f64 = stroked.iter().map(|s| s.recording.usable_seconds()).sum();
    let (fastest_mps, strongest_n) = (most(|s| s.fastest.0), most(|s| s.strongest.0));
    if usable_secs < MIN_PIECE_SECS + SETTLE_SECS {
        FitError::TooShort { seconds: usable_secs }
    } else if strongest_n < MIN_FORCE.0 {
        FitError::NoContact { strongest_n }
    } else if fastest_mps < MIN_SPEED.0 {
        FitError::NoMotion { fastest_mm_per_s: 1e3 * fastest_mps }
    } else {
        FitError::NotStationary { shortest_secs: MIN_PIECE_SECS }
    }
}

fn notes(stroked: &[Stroked<'_>], (short_secs, n_min): (f64, usize), silent_secs: f64) -> Vec<String> {
    let sum = |value: fn(&Segmentation) -> f64| stroked.iter().map(|s| value(&s.segmentation)).sum::<f64>();
    let left_out = [
        (sum(|s| s.lifted_secs), format!("with the tip lifted (below {MIN_FORCE})")),
        (sum(|s| s.slow_secs), format!("with a tip speed below {:.0} mm/s", MIN_SPEED.mm_per_s())),
        (sum(|s| s.changing_secs), "with speed or force changing too fast".to_owned()),
        (short_secs, format!("in segments with fewer than {n_min} samples")),
        (silent_secs, "without any vibration".to_owned()),
    ];
    left_out
        .into_iter()
        .filter(|(secs, _)| *secs >= 0.05)
        .map(|(secs, what)| format!("{secs:.1} s {what} were left out."))
        .collect()
}
