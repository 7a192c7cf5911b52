//! Records the mouse or the pen on the pad.

use std::time::Instant;

use shagreen_device::controls::Takeover;
use shagreen_device::hid::tracker::TrackedSample;
use shagreen_device::track::PenSample;

/// Maximum duration of a recording, in seconds.
pub(crate) const LONGEST_SECS: f64 = 60.0;
/// Gap in seconds above which samples of a touching tip are interpolated. Without them, a delay of the window would
/// count as a lift.
const HOLE_SECS: f64 = 0.03;
/// Maximum time step of interpolated samples, in seconds.
const FILL_SECS: f64 = 0.01;
/// Time in the air before the first touch, in seconds: a stroke that starts in contact would have no landing.
const AIR_SECS: f64 = 0.01;
/// Maximum time in seconds from a pen tap on a button until the window handles it; a longer touch is no click.
const TAP_SECS: f64 = 0.9;
/// Maximum movement of the pen during such a tap, in m.
const TAP_M: f64 = 2e-3;

/// Source of a sample.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Stylus {
    /// Mouse, or a device that the window system treats as one.
    Mouse,
    /// Pen that is read directly from the device.
    Pen,
}

/// Recording in progress; it starts with the first touch.
#[derive(Debug)]
pub(crate) struct Recorder {
    began: Instant,
    samples: Vec<PenSample>,
    /// Source of the last sample.
    stylus: Stylus,
    /// Offset from the clock of the pen to that of the recorder, in seconds.
    pen_ahead_secs: Option<f64>,
    /// Time when a pen was last in range, in seconds.
    pen_near_secs: f64,
    /// Whether the stylus was in the air before its first touch.
    lands: bool,
}

impl Recorder {
    pub(crate) fn new() -> Self {
        Self {
            began: Instant::now(),
            samples: Vec::new(),
            stylus: Stylus::Mouse,
            pen_ahead_secs: None,
            pen_near_secs: f64::NEG_INFINITY,
            lands: false,
        }
    }

    /// Samples so far, from the first touch.
    pub(crate) fn samples(&self) -> &[PenSample] {
        &self.samples
    }

    /// Time since the first touch in seconds, or `None` before it.
    pub(crate) fn secs(&self) -> Option<f64> {
        self.samples.first().map(|first| self.began.elapsed().as_secs_f64() - first.time_secs)
    }

    /// Whether the maximum duration is reached.
    pub(crate) fn is_full(&self) -> bool {
        self.secs().is_some_and(|secs| secs > LONGEST_SECS)
    }

    /// Adds a mouse sample at the present time; its own time is ignored. While a pen is in range the mouse is ignored,
    /// because the system moves it with the pen.
    pub(crate) fn take_mouse(&mut self, sample: PenSample) {
        let time_secs = self.began.elapsed().as_secs_f64();
        if time_secs - self.pen_near_secs > f64::from(Takeover::USUAL.lifted_secs) {
            self.take(Stylus::Mouse, PenSample { time_secs, ..sample });
        }
    }

    /// Adds the pen samples since the last call, whose times are those of the pen's clock.
    pub(crate) fn take_pen(&mut self, moments: &[TrackedSample]) {
        let Some(newest) = moments.last() else { return };
        let now_secs = self.began.elapsed().as_secs_f64();
        // The newest sample is at most one frame old.
        let ahead_secs = *self.pen_ahead_secs.get_or_insert(now_secs - newest.time_secs);
        for moment in moments {
            let time_secs = moment.time_secs + ahead_secs;
            match moment.sample() {
                Some(sample) => {
                    self.pen_near_secs = now_secs;
                    self.take(Stylus::Pen, PenSample { time_secs, ..sample });
                }
                None => self.lift_pen(time_secs),
            }
        }
    }

    /// Lifts a pen that left the range without reporting a lift.
    fn lift_pen(&mut self, time_secs: f64) {
        if let Some(last) = self.samples.last().copied().filter(|last| last.touching) {
            self.take(Stylus::Pen, PenSample { time_secs, touching: false, impact_mps: None, ..last });
        }
    }

