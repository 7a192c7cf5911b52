//! Design tokens: every color, size and distance of the window, for a dark and a light theme.

use egui::style::ScrollStyle;
use egui::{
    Color32, CornerRadius, FontFamily, FontId, Margin, Stroke, Style, TextStyle, Theme, Visuals, vec2,
};
use shagreen_formats::figure::{self, Tone};
use shagreen_formats::project::N_COLORS;

/// Colors of one theme.
#[derive(Clone, Copy, Debug)]
pub struct Tokens {
    /// Background of the window.
    pub background: Color32,
    /// Background of panels.
    pub panel: Color32,
    /// Cards and recessed areas within panels.
    pub raised: Color32,
    /// Controls that are not pointed at.
    pub control: Color32,
    /// Controls under the pointer.
    pub control_hovered: Color32,
    /// Outline of controls that are not pointed at, of check boxes and of text fields.
    pub control_line: Color32,
    /// Text fields.
    pub field: Color32,
    /// Thin lines.
    pub line: Color32,
    /// Primary text.
    pub text: Color32,
    /// Secondary text.
    pub text_weak: Color32,
    /// The authored point and everything that belongs to it.
    pub accent: Color32,
    /// Text on the accent color.
    pub on_accent: Color32,
    /// Selected entry, selected text, and the rail of a slider up to its handle.
    pub chosen: Color32,
    /// Text on the selection color, and the outline of the field with the keyboard focus.
    pub on_chosen: Color32,
    /// The three contributing textures, distinguishable with any color vision (after Okabe and Ito).
    pub parents: [Color32; 3],
    /// Further lines of a figure. They have another style than those in other colors, and are distinguishable from each other with
    /// any color vision.
    pub further: [Color32; 4],
    /// Colors that distinguish authored textures, next to their names (after Okabe and Ito).
    pub authored: [Color32; N_COLORS as usize],
    /// Warnings.
    pub warning: Color32,
    /// Errors.
    pub error: Color32,
}

/// Colors of the dark theme.
pub const DARK: Tokens = Tokens {
    background: Color32::from_rgb(0x12, 0x15, 0x17),
    panel: Color32::from_rgb(0x1A, 0x1E, 0x21),
    raised: Color32::from_rgb(0x22, 0x27, 0x2B),
    control: Color32::from_rgb(0x2D, 0x34, 0x39),
    control_hovered: Color32::from_rgb(0x39, 0x42, 0x48),
    control_line: Color32::from_rgb(0x70, 0x7B, 0x81),
    field: Color32::from_rgb(0x12, 0x15, 0x17),
    line: Color32::from_rgb(0x33, 0x3B, 0x41),
    text: Color32::from_rgb(0xE9, 0xEC, 0xEB),
    text_weak: Color32::from_rgb(0xA3, 0xAE, 0xB2),
    accent: Color32::from_rgb(0x5F, 0xC9, 0xB0),
    on_accent: Color32::from_rgb(0x0C, 0x1F, 0x1A),
    chosen: Color32::from_rgb(0x2B, 0x6B, 0x5D),
    on_chosen: Color32::from_rgb(0xD2, 0xFA, 0xF0),
    parents: [
        Color32::from_rgb(0xF0, 0xA8, 0x30),
        Color32::from_rgb(0x62, 0xB8, 0xEC),
        Color32::from_rgb(0xDB, 0x8C, 0xB8),
    ],
    further: [
        Color32::from_rgb(0xEA, 0xE0, 0x4E),
        Color32::from_rgb(0x7B, 0x93, 0xF5),
        Color32::from_rgb(0xEE, 0x7B, 0x52),
        Color32::from_rgb(0xC2, 0xD8, 0xEE),
    ],
    authored: [
        Color32::from_rgb(0xF0, 0xA8, 0x30),
        Color32::from_rgb(0x62, 0xB8, 0xEC),
        Color32::from_rgb(0x6C, 0xC4, 0x6A),
        Color32::from_rgb(0xEF, 0xE2, 0x5A),
        Color32::from_rgb(0x93, 0xA0, 0xFF),
        Color32::from_rgb(0xEE, 0x7B, 0x52),
        Color32::from_rgb(0xDB, 0x8C, 0xB8),
        Color32::from_rgb(0xB4, 0xBC, 0xC0),
    ],
    warning: Color32::from_rgb(0xF2, 0xC0, 0x4A),
    error: Color32::from_rgb(0xF0, 0x7A, 0x6A),
};

