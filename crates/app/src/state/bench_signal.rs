//! Signal of the Signals workspace: an acceleration profile, and the speed and force of its stroke.

use std::sync::Arc;

use shagreen_core::dsp::filter::resample;
use shagreen_core::dsp::spectrum::rms;
use shagreen_core::signals::spatial_spectrogram::Framing;
use shagreen_core::texture::TextureModel;
use shagreen_core::texture::profile::Profile;
use shagreen_core::texture::relief::{MAX_VALUES, Relief, felt_profile};
use shagreen_core::units::{Hertz, MetersPerSecond, Newtons};
use shagreen_formats::imported::Imported;

use crate::strings::signals as strings;

/// Maximum duration of a signal, in s.
const LONGEST_SECS: f64 = 30.0;
/// Sample rate of the texture that plays a signal by position; its bandwidth is half of this.
const FELT_RATE: Hertz = Hertz(2000.0);

/// Acceleration profile, and the speed and force of its stroke.
#[derive(Clone, Debug, PartialEq)]
pub struct BenchSignal {
    /// Name of the signal.
    pub name: String,
    /// Acceleration in m/s² over position.
    pub profile: Profile,
    /// Tip speed of the stroke, which converts between position and time.
    pub speed: MetersPerSecond,
    /// Normal force at which the signal has its stated level.
    pub force: Newtons,
    /// Names of the source textures that may not be redistributed.
    pub restricted: Vec<String>,
    /// License terms of the source textures; empty if none are stated.
    pub terms: Vec<String>,
}

impl BenchSignal {
    /// Signal of a stroke with constant speed, from samples in m/s². Imperceptible frequencies are removed, and the
    /// signal is truncated to the length of a relief.
    ///
    /// # Errors
    /// States why there is no signal: it is too short, or the speed is invalid.
    pub(crate) fn of_samples(
        name: &str,
        samples_mps2: &[f64],
        rate: Hertz,
        speed: MetersPerSecond,
        force: Newtons,
    ) -> Result<Imported<Self>, String> {
        let profile = felt_profile(samples_mps2, rate, speed).map_err(|error| error.to_string())?;
        let Imported { value: profile, warnings } = cut(&profile, speed)?;
        Ok(Imported { value: Self::new(name, profile, speed, force)?, warnings })
    }

    /// Signal of a profile of accelerations in m/s².
    ///
    /// # Errors
    /// States why the profile cannot be a relief.
    pub(crate) fn new(
        name: &str,
        profile: Profile,
        speed: MetersPerSecond,
        force: Newtons,
    ) -> Result<Self, String> {
        let signal =
            Self { name: name.to_owned(), profile, speed, force, restricted: Vec::new(), terms: Vec::new() };
        // Every signal must be playable as a relief.
        signal.relief()?;
        Ok(signal)
    }

    /// Signal with other accelerations in m/s² and the same step, speed and force.
    ///
    /// # Errors
    /// As [`BenchSignal::new`].
    pub(crate) fn with_values(&self, name: String, values: Vec<f64>) -> Result<Self, String> {
        let profile = Profile::new(self.profile.step_m(), values).map_err(|error| error.to_string())?;
        let signal = Self { name, profile, ..self.clone() };
        signal.relief()?;
        Ok(signal)
    }

    /// Framing of the spatial spectrogram with windows of about `window_m` in m: at least four samples, and at most
    /// twice the length of the signal.
    pub(crate) fn framing(&self, window_m: f64) -> Framing {
        Framing::of_length(window_m.min(2.0 * self.profile.length_m()), self.profile.step_m())
    }

    /// Window length in m.
    pub(crate) fn window_m(&self, framing: Framing) -> f64 {
        framing.window() as f64 * self.profile.step_m()
    }

    /// Sample rate at the signal's own speed.
    pub(crate) fn rate(&self) -> Hertz {
        Hertz(self.speed.0 / self.profile.step_m())
    }

    /// Duration at the signal's own speed, in s.
    pub(crate) fn seconds(&self) -> f64 {
        self.profile.length_m() / self.speed.0
    }

    /// Root mean square acceleration in m/s².
    pub(crate) fn level_mps2(&self) -> f64 {
        rms(self.profile.values())
    }

    /// Samples in m/s² at a sample rate, at the signal's own speed.
    pub(crate) fn at(&self, rate: Hertz) -> Vec<f64> {
        resample(self.profile.values(), self.rate(), rate)
    }

