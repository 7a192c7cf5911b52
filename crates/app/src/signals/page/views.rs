//! Views of the signals: maps over time, maps over position with the editor, and differences.

use std::sync::Arc;

use egui::{Align, Label, Layout, Rect, RichText, ScrollArea, Ui, UiBuilder, pos2};
use shagreen_formats::figure::Tone;

use super::{SignalsPage, View};
use crate::choices::signals::Slot;
use crate::command::Command;
use crate::figure_ui::framed_figure_ui;
use crate::look::theme::{GAP, GROUP_GAP, SCROLL_BAR_ROOM, tokens};
use crate::signals::analysis::ByRate;
use crate::signals::editor_ui::tools_ui;
use crate::signals::features_ui::features_ui;
use crate::signals::figures::{features_figure, fidelity_figure, rates_figure};
use crate::signals::maps::{Seen, map_ui};
use crate::signals::model_ui::{model_ui, origin_ui};
use crate::signals::slot::Place;
use crate::signals::spatial_ui::{places_map_ui, spatial_ui};
use crate::strings::differences::predicted_by;
use crate::strings::digits::three_digits;
use crate::strings::signals as strings;

/// Range of the window length, in mm: from the shortest to the longest window of the paper.
const WINDOWS_MM: (f64, f64) = (0.2, 20.0);
/// Width in points below which figures are placed below each other, if the height allows it: three of them beside each
/// other would shorten their labels.
const NARROW: f32 = 800.0;
/// Least height in points of figures below each other.
const TALL: f32 = 420.0;

impl SignalsPage {
    /// Draws the tabs and the selected view.
    pub(super) fn views_ui(&mut self, ui: &mut Ui, commands: &mut Vec<Command>) {
        ui.horizontal(|ui| {
            for view in View::ALL {
                ui.selectable_value(&mut self.view, view, strings::view(view))
                    .on_hover_text(strings::view_help(view));
            }
            if self.view == View::Places {
                ui.add_space(GROUP_GAP);
                self.window_ui(ui);
                let is_zoomed = self.spatial.shown_mm.is_some();
                let whole = ui.add_enabled(is_zoomed, egui::Button::new(strings::SHOW_ALL));
                if whole
                    .on_hover_text(strings::ZOOM_HELP)
                    .on_disabled_hover_text(strings::ZOOM_HELP)
                    .clicked()
                {
                    self.spatial.shown_mm = None;
                }
            }
            if self.view == View::Differences {
                ui.add_space(GROUP_GAP);
                commands.extend(model_ui(ui, &self.model));
            }
        });
        ui.add_space(GAP);
        if self.view != View::Differences {
            let signals = Slot::ALL.map(|slot| self.signal(slot).map(Arc::clone));
            self.maps.follow(
                &signals,
                Seen { view: self.view, window_mm: self.window_mm, shown_mm: self.spatial.shown_mm },
            );
        }
        match self.view {
            View::Times => self.times_ui(ui, commands),
            View::Places => self.places_ui(ui, commands),
            View::Differences => self.differences_ui(ui, commands),
        }
    }

    fn window_ui(&mut self, ui: &mut Ui) {
        let t = tokens(ui.ctx());
        let text = RichText::new(strings::WINDOW).color(t.text_weak);
        ui.add(Label::new(text).selectable(false)).on_hover_text(strings::WINDOW_HELP);
        ui.spacing_mut().slider_width = (0.25 * ui.available_width()).min(220.0);
        let slider = egui::Slider::new(&mut self.window_mm, WINDOWS_MM.0..=WINDOWS_MM.1);
        let shown = |window_mm: f64, _| three_digits(window_mm);
        let slider = slider.logarithmic(true).suffix(" mm").custom_formatter(shown);
        ui.add(slider).accessible_name(strings::WINDOW).on_hover_text(strings::WINDOW_HELP);
    }

    fn times_ui(&self, ui: &mut Ui, commands: &mut Vec<Command>) {
        ui.columns_const(|columns: &mut [Ui; 2]| {
            for (ui, slot) in columns.iter_mut().zip(Slot::ALL) {
                commands.extend(map_ui(ui, slot, self.maps.map(slot), strings::stem(self.view, slot)));
            }
        });
    }

    fn places_ui(&mut self, ui: &mut Ui, commands: &mut Vec<Command>) {
        let signal = self.signal(Slot::B).map(Arc::clone);
        let window_m = self.window_m();
        let is_stretched = ui.add_enabled_ui(signal.is_some(), |ui| tools_ui(ui, &mut self.editor)).inner;
        if let Some(signal) = signal.as_ref().filter(|_| is_stretched) {
            let stretched = self.editor.stretch(signal, window_m);
            self.take_painted(stretched.map(Some));
        }
        ui.add_space(GAP);
        let known = self.of_each(Place::by_window);
        let is_waiting = known.len() < self.n_signals();
        let fidelity = Arc::new(fidelity_figure(&known, window_m));
        // The maps of this frame, even if the signal is edited in it.
        let maps = Slot::ALL.map(|slot| self.maps.map(slot).cloned());
        let mut painted = None;
        let [mut first, mut second, mut third] = three_areas(ui);
        let stem = strings::stem(View::Places, Slot::A);
        match (&maps[0], self.signal(Slot::A).map(|signal| 1e3 * signal.profile.length_m())) {
            (Some(Ok(figure)), Some(length_mm)) => {
                let spatial = &mut self.spatial;
                let (save, _) = places_map_ui(&mut first, Slot::A, figure, stem, spatial, length_mm);
                commands.extend(save);
            }
            (map, _) => commands.extend(map_ui(&mut first, Slot::A, map.as_ref(), stem)),
        }
        match (&maps[1], &signal) {
            (Some(Ok(figure)), Some(signal)) => {
                let stem = strings::stem(View::Places, Slot::B);
                let (spatial, editor) = (&mut self.spatial, &mut self.editor);
                let shown = spatial_ui(&mut second, figure, stem, spatial, editor, signal, window_m);
                commands.extend(shown.save);
                painted = shown.painted;
            }
            (map, _) => commands.extend(map_ui(&mut second, Slot::B, map.as_ref(), "")),
        }
        waiting_ui(&mut third, is_waiting);
        commands.extend(framed_figure_ui(&mut third, "fidelity by window", &fidelity, "fidelity-by-window"));
        if let Some(painted) = painted {
            self.take_painted(painted);
        }
    }