/// Colors of the light theme.
pub const LIGHT: Tokens = Tokens {
    background: Color32::from_rgb(0xE9, 0xEB, 0xE8),
    panel: Color32::from_rgb(0xF7, 0xF8, 0xF6),
    raised: Color32::from_rgb(0xFF, 0xFF, 0xFF),
    control: Color32::from_rgb(0xE3, 0xE7, 0xE4),
    control_hovered: Color32::from_rgb(0xD6, 0xDC, 0xD8),
    control_line: Color32::from_rgb(0x87, 0x91, 0x8C),
    field: Color32::from_rgb(0xFF, 0xFF, 0xFF),
    line: Color32::from_rgb(0xCB, 0xD2, 0xCD),
    text: Color32::from_rgb(0x1B, 0x21, 0x24),
    text_weak: Color32::from_rgb(0x54, 0x60, 0x66),
    accent: Color32::from_rgb(0x12, 0x70, 0x60),
    on_accent: Color32::from_rgb(0xFF, 0xFF, 0xFF),
    chosen: Color32::from_rgb(0x9C, 0xCF, 0xC4),
    on_chosen: Color32::from_rgb(0x06, 0x3F, 0x35),
    parents: [
        Color32::from_rgb(0x96, 0x57, 0x00),
        Color32::from_rgb(0x16, 0x6C, 0xAB),
        Color32::from_rgb(0xA3, 0x3C, 0x78),
    ],
    further: [
        Color32::from_rgb(0x5E, 0x2A, 0x06),
        Color32::from_rgb(0x16, 0x16, 0x8A),
        Color32::from_rgb(0x2F, 0x5B, 0xE6),
        Color32::from_rgb(0xC4, 0x18, 0x4A),
    ],
    authored: [
        Color32::from_rgb(0x96, 0x57, 0x00),
        Color32::from_rgb(0x16, 0x6C, 0xAB),
        Color32::from_rgb(0x1F, 0x70, 0x34),
        Color32::from_rgb(0x6E, 0x61, 0x00),
        Color32::from_rgb(0x3F, 0x45, 0xB4),
        Color32::from_rgb(0xB0, 0x3E, 0x16),
        Color32::from_rgb(0xA3, 0x3C, 0x78),
        Color32::from_rgb(0x59, 0x63, 0x68),
    ],
    warning: Color32::from_rgb(0x8A, 0x5A, 0x00),
    error: Color32::from_rgb(0xB3, 0x2D, 0x20),
};

/// Width of a scroll bar and opacity of its handle while the pointer is elsewhere, in points and 0..1.
const RESTING_BAR: (f32, f32) = (3.0, 0.45);
/// Time for which the pointer rests before a tooltip appears, in seconds.
pub(crate) const TOOLTIP_DELAY_SECS: f32 = 0.6;
/// Distance between related items, in points.
pub const GAP: f32 = 6.0;
/// Distance between groups, in points.
pub const GROUP_GAP: f32 = 10.0;
/// Width beside the content of a scroll area that its bar, which lies over the content, does not cover, in points.
pub const SCROLL_BAR_ROOM: f32 = 8.0;
/// Corner radius of cards and controls, in points.
pub const RADIUS: u8 = 5;
/// Width of the column with the texture list, in points.
pub const LIBRARY_WIDTH: f32 = 208.0;
/// Width of the column with sliders and contributions, in points.
pub const INSPECTOR_WIDTH: f32 = 290.0;
/// Range of widths of the column with the texture list when the user moves its border, in points.
pub const LIBRARY_WIDTHS: std::ops::RangeInclusive<f32> = 170.0..=400.0;
/// Range of widths of the column with sliders and contributions when the user moves its border, in points.
pub const INSPECTOR_WIDTHS: std::ops::RangeInclusive<f32> = 260.0..=560.0;
/// Width that both columns leave to the map, in points.
pub const LEAST_MAP_WIDTH: f32 = 300.0;
/// Width of the column with judgments and options in the Build workspace, in points.
pub const BUILD_INPUTS_WIDTH: f32 = 300.0;
/// Width of the column with the validation summary of a space, in points.
pub const VERDICT_WIDTH: f32 = 280.0;
/// Range of heights of the row with pad and scope, in points; the row grows with the window.
pub const STAGE_HEIGHTS: std::ops::RangeInclusive<f32> = 208.0..=360.0;
/// Smallest height of this row when the user moves its border, in points.
pub const LEAST_STAGE_HEIGHT: f32 = 150.0;
/// Largest share of the window height that this row takes when the user moves its border.
pub const LARGEST_STAGE_SHARE: f32 = 0.6;
/// Share of the window height that this row takes within that range.
pub const STAGE_SHARE: f32 = 0.27;
/// Minimum width of the pad, in points, at which the sliders above it are still usable.
pub const PAD_WIDTH: f32 = 440.0;

/// Returns the tokens of the active theme.
pub fn tokens(ctx: &egui::Context) -> &'static Tokens {
    match ctx.theme() {
        Theme::Dark => &DARK,
        Theme::Light => &LIGHT,
    }
}

/// Color of a part of a figure. Colors of lines with the same style are distinguishable with any color vision.
pub fn tone_color(t: &Tokens, tone: Tone) -> Color32 {
    match tone {
        Tone::Main => t.accent,
        Tone::Second => t.parents[0],
        Tone::Third => t.parents[1],
        Tone::Fourth => t.parents[2],
        Tone::Fifth => t.further[0],
        Tone::Sixth => t.further[1],
        Tone::Seventh => t.further[2],
        Tone::Eighth => t.further[3],
        Tone::Limit => t.text,
        Tone::Faint => t.text_weak.gamma_multiply(0.55),
    }
}

