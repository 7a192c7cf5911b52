//! Movement of the tip during a trial.

use shagreen_core::people::study::answer::Motion;
use shagreen_device::touch::Touch;

/// Longest time between two frames that counts, in s: after a longer one, the movement meanwhile is not known.
const LONGEST_SECS: f64 = 0.25;

/// Sums over the time in contact.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct MotionMeter {
    contact_secs: f64,
    distance_m: f64,
    impulse_n_s: f64,
}

impl MotionMeter {
    /// Adds a time in s with a touch.
    pub(super) fn add(&mut self, touch: Touch, secs: f64) {
        let (speed_mps, force_n) = (f64::from(touch.contact.speed_mps), f64::from(touch.contact.force_n));
        if force_n > 0.0 && (0.0..=LONGEST_SECS).contains(&secs) {
            self.contact_secs += secs;
            self.distance_m += speed_mps * secs;
            self.impulse_n_s += force_n * secs;
        }
    }

    /// Distance that the tip moved in contact, in m.
    pub(super) fn distance_m(self) -> f64 {
        self.distance_m
    }

    /// Distance, mean speed and mean force in contact; `None` without contact.
    pub(super) fn motion(&self) -> Option<Motion> {
        (self.contact_secs > 0.0).then(|| Motion {
            distance_m: self.distance_m,
            mean_speed_mps: self.distance_m / self.contact_secs,
            mean_force_n: self.impulse_n_s / self.contact_secs,
        })
    }
}

#[cfg(test)]
mod tests {
    use shagreen_device::synth::contact::Contact;
    use shagreen_device::touch::Touch;

    use super::MotionMeter;

    #[test]
    fn only_the_time_in_contact_counts() {
        let touch =
            |speed_mps, force_n| Touch { contact: Contact { speed_mps, force_n }, ..Touch::default() };
        let mut meter = MotionMeter::default();
        meter.add(touch(0.2, 0.0), 0.1);
        assert_eq!(meter.motion(), None);
        for _ in 0..10 {
            meter.add(touch(0.125, 0.5), 0.1);
            meter.add(touch(0.375, 1.5), 0.1);
            meter.add(touch(9.0, 0.0), 0.1);
            // After a long pause of the window, nobody knows what the hand did.
            meter.add(touch(9.0, 9.0), 5.0);
        }
        assert!((meter.distance_m() - 0.5).abs() < 1e-9);
        let motion = meter.motion().unwrap();
        assert!((motion.distance_m - 0.5).abs() < 1e-9);
        assert!((motion.mean_speed_mps - 0.25).abs() < 1e-9);
        assert!((motion.mean_force_n - 1.0).abs() < 1e-9);
    }
}
