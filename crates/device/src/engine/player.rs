//! What moves over the texture, at any moment of the engine's clock.

use shagreen_synth::contact::{Contact, ContactSource};

use super::FADE_SECS;
use crate::controls::Input;
use crate::kinematics::held_speed;
use crate::touch::{Touch, mix_contacts};
use crate::track::Track;

/// Speed of the landings that taps were measured at, in m/s. Recordings do not say it; this is a light tap by hand.
const USUAL_LANDING_MPS: f32 = 0.1;
/// How much weaker or stronger than measured a landing may be: estimates of its speed are rough.
const STRENGTHS: (f32, f32) = (0.1, 3.0);
/// Two landings are at least this far apart, in seconds: what comes sooner is a switch that chatters.
const CHATTER_SECS: f64 = 0.030;
/// A live landing is still played where the input is switched to the person's this much later, in seconds.
const PATIENCE_SECS: f64 = 0.030;

/// The tip has landed.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Landing {
    /// When it is to be heard, on the stream's clock.
    pub(super) stream_secs: f64,
    /// How hard, over the landing that the tap was measured at.
    pub(super) strength: f32,
}

/// The input, its clock, and the fade from the input before.
#[derive(Debug)]
pub(super) struct Player {
    input: Input,
    /// Seconds since the engine began; it goes on where the stream's clock starts again.
    clock_secs: f64,
    stream_secs: f64,
    input_start_secs: f64,
    /// How far the automatic hand has come, in m.
    distance_m: f64,
    live: Touch,
    live_secs: f64,
    track: Option<Box<Track>>,
    touch: Touch,
    fade_from: Contact,
    fade_start_secs: f64,
    /// A landing of the person that has not been played: when it was reported on the engine's clock, and how hard.
    live_landing: Option<(f64, f32)>,
    track_landing: Option<Landing>,
    last_landing_secs: f64,
}

impl Player {
    /// Nothing on the pad.
    pub(super) fn new() -> Self {
        Self {
            input: Input::Lifted,
            clock_secs: 0.0,
            stream_secs: 0.0,
            input_start_secs: 0.0,
            distance_m: 0.0,
            live: Touch::default(),
            live_secs: 0.0,
            track: None,
            touch: Touch::default(),
            fade_from: Contact::LIFTED,
            fade_start_secs: f64::NEG_INFINITY,
            live_landing: None,
            track_landing: None,
            last_landing_secs: f64::NEG_INFINITY,
        }
    }

    /// Fades to another input. The automatic hand goes on from where it is when only its numbers change.
    pub(super) fn set_input(&mut self, input: Input) {
        if input == self.input {
            return;
        }
        let goes_on = match (self.input, input) {
            (Input::Hand(old), Input::Hand(new)) => old.path == new.path,
            _ => false,
        };
        self.input = input;
        self.fade();
        if !goes_on {
            self.start();
        }
    }

    /// Takes a stroke, to be played from its start while the input is [`Input::Track`]; gives back the one before.
    pub(super) fn play(&mut self, track: Box<Track>) -> Option<Box<Track>> {
        if self.input == Input::Track {
            self.fade();
            self.start();
        }
        self.track.replace(track)
    }

    /// Takes what the person did `age_secs` ago, and how fast the tip landed if it did.
    pub(super) fn report(&mut self, touch: Touch, landing_mps: Option<f32>, age_secs: f64) {
        let was_touching = self.live.contact.force_n > 0.0;
        self.live = touch.sanitized();
        self.live_secs = self.clock_secs - age_secs;
        if self.live.contact.force_n == 0.0 {
            self.live_landing = None;
        } else if !was_touching {
            let relative = landing_mps.map_or(1.0, |mps| mps / USUAL_LANDING_MPS);
            let strength = if relative.is_nan() { 1.0 } else { relative.clamp(STRENGTHS.0, STRENGTHS.1) };
            self.live_landing = Some((self.clock_secs, strength));
        }
    }

    /// The landing that is to be played next, if there is one; `stream_secs` is the stream's clock at the next frame.
    pub(super) fn take_landing(&mut self, stream_secs: f64) -> Option<Landing> {
        let landing = match self.input {
            Input::Live => self.live_landing.take().and_then(|(reported_secs, strength)| {
                let is_new = self.clock_secs - reported_secs <= PATIENCE_SECS;
                is_new.then_some(Landing { stream_secs, strength })
            }),
            Input::Track => self.track_landing.take(),
            _ => None,
        }?;
        let is_chatter = self.clock_secs - self.last_landing_secs < CHATTER_SECS;
        self.last_landing_secs = self.clock_secs;
        (!is_chatter).then_some(landing)
    }

