//! Noise on a second output: headphones that mask the sound of the actuator during a study.

use std::sync::mpsc::{Receiver, TryRecvError};
use std::time::{Duration, Instant};

use egui::Context;
use shagreen_core::maths::rng::Random;
use shagreen_core::people::study::plan::{MaskingNoise, NoiseColor};
use shagreen_device::engine::{ChannelMask, Handle};
use shagreen_device::error::{DeviceError, DeviceErrorKind};
use shagreen_device::output::{OpenOptions, Running, UNCALIBRATED_FULL_SCALE_MPS2, USUAL_CEILING, open};
use shagreen_device::signal::Signal;
use shagreen_device::synth::drive::{DriveConfig, Driven};

use crate::state::background::in_background;
use crate::strings;

/// Duration of the noise, in s. It starts again after a shorter time, so that it never pauses.
const NOISE_SECS: f64 = 30.0;
const AGAIN: Duration = Duration::from_secs(25);
/// Sample rate of the textures of this output, which plays none, in Hz.
const UNUSED_RATE_HZ: f32 = 1000.0;
/// Factors of the filter that turns white noise into pink noise, and of their inputs: three first-order sections whose sum
/// falls by 3 dB an octave within 0.5 dB from 40 Hz on at the usual sample rates (the economy filter of Paul Kellet).
const PINK: [(f64, f64); 3] = [(0.997_65, 0.099_046_0), (0.963_00, 0.296_516_4), (0.570_00, 1.052_691_3)];
/// Weight of the white noise in the pink one.
const PINK_WHITE: f64 = 0.1848;

/// The second output while it plays the noise. Dropping it closes the output.
pub struct MaskingOutput {
    id: String,
    noise: MaskingNoise,
    opening: Option<Receiver<Result<(Handle, Running), DeviceError>>>,
    output: Option<(Handle, Running)>,
    signal: Option<Signal>,
    played: Option<Instant>,
    problem: Option<String>,
}

impl MaskingOutput {
    /// Opens the output with this id in the background, to play the noise until this is dropped.
    pub fn open(id: String, noise: MaskingNoise, ctx: &Context) -> Self {
        let options = OpenOptions {
            model_rate_hz: UNUSED_RATE_HZ,
            preferred_rate_hz: None,
            buffer_frames: None,
            seed: 1,
            drive: DriveConfig::proportional(UNCALIBRATED_FULL_SCALE_MPS2, USUAL_CEILING),
            channels: ChannelMask::FIRST_TWO,
            friction: None,
            take_over: false,
        };
        let wanted = id.clone();
        let opening = Some(in_background(ctx.clone(), move || open(&wanted, options)));
        Self { id, noise, opening, output: None, signal: None, played: None, problem: None }
    }

    /// Id of the output.
    pub fn id(&self) -> &str {
        &self.id
    }

    /// Whether the noise plays, or the output is still being opened for it.
    pub fn plays(&self) -> bool {
        self.problem.is_none()
    }

    /// Why there is no noise.
    pub fn problem(&self) -> Option<&str> {
        self.problem.as_deref()
    }

    /// Plays the noise again before it ends. Called once a frame.
    pub fn follow(&mut self) {
        if let Some(opening) = &self.opening {
            let opened = match opening.try_recv() {
                Err(TryRecvError::Empty) => return,
                Err(TryRecvError::Disconnected) => {
                    Err(DeviceError::new(DeviceErrorKind::Backend, strings::OPENING_FAILED))
                }
                Ok(opened) => opened,
            };
            self.opening = None;
            match opened {
                Ok((handle, running)) => self.output = Some((handle, running)),
                Err(error) => self.problem = Some(error.to_string()),
            }
        }
        let Some((handle, _)) = &mut self.output else { return };
        handle.collect();
        if let Some(loss) = handle.loss() {
            self.problem = Some(loss.to_string());
        }
        if self.played.is_some_and(|played| played.elapsed() < AGAIN) {
            return;
        }
        let rate_hz = f64::from(handle.config().device_rate_hz);
        let signal = match &self.signal {
            Some(signal) => signal.clone(),
            None => match Signal::new(noise(self.noise, rate_hz), rate_hz, Driven::Drive) {
                Ok(signal) => self.signal.insert(signal).clone(),
                Err(error) => {
                    self.problem = Some(error.to_string());
                    return;
                }
            },
        };
        // If the output is busy, the next frame retries.
        if handle.play_signal(signal).is_ok() {
            self.played = Some(Instant::now());
        }
    }
}

/// Samples of a noise as fractions of the full scale, at a rate in Hz. Its root mean square is the level.
fn noise(noise: MaskingNoise, rate_hz: f64) -> Vec<f32> {
    let mut random = Random::new(1);
    let mut sections = [0.0; 3];
    let n_samples = (NOISE_SECS * rate_hz) as usize;
    let samples: Vec<f64> = (0..n_samples)
        .map(|_| {
            let white = random.normal();
            match noise.color {
                NoiseColor::White => white,
                NoiseColor::Pink => {
                    for (section, (pole, gain)) in sections.iter_mut().zip(PINK) {
                        *section = pole * *section + gain * white;
                    }
                    sections.iter().sum::<f64>() + PINK_WHITE * white
                }
            }
        })
        .collect();
    let power = samples.iter().map(|x| x * x).sum::<f64>() / n_samples.max(1) as f64;
    let factor = 10_f64.powf(noise.level_db / 20.0) / power.sqrt().max(f64::MIN_POSITIVE);
    samples.into_iter().map(|x| (factor * x).clamp(-1.0, 1.0) as f32).collect()
}

#[cfg(test)]
mod tests {
    use shagreen_core::people::study::plan::{MaskingNoise, NoiseColor};

    use super::noise;

    /// Power between two frequencies in Hz, by correlation with tones at 41 frequencies between them.
    fn power(samples: &[f32], rate_hz: f64, low_hz: f64) -> f64 {
        let tone = |i: usize| {
            let frequency_hz = low_hz * (1.0 + i as f64 / 41.0);
            let step = std::f64::consts::TAU * frequency_hz / rate_hz;
            let (mut re, mut im) = (0.0, 0.0);
            for (n, x) in samples.iter().enumerate() {
                re += f64::from(*x) * (step * n as f64).cos();
                im += f64::from(*x) * (step * n as f64).sin();
            }
            re * re + im * im
        };
        (0..41).map(tone).sum()
    }

    /// The density of white noise is equal everywhere, that of pink noise halves with each octave. Each estimate has 82
    /// degrees of freedom, so that its standard deviation is 16 %, and a ratio of two is within a factor of 2 of its
    /// expectation with a probability above 0.998.
    #[test]
    fn noises_have_their_level_and_their_spectrum() {
        for (color, octaves_down) in [(NoiseColor::White, 0.0), (NoiseColor::Pink, 4.0)] {
            let rate_hz = 8000.0;
            let samples = noise(MaskingNoise { color, level_db: -20.0 }, rate_hz);
            let rms =
                (samples.iter().map(|x| f64::from(*x).powi(2)).sum::<f64>() / samples.len() as f64).sqrt();
            // A few samples beyond ten standard deviations would be cut off: none are.
            assert!((rms - 0.1).abs() < 1e-4, "{rms}");
            let part = &samples[..40_000];
            let ratio = power(part, rate_hz, 100.0) / power(part, rate_hz, 1600.0);
            let expected = 2_f64.powf(octaves_down);
            assert!(ratio > expected / 2.0 && ratio < 2.0 * expected, "{color:?}: {ratio}");
        }
    }
}
