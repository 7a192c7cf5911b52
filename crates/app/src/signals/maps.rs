//! Maps of both signals in a common color range, computed again only when their input changes.

use std::sync::Arc;

use egui::{Label, RichText, Ui};
use shagreen_core::signals::spatial_spectrogram::Transform;
use shagreen_formats::figure::Figure;

use super::figures::Levels;
use super::spatial_ui::ShownMm;
use crate::choices::signals::Slot;
use crate::choices::signals::View;
use crate::command::Command;
use crate::figure_ui::framed_figure_ui;
use crate::look::theme::tokens;
use crate::state::bench_signal::BenchSignal;
use crate::strings::differences::named;
use crate::strings::signals as strings;

/// View settings of the maps.
#[derive(Clone, Copy, PartialEq)]
pub(super) struct Seen {
    pub(super) view: View,
    /// Window length of the spatial spectrogram, in mm.
    pub(super) window_mm: f64,
    /// Range of positions that is shown.
    pub(super) shown_mm: ShownMm,
}

impl Seen {
    /// The settings without those that have no effect in their view.
    fn relevant(self) -> Self {
        match self.view {
            View::Places => self,
            View::Times | View::Differences => Self { window_mm: 0.0, shown_mm: None, ..self },
        }
    }
}

/// Levels of a signal, and the input that they were computed from.
struct Drawn {
    of: Arc<BenchSignal>,
    seen: Seen,
    levels: Result<Levels, String>,
}

/// Map, or why there is none.
pub(super) type MapFigure = Result<Arc<Figure>, String>;

#[derive(Default)]
pub(super) struct Maps {
    drawn: [Option<Drawn>; 2],
    figures: [Option<MapFigure>; 2],
}

impl Maps {
    /// Computes the maps again whose input has changed.
    pub(super) fn follow(&mut self, signals: &[Option<Arc<BenchSignal>>; 2], seen: Seen) {
        let seen = seen.relevant();
        let mut is_new = false;
        for (drawn, signal) in self.drawn.iter_mut().zip(signals) {
            let is_drawn = match (&*drawn, signal) {
                (Some(drawn), Some(signal)) => Arc::ptr_eq(&drawn.of, signal) && drawn.seen == seen,
                (drawn, signal) => drawn.is_none() && signal.is_none(),
            };
            if !is_drawn {
                is_new = true;
                *drawn = signal.as_ref().map(|signal| Drawn {
                    of: Arc::clone(signal),
                    seen,
                    levels: levels(signal, seen),
                });
            }
        }
        if is_new {
            let levels = self.drawn.iter().flatten().filter_map(|drawn| drawn.levels.as_ref().ok());
            let highest_db = levels.map(Levels::highest_db).fold(f64::NEG_INFINITY, f64::max);
            let figure = |slot: Slot| Some(self.drawn[slot.index()].as_ref()?.figure(slot, highest_db));
            self.figures = Slot::ALL.map(figure);
        }
    }

    /// Map of a signal; `None` if there is no signal.
    pub(super) fn map(&self, slot: Slot) -> Option<&MapFigure> {
        self.figures[slot.index()].as_ref()
    }
}

impl Drawn {
    fn figure(&self, slot: Slot, highest_db: f64) -> MapFigure {
        let Seen { view, window_mm, .. } = self.seen;
        let levels = self.levels.clone()?;
        let window_mm = 1e3 * self.of.window_m(self.of.framing(1e-3 * window_mm));
        let title = strings::map_title(view, &named(slot, &self.of.name), window_mm);
        Ok(Arc::new(levels.figure(title, strings::map_axes(view), highest_db)))
    }
}

fn levels(signal: &BenchSignal, seen: Seen) -> Result<Levels, String> {
    if seen.view != View::Places {
        return Levels::over_time(signal).ok_or_else(|| strings::TOO_SHORT_TO_DRAW.to_owned());
    }
    // From the signal itself: its spectra can differ from those that were painted.
    let transform = Transform::new(signal.framing(1e-3 * seen.window_mm));
    let power = transform.power(signal.profile.values()).map_err(|error| error.to_string())?;
    let length_mm = 1e3 * signal.profile.length_m();
    // The other signal may be longer.
    let (from, to) = seen.shown_mm.filter(|(from, _)| *from < length_mm).unwrap_or((0.0, length_mm));
    Ok(Levels::over_places(&power, signal, (from, to.min(length_mm))))
}

/// Draws the map of a slot, or why there is none.
pub(super) fn map_ui(ui: &mut Ui, slot: Slot, map: Option<&MapFigure>, stem: &str) -> Option<Command> {
    let t = tokens(ui.ctx());
    match map {
        Some(Ok(figure)) => framed_figure_ui(ui, strings::map_name(slot), figure, stem),
        Some(Err(reason)) => {
            ui.add(Label::new(RichText::new(reason).color(t.error)).wrap());
            None
        }
        None => {
            let text = RichText::new(strings::nothing_in(slot)).color(t.text_weak);
            ui.add(Label::new(text).wrap().selectable(false));
            None
        }
    }
}