/// Color of a map at a share of its range, 0 to 1.
pub fn map_color(share: f32) -> Color32 {
    let [red, green, blue] = figure::map_color(share);
    Color32::from_rgb(red, green, blue)
}

/// Installs both themes in an egui context.
pub fn install(ctx: &egui::Context) {
    ctx.set_style_of(Theme::Dark, style(&DARK, Visuals::dark()));
    ctx.set_style_of(Theme::Light, style(&LIGHT, Visuals::light()));
}

fn style(t: &Tokens, mut visuals: Visuals) -> Style {
    let radius = CornerRadius::same(RADIUS);
    visuals.panel_fill = t.panel;
    visuals.window_fill = t.raised;
    visuals.window_stroke = Stroke::new(1.0, t.line);
    visuals.window_corner_radius = radius;
    visuals.menu_corner_radius = radius;
    visuals.extreme_bg_color = t.background;
    visuals.text_edit_bg_color = Some(t.field);
    visuals.faint_bg_color = t.raised;
    visuals.weak_text_color = Some(t.text_weak);
    visuals.hyperlink_color = t.accent;
    visuals.warn_fg_color = t.warning;
    visuals.error_fg_color = t.error;
    visuals.selection.bg_fill = t.chosen;
    visuals.selection.stroke = Stroke::new(1.5, t.on_chosen);
    visuals.slider_trailing_fill = true;
    let widgets = &mut visuals.widgets;
    for (widget, fill) in [
        (&mut widgets.noninteractive, t.panel),
        (&mut widgets.inactive, t.control),
        (&mut widgets.hovered, t.control_hovered),
        (&mut widgets.active, t.control_hovered),
        (&mut widgets.open, t.control),
    ] {
        widget.bg_fill = fill;
        widget.weak_bg_fill = fill;
        widget.corner_radius = radius;
        widget.bg_stroke = Stroke::NONE;
        widget.fg_stroke = Stroke::new(1.0, t.text);
        widget.expansion = 0.0;
    }
    widgets.noninteractive.bg_stroke = Stroke::new(1.0, t.line);
    // An unchecked box and an empty field have nothing else that shows where they are.
    widgets.inactive.bg_stroke = Stroke::new(1.0, t.control_line);
    widgets.open.bg_stroke = Stroke::new(1.0, t.control_line);
    widgets.hovered.bg_stroke = Stroke::new(1.0, t.text_weak);
    widgets.active.bg_stroke = Stroke::new(1.0, t.accent);
    let mut style = Style { visuals, ..Style::default() };
    style.text_styles = [
        (TextStyle::Small, 11.5),
        (TextStyle::Body, 13.5),
        (TextStyle::Button, 13.5),
        (TextStyle::Heading, 17.0),
    ]
    .map(|(text_style, size)| (text_style, FontId::new(size, FontFamily::Proportional)))
    .into_iter()
    .chain([(TextStyle::Monospace, FontId::new(12.5, FontFamily::Monospace))])
    .collect();
    style.spacing.item_spacing = vec2(GAP, GAP);
    style.spacing.button_padding = vec2(9.0, 4.0);
    style.spacing.interact_size.y = 24.0;
    style.spacing.slider_rail_height = 5.0;
    style.spacing.window_margin = Margin::same(10);
    // Visible wherever something scrolls, and over the content, so that nothing moves when a bar appears.
    let (floating_width, dormant_handle_opacity) = RESTING_BAR;
    style.spacing.scroll = ScrollStyle { floating_width, dormant_handle_opacity, ..ScrollStyle::floating() };
    style.interaction.tooltip_delay = TOOLTIP_DELAY_SECS;
    // Without a grace time, every tooltip waits until the pointer rests.
    style.interaction.tooltip_grace_time = 0.0;
    style
}

/// Relative luminance according to WCAG 2.1.
#[cfg(test)]
fn luminance(color: Color32) -> f64 {
    let [red, green, blue] = linear(color);
    0.2126 * red + 0.7152 * green + 0.0722 * blue
}

/// Red, green and blue of an opaque color, proportional to light, 0 to 1.
#[cfg(test)]
fn linear(color: Color32) -> [f64; 3] {
    [color.r(), color.g(), color.b()].map(|c| {
        let c = f64::from(c) / 255.0;
        if c <= 0.04045 { c / 12.92 } else { ((c + 0.055) / 1.055).powf(2.4) }
    })
}

/// Contrast of two opaque colors according to WCAG 2.1, 1 to 21.
#[cfg(test)]
pub(crate) fn contrast(a: Color32, b: Color32) -> f64 {
    let (a, b) = (luminance(a), luminance(b));
    (a.max(b) + 0.05) / (a.min(b) + 0.05)
}

#[cfg(test)]
mod tests;
