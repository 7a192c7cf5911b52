//! Tip motion over the texture at each time of the engine's clock.

use std::mem::{Discriminant, discriminant};

use shagreen_synth::contact::{Contact, ContactSource, Place};
use shagreen_synth::stream::REQUEST_SECS;

use super::FADE_SECS;
use super::place::FollowedPlace;
use crate::controls::{Input, Takeover};
use crate::impact::strength_of;
use crate::kinematics::held_speed;
use crate::live::TimedTouch;
use crate::touch::{Touch, mix_contacts};
use crate::track::Track;

/// Shortest time between two contact onsets, in seconds. An earlier one is contact bounce.
const CHATTER_SECS: f64 = 0.030;
/// Longest age in seconds at which a live contact onset is still played after a switch to live input.
const PATIENCE_SECS: f64 = 0.030;

/// Contact onset of the tip.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Landing {
    /// Time at which its tap transient starts, on the stream's clock, in seconds.
    pub(super) stream_secs: f64,
    /// Impact speed relative to the reference ([`strength_of`]).
    pub(super) strength: f32,
}

/// The input with its clock, and the fade from the previous input.
#[derive(Debug)]
pub(super) struct Player {
    /// Requested input.
    chosen: Input,
    takeover: Option<Takeover>,
    /// Whether live input has taken over from the requested input.
    has_taken_over: bool,
    /// Seconds since the engine started. A restart of the stream's clock does not affect it.
    clock_secs: f64,
    stream_secs: f64,
    input_start_secs: f64,
    /// Distance along the automatic stroke, in m.
    distance_m: f64,
    /// Position within a repeated stroke, in the stroke's own seconds.
    track_secs: f64,
    live: Touch,
    live_secs: f64,
    /// Tip position on the pad.
    place: FollowedPlace,
    /// Kind of the input in the last tick.
    last_kind: Discriminant<Input>,
    /// Index of the stylus that is followed; below, whether it touches or is near.
    live_stylus_idx: usize,
    live_is_near: bool,
    /// Time when it was last near, on the engine's clock.
    near_secs: f64,
    track: Option<Box<Track>>,
    touch: Touch,
    fade_from: Contact,
    fade_start_secs: f64,
    /// Live contact onset that is not yet played: its report time on the engine's clock, and its strength.
    live_landing: Option<(f64, f32)>,
    track_landing: Option<Landing>,
    /// Whether the tip touches at the current position of the stroke. Resuming there is not a contact onset.
    track_is_down: bool,
    last_landing_secs: f64,
    /// Last contact onset and last time in contact, on the stream's clock.
    contact_secs: Option<(f64, f64)>,
}

impl Player {
    /// A player with a lifted tip.
    pub(super) fn new() -> Self {
        Self {
            chosen: Input::Lifted,
            takeover: None,
            has_taken_over: false,
            clock_secs: 0.0,
            stream_secs: 0.0,
            input_start_secs: 0.0,
            distance_m: 0.0,
            track_secs: 0.0,
            live: Touch::default(),
            live_secs: 0.0,
            place: FollowedPlace::default(),
            last_kind: discriminant(&Input::Lifted),
            live_stylus_idx: 0,
            live_is_near: false,
            near_secs: f64::NEG_INFINITY,
            track: None,
            touch: Touch::default(),
            fade_from: Contact::LIFTED,
            fade_start_secs: f64::NEG_INFINITY,
            live_landing: None,
            track_landing: None,
            track_is_down: false,
            last_landing_secs: f64::NEG_INFINITY,
            contact_secs: None,
        }
    }

    /// Fades to another input. An automatic stroke or a repeated stroke continues from its position if only its
    /// parameters change.
    pub(super) fn set_input(&mut self, input: Input) {
        if input == self.chosen {
            return;
        }
        let goes_on = match (self.chosen, input) {
            (Input::Hand(old), Input::Hand(new)) => old.path == new.path,
            (Input::Repeat(_), Input::Repeat(_)) => true,
            _ => false,
        };
        self.chosen = input;
        self.fade_chosen();
        if !goes_on {
            self.start();
        }
    }

    /// Sets when live input takes over automatically.
    pub(super) fn set_takeover(&mut self, takeover: Option<Takeover>) {
        self.takeover = takeover;
        self.look_for_a_hand();
    }