    fn take(&mut self, stylus: Stylus, sample: PenSample) {
        let PenSample { time_secs, x_m, y_m, force_n, touching, .. } = sample;
        if ![time_secs, x_m, y_m, force_n].iter().all(|number| number.is_finite()) {
            return;
        }
        let (Some(first), Some(last)) = (self.samples.first(), self.samples.last().copied()) else {
            if touching {
                self.samples.push(sample);
                self.stylus = stylus;
                // A mouse reports only while it is pressed, and it has pressed the button that started the recording.
                self.lands |= stylus == Stylus::Mouse;
            } else {
                self.lands = true;
            }
            return;
        };
        let secs = time_secs - last.time_secs;
        let is_forgotten = secs > f64::from(Takeover::USUAL.stale_secs);
        let is_others_turn = stylus != self.stylus && (!touching || (last.touching && !is_forgotten));
        if secs < 0.0 || is_others_turn || time_secs - first.time_secs > LONGEST_SECS {
            return;
        }
        let is_held = last.touching && touching && stylus == self.stylus;
        if is_held && secs > HOLE_SECS && !is_forgotten {
            let n_steps = (secs / FILL_SECS).ceil();
            let between = |a: f64, b: f64, step: u32| a + f64::from(step) / n_steps * (b - a);
            self.samples.extend((1..n_steps as u32).map(|step| PenSample {
                time_secs: between(last.time_secs, time_secs, step),
                x_m: between(last.x_m, x_m, step),
                y_m: between(last.y_m, y_m, step),
                force_n: between(last.force_n, force_n, step),
                touching,
                impact_mps: None,
            }));
        }
        self.samples.push(sample);
        self.stylus = stylus;
    }

    /// Removes the last touch of a pen if it may have been a tap on a button: pen samples are recorded outside the pad
    /// too.
    pub(crate) fn drop_tap(&mut self) {
        let Some(last) = self.samples.iter().rposition(|sample| sample.touching) else { return };
        let lift = self.samples[..last].iter().rposition(|sample| !sample.touching);
        let from = lift.map_or(0, |lift| lift + 1);
        let PenSample { time_secs, x_m, y_m, .. } = self.samples[from];
        let is_still = |sample: &PenSample| (sample.x_m - x_m).hypot(sample.y_m - y_m) < TAP_M;
        let is_short = self.began.elapsed().as_secs_f64() - time_secs < TAP_SECS;
        if self.stylus == Stylus::Pen && is_short && self.samples[from..=last].iter().all(is_still) {
            self.samples.truncate(from);
        }
    }

    /// Shifts all samples back in time.
    #[cfg(test)]
    pub(crate) fn age(&mut self, secs: f64) {
        for sample in &mut self.samples {
            sample.time_secs -= secs;
        }
    }

    /// Samples from the landing of the first touch to the last lift, with times from zero. `None` if nothing touched.
    pub(crate) fn finish(mut self) -> Option<Vec<PenSample>> {
        let first = *self.samples.first()?;
        let last_touch = self.samples.iter().rposition(|sample| sample.touching)?;
        self.samples.truncate(last_touch + 2);
        let mut start_secs = first.time_secs;
        if self.lands {
            start_secs -= AIR_SECS;
            let in_air = PenSample { force_n: 0.0, touching: false, impact_mps: None, ..first };
            self.samples.insert(0, PenSample { time_secs: start_secs, ..in_air });
        }
        for sample in &mut self.samples {
            sample.time_secs -= start_secs;
        }
        Some(self.samples)
    }
}

#[cfg(test)]
mod tests {
    use super::{AIR_SECS, FILL_SECS, LONGEST_SECS, PenSample, Recorder, Stylus, TrackedSample};
    use shagreen_device::hid::pen::PenReport;
    use shagreen_device::touch::Touch;

    fn sample(time_secs: f64, x_m: f64, touching: bool) -> PenSample {
        PenSample { time_secs, x_m, force_n: 0.5, touching, ..PenSample::default() }
    }

