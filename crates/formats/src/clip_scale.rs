//! Scale of the files that describe vibration by numbers from 0 to 1.

use shagreen_core::signals::haptic_envelope::USUAL_BAND_HZ;
use shagreen_core::units::Hertz;

use crate::acf::AcfV1;

/// What an amplitude of 1 and the frequencies 0 and 1 of a file are.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ClipScale {
    /// Acceleration in m/s² of an amplitude of 1, above 0.
    pub full_scale_mps2: f64,
    /// Frequency of 0, and frequency of 1, which is higher.
    pub band: [Hertz; 2],
}

impl ClipScale {
    /// Scale with the band of an actuator, or the usual band if none is known.
    pub fn new(full_scale_mps2: f64, acf: Option<&AcfV1>) -> Self {
        let usual = USUAL_BAND_HZ.map(Hertz);
        let of_actuator =
            |acf: &AcfV1| [acf.continuous.frequency_min, acf.continuous.frequency_max].map(Hertz);
        // A configuration that is written here always has a band.
        let band = acf.map(of_actuator).filter(|[low, high]| low.0 < high.0).unwrap_or(usual);
        Self { full_scale_mps2, band }
    }

    /// Amplitude of an acceleration, 0 to 1, to four decimals.
    pub fn amplitude(&self, mps2: f64) -> f64 {
        short((mps2 / self.full_scale_mps2).clamp(0.0, 1.0))
    }

    /// Frequency of 0 to 1, to four decimals. Frequencies outside the band become those of its ends.
    pub fn frequency(&self, frequency: Hertz) -> f64 {
        let [low, high] = self.band;
        short(((frequency.0 - low.0) / (high.0 - low.0)).clamp(0.0, 1.0))
    }
}

/// Rounds to four decimals.
fn short(value: f64) -> f64 {
    (1e4 * value).round() / 1e4
}

#[cfg(test)]
mod tests {
    use super::ClipScale;
    use crate::acf::acf;
    use crate::actuator_toml::built_in_actuators;
    use shagreen_core::actuator::Drive;
    use shagreen_core::units::Hertz;

    #[test]
    fn amplitudes_and_frequencies_are_shares_of_their_scale() {
        let scale = ClipScale::new(4.0, None);
        for (mps2, expected) in [(0.0, 0.0), (1.0, 0.25), (4.0, 1.0), (9.0, 1.0), (f64::MIN_POSITIVE, 0.0)] {
            assert_eq!(scale.amplitude(mps2), expected);
        }
        for (hz, expected) in [(0.0, 0.0), (60.0, 0.0), (180.0, 0.5), (300.0, 1.0), (900.0, 1.0)] {
            assert_eq!(scale.frequency(Hertz(hz)), expected);
        }
    }

    #[test]
    fn an_actuator_has_its_own_band() {
        let actuator = built_in_actuators().unwrap();
        let actuator = actuator.into_iter().find(|known| known.response().is_ok()).unwrap();
        let acf = acf(&actuator, Drive::ASSUMED, "").unwrap();
        let scale = ClipScale::new(1.0, Some(&acf));
        assert_eq!(scale.frequency(Hertz(acf.continuous.frequency_max)), 1.0);
        assert_eq!(scale.frequency(Hertz(acf.continuous.frequency_min)), 0.0);
        assert_ne!(scale.band, ClipScale::new(1.0, None).band);
    }
}
