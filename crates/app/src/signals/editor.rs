//! The editor of spatial spectrograms: a brush, an eraser, copies, and what was done taken back.

use std::ops::RangeInclusive;
use std::sync::Arc;

use shagreen_core::relief::MAX_VALUES;
use shagreen_core::spatial_spectrogram::edit::{Brush, Patch, Region};
use shagreen_core::spatial_spectrogram::{SpatialSpectrogram, Spectra, Transform, profile_of, refine};

use super::bench_signal::BenchSignal;
use crate::strings::signals as strings;

/// Steps that can be taken back.
const MAX_STEPS: usize = 50;
/// From touch to touch of a brush that is drawn along, in its radius: its rim is soft, so that they melt.
const SPACING: f64 = 0.35;
/// Steps towards the stretched spectrogram: without them waves that go on get softer.
const N_REFINEMENTS: usize = 32;
/// Widths of brushes, in mm either side.
pub(super) const RADII_MM: RangeInclusive<f64> = 0.1..=50.0;
/// Heights of brushes, in octaves either side.
pub(super) const RADII_OCTAVES: RangeInclusive<f64> = 0.1..=4.0;
/// What a touch of a brush does, in dB.
pub(super) const GAINS_DB: RangeInclusive<f64> = 0.5..=24.0;

/// What the pointer does.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Tool {
    /// Makes louder what is under it.
    #[default]
    Louder,
    /// Makes softer what is under it.
    Softer,
    /// Takes out what is in a rectangle.
    Erase,
    /// Remembers what is in a rectangle.
    Copy,
    /// Puts there what was remembered, at a click.
    Paste,
}

impl Tool {
    /// All of them, in the order of their buttons.
    pub const ALL: [Self; 5] = [Self::Louder, Self::Softer, Self::Erase, Self::Copy, Self::Paste];

    /// Whether it is drawn along, as a brush is.
    pub(super) fn is_brush(self) -> bool {
        matches!(self, Self::Louder | Self::Softer)
    }

    /// Whether it works on a rectangle.
    pub(super) fn takes_region(self) -> bool {
        matches!(self, Self::Erase | Self::Copy)
    }
}

/// Spectra and the signal that was made of them.
#[derive(Clone)]
struct Painted {
    signal: Arc<BenchSignal>,
    spectra: Arc<Spectra>,
}

/// A signal before or after a change; with its spectra, where it came of some.
#[derive(Clone)]
struct State {
    signal: Arc<BenchSignal>,
    spectra: Option<Arc<Spectra>>,
    /// What was done to it next.
    tool: &'static str,
}

/// The editor. It is given a signal and returns another; what it was given stays as it was.
pub(super) struct Editor {
    pub(super) tool: Tool,
    pub(super) radius_mm: f64,
    pub(super) radius_octaves: f64,
    pub(super) gain_db: f64,
    /// Factor of the next stretch.
    pub(super) stretch: f64,
    patch: Option<Patch>,
    painted: Option<Painted>,
    undo: Vec<State>,
    redo: Vec<State>,
    /// Where the brush touched last in the stroke that is being drawn.
    last_touch: Option<(f64, f64)>,
}

impl Default for Editor {
    fn default() -> Self {
        Self {
            tool: Tool::default(),
            radius_mm: 5.0,
            radius_octaves: 0.7,
            gain_db: 6.0,
            stretch: 2.0,
            patch: None,
            painted: None,
            undo: Vec::new(),
            redo: Vec::new(),
            last_touch: None,
        }
    }
}

impl Editor {
    /// The spectra of a signal: those that it was made of, where it was.
    ///
    /// # Errors
    /// In words: the windows do not fit.
    pub(super) fn spectra(&self, signal: &Arc<BenchSignal>, window_m: f64) -> Result<Arc<Spectra>, String> {
        let framing = signal.framing(window_m);
        if let Some(painted) = &self.painted
            && Arc::ptr_eq(&painted.signal, signal)
            && painted.spectra.framing() == framing
        {
            return Ok(Arc::clone(&painted.spectra));
        }
        let made = Transform::new(framing).spectra(signal.profile.values());
        made.map(Arc::new).map_err(|error| error.to_string())
    }

