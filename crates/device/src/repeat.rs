//! Endless repetition of a recorded stroke, optionally with changed tempo and force.
//!
//! The stroke is parameterized by its own time: at tempo 2, the tip takes half the time at twice the speed. A stroke
//! whose tempo changes during repetition therefore continues from its position.

use crate::touch::Touch;
use crate::track::Track;

/// Time with a lifted tip between the end of a stroke and its next start, in seconds. The way back is not part of the
/// stroke, and the pause keeps the next contact onset from being ignored as contact bounce.
pub const LIFT_SECS: f64 = 0.1;

/// Parameters of the repetition.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Repeat {
    /// Speed relative to the recording, above zero.
    pub tempo: f32,
    /// Force relative to the recording, at least zero.
    pub force: f32,
}

impl Repeat {
    /// The stroke as it was recorded.
    pub const AS_RECORDED: Self = Self { tempo: 1.0, force: 1.0 };

    /// Returns the track time `step_secs` after `track_secs`. Track time runs from zero over the duration of the track
    /// and of the lift after it, and then restarts at zero. At a slower tempo, the lift takes less track time; if it is
    /// then already over, the stroke starts again. An invalid tempo stops the tip.
    pub(crate) fn advanced(self, track: &Track, track_secs: f64, step_secs: f64) -> f64 {
        let tempo = f64::from(self.tempo);
        if !(tempo.is_finite() && tempo > 0.0) {
            return track_secs;
        }
        // The lift has the same duration at every tempo.
        let cycle_secs = track.duration_secs() + tempo * LIFT_SECS;
        if track_secs > cycle_secs {
            return 0.0;
        }
        (track_secs + tempo * step_secs).rem_euclid(cycle_secs)
    }

    /// Returns the touch at this track time. Cost: that of [`Track::touch_at`].
    pub(crate) fn touch_at(self, track: &Track, track_secs: f64) -> Touch {
        let mut touch = track.touch_at(track_secs);
        touch.contact.speed_mps *= self.tempo;
        touch.contact.force_n *= self.force;
        touch
    }
}

#[cfg(test)]
mod tests {
    use super::{LIFT_SECS, Repeat};
    use crate::controls::Input;
    use crate::engine::{self, ChannelMask, EngineConfig};
    use crate::track::{PenSample, Track};
    use shagreen_synth::contact::Contact;
    use shagreen_synth::drive::DriveConfig;

    /// A stroke of 1 s to the right at 0.1 m/s with 0.5 N.
    fn straight() -> Track {
        let sample = |i| PenSample {
            time_secs: 0.01 * f64::from(i),
            x_m: 1e-3 * f64::from(i),
            force_n: 0.5,
            touching: true,
            ..PenSample::default()
        };
        Track::new(&(0..=100).map(sample).collect::<Vec<_>>()).unwrap()
    }

    #[test]
    fn it_begins_again_after_the_lift_at_every_tempo() {
        let track = straight();
        for tempo in [0.25_f32, 0.5, 1.0, 3.0] {
            let repeat = Repeat { tempo, ..Repeat::AS_RECORDED };
            let cycle_secs = 1.0 / f64::from(tempo) + LIFT_SECS;
            let mut track_secs = 0.0;
            for tick in 1..5000 {
                track_secs = repeat.advanced(&track, track_secs, 1e-3);
                let expected = (1e-3 * f64::from(tick)).rem_euclid(cycle_secs) * f64::from(tempo);
                let off = (track_secs - expected).abs();
                // Rounding errors accumulate, and at the wraparound they decide on which side the time lies.
                assert!(off < 1e-9 || off > cycle_secs * f64::from(tempo) - 1e-9, "{tempo}: {track_secs}");
                let touch = repeat.touch_at(&track, track_secs);
                assert_eq!(touch.contact.force_n == 0.0, track_secs > track.duration_secs(), "{track_secs}");
            }
        }
    }

    /// Whatever the tempo becomes during the lift, the next contact onset is at the start of the stroke.
    #[test]
    fn another_tempo_during_the_lift_begins_no_stroke_in_its_middle() {
        let (track, step_secs) = (straight(), 1e-3);
        let tempos = [0.25_f32, 0.5, 1.0, 2.0, 4.0];
        for before in tempos {
            for share in [0.05, 0.5, 0.95] {
                let lifted_secs = track.duration_secs() + f64::from(before) * share * LIFT_SECS;
                for after in tempos {
                    let repeat = Repeat { tempo: after, ..Repeat::AS_RECORDED };
                    let next_secs = repeat.advanced(&track, lifted_secs, step_secs);
                    let begins = next_secs < f64::from(after) * step_secs + 1e-9;
                    assert!(begins || next_secs > track.duration_secs(), "{before} to {after}: {next_secs}");
                }
            }
        }
    }

    #[test]
    fn tempo_and_force_are_factors() {
        let (track, repeat) = (straight(), Repeat { tempo: 2.0, force: 0.5 });
        let (as_it_was, changed) = (track.touch_at(0.5), repeat.touch_at(&track, 0.5));
        assert_eq!((changed.x_m, changed.y_m), (as_it_was.x_m, as_it_was.y_m));
        assert_eq!(changed.contact.speed_mps, 2.0 * as_it_was.contact.speed_mps);
        assert_eq!(changed.contact.force_n, 0.5 * as_it_was.contact.force_n);
    }

    #[test]
    fn the_engine_strokes_lifts_strokes_again_and_stops() {
        let config = EngineConfig {
            model_rate_hz: 1000.0,
            device_rate_hz: 48_000.0,
            seed: 1,
            drive: DriveConfig::proportional(20.0, 0.9),
            channels: ChannelMask::FIRST_TWO,
            friction: None,
        };
        let (mut handle, mut engine) = engine::new(config).unwrap();
        handle.repeat_track(straight(), Repeat::AS_RECORDED).unwrap();
        // Each block is 5 ms long.
        let mut out = [0.0; 480];
        let mut contacts = Vec::new();
        for _ in 0..400 {
            engine.process(&mut out, 2);
            contacts.push(handle.status().touch.contact);
        }
        let at = |secs: f64| contacts[(200.0 * secs) as usize];
        for secs in [0.5, 0.9, 1.1 + 0.5, 1.1 + 0.85] {
            let Contact { speed_mps, force_n } = at(secs);
            assert!((speed_mps - 0.1).abs() < 1e-4 && force_n == 0.5, "{secs}: {speed_mps} {force_n}");
        }
        assert_eq!(at(1.05), Contact::LIFTED);
        handle.set_input(Input::Lifted);
        // The fade takes four blocks, and the status lags by one.
        for _ in 0..5 {
            engine.process(&mut out, 2);
        }
        assert_eq!(handle.status().touch.contact, Contact::LIFTED);
    }

    #[test]
    fn a_nonsense_tempo_stands_still() {
        let track = straight();
        for tempo in [0.0, -1.0, f32::NAN, f32::INFINITY] {
            assert_eq!(Repeat { tempo, ..Repeat::AS_RECORDED }.advanced(&track, 0.3, 0.01), 0.3);
        }
    }
}