    /// The input that is followed.
    pub(super) fn input(&self) -> Input {
        if self.has_taken_over { Input::Live } else { self.chosen }
    }

    /// Sets the stroke for [`Input::Track`] and [`Input::Repeat`], played from its start. Returns the previous stroke.
    pub(super) fn play(&mut self, track: Box<Track>) -> Option<Box<Track>> {
        if is_track(self.chosen) {
            self.fade_chosen();
            self.start();
        }
        self.track.replace(track)
    }

    /// Records a touch of one stylus, `age_secs` old. The first stylus that is near is followed until it reports
    /// leaving or stops sending, because the system also moves and presses a mouse when a pen does.
    pub(super) fn report(&mut self, stylus_idx: usize, timed: TimedTouch, age_secs: f64) {
        let TimedTouch { touch, landing_mps, is_near, .. } = timed;
        let stale_secs = f64::from(self.takeover.unwrap_or(Takeover::USUAL).stale_secs);
        let is_anothers_turn = self.live_is_near && self.clock_secs - self.live_secs <= stale_secs;
        if is_anothers_turn && stylus_idx != self.live_stylus_idx {
            return;
        }
        let was_touching = self.live.contact.force_n > 0.0;
        self.live = touch.sanitized();
        self.live_secs = self.clock_secs - age_secs;
        let place_m = place_of(self.live);
        if was_touching {
            self.place.report(place_m, self.live_secs);
        } else {
            self.place.begin(place_m, self.live_secs);
        }
        if is_near || self.live_is_near {
            self.near_secs = self.live_secs;
        }
        (self.live_stylus_idx, self.live_is_near) = (stylus_idx, is_near);
        if self.live.contact.force_n == 0.0 {
            self.live_landing = None;
        } else if !was_touching {
            self.live_landing = Some((self.clock_secs, strength_of(landing_mps)));
        }
        self.look_for_a_hand();
    }

    /// Returns the next contact onset to play, if any. `stream_secs` is the stream's clock at the next frame.
    pub(super) fn take_landing(&mut self, stream_secs: f64) -> Option<Landing> {
        let landing = match self.input() {
            Input::Live => self.live_landing.take().and_then(|(reported_secs, strength)| {
                let is_new = self.clock_secs - reported_secs <= PATIENCE_SECS;
                is_new.then_some(Landing { stream_secs, strength })
            }),
            Input::Track | Input::Repeat(_) => self.track_landing.take(),
            _ => None,
        }?;
        let is_chatter = self.clock_secs - self.last_landing_secs < CHATTER_SECS;
        self.last_landing_secs = self.clock_secs;
        (!is_chatter).then_some(landing)
    }

    /// Restarts the stream's clock at zero.
    pub(super) fn restart_clock(&mut self) {
        (self.stream_secs, self.contact_secs) = (0.0, None);
    }

    /// Last contact onset and last time in contact, on the stream's clock; `None` before the first contact.
    pub(super) fn contact_secs(&self) -> Option<(f64, f64)> {
        self.contact_secs
    }

    /// Notes that the tip is in contact between two times of the stream's clock; they are equal for a tap between two
    /// ticks.
    pub(super) fn note_contact(&mut self, from_secs: f64, to_secs: f64) {
        let was_touching = self.touch.contact.force_n > 0.0;
        let (landed_secs, touched_secs) = self.contact_secs.unwrap_or((from_secs, to_secs));
        let landed_secs = if was_touching { landed_secs.min(from_secs) } else { from_secs };
        self.contact_secs = Some((landed_secs, touched_secs.max(to_secs)));
    }

    /// Touch of the last tick.
    pub(super) fn touch(&self) -> Touch {
        self.touch
    }

    /// Time since the input started, in seconds.
    pub(super) fn input_secs(&self) -> f64 {
        self.clock_secs - self.input_start_secs
    }

    /// Switches to live input if it takes over, and back to the requested input when it has ended.
    fn look_for_a_hand(&mut self) {
        let has_taken_over = self.takeover.is_some_and(|takeover| {
            let secs = if self.live_is_near { takeover.stale_secs } else { takeover.lifted_secs };
            self.clock_secs - self.near_secs <= f64::from(secs)
        });
        if has_taken_over == self.has_taken_over {
            return;
        }
        self.has_taken_over = has_taken_over;
        if self.chosen != Input::Live {
            self.fade();
        }
    }

