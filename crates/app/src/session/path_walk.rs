//! How far a stroke has come along a path.

use std::time::Instant;

use shagreen_core::texture_path::Along;
use shagreen_device::touch::Touch;

/// The place of the stroke on a path, while one is played.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct PathWalk {
    is_playing: bool,
    /// In m or s, as the path counts.
    traveled: f64,
    was_touching: bool,
    last: Option<Instant>,
}

impl PathWalk {
    /// From the beginning, or not at all.
    pub(super) fn set_playing(&mut self, is_playing: bool) {
        *self = Self { is_playing, ..Self::default() };
    }

    pub(super) fn is_playing(&self) -> bool {
        self.is_playing
    }

    /// How far the stroke has come, in m or s.
    pub(super) fn traveled(&self) -> f64 {
        self.traveled
    }

    /// Goes on to where the stroke is at `now`; each touch begins anew.
    pub(super) fn advance(&mut self, touch: Touch, along: Along, now: Instant) {
        let secs = self.last.map_or(0.0, |last| now.duration_since(last).as_secs_f64());
        self.last = Some(now);
        let is_touching = touch.contact.force_n > 0.0;
        if is_touching && !self.was_touching {
            self.traveled = 0.0;
        } else if is_touching {
            self.traveled += match along {
                Along::Distance => f64::from(touch.contact.speed_mps) * secs,
                Along::Time => secs,
            };
        }
        self.was_touching = is_touching;
    }
}

#[cfg(test)]
mod tests {
    use super::PathWalk;
    use shagreen_core::texture_path::Along;
    use shagreen_device::synth::contact::Contact;
    use shagreen_device::touch::Touch;
    use std::time::{Duration, Instant};

    #[test]
    fn a_stroke_counts_its_way_or_its_time_and_each_touch_begins_anew() {
        let touch = Touch { contact: Contact { speed_mps: 0.2, force_n: 1.0 }, ..Touch::default() };
        let start = Instant::now();
        for (along, traveled) in [(Along::Distance, 0.1), (Along::Time, 0.5)] {
            let mut walk = PathWalk::default();
            walk.set_playing(true);
            let tick = |i: u64| start + Duration::from_millis(20 * i);
            (0..=25).for_each(|i| walk.advance(touch, along, tick(i)));
            // A speed in f32.
            assert!((walk.traveled() - traveled).abs() < 1e-7, "{}", walk.traveled());
            (26..40).for_each(|i| walk.advance(touch.lifted(), along, tick(i)));
            assert!((walk.traveled() - traveled).abs() < 1e-7, "a lifted tip stays");
            walk.advance(touch, along, tick(40));
            assert!(walk.traveled() == 0.0 && walk.is_playing());
        }
    }
}
