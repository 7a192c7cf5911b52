//! MFCC plan: precomputes everything that does not depend on the signal.

use std::borrow::Cow;
use std::f64::consts::{LN_10, PI, TAU};

use ndarray::linalg::general_mat_mul;
use ndarray::{Array2, ArrayViewMut2, Axis, Slice};

use crate::dsp::mfcc::error::{MfccError, MfccPlanError};
use crate::dsp::mfcc::filter_bank::filter_bank;
use crate::dsp::mfcc::lags::{self, LagFilters};
use crate::dsp::mfcc::logarithm::ln_all;
use crate::dsp::mfcc::options::{
    Dct, FirstCoefficient, Framing, Lifter, Logarithm, MAX_SAMPLE, MAX_TRANSFORM, MfccOptions, Spectrum,
    TransformLength, Window,
};
use crate::dsp::mfcc::transform::Transform;
use crate::dsp::spectrum::hann;
use crate::units::Hertz;

/// MFCC computation with fixed options and sample rate, for any number of signals.
#[derive(Clone)]
pub struct MfccPlan {
    label: &'static str,
    rate: Hertz,
    framing: Framing,
    pre_emphasis: f64,
    n_frame: usize,
    n_hop: usize,
    n_transform: usize,
    n_filters: usize,
    n_empty_filters: usize,
    logarithm: Logarithm,
    transform: Transform,
    /// Present if frames are short and the spectrum is a power spectrum.
    lag_filters: Option<LagFilters>,
    /// Matrix from logarithms to coefficients, `filters × coefficients`, including lifter and decibel scale. The frame
    /// energy counts as the last filter.
    cosines: Array2<f64>,
}

impl MfccPlan {
    /// Creates the plan for `options` and signals of this sample rate.
    ///
    /// # Errors
    /// See [`MfccPlanError`].
    pub fn new(options: &MfccOptions, rate: Hertz) -> Result<Self, MfccPlanError> {
        check(options, rate)?;
        let n_frame = n_samples("frame", options.frame_secs, rate)?;
        let n_hop = n_samples("hop", options.hop_secs, rate)?;
        let n_transform = match options.transform {
            TransformLength::Samples(n) => n,
            TransformLength::PowersOfTwo(times) => n_frame.next_power_of_two().saturating_mul(times),
        };
        if n_transform < n_frame || n_transform > MAX_TRANSFORM {
            return Err(MfccPlanError::Transform { n_transform, n_frame });
        }
        let mut filters = filter_bank(options, rate, n_transform);
        let n_empty_filters = filters.rows().into_iter().filter(|row| row.iter().all(|w| *w == 0.0)).count();
        if options.first == FirstCoefficient::LogEnergy {
            let ones = Array2::ones((1, filters.ncols()));
            filters.append(Axis(0), ones.view()).unwrap_or_else(|e| unreachable!("one row more: {e}"));
        }
        if options.spectrum == Spectrum::PowerPerSample {
            filters /= n_transform as f64;
        }
        let window = window(options.window, n_frame);
        let is_magnitude = options.spectrum == Spectrum::Magnitude;
        let transform = Transform::new(&window, n_transform, &filters, is_magnitude);
        let is_short = n_frame <= lags::MAX_FRAME && !is_magnitude;
        Ok(Self {
            label: options.label,
            rate,
            framing: options.framing,
            pre_emphasis: options.pre_emphasis,
            n_frame,
            n_hop,
            n_transform,
            n_filters: options.n_filters,
            n_empty_filters,
            logarithm: options.logarithm,
            transform,
            lag_filters: is_short.then(|| LagFilters::new(&window, n_transform, &filters)),
            cosines: cosines(options, filters.nrows()),
        })
    }

