//! Signals that the output plays in the place of textures.

use shagreen_core::dsp::filter::resample;
use shagreen_core::units::Hertz;
use shagreen_device::signal::{Signal, SignalError};
use shagreen_device::synth::drive::Driven;

use crate::session::player::Player;
use crate::strings;

/// Duration of a test tone, in seconds.
const TONE_SECS: f64 = 2.0;

impl Player {
    pub(in crate::session) fn play_tone(&mut self, frequency_hz: f64, amplitude_mps2: f64) {
        self.play(|rate_hz| Signal::tone(frequency_hz, amplitude_mps2, TONE_SECS, rate_hz));
    }

    pub(in crate::session) fn play_samples(&mut self, samples_mps2: &[f64], rate: Hertz) {
        self.play(|rate_hz| {
            let samples = resample(samples_mps2, rate, Hertz(rate_hz));
            Signal::new(samples.iter().map(|x| *x as f32).collect(), rate_hz, Driven::Acceleration)
        });
    }

    /// Plays the signal that `made` returns for the sample rate of the output in Hz.
    fn play(&mut self, made: impl FnOnce(f64) -> Result<Signal, SignalError>) {
        let Some(handle) = &mut self.handle else { return };
        match made(f64::from(handle.config().device_rate_hz)) {
            Ok(signal) => {
                if handle.play_signal(signal).is_err() {
                    self.message = Some(strings::OUTPUT_BUSY.to_owned());
                }
            }
            Err(error) => self.message = Some(error.to_string()),
        }
    }

    pub(in crate::session) fn stop_tone(&mut self) {
        if let Some(handle) = &mut self.handle {
            handle.stop_signal();
        }
    }
}