    /// The stream's clock starts at zero again.
    pub(super) fn restart_clock(&mut self) {
        self.stream_secs = 0.0;
    }

    /// The touch of the last tick.
    pub(super) fn touch(&self) -> Touch {
        self.touch
    }

    /// Since the input began, in seconds.
    pub(super) fn input_secs(&self) -> f64 {
        self.clock_secs - self.input_start_secs
    }

    fn fade(&mut self) {
        self.fade_from = self.touch.contact;
        self.fade_start_secs = self.clock_secs;
    }

    fn start(&mut self) {
        self.input_start_secs = self.clock_secs;
        self.distance_m = 0.0;
    }

    /// What the input says, `step_secs` after it was asked last.
    fn asked(&mut self, step_secs: f64) -> Touch {
        match self.input {
            Input::Lifted => self.touch.lifted(),
            Input::Live => {
                let mut touch = self.live;
                let speed = held_speed(f64::from(touch.contact.speed_mps), self.clock_secs - self.live_secs);
                touch.contact.speed_mps = speed as f32;
                touch
            }
            Input::Hand(hand) => {
                let step_m = f64::from(hand.speed_mps) * step_secs;
                if step_m.is_finite() {
                    self.distance_m += step_m;
                }
                hand.touch_at_distance(self.distance_m)
            }
            Input::Track => {
                let secs = self.input_secs();
                self.track.as_ref().map_or_else(|| self.touch.lifted(), |track| track.touch_at(secs))
            }
        }
    }
}

impl ContactSource for Player {
    fn contact_at(&mut self, time_secs: f64) -> Contact {
        let step_secs = (time_secs - self.stream_secs).max(0.0);
        self.stream_secs = time_secs;
        self.clock_secs += step_secs;
        let mut touch = self.asked(step_secs).sanitized();
        if self.input == Input::Track && self.touch.contact.force_n == 0.0 && touch.contact.force_n > 0.0 {
            self.track_landing = Some(Landing { stream_secs: time_secs, strength: 1.0 });
        }
        let share = (self.clock_secs - self.fade_start_secs) / FADE_SECS;
        if share < 1.0 {
            touch.contact = mix_contacts(self.fade_from, touch.contact, share.max(0.0) as f32);
        }
        self.touch = touch;
        touch.contact
    }
}

#[cfg(test)]
mod tests {
    use super::{Contact, ContactSource as _, FADE_SECS, Input, Player};
    use crate::hand::{Hand, Path};
    use crate::touch::Touch;
    use crate::track::{PenSample, Track};

    const TICK: f64 = 0.005;
    const HAND: Hand = Hand { path: Path::Circle, speed_mps: 0.1, force_n: 1.0, extent_m: 0.06 };

    /// Ticks a player on; each touch with the time of its tick.
    fn run(player: &mut Player, n_ticks: usize) -> Vec<(f64, Touch)> {
        let one = |_| {
            let next = player.stream_secs + TICK;
            player.contact_at(next);
            (player.clock_secs, player.touch())
        };
        (0..n_ticks).map(one).collect()
    }

    fn distance(a: Touch, b: Touch) -> f32 {
        (a.x_m - b.x_m).hypot(a.y_m - b.y_m)
    }

    #[test]
    fn the_hand_starts_when_it_is_chosen() {
        let mut player = Player::new();
        run(&mut player, 13);
        player.set_input(Input::Hand(HAND));
        for (i, (_, touch)) in run(&mut player, 50).into_iter().enumerate() {
            let expected = HAND.touch_at((i + 1) as f64 * TICK);
            assert!(distance(touch, expected) < 1e-6);
            if (i + 1) as f64 * TICK >= FADE_SECS {
                assert!((touch.contact.speed_mps - 0.1).abs() < 1e-7 && touch.contact.force_n == 1.0);
            }
        }
        assert!((player.input_secs() - 50.0 * TICK).abs() < 1e-12);
    }