    /// Name of the plan's options, shown beside results.
    pub fn label(&self) -> &'static str {
        self.label
    }

    /// Sample rate of the signals.
    pub fn rate(&self) -> Hertz {
        self.rate
    }

    /// Number of coefficients of each frame.
    pub fn n_coefficients(&self) -> usize {
        self.cosines.ncols()
    }

    /// Number of filters that contain no bin. Their logarithm is constant, so that the coefficients carry less
    /// information than their number suggests.
    pub fn n_empty_filters(&self) -> usize {
        self.n_empty_filters
    }

    /// Number of frames in a signal of `n` samples; zero if it is too short.
    pub fn n_frames(&self, n: usize) -> usize {
        match self.framing {
            _ if n == 0 => 0,
            Framing::Whole if n < self.n_frame => 0,
            Framing::Whole => 1 + (n - self.n_frame) / self.n_hop,
            Framing::PaddedEnd => 1 + n.saturating_sub(self.n_frame).div_ceil(self.n_hop),
            // The signal is padded by half a transform at each end.
            Framing::Centered => 1 + (n + 2 * (self.n_transform / 2) - self.n_transform) / self.n_hop,
        }
    }

    /// Coefficients of every frame of a signal, `frames × coefficients`.
    ///
    /// # Errors
    /// [`MfccError::TooShort`] if the signal has no frame. [`MfccError::Sample`] if a sample is not finite or its
    /// magnitude exceeds [`MAX_SAMPLE`].
    pub fn coefficients(&self, signal: &[f64]) -> Result<Array2<f64>, MfccError> {
        let is_bad = |x: &f64| x.is_nan() | (x.abs() > MAX_SAMPLE);
        // Counts all samples: a search with an early exit is not vectorized.
        if signal.iter().map(|x| usize::from(is_bad(x))).sum::<usize>() > 0 {
            let found = signal.iter().copied().enumerate().find(|(_, x)| is_bad(x));
            let (index, value) = found.unwrap_or_default();
            return Err(MfccError::Sample { index, value });
        }
        let n_frames = self.n_frames(signal.len());
        if n_frames == 0 {
            let needed = if self.framing == Framing::Whole { self.n_frame } else { 1 };
            return Err(MfccError::TooShort { n: signal.len(), needed });
        }
        let padded = self.padded(signal, n_frames);
        // A limit relative to the signal's maximum needs all frames at once; otherwise small blocks stay in the cache.
        let is_relative = matches!(self.logarithm, Logarithm::Decibels { .. });
        let n_at_once = if is_relative { n_frames } else { n_frames.min(lags::BLOCK) };
        let mut sums = Array2::zeros((n_at_once, self.cosines.nrows()));
        let mut coefficients = Array2::zeros((n_frames, self.n_coefficients()));
        for (part_idx, mut part) in coefficients.axis_chunks_iter_mut(Axis(0), n_at_once).enumerate() {
            let from = &padded[part_idx * n_at_once * self.n_hop..];
            let mut sums = sums.slice_axis_mut(Axis(0), Slice::from(..part.nrows()));
            self.fill(from, &mut sums);
            self.take_logarithms(&mut sums);
            general_mat_mul(1.0, &sums, &self.cosines, 0.0, &mut part);
        }
        Ok(coefficients)
    }

    /// Signal with pre-emphasis and with the zero padding that the frames need.
    fn padded<'a>(&self, signal: &'a [f64], n_frames: usize) -> Cow<'a, [f64]> {
        if self.framing == Framing::Whole && self.pre_emphasis == 0.0 {
            return Cow::Borrowed(signal);
        }
        // The frame is centered in its transform.
        let n_before = match self.framing {
            Framing::Whole | Framing::PaddedEnd => 0,
            Framing::Centered => self.n_transform / 2 - (self.n_transform - self.n_frame) / 2,
        };
        let n_needed = (n_frames - 1) * self.n_hop + self.n_frame;
        let mut padded = Vec::with_capacity(n_needed.max(n_before + signal.len()));
        padded.resize(n_before, 0.0);
        padded.extend_from_slice(signal);
        if self.pre_emphasis != 0.0 {
            for (value, before) in padded[n_before..].iter_mut().skip(1).zip(signal) {
                *value -= self.pre_emphasis * before;
            }
        }
        padded.resize(n_needed.max(padded.len()), 0.0);
        Cow::Owned(padded)
    }

    /// Filter outputs of the frames from the start of `padded` on; the rows of `sums` are contiguous.
    fn fill(&self, padded: &[f64], sums: &mut ArrayViewMut2<'_, f64>) {
        let one_by_one = match &self.lag_filters {
            Some(lag_filters) => lag_filters.fill(padded, self.n_hop, sums),
            None => (0..sums.nrows()).collect(),
        };
        if one_by_one.is_empty() {
            return;
        }
        let mut scratch = self.transform.scratch();
        for frame_idx in one_by_one {
            let frame = &padded[frame_idx * self.n_hop..][..self.n_frame];
            match sums.row_mut(frame_idx).as_slice_mut() {
                Some(row) => self.transform.sums(frame, &mut scratch, row),
                None => unreachable!("a row of a matrix in standard layout is a slice"),
            }
        }
    }

    /// Replaces filter outputs by natural logarithms; the options define zeros and the floor.
    fn take_logarithms(&self, sums: &mut ArrayViewMut2<'_, f64>) {
        let Some(values) = sums.as_slice_mut() else {
            unreachable!("a matrix in standard layout is contiguous")
        };
        match self.logarithm {
            Logarithm::Floored { floor } | Logarithm::Decibels { floor, .. } => {
                ln_all(values, |sum| if sum > floor { sum } else { floor });
            }
            // Subnormal numbers have lost their digits and count as zero.
            Logarithm::ZeroReplaced { instead } => {
                ln_all(values, |sum| if sum >= f64::MIN_POSITIVE { sum } else { instead });
            }
        }
        if let Logarithm::Decibels { top_db, .. } = self.logarithm {
            let mut of_filters = sums.slice_axis_mut(Axis(1), Slice::from(..self.n_filters));
            let highest = of_filters.iter().copied().fold(f64::NEG_INFINITY, f64::max);
            let lowest = highest - top_db * LN_10 / 10.0;
            of_filters.mapv_inplace(|value| value.max(lowest));
        }
    }
}

