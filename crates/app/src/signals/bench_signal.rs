//! A signal of the bench: accelerations along a line, and the stroke that they were recorded or are meant for.

use std::sync::Arc;

use shagreen_core::filter::resample;
use shagreen_core::profile::Profile;
use shagreen_core::relief::{MAX_VALUES, Relief, felt_profile};
use shagreen_core::spatial_spectrogram::Framing;
use shagreen_core::spectrum::rms;
use shagreen_core::texture::TextureModel;
use shagreen_core::units::{Hertz, MetersPerSecond, Newtons};
use shagreen_formats::imported::Imported;

use crate::strings::signals as strings;

/// Longest stroke of the bench, in s.
const LONGEST_SECS: f64 = 30.0;
/// Samples a second of the texture as which a signal is felt: a relief goes up to half of it.
const FELT_RATE: Hertz = Hertz(2000.0);

/// Accelerations along a line.
#[derive(Clone, Debug, PartialEq)]
pub struct BenchSignal {
    /// What it is called.
    pub name: String,
    /// Accelerations in m/s² over places.
    pub profile: Profile,
    /// How fast it was or is to be stroked, which makes its places times.
    pub speed: MetersPerSecond,
    /// The force at which it has its level.
    pub force: Newtons,
    /// Names of the textures it was made of that may not be passed on.
    pub restricted: Vec<String>,
    /// Terms of the textures it was made of; empty where nobody stated any.
    pub terms: Vec<String>,
}

impl BenchSignal {
    /// A recording in m/s² of a stroke. What comes too fast to be felt is left out, and what is longer than a relief can be.
    ///
    /// # Errors
    /// In words: it is too short, or its speed makes no profile of it.
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

    /// Accelerations in m/s² over places.
    ///
    /// # Errors
    /// In words: it makes no relief.
    pub(super) fn new(
        name: &str,
        profile: Profile,
        speed: MetersPerSecond,
        force: Newtons,
    ) -> Result<Self, String> {
        let signal =
            Self { name: name.to_owned(), profile, speed, force, restricted: Vec::new(), terms: Vec::new() };
        // It can be felt, or it is none.
        signal.relief()?;
        Ok(signal)
    }

    /// The same stroke with other accelerations.
    ///
    /// # Errors
    /// As [`BenchSignal::new`].
    pub(super) fn with_values(&self, name: String, values: Vec<f64>) -> Result<Self, String> {
        let profile = Profile::new(self.profile.step_m(), values).map_err(|error| error.to_string())?;
        let signal = Self { name, profile, ..self.clone() };
        signal.relief()?;
        Ok(signal)
    }

    /// How it is cut into windows of a length in m, or of the nearest that there is: four samples at least, and no more than
    /// twice its own length.
    pub(super) fn framing(&self, window_m: f64) -> Framing {
        Framing::of_length(window_m.min(2.0 * self.profile.length_m()), self.profile.step_m())
    }

    /// The length of windows in m.
    pub(super) fn window_m(&self, framing: Framing) -> f64 {
        framing.window() as f64 * self.profile.step_m()
    }

    /// Samples a second at its own speed.
    pub(crate) fn rate(&self) -> Hertz {
        Hertz(self.speed.0 / self.profile.step_m())
    }

    /// How long it takes at its own speed, in s.
    pub(crate) fn seconds(&self) -> f64 {
        self.profile.length_m() / self.speed.0
    }

    /// Its root mean square in m/s².
    pub(super) fn level_mps2(&self) -> f64 {
        rms(self.profile.values())
    }

    /// Its samples in m/s² at a rate, at its own speed.
    pub(crate) fn at(&self, rate: Hertz) -> Vec<f64> {
        resample(self.profile.values(), self.rate(), rate)
    }

    /// What a tip meets.
    ///
    /// # Errors
    /// In words: it is too long, too strong or too coarse.
    pub(crate) fn relief(&self) -> Result<Relief, String> {
        Relief::new(self.profile.clone(), self.force).map_err(|error| error.to_string())
    }

    /// A texture that is silent but for this.
    ///
    /// # Errors
    /// As [`BenchSignal::relief`].
    pub(crate) fn texture(&self) -> Result<TextureModel, String> {
        TextureModel::of_relief(Arc::new(self.relief()?), FELT_RATE).map_err(|error| error.to_string())
    }
}

/// What the bench takes of a profile: as much as a relief can hold, and as much as is worked out soon.
///
/// # Errors
/// In words: too little is left.
pub(super) fn cut(profile: &Profile, speed: MetersPerSecond) -> Result<Imported<Profile>, String> {
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
pub(super) mod tests {
    use super::BenchSignal;
    use shagreen_core::units::{Hertz, MetersPerSecond, Newtons};
    use std::f64::consts::TAU;

    /// So many seconds of a tone of 1 m/s² at a rate, stroked at 100 mm/s.
    pub(in crate::signals) fn tone(frequency_hz: f64, rate_hz: f64, seconds: f64) -> BenchSignal {
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
            // Where no edge is near it is the tone again.
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
        // A slow stroke takes long: so much of it is taken as is worked out soon.
        let slow = BenchSignal::of_samples("slow", &long, Hertz(1000.0), speed, force).unwrap();
        assert!((slow.value.seconds() - 30.0).abs() < 0.01, "{}", slow.value.seconds());
        let model = tone(50.0, 1000.0, 1.0).texture().unwrap();
        assert!(model.relief().is_some());
    }
}