    /// Relief with the profile of the signal.
    ///
    /// # Errors
    /// States that the profile is too long, too strong or too coarse.
    pub(crate) fn relief(&self) -> Result<Relief, String> {
        Relief::new(self.profile.clone(), self.force).map_err(|error| error.to_string())
    }

    /// Texture that contains only this relief.
    ///
    /// # Errors
    /// As [`BenchSignal::relief`].
    pub(crate) fn texture(&self) -> Result<TextureModel, String> {
        TextureModel::of_relief(Arc::new(self.relief()?), FELT_RATE).map_err(|error| error.to_string())
    }
}

/// Truncates a profile to the size of a relief and to [`LONGEST_SECS`], which limits the computation time.
///
/// # Errors
/// States that the remaining profile is too short.
pub(crate) fn cut(profile: &Profile, speed: MetersPerSecond) -> Result<Imported<Profile>, String> {
    let n = profile.values().len();
    let in_time = (LONGEST_SECS * speed.0 / profile.step_m()) as usize;
    let n_kept = n.min(MAX_VALUES).min(in_time.max(2));
    let step_m = profile.step_m();
    let kept = Profile::new(step_m, profile.values()[..n_kept].to_vec());
    let value = kept.map_err(|error| error.to_string())?;
    let warnings = if n_kept < n { vec![strings::cut(value.length_m() / speed.0)] } else { Vec::new() };
    Ok(Imported { value, warnings })
}

#[cfg(test)]
pub(crate) mod tests {
    use super::BenchSignal;
    use shagreen_core::units::{Hertz, MetersPerSecond, Newtons};
    use std::f64::consts::TAU;

    /// Tone of 1 m/s² amplitude at 100 mm/s and 1 N.
    pub(crate) fn tone(frequency_hz: f64, rate_hz: f64, seconds: f64) -> BenchSignal {
        let n = (seconds * rate_hz) as usize;
        let samples: Vec<f64> = (0..n).map(|i| (TAU * frequency_hz * i as f64 / rate_hz).sin()).collect();
        let (speed, force) = (MetersPerSecond(0.1), Newtons(1.0));
        BenchSignal::of_samples("tone", &samples, Hertz(rate_hz), speed, force).unwrap().value
    }

    #[test]
    fn a_recording_becomes_a_line_of_its_length_whatever_its_rate() {
        for rate_hz in [1000.0, 2000.0, 4000.0, 44_100.0, 48_000.0] {
            let signal = tone(100.0, rate_hz, 2.0);
            assert!((signal.profile.length_m() - 0.2).abs() < 2e-4, "{rate_hz}");
            assert!((signal.level_mps2() - 0.5_f64.sqrt()).abs() < 2e-3, "{rate_hz}");
            assert!((signal.seconds() - 2.0).abs() < 2e-3 && signal.rate().0 <= 4000.0);
            let again = signal.at(Hertz(2000.0));
            assert!(again.len().abs_diff(4000) <= 2, "{} at {rate_hz}", again.len());
            // Far from the ends the resampled signal is the same tone.
            let worst = again[200..3800]
                .iter()
                .enumerate()
                .map(|(i, x)| (x - (TAU * 100.0 * (i + 200) as f64 / 2000.0).sin()).abs());
            assert!(worst.fold(0.0, f64::max) < 0.01, "{rate_hz}");
        }
    }

    #[test]
    fn what_is_too_long_is_cut_and_said_and_what_is_none_is_refused() {
        let (speed, force) = (MetersPerSecond(0.1), Newtons(1.0));
        let long = vec![0.1; 100_000];
        let imported = BenchSignal::of_samples("long", &long, Hertz(4000.0), speed, force).unwrap();
        assert_eq!(imported.value.profile.values().len(), 65_536);
        assert!(imported.warnings[0].contains("16.4 s"), "{:?}", imported.warnings);
        assert!(BenchSignal::of_samples("none", &[1.0], Hertz(4000.0), speed, force).is_err());
        assert!(BenchSignal::of_samples("huge", &[1e9; 100], Hertz(4000.0), speed, force).is_err());
        // A slow stroke is truncated to the maximum duration.
        let slow = BenchSignal::of_samples("slow", &long, Hertz(1000.0), speed, force).unwrap();
        assert!((slow.value.seconds() - 30.0).abs() < 0.01, "{}", slow.value.seconds());
        let model = tone(50.0, 1000.0, 1.0).texture().unwrap();
        assert!(model.relief().is_some());
    }
}