    /// The brush is at a place in m and a spatial frequency in 1/m, on the way of a stroke. Returns what it makes of the signal;
    /// `None` where it has not moved far enough to touch again.
    ///
    /// # Errors
    /// In words: the windows do not fit, or what would come of it is no signal.
    pub(super) fn brush_at(
        &mut self,
        signal: &Arc<BenchSignal>,
        window_m: f64,
        (place_m, per_m): (f64, f64),
    ) -> Result<Option<Arc<BenchSignal>>, String> {
        if per_m <= 0.0 {
            return Ok(None);
        }
        let sign = if self.tool == Tool::Softer { -1.0 } else { 1.0 };
        let brush = Brush {
            radius_m: 1e-3 * self.radius_mm,
            radius_octaves: self.radius_octaves,
            gain_db: sign * self.gain_db,
        };
        let touches = self.touches((place_m, per_m), &brush);
        let Some(last) = touches.last() else { return Ok(None) };
        let mut spectra = (*self.spectra(signal, window_m)?).clone();
        let step_m = signal.profile.step_m();
        for (place_m, per_m) in &touches {
            spectra.paint(&brush, step_m, *place_m, *per_m);
        }
        // What is drawn without letting go is one step.
        let painted = self.take(signal, spectra, self.last_touch.is_none(), strings::BRUSH_STROKE)?;
        self.last_touch = Some(*last);
        Ok(Some(painted))
    }

    /// Where a brush touches on its way from its last touch, all of the same distance; at once where it is put down.
    fn touches(&self, to: (f64, f64), brush: &Brush) -> Vec<(f64, f64)> {
        let Some(from) = self.last_touch else { return vec![to] };
        let across = (to.0 - from.0) / brush.radius_m;
        let up = (to.1 / from.1).log2() / brush.radius_octaves;
        let n = (across.hypot(up) / SPACING) as usize;
        let share = |i: usize| (i as f64 * SPACING / across.hypot(up)).min(1.0);
        let at = |s: f64| (from.0 + s * (to.0 - from.0), from.1 * (to.1 / from.1).powf(s));
        (1..=n).map(|i| at(share(i))).collect()
    }

    /// The brush is lifted: what it does next is another step.
    pub(super) fn lift(&mut self) {
        self.last_touch = None;
    }

    /// Takes out what is in a rectangle.
    ///
    /// # Errors
    /// As [`Editor::brush_at`].
    pub(super) fn erase(
        &mut self,
        signal: &Arc<BenchSignal>,
        window_m: f64,
        region: &Region,
    ) -> Result<Arc<BenchSignal>, String> {
        let mut spectra = (*self.spectra(signal, window_m)?).clone();
        spectra.erase(region, signal.profile.step_m());
        self.take(signal, spectra, true, strings::ERASING)
    }

    /// Remembers what is in a rectangle, to be pasted from now on.
    ///
    /// # Errors
    /// In words: there is nothing in it, or the windows do not fit.
    pub(super) fn copy(
        &mut self,
        signal: &Arc<BenchSignal>,
        window_m: f64,
        region: &Region,
    ) -> Result<(), String> {
        let patch = self.spectra(signal, window_m)?.copy(region, signal.profile.step_m());
        self.patch = Some(patch.ok_or(strings::NOTHING_COPIED)?);
        self.tool = Tool::Paste;
        Ok(())
    }

    /// Whether something was copied.
    pub(super) fn has_copy(&self) -> bool {
        self.patch.is_some()
    }

    /// Puts what was copied at a place in m.
    ///
    /// # Errors
    /// In words: nothing was copied, or from other windows.
    pub(super) fn paste(
        &mut self,
        signal: &Arc<BenchSignal>,
        window_m: f64,
        place_m: f64,
    ) -> Result<Arc<BenchSignal>, String> {
        let mut spectra = (*self.spectra(signal, window_m)?).clone();
        let patch = self.patch.as_ref().ok_or(strings::NOTHING_TO_PASTE)?;
        let pasted = spectra.paste(patch, signal.profile.step_m(), place_m);
        pasted.map_err(|error| error.to_string())?;
        self.take(signal, spectra, true, strings::PASTING)
    }