    /// Times since the first touch and contacts of a recording, from its first touch on.
    fn recorded(samples: &[(Stylus, f64, bool)]) -> Vec<(f64, bool)> {
        let mut recorder = Recorder::new();
        for (stylus, time_secs, touching) in samples {
            recorder.take(*stylus, sample(*time_secs, 0.1 * time_secs, *touching));
        }
        let samples = recorder.finish().unwrap_or_default();
        let from = samples.iter().position(|s| s.touching).unwrap_or(0);
        let start_secs = samples.get(from).map_or(0.0, |s| s.time_secs);
        // To nanoseconds, because the shift of the times is subject to rounding.
        let secs = |s: &PenSample| ((s.time_secs - start_secs) * 1e9).round() / 1e9;
        samples[from..].iter().map(|s| (secs(s), s.touching)).collect()
    }

    #[test]
    fn what_is_idle_at_both_ends_is_cut() {
        use Stylus::Mouse;
        let samples = [(0.5, false), (1.0, true), (1.25, true), (1.5, false), (2.0, false), (9.0, false)];
        let kept = recorded(&samples.map(|(time_secs, touching)| (Mouse, time_secs, touching)));
        assert_eq!((kept[0], kept[kept.len() - 1]), ((0.0, true), (0.5, false)));
        assert_eq!(recorded(&[(Mouse, 0.5, false), (Mouse, 0.7, false)]), []);
        assert_eq!(recorded(&[]), []);
    }

    #[test]
    fn a_recording_lands_unless_the_tip_touched_from_its_beginning() {
        let begin = |samples: &[(Stylus, f64, bool)]| {
            let mut recorder = Recorder::new();
            for (stylus, time_secs, touching) in samples {
                recorder.take(*stylus, sample(*time_secs, 0.0, *touching));
            }
            let kept = recorder.finish().unwrap();
            kept[..2].iter().map(|s| ((s.time_secs * 1e9).round() / 1e9, s.touching)).collect::<Vec<_>>()
        };
        let landed = [(0.0, false), (AIR_SECS, true)];
        assert_eq!(begin(&[(Stylus::Mouse, 1.0, true), (Stylus::Mouse, 1.02, true)]), landed);
        assert_eq!(begin(&[(Stylus::Pen, 0.5, false), (Stylus::Pen, 1.0, true)]), landed);
        let pressed = [(Stylus::Pen, 1.0, true), (Stylus::Pen, 1.02, true)];
        assert_eq!(begin(&pressed), [(0.0, true), (0.02, true)]);
    }

    #[test]
    fn a_window_that_was_busy_is_no_lift() {
        use Stylus::Mouse;
        let mut recorder = Recorder::new();
        recorder.take(Mouse, sample(0.0, 0.0, true));
        recorder.take(Mouse, sample(0.2, 0.02, true));
        recorder.take(Mouse, sample(0.3, 0.02, false));
        let kept = recorder.finish().unwrap();
        assert_eq!(kept.len(), 23);
        let held = &kept[1..22];
        assert!(held.windows(2).all(|pair| pair[1].time_secs - pair[0].time_secs <= FILL_SECS + 1e-12));
        let x_m = |s: &PenSample| 0.1 * (s.time_secs - AIR_SECS);
        assert!(held.iter().all(|s| s.touching && (s.x_m - x_m(s)).abs() < 1e-12));
        // A stylus that sends nothing for seconds has left, so the gap is not filled.
        assert_eq!(recorded(&[(Mouse, 0.0, true), (Mouse, 5.0, true)]), [(0.0, true), (5.0, true)]);
    }

    #[test]
    fn who_touches_first_is_followed_until_the_tip_is_lifted() {
        use Stylus::{Mouse, Pen};
        let kept = recorded(&[
            (Pen, 0.00, true),
            (Mouse, 0.01, true),
            (Pen, 0.02, true),
            (Mouse, 0.02, false),
            (Pen, 0.03, false),
            (Mouse, 0.04, true),
            (Pen, 0.05, false),
            (Mouse, 0.06, false),
        ]);
        assert_eq!(
            kept,
            [(0.0, true), (0.02, true), (0.03, false), (0.04, true), (0.06, false)],
            "the mouse, then the pen's hovering, do not matter"
        );
    }