    #[test]
    fn a_hand_that_changes_its_numbers_goes_on_from_where_it_is() {
        for path in [Path::Line, Path::Circle, Path::Scribble] {
            let mut player = Player::new();
            let mut last = Touch::default();
            for (i, speed_mps) in [0.1, 0.3, 0.02, 0.25].into_iter().enumerate() {
                player.set_input(Input::Hand(Hand { path, speed_mps, force_n: 0.5 + i as f32, ..HAND }));
                for (_, touch) in run(&mut player, 37) {
                    if player.clock_secs > 0.0 && i > 0 {
                        // The way in a tick, and 3 %: the scribble's spread of 2 %, and `f32` positions of micrometers.
                        assert!(
                            distance(last, touch) <= 1.03 * speed_mps * TICK as f32,
                            "{path:?} at {speed_mps}"
                        );
                    }
                    last = touch;
                }
            }
            assert!((player.input_secs() - 4.0 * 37.0 * TICK).abs() < 1e-9, "one stroke");
        }
    }

    #[test]
    fn every_change_of_input_is_a_ramp() {
        let mut player = Player::new();
        let samples = [0.0, 0.02, 0.04].map(|time_secs| PenSample {
            time_secs,
            force_n: 2.0,
            touching: true,
            x_m: time_secs,
            ..PenSample::default()
        });
        player.play(Box::new(Track::new(&samples).unwrap()));
        player.report(
            Touch { contact: Contact { speed_mps: 0.4, force_n: 2.0 }, ..Touch::default() },
            None,
            0.0,
        );
        let mut last = 0.0;
        for input in
            [Input::Hand(HAND), Input::Lifted, Input::Live, Input::Hand(HAND), Input::Track, Input::Lifted]
        {
            player.set_input(input);
            let touches = run(&mut player, 4);
            for (_, touch) in touches {
                // 2 N in four ticks.
                assert!((touch.contact.force_n - last).abs() <= 0.5 + 1e-6, "{input:?}");
                last = touch.contact.force_n;
            }
        }
        assert_eq!(last, 0.0);
    }

    #[test]
    fn a_live_hand_that_stops_reporting_falls_silent() {
        let mut player = Player::new();
        player.set_input(Input::Live);
        run(&mut player, 10);
        let live = Touch { x_m: 0.01, y_m: 0.02, contact: Contact { speed_mps: 0.2, force_n: 1.0 } };
        // Five milliseconds on its way.
        player.report(live, None, 0.005);
        let touches = run(&mut player, 100);
        assert_eq!(touches[2].1, live, "held at an age of 20 ms");
        assert!(touches[3].1.contact.speed_mps < 0.2);
        assert!(touches[99].1.contact.speed_mps < 1e-9);
        assert_eq!((touches[99].1.x_m, touches[99].1.contact.force_n), (0.01, 1.0));
        // Nonsense is a lifted tip.
        player.report(
            Touch { contact: Contact { speed_mps: f32::NAN, force_n: f32::INFINITY }, ..live },
            None,
            0.0,
        );
        assert_eq!(run(&mut player, 1)[0].1.contact, Contact::LIFTED);
    }

    #[test]
    fn a_track_starts_at_its_beginning_and_ends_lifted() {
        let samples: Vec<_> = (0..30)
            .map(|i| PenSample {
                time_secs: 7.0 + 0.01 * f64::from(i),
                x_m: 1e-3 * f64::from(i),
                force_n: 0.5,
                touching: true,
                ..PenSample::default()
            })
            .collect();
        let track = Track::new(&samples).unwrap();
        let mut player = Player::new();
        player.set_input(Input::Track);
        assert!(run(&mut player, 20).iter().all(|(_, touch)| touch.contact == Contact::LIFTED));
        assert!(player.play(Box::new(track.clone())).is_none());
        for (i, (_, touch)) in run(&mut player, 80).into_iter().enumerate() {
            let secs = (i + 1) as f64 * TICK;
            assert!(distance(touch, track.touch_at(secs)) < 1e-6);
            // At its very end rounding decides whether it is lifted.
            if secs >= FADE_SECS && (secs - track.duration_secs()).abs() > 1e-9 {
                assert!((touch.contact.speed_mps - track.touch_at(secs).contact.speed_mps).abs() < 1e-6);
            }
        }
        // A new track, or the choice of the input again, starts anew.
        assert_eq!(player.play(Box::new(track.clone())), Some(Box::new(track)));
        run(&mut player, 3);
        assert!((player.input_secs() - 3.0 * TICK).abs() < 1e-12);
    }

    #[test]
    fn the_stream_may_start_its_clock_again() {
        let mut player = Player::new();
        player.set_input(Input::Hand(HAND));
        let before = run(&mut player, 20)[19].1;
        player.restart_clock();
        let after = run(&mut player, 1)[0].1;
        assert!(distance(before, after) <= 0.1 * TICK as f32 * 1.01);
        assert!((player.input_secs() - 21.0 * TICK).abs() < 1e-12);
    }
}