    /// Draws the signal out, or together.
    ///
    /// # Errors
    /// In words: by so much it cannot be, or it would be longer than a signal can be.
    pub(super) fn stretch(
        &mut self,
        signal: &Arc<BenchSignal>,
        window_m: f64,
    ) -> Result<Arc<BenchSignal>, String> {
        let n_stretched = self.stretch * signal.profile.values().len() as f64;
        if n_stretched > MAX_VALUES as f64 {
            return Err(strings::too_long(MAX_VALUES as f64 / signal.profile.values().len() as f64));
        }
        let transform = Transform::new(signal.framing(window_m));
        // The phases of other places tell nothing: what is left is the spectrogram without them.
        let spectrogram = SpatialSpectrogram::of(signal.profile.values(), &transform)
            .map_err(|error| error.to_string())?
            .stretched(self.stretch)
            .map_err(|error| error.to_string())?;
        let begin = profile_of(&spectrogram, &transform);
        let stretched = refine(&spectrogram, &begin, N_REFINEMENTS).map_err(|error| error.to_string())?;
        let spectra = transform.spectra(&stretched).map_err(|error| error.to_string())?;
        self.take(signal, spectra, true, strings::STRETCHING)
    }

    /// Makes a signal of spectra that were changed.
    fn take(
        &mut self,
        before: &Arc<BenchSignal>,
        spectra: Spectra,
        is_step: bool,
        what: &'static str,
    ) -> Result<Arc<BenchSignal>, String> {
        let values = Transform::new(spectra.framing()).profile(&spectra);
        let signal = Arc::new(before.with_values(strings::painted(&before.name), values)?);
        if is_step {
            self.push_step(before, what);
        }
        self.painted = Some(Painted { signal: Arc::clone(&signal), spectra: Arc::new(spectra) });
        Ok(signal)
    }

    /// What is there `before` a step can be had back, and what was taken back cannot be made again.
    fn push_step(&mut self, before: &Arc<BenchSignal>, what: &'static str) {
        self.redo.clear();
        self.undo.push(self.state_of(before, what));
        if self.undo.len() > MAX_STEPS {
            self.undo.remove(0);
        }
    }

    fn state_of(&self, signal: &Arc<BenchSignal>, tool: &'static str) -> State {
        let painted = self.painted.as_ref().filter(|painted| Arc::ptr_eq(&painted.signal, signal));
        let spectra = painted.map(|painted| Arc::clone(&painted.spectra));
        State { signal: Arc::clone(signal), spectra, tool }
    }

    /// What would be taken back, and what would be made again.
    pub(super) fn labels(&self) -> [Option<&'static str>; 2] {
        [&self.undo, &self.redo].map(|steps| steps.last().map(|state| state.tool))
    }

    /// Takes the last change back; returns the signal as it was before.
    pub(super) fn undo(&mut self, now: &Arc<BenchSignal>) -> Option<Arc<BenchSignal>> {
        let state = self.undo.pop()?;
        self.redo.push(self.state_of(now, state.tool));
        Some(self.restore(state))
    }

    /// Makes it again.
    pub(super) fn redo(&mut self, now: &Arc<BenchSignal>) -> Option<Arc<BenchSignal>> {
        let state = self.redo.pop()?;
        self.undo.push(self.state_of(now, state.tool));
        Some(self.restore(state))
    }

    fn restore(&mut self, state: State) -> Arc<BenchSignal> {
        let State { signal, spectra, .. } = state;
        self.painted = spectra.map(|spectra| Painted { signal: Arc::clone(&signal), spectra });
        self.lift();
        signal
    }

    /// Another signal takes the place of this one, which can be had back.
    pub(super) fn replaced(&mut self, before: &Arc<BenchSignal>) {
        self.push_step(before, strings::REPLACING);
        (self.painted, self.last_touch) = (None, None);
    }

    /// Nothing is there any more: what was done is past.
    pub(super) fn forget(&mut self) {
        (self.painted, self.last_touch) = (None, None);
        self.undo.clear();
        self.redo.clear();
    }
}

#[cfg(test)]
mod tests {
    use super::{Editor, Tool};
    use crate::signals::bench_signal::BenchSignal;
    use crate::signals::bench_signal::tests::tone;
    use shagreen_core::spatial_spectrogram::edit::Region;
    use shagreen_core::spectrum::rms;
    use std::sync::Arc;

    const WINDOW_M: f64 = 5e-3;

    /// 100 Hz at 100 mm/s: a wave of 1 mm on 100 mm.
    fn signal() -> Arc<BenchSignal> {
        Arc::new(tone(100.0, 2000.0, 1.0))
    }

    /// The level between two places in mm.
    fn level(signal: &BenchSignal, from_mm: f64, to_mm: f64) -> f64 {
        let at = |mm: f64| (1e-3 * mm / signal.profile.step_m()) as usize;
        rms(&signal.profile.values()[at(from_mm)..at(to_mm)])
    }