    fn n_signals(&self) -> usize {
        self.places.iter().filter(|place| place.signal().is_some()).count()
    }

    /// Results about the signals as they are now, with the color and the letter of their slots.
    fn of_each<'a, T: ?Sized>(
        &'a self,
        known: impl Fn(&'a Place) -> Option<&'a T>,
    ) -> Vec<(Tone, &'static str, &'a T)> {
        let of = Slot::ALL.into_iter().zip([Tone::Main, Tone::Second]);
        of.filter_map(|(slot, tone)| Some((tone, slot.name(), known(&self.places[slot.index()])?))).collect()
    }

    fn differences_ui(&self, ui: &mut Ui, commands: &mut Vec<Command>) {
        origin_ui(ui, &self.model);
        let known: Vec<(Tone, &str, &ByRate)> = self.of_each(Place::by_rate);
        let source = self.model().map_or_else(
            || strings::PREDICTED.to_owned(),
            |model| predicted_by(&model.name, &model.origin()),
        );
        let rates = Arc::new(rates_figure(&known, &source));
        let names = Slot::ALL.map(|slot| self.signal(slot).map_or("", |signal| &signal.name));
        let compared = self.compared();
        let [mut left, mut right] = two_areas(ui);
        match compared {
            Some(Ok(compared)) => {
                let figure = Arc::new(features_figure(compared, names, &source));
                let scroll = ScrollArea::both().id_salt("features").auto_shrink(false);
                let shown = scroll.show(&mut left, |ui| {
                    ui.set_max_width(ui.available_width() - SCROLL_BAR_ROOM);
                    features_ui(ui, compared, names, &figure)
                });
                commands.extend(shown.inner);
            }
            Some(Err(reason)) => {
                let text = RichText::new(reason).color(tokens(left.ctx()).warning);
                left.add(Label::new(text).wrap());
            }
            None => {
                let is_pair = self.pair().is_some();
                let said = if is_pair { strings::MAKING } else { strings::NEEDS_PAIR };
                let text = RichText::new(said).color(tokens(left.ctx()).text_weak);
                left.add(Label::new(text).wrap());
            }
        }
        waiting_ui(&mut right, known.len() < self.n_signals());
        for (_, name, of) in &known {
            if let Err(reason) = of {
                let text = RichText::new(format!("{name}: {reason}")).small();
                right.add(Label::new(text).wrap());
            }
        }
        commands.extend(framed_figure_ui(&mut right, "d' by rate", &rates, "d-prime-by-rate"));
    }
}

/// Areas of three figures in the remaining space: beside each other, or two above one in a narrow window.
fn three_areas(ui: &mut Ui) -> [Ui; 3] {
    let area = ui.available_rect_before_wrap();
    if is_wide(area) {
        return areas(ui, columns(area, ui.spacing().item_spacing.x));
    }
    let [upper, lower] = rows(area);
    let [first, second] = columns(upper, ui.spacing().item_spacing.x);
    areas(ui, [first, second, lower])
}

/// Areas of two figures in the remaining space: beside each other, or below each other in a narrow window.
fn two_areas(ui: &mut Ui) -> [Ui; 2] {
    let area = ui.available_rect_before_wrap();
    let gap = ui.spacing().item_spacing.x;
    areas(ui, if is_wide(area) { columns(area, gap) } else { rows(area) })
}

/// Whether figures are placed beside each other.
fn is_wide(area: Rect) -> bool {
    area.width() >= NARROW || area.height() < TALL
}

fn areas<const N: usize>(ui: &mut Ui, rects: [Rect; N]) -> [Ui; N] {
    ui.advance_cursor_after_rect(ui.available_rect_before_wrap());
    rects.map(|rect| {
        ui.new_child(UiBuilder::new().max_rect(rect).layout(Layout::top_down_justified(Align::Min)))
    })
}

/// Columns of the same width, with a gap between them.
fn columns<const N: usize>(area: Rect, gap: f32) -> [Rect; N] {
    let width = (area.width() - (N as f32 - 1.0) * gap) / N as f32;
    std::array::from_fn(|i| {
        let left = area.left() + i as f32 * (width + gap);
        Rect::from_min_max(pos2(left, area.top()), pos2(left + width, area.bottom()))
    })
}

/// Two rows of the same height, with a gap between them.
fn rows(area: Rect) -> [Rect; 2] {
    let middle = area.center().y;
    [
        Rect::from_min_max(area.min, pos2(area.right(), middle - 0.5 * GROUP_GAP)),
        Rect::from_min_max(pos2(area.left(), middle + 0.5 * GROUP_GAP), area.max),
    ]
}

/// Shows that a computation is still running.
fn waiting_ui(ui: &mut Ui, is_waiting: bool) {
    if is_waiting {
        let text = RichText::new(strings::MAKING).small().color(tokens(ui.ctx()).text_weak);
        ui.add(Label::new(text).selectable(false));
    }
}