    /// Starts a fade to the requested input, unless live input has taken over.
    fn fade_chosen(&mut self) {
        if !self.has_taken_over {
            self.fade();
        }
    }

    fn fade(&mut self) {
        self.fade_from = self.touch.contact;
        self.fade_start_secs = self.clock_secs;
    }

    fn start(&mut self) {
        self.input_start_secs = self.clock_secs;
        (self.distance_m, self.track_secs) = (0.0, 0.0);
        self.place.jump();
        // A live touch that has taken over does not belong to the stroke.
        self.track_is_down = !self.has_taken_over && self.touch.contact.force_n > 0.0;
    }

    /// Strength of the landing that began the contact in progress in the track; `None` if that contact has no landing, as
    /// in a stroke that starts in contact. A repetition at another tempo lands faster or slower in proportion.
    fn track_strength(&self) -> Option<f32> {
        let track = self.track.as_ref()?;
        let (track_secs, tempo) = match self.input() {
            Input::Track => (self.input_secs(), 1.0),
            Input::Repeat(repeat) => (self.track_secs, repeat.tempo),
            _ => return None,
        };
        let landing = track.landing_at(track_secs)?;
        Some(strength_of(landing.impact_mps.map(|mps| tempo * mps)))
    }

    /// Returns the touch of the input, `step_secs` after the last call.
    fn asked(&mut self, step_secs: f64) -> Touch {
        match self.input() {
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
            Input::Repeat(repeat) => match &self.track {
                Some(track) => {
                    self.track_secs = repeat.advanced(track, self.track_secs, step_secs);
                    repeat.touch_at(track, self.track_secs)
                }
                None => self.touch.lifted(),
            },
        }
    }
}

/// Position of a touch to the right and upwards, in m.
fn place_of(touch: Touch) -> [f64; 2] {
    [touch.x_m, touch.y_m].map(f64::from)
}

/// Whether an input plays a track.
fn is_track(input: Input) -> bool {
    matches!(input, Input::Track | Input::Repeat(_))
}

impl ContactSource for Player {
    fn contact_at(&mut self, time_secs: f64) -> Contact {
        let step_secs = (time_secs - self.stream_secs).max(0.0);
        self.stream_secs = time_secs;
        self.clock_secs += step_secs;
        if self.has_taken_over && self.chosen != Input::Live {
            self.input_start_secs += step_secs;
        }
        self.look_for_a_hand();
        let mut touch = self.asked(step_secs).sanitized();
        if is_track(self.input()) {
            let is_down = touch.contact.force_n > 0.0;
            if is_down
                && !self.track_is_down
                && let Some(strength) = self.track_strength()
            {
                self.track_landing = Some(Landing { stream_secs: time_secs, strength });
            }
            self.track_is_down = is_down;
        }
        let share = (self.clock_secs - self.fade_start_secs) / FADE_SECS;
        if share < 1.0 {
            touch.contact = mix_contacts(self.fade_from, touch.contact, share.max(0.0) as f32);
        }
        let kind = discriminant(&self.input());
        if kind != self.last_kind {
            self.last_kind = kind;
            if self.input() == Input::Live {
                self.place.begin(place_of(self.live), self.live_secs);
            } else {
                self.place.jump();
            }
        }
        match self.input() {
            Input::Live => {
                self.place.at(self.clock_secs, step_secs, f64::from(touch.contact.speed_mps));
            }
            // A lifting tip keeps its position.
            Input::Lifted => {}
            _ => self.place.set(place_of(touch)),
        }
        if touch.contact.force_n > 0.0 {
            // The level rises from zero within the tick that ends now.
            let was_touching = self.touch.contact.force_n > 0.0;
            let from_secs = if was_touching { time_secs } else { time_secs - step_secs + REQUEST_SECS };
            self.note_contact(from_secs, time_secs);
        }
        self.touch = touch;
        touch.contact
    }

    fn place(&self) -> Place {
        self.place.place()
    }
}

#[cfg(test)]
mod tests;