fn check(options: &MfccOptions, rate: Hertz) -> Result<(), MfccPlanError> {
    let value = |what, value: f64, low: f64, high: f64| {
        // NaN is in no range.
        if (low..=high).contains(&value) {
            Ok(())
        } else {
            Err(MfccPlanError::Value { what, value, low, high })
        }
    };
    value("the rate in Hz", rate.0, f64::MIN_POSITIVE, 1e9)?;
    value("the length of a frame in s", options.frame_secs, f64::MIN_POSITIVE, 1e6)?;
    value("the hop in s", options.hop_secs, f64::MIN_POSITIVE, 1e6)?;
    value("the pre-emphasis", options.pre_emphasis, 0.0, 1.0)?;
    match options.logarithm {
        Logarithm::Floored { floor } => value("the floor of the logarithm", floor, f64::MIN_POSITIVE, 1e100)?,
        Logarithm::ZeroReplaced { instead } => {
            value("the replacement for zero in the logarithm", instead, f64::MIN_POSITIVE, 1e100)?;
        }
        Logarithm::Decibels { floor, top_db } => {
            value("the floor of the logarithm", floor, f64::MIN_POSITIVE, 1e100)?;
            value("the dynamic range in dB", top_db, f64::MIN_POSITIVE, f64::INFINITY)?;
        }
    }
    if let Lifter::FromZero(length) | Lifter::FromOne(length) = options.lifter {
        value("the length of the lifter", length, 1.0, 1e6)?;
    }
    let (low_hz, high_hz, nyquist_hz) = (options.low.0, options.high.0, 0.5 * rate.0);
    if !(low_hz >= 0.0 && low_hz < high_hz && high_hz <= nyquist_hz) {
        return Err(MfccPlanError::Edges { low_hz, high_hz, nyquist_hz });
    }
    let (n_filters, n_coefficients) = (options.n_filters, options.n_coefficients);
    if !(1..=MAX_TRANSFORM / 2).contains(&n_filters) {
        return Err(MfccPlanError::Filters { n: n_filters });
    }
    if !(1..=n_filters).contains(&n_coefficients) {
        return Err(MfccPlanError::Coefficients { n_coefficients, n_filters });
    }
    Ok(())
}

fn n_samples(what: &'static str, secs: f64, rate: Hertz) -> Result<usize, MfccPlanError> {
    let n = (secs * rate.0).round();
    if n < 1.0 { Err(MfccPlanError::Duration { what, secs, rate_hz: rate.0 }) } else { Ok(n as usize) }
}

fn window(window: Window, n: usize) -> Vec<f64> {
    match window {
        Window::Rectangular => vec![1.0; n],
        Window::Hamming if n == 1 => vec![1.0],
        Window::Hamming => (0..n).map(|i| 0.54 - 0.46 * (TAU * i as f64 / (n - 1) as f64).cos()).collect(),
        Window::Hann => hann(n),
    }
}

/// Matrix from natural logarithms of `n_sums` filter outputs to coefficients.
fn cosines(options: &MfccOptions, n_sums: usize) -> Array2<f64> {
    let n = options.n_filters as f64;
    let unit = match options.logarithm {
        Logarithm::Decibels { .. } => 10.0 / LN_10,
        Logarithm::Floored { .. } | Logarithm::ZeroReplaced { .. } => 1.0,
    };
    let value = |(m, k): (usize, usize)| {
        if k == 0 && options.first == FirstCoefficient::LogEnergy {
            return if m == options.n_filters { 1.0 } else { 0.0 };
        }
        if m == options.n_filters {
            return 0.0;
        }
        let scale = match options.dct {
            Dct::Orthonormal if k == 0 => (1.0 / n).sqrt(),
            Dct::Orthonormal | Dct::Htk => (2.0 / n).sqrt(),
        };
        let lift = match options.lifter {
            Lifter::None => 1.0,
            Lifter::FromZero(length) => 1.0 + 0.5 * length * (PI * k as f64 / length).sin(),
            Lifter::FromOne(length) => 1.0 + 0.5 * length * (PI * (k + 1) as f64 / length).sin(),
        };
        unit * scale * lift * (PI * k as f64 * (m as f64 + 0.5) / n).cos()
    };
    Array2::from_shape_fn((n_sums, options.n_coefficients), value)
}