    #[test]
    fn a_stroke_of_the_brush_is_heard_where_it_was_and_is_one_step() {
        let (mut editor, first) = (Editor::default(), signal());
        let mut now = Arc::clone(&first);
        for i in 0..20 {
            let at = (0.02 + 0.0005 * f64::from(i), 1000.0);
            if let Some(made) = editor.brush_at(&now, WINDOW_M, at).unwrap() {
                now = made;
            }
        }
        editor.lift();
        assert!(level(&now, 20.0, 30.0) > 1.8 * level(&first, 20.0, 30.0));
        let far = level(&now, 60.0, 90.0) / level(&first, 60.0, 90.0);
        assert!((far - 1.0).abs() < 1e-9, "{far}");
        assert!(now.name.contains("painted") && editor.labels()[0].is_some());
        let back = editor.undo(&now).unwrap();
        assert!(Arc::ptr_eq(&back, &first) && editor.labels()[0].is_none());
        let again = editor.redo(&back).unwrap();
        assert!(Arc::ptr_eq(&again, &now) && editor.redo(&again).is_none());
        // A brush that makes softer takes it away again, nearly.
        editor.tool = Tool::Softer;
        let soft = editor.brush_at(&again, WINDOW_M, (0.025, 1000.0)).unwrap().unwrap();
        assert!(level(&soft, 23.0, 27.0) < level(&again, 23.0, 27.0));
        assert!(editor.labels()[1].is_none(), "what was done anew cannot be made again");
    }

    /// However many reports a stroke has, it does the same.
    #[test]
    fn a_brush_does_not_depend_on_how_often_it_is_told_where_it_is() {
        let drawn = |n: i32| {
            let (mut editor, mut now) = (Editor::default(), signal());
            for i in 0..=n {
                let at = (0.02 + 0.03 * f64::from(i) / f64::from(n), 1000.0);
                if let Some(made) = editor.brush_at(&now, WINDOW_M, at).unwrap() {
                    now = made;
                }
            }
            level(&now, 20.0, 45.0)
        };
        let (coarse, fine) = (drawn(3), drawn(200));
        assert!((coarse / fine - 1.0).abs() < 0.1, "{coarse} and {fine}");
    }

    #[test]
    fn a_rectangle_is_erased_copied_and_pasted() {
        let (mut editor, first) = (Editor::default(), signal());
        let region = Region { places_m: 0.03..0.05, per_m: 500.0..2000.0 };
        let erased = editor.erase(&first, WINDOW_M, &region).unwrap();
        assert!(level(&erased, 37.0, 43.0) < 0.2 * level(&first, 37.0, 43.0));
        assert!(editor.paste(&erased, WINDOW_M, 0.03).is_err(), "nothing was copied");
        let whole = Region { places_m: 0.07..0.095, per_m: 500.0..2000.0 };
        editor.copy(&erased, WINDOW_M, &whole).unwrap();
        assert_eq!(editor.tool, Tool::Paste);
        let pasted = editor.paste(&erased, WINDOW_M, 0.028).unwrap();
        assert!(level(&pasted, 37.0, 43.0) > 0.7 * level(&first, 37.0, 43.0));
        assert!(editor.paste(&pasted, 2e-3, 0.0).is_err(), "other windows");
        let nowhere = Region { places_m: 1.0..2.0, per_m: 1.0..2.0 };
        assert!(editor.copy(&pasted, WINDOW_M, &nowhere).is_err());
    }

    #[test]
    fn what_is_stretched_is_longer_and_keeps_its_waves() {
        let (mut editor, first) = (Editor::default(), signal());
        let long = editor.stretch(&first, WINDOW_M).unwrap();
        assert!((long.profile.length_m() - 0.2).abs() < 1e-3);
        assert!((level(&long, 20.0, 180.0) / level(&first, 20.0, 80.0) - 1.0).abs() < 0.15);
        editor.stretch = 10.0;
        let mut now = long;
        let refused = loop {
            match editor.stretch(&now, WINDOW_M) {
                Ok(longer) => now = longer,
                Err(reason) => break reason,
            }
        };
        assert!(refused.contains("times at most"), "{refused}");
        assert_eq!(editor.labels()[0], Some(crate::strings::signals::STRETCHING));
        editor.forget();
        assert!(editor.undo(&now).is_none());
    }
}
