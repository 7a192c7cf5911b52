//! The rule by which a drive signal becomes a waveform and an intensity.
//!
//! The signal is measured in windows of [`WINDOW_SECS`]:
//!
//! 1. *Intensity.* It is proportional to the root mean square of the signal, and 100 % at [`FULL_RMS`] of full scale: a
//!    Gaussian signal at this level just reaches full scale with its peaks, four times its root mean square. It is
//!    rounded to whole percent; at 0 %, nothing plays.
//! 2. *Frequency.* `f = (fs / π) asin(½ √(Σ (x[n] − x[n−1])² / Σ x[n]²))`, which is the frequency of a sine, and for noise
//!    the root mean square frequency of its spectrum.
//! 3. *Waveform.* Of the continuous waveforms that the pen has, the one whose frequency in [`ASSUMED_HZ`] is nearest in
//!    octaves. The present one is kept unless another is nearer by more than [`HYSTERESIS_OCTAVES`].
//! 4. *Tap.* A window after silence whose peak exceeds [`TAP_CREST`] times its root mean square is a tap. It plays a click
//!    at the peak as a share of full scale, if the pen has one.
//!
//! Neither the frequencies of the waveforms nor the relation between intensity and acceleration were measured: no data of
//! a real pen were available. They are assumptions, and the result is an approximation.

use crate::haptic_pen::waveform::{Play, Waveform};

/// Length of a measured window in s.
pub const WINDOW_SECS: f32 = 0.05;
/// Root mean square of the signal at an intensity of 100 %, as a share of full scale.
pub const FULL_RMS: f32 = 0.25;
/// Octaves by which another waveform must be nearer to replace the present one.
pub const HYSTERESIS_OCTAVES: f32 = 0.25;
/// Ratio of the peak to the root mean square above which a window after silence is a tap.
pub const TAP_CREST: f32 = 4.0;

/// Assumed frequencies of the continuous waveforms in Hz: soft tools low, hard tools high, around the resonance of small
/// actuators at about 200 Hz, at equal distances of about 0.43 octaves.
pub const ASSUMED_HZ: [(Waveform, f32); 7] = [
    (Waveform::BRUSH, 80.0),
    (Waveform::ERASER, 108.0),
    (Waveform::MARKER, 146.0),
    (Waveform::CHISEL_MARKER, 197.0),
    (Waveform::INK, 266.0),
    (Waveform::PENCIL, 359.0),
    (Waveform::SPARKLE, 485.0),
];

/// Measurement of a window.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Measure {
    /// Root mean square, as a share of full scale.
    pub rms: f32,
    /// Highest magnitude, as a share of full scale.
    pub peak: f32,
    /// Frequency in Hz; zero for silence.
    pub frequency_hz: f32,
}

/// Translates a drive signal into waveforms and intensities.
#[derive(Clone, Debug)]
pub struct Translator {
    rate_hz: f32,
    window_frames: usize,
    continuous: Vec<(Waveform, f32)>,
    has_click: bool,
    n_frames: usize,
    squares: f64,
    squared_steps: f64,
    peak: f32,
    last: f32,
    played: Option<Waveform>,
}

impl Translator {
    /// A translator for a signal at this sample rate and a pen with these waveforms.
    pub fn new(rate_hz: u32, offered: impl Iterator<Item = Waveform>) -> Self {
        let offered: Vec<Waveform> = offered.collect();
        let is_offered = |waveform: Waveform| offered.contains(&waveform);
        Self {
            rate_hz: rate_hz as f32,
            window_frames: (WINDOW_SECS * rate_hz as f32).round().max(1.0) as usize,
            continuous: ASSUMED_HZ.into_iter().filter(|(waveform, _)| is_offered(*waveform)).collect(),
            has_click: is_offered(Waveform::CLICK),
            n_frames: 0,
            squares: 0.0,
            squared_steps: 0.0,
            peak: 0.0,
            last: 0.0,
            played: None,
        }
    }

    /// Takes a block of interleaved frames of `channels` samples. Returns the waveform and the intensity of the last
    /// window that it completes; `None` if it completes none. Of each frame, the sample of the largest magnitude counts:
    /// all channels carry the same signal or none.
    pub fn process(&mut self, block: &[f32], channels: usize) -> Option<Play> {
        let mut newest = None;
        for frame in block.chunks(channels.max(1)) {
            let sample = frame.iter().fold(0.0, |most: f32, x| if x.abs() > most.abs() { *x } else { most });
            if let Some(measure) = self.take(sample) {
                let play = self.play(measure);
                // A click must not be lost, because it is not repeated.
                if newest.is_none_or(|newest: Play| newest.waveform != Some(Waveform::CLICK)) {
                    newest = Some(play);
                }
            }
        }
        newest
    }

    /// Adds a sample to the window. Returns the measurement of a window that is complete.
    fn take(&mut self, sample: f32) -> Option<Measure> {
        let step = sample - std::mem::replace(&mut self.last, sample);
        self.squares += f64::from(sample).powi(2);
        self.squared_steps += f64::from(step).powi(2);
        self.peak = self.peak.max(sample.abs());
        self.n_frames += 1;
        if self.n_frames < self.window_frames {
            return None;
        }
        let n_frames = std::mem::take(&mut self.n_frames) as f64;
        let squares = std::mem::take(&mut self.squares);
        let squared_steps = std::mem::take(&mut self.squared_steps);
        let ratio = if squares > 0.0 { (squared_steps / squares).sqrt() } else { 0.0 };
        let half_angle = (0.5 * ratio).min(1.0).asin();
        Some(Measure {
            rms: (squares / n_frames).sqrt() as f32,
            peak: std::mem::take(&mut self.peak),
            frequency_hz: self.rate_hz * (half_angle / std::f64::consts::PI) as f32,
        })
    }

    /// The waveform and the intensity for a window.
    fn play(&mut self, measure: Measure) -> Play {
        let intensity_percent = percent(measure.rms / FULL_RMS);
        if intensity_percent == 0 {
            self.played = None;
            return Play::SILENCE;
        }
        let is_tap = self.played.is_none() && measure.peak > TAP_CREST * measure.rms;
        self.played = self.nearest(measure.frequency_hz);
        if is_tap && self.has_click {
            return Play { waveform: Some(Waveform::CLICK), intensity_percent: percent(measure.peak).max(1) };
        }
        Play { waveform: self.played, intensity_percent }
    }

    /// The continuous waveform of the pen for a frequency.
    fn nearest(&self, frequency_hz: f32) -> Option<Waveform> {
        let octaves = |(_, hz): &(Waveform, f32)| (frequency_hz.max(1.0) / hz).log2().abs();
        let best = self.continuous.iter().min_by(|a, b| octaves(a).total_cmp(&octaves(b)))?;
        let present = self.continuous.iter().find(|(waveform, _)| Some(*waveform) == self.played);
        let keeps = |present: &&(Waveform, f32)| octaves(present) <= octaves(best) + HYSTERESIS_OCTAVES;
        Some(present.filter(keeps).unwrap_or(best).0)
    }
}

/// Whole percent of a share, 0 to 100. What is not a number is zero.
fn percent(share: f32) -> u8 {
    (100.0 * share).round().clamp(0.0, 100.0) as u8
}

#[cfg(test)]
mod tests;