    #[test]
    fn a_tap_of_the_pen_on_a_button_is_no_stroke() {
        use Stylus::{Mouse, Pen};
        let stroke = [(-3.0, 0.0, true), (-2.5, 0.05, true), (-2.0, 0.05, false)];
        for (stylus, tap, n_kept) in [
            (Pen, [(-0.2, 0.09, true), (-0.1, 0.0905, true), (-0.05, 0.0905, false)], 3),
            (Pen, [(-0.2, 0.09, true), (-0.1, 0.0905, true), (-0.05, 0.0905, true)], 3),
            // No taps on a button: a moving pen, an old touch, and a mouse.
            (Pen, [(-0.2, 0.09, true), (-0.1, 0.095, true), (-0.05, 0.095, false)], 6),
            (Pen, [(-1.5, 0.09, true), (-1.49, 0.09, true), (-1.4, 0.09, false)], 6),
            (Mouse, [(-0.2, 0.09, true), (-0.19, 0.09, true), (-0.18, 0.09, false)], 6),
        ] {
            let mut recorder = Recorder::new();
            for (time_secs, x_m, touching) in stroke.into_iter().chain(tap) {
                recorder.take(stylus, sample(time_secs, x_m, touching));
            }
            recorder.drop_tap();
            let mut kept = recorder.finish().unwrap();
            // Ignores interpolated samples.
            let first_secs = kept.iter().find(|sample| sample.touching).unwrap().time_secs;
            let given: Vec<f64> = stroke.iter().chain(&tap).map(|given| given.0 + 3.0 + first_secs).collect();
            kept.retain(|sample| given.iter().any(|secs| (secs - sample.time_secs).abs() < 1e-9));
            assert_eq!(kept.len(), n_kept, "{stylus:?} {tap:?}");
        }
        let mut alone = Recorder::new();
        alone.take(Pen, sample(-0.1, 0.0, true));
        alone.drop_tap();
        assert!(alone.finish().is_none());
        Recorder::new().drop_tap();
    }

    #[test]
    fn it_is_full_a_minute_after_the_first_touch() {
        let mut recorder = Recorder::new();
        assert!(!recorder.is_full() && recorder.secs().is_none());
        recorder.take(Stylus::Mouse, sample(0.0, 0.0, true));
        assert!(!recorder.is_full());
        recorder.age(LONGEST_SECS);
        assert!(recorder.is_full());
    }

    /// The pen has its own clock, and the system moves the mouse with the pen.
    #[test]
    fn a_pen_is_recorded_by_its_own_clock_and_the_mouse_beside_it_is_not() {
        let moment = |time_secs: f64, place_m: Option<[f64; 2]>, tip: bool| TrackedSample {
            time_secs,
            report: PenReport { tip, in_range: place_m.is_some(), ..PenReport::default() },
            place_m,
            force_n: if tip { 0.7 } else { 0.0 },
            touch: Touch::default(),
            landing: None,
            impact_mps: None,
        };
        let mut recorder = Recorder::new();
        recorder.take_pen(&[moment(500.0, Some([0.0, 0.0]), false), moment(500.01, Some([0.0, 0.0]), true)]);
        recorder.take_mouse(sample(0.0, 0.01, true));
        recorder.take_pen(&[moment(500.02, Some([1e-3, 2e-3]), true), moment(500.03, None, false)]);
        let kept = recorder.finish().unwrap();
        let of = |s: &PenSample| (s.x_m, s.y_m, s.force_n, s.touching);
        assert_eq!(
            kept.iter().map(of).collect::<Vec<_>>(),
            [
                (0.0, 0.0, 0.0, false),
                (0.0, 0.0, 0.7, true),
                (1e-3, 2e-3, 0.7, true),
                (1e-3, 2e-3, 0.7, false)
            ],
            "it lands, and out of range it is lifted where it was"
        );
        for (sample, expected) in kept.iter().zip([0.0, 0.01, 0.02, 0.03]) {
            assert!((sample.time_secs - expected).abs() < 1e-9);
        }
    }

    #[test]
    fn time_neither_goes_back_nor_on_for_ever() {
        use Stylus::Mouse;
        let kept =
            recorded(&[(Mouse, 1.0, true), (Mouse, 0.5, true), (Mouse, 1.01, true), (Mouse, f64::NAN, true)]);
        assert_eq!(kept.len(), 2);
        let late = recorded(&[(Mouse, 0.0, true), (Mouse, 0.01, false), (Mouse, LONGEST_SECS + 0.1, true)]);
        assert_eq!(late.len(), 2);
    }
}
