//! Editor of spatial spectrograms: brush, eraser, copy and paste, with undo.

use std::ops::RangeInclusive;
use std::sync::Arc;

use shagreen_core::signals::spatial_spectrogram::edit::{Brush, Patch, Region};
use shagreen_core::signals::spatial_spectrogram::{
    SpatialSpectrogram, Spectra, Transform, profile_of, refine,
};
use shagreen_core::texture::relief::MAX_VALUES;

use crate::choices::signals::Tool;
use crate::state::bench_signal::BenchSignal;
use crate::strings::signals as strings;

/// Maximum number of undo steps.
const MAX_STEPS: usize = 50;
/// Distance between touches of a brush along a stroke, in brush radii. The edge of the brush is soft, so that touches
/// merge.
const SPACING: f64 = 0.35;
/// Griffin-Lim iterations towards the stretched spectrogram: without them, continuous waves lose level.
const N_REFINEMENTS: usize = 32;
/// Range of the half-width of a brush, in mm.
pub(super) const RADII_MM: RangeInclusive<f64> = 0.1..=50.0;
/// Range of the half-height of a brush, in octaves.
pub(super) const RADII_OCTAVES: RangeInclusive<f64> = 0.1..=4.0;
/// Range of the gain of one brush touch, in dB.
pub(super) const GAINS_DB: RangeInclusive<f64> = 0.5..=24.0;

impl Tool {
    /// All tools, in the order of their buttons.
    pub const ALL: [Self; 5] = [Self::Louder, Self::Softer, Self::Erase, Self::Copy, Self::Paste];

    /// Whether the tool is a brush, which is drawn along a stroke.
    pub(super) fn is_brush(self) -> bool {
        matches!(self, Self::Louder | Self::Softer)
    }

    /// Whether the tool works on a rectangle.
    pub(super) fn takes_region(self) -> bool {
        matches!(self, Self::Erase | Self::Copy)
    }
}

/// Spectra, and the signal that was synthesized from them.
#[derive(Clone)]
struct Painted {
    signal: Arc<BenchSignal>,
    spectra: Arc<Spectra>,
}

/// Signal before or after a change, with its spectra if it was synthesized from any.
#[derive(Clone)]
struct State {
    signal: Arc<BenchSignal>,
    spectra: Option<Arc<Spectra>>,
    /// Name of the change that was made to it next.
    tool: &'static str,
}

/// Editor. It takes a signal and returns a new one; the original is not changed.
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
    /// Last touch of the brush in the current stroke: position in m, spatial frequency in 1/m.
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
    /// Returns the spectra of a signal: those that it was synthesized from, if any.
    ///
    /// # Errors
    /// A sentence: the windows do not fit the signal.
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

    /// Moves the brush to a position in m and a spatial frequency in 1/m, as part of a stroke. Returns the changed
    /// signal; `None` if the brush has not moved far enough for another touch.
    ///
    /// # Errors
    /// A sentence: the windows do not fit the signal, or the result is not a valid signal.
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
        // A stroke is one undo step, until the brush is lifted.
        let what = if self.tool == Tool::Softer { strings::ATTENUATING } else { strings::AMPLIFYING };
        let painted = self.take(signal, spectra, self.last_touch.is_none(), what)?;
        self.last_touch = Some(*last);
        Ok(Some(painted))
    }

    /// Touches of a brush on its way from the last touch, at equal distances. The first touch of a stroke is at `to`.
    fn touches(&self, to: (f64, f64), brush: &Brush) -> Vec<(f64, f64)> {
        let Some(from) = self.last_touch else { return vec![to] };
        let across = (to.0 - from.0) / brush.radius_m;
        let up = (to.1 / from.1).log2() / brush.radius_octaves;
        let n = (across.hypot(up) / SPACING) as usize;
        let share = |i: usize| (i as f64 * SPACING / across.hypot(up)).min(1.0);
        let at = |s: f64| (from.0 + s * (to.0 - from.0), from.1 * (to.1 / from.1).powf(s));
        (1..=n).map(|i| at(share(i))).collect()
    }

    /// Lifts the brush: the next stroke is another undo step.
    pub(super) fn lift(&mut self) {
        self.last_touch = None;
    }

    /// Erases the content of a rectangle.
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

    /// Copies the content of a rectangle, and selects the paste tool.
    ///
    /// # Errors
    /// A sentence: the rectangle is empty, or the windows do not fit the signal.
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

    /// Pastes the copied content at a position in m.
    ///
    /// # Errors
    /// A sentence: nothing was copied, or it was copied from other windows.
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

    /// Stretches or compresses the signal by the stretch factor.
    ///
    /// # Errors
    /// A sentence: the factor cannot be applied, or the result would be longer than a signal can be.
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
        // Phases do not carry over to other positions, so only the magnitudes are stretched.
        let spectrogram = SpatialSpectrogram::of(signal.profile.values(), &transform)
            .map_err(|error| error.to_string())?
            .stretched(self.stretch)
            .map_err(|error| error.to_string())?;
        let begin = profile_of(&spectrogram, &transform);
        let stretched = refine(&spectrogram, &begin, N_REFINEMENTS).map_err(|error| error.to_string())?;
        let spectra = transform.spectra(&stretched).map_err(|error| error.to_string())?;
        self.take(signal, spectra, true, strings::STRETCHING)
    }

    /// Synthesizes a signal from changed spectra.
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

    /// Adds an undo step that returns to `before`, and discards the redo steps.
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

    /// Names of the next undo step and of the next redo step.
    pub(super) fn labels(&self) -> [Option<&'static str>; 2] {
        [&self.undo, &self.redo].map(|steps| steps.last().map(|state| state.tool))
    }

    /// Undoes the last change; returns the signal before it.
    pub(super) fn undo(&mut self, now: &Arc<BenchSignal>) -> Option<Arc<BenchSignal>> {
        let state = self.undo.pop()?;
        self.redo.push(self.state_of(now, state.tool));
        Some(self.restore(state))
    }

    /// Redoes the change that was undone last; returns the signal after it.
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

    /// Adds an undo step for a signal that another one has replaced.
    pub(super) fn replaced(&mut self, before: &Arc<BenchSignal>) {
        self.push_step(before, strings::REPLACING);
        (self.painted, self.last_touch) = (None, None);
    }

    /// Discards all steps, because there is no signal any more.
    pub(super) fn forget(&mut self) {
        (self.painted, self.last_touch) = (None, None);
        self.undo.clear();
        self.redo.clear();
    }
}

#[cfg(test)]
mod tests {
    use super::{Editor, Tool};
    use crate::state::bench_signal::BenchSignal;
    use crate::state::bench_signal::tests::tone;
    use shagreen_core::dsp::spectrum::rms;
    use shagreen_core::signals::spatial_spectrogram::edit::Region;
    use std::sync::Arc;

    const WINDOW_M: f64 = 5e-3;

    /// 100 Hz at 100 mm/s: a wavelength of 1 mm, 100 mm long.
    fn signal() -> Arc<BenchSignal> {
        Arc::new(tone(100.0, 2000.0, 1.0))
    }

    /// RMS level between two positions in mm.
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
        assert!(now.name.contains("edited") && editor.labels()[0].is_some());
        let back = editor.undo(&now).unwrap();
        assert!(Arc::ptr_eq(&back, &first) && editor.labels()[0].is_none());
        let again = editor.redo(&back).unwrap();
        assert!(Arc::ptr_eq(&again, &now) && editor.redo(&again).is_none());
        // A brush with the opposite gain nearly removes it again.
        editor.tool = Tool::Softer;
        let soft = editor.brush_at(&again, WINDOW_M, (0.025, 1000.0)).unwrap().unwrap();
        assert!(level(&soft, 23.0, 27.0) < level(&again, 23.0, 27.0));
        assert!(editor.labels()[1].is_none(), "what was done anew cannot be made again");
    }

    /// The result of a stroke does not depend on the number of pointer reports.
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
        assert!(refused.contains("the maximum for this signal is"), "{refused}");
        assert_eq!(editor.labels()[0], Some(crate::strings::signals::STRETCHING));
        editor.forget();
        assert!(editor.undo(&now).is_none());
    }
}
