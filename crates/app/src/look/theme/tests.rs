use super::{DARK, LIGHT, Tokens, contrast, linear, luminance, map_color, style, tone_color};
use egui::{Color32, Style, Visuals};
use shagreen_formats::figure::compared_line;

/// Pairs of text and surface in the window that are illegible (WCAG AA: contrast below 4.5 to 1). Also pairs of a
/// mark and its surface that are indistinguishable (below 3 to 1).
fn unreadable(t: &Tokens, style: &Style) -> Vec<String> {
    let mut pairs = Vec::new();
    for surface in [t.background, t.panel, t.raised] {
        pairs.push((t.text, surface, 7.0));
        let colors =
            [t.text_weak, t.accent, t.warning, t.error].into_iter().chain(t.parents).chain(t.further);
        pairs.extend(colors.map(|color| (color, surface, 4.5)));
        pairs.extend(t.authored.map(|color| (color, surface, 3.0)));
    }
    pairs.push((t.on_accent, t.accent, 4.5));
    let visuals = &style.visuals;
    let widgets = &visuals.widgets;
    for widget in
        [&widgets.noninteractive, &widgets.inactive, &widgets.hovered, &widgets.active, &widgets.open]
    {
        pairs.push((widget.fg_stroke.color, widget.bg_fill, 4.5));
        pairs.push((widget.fg_stroke.color, widget.weak_bg_fill, 4.5));
    }
    pairs.extend([t.text, t.text_weak].map(|color| (color, t.field, 4.5)));
    // Text of a selected tab or entry, and selected text.
    pairs.push((visuals.selection.stroke.color, visuals.selection.bg_fill, 4.5));
    // Outline of a check box or field, on a panel and in a menu.
    pairs.extend([t.panel, t.raised].map(|surface| (widgets.inactive.bg_stroke.color, surface, 3.0)));
    // Outline of the field with the keyboard focus.
    pairs.push((visuals.selection.stroke.color, t.panel, 3.0));
    let is_unreadable = |(color, surface, least): &(Color32, Color32, f64)| {
        // A translucent surface shows the color of the panel below.
        contrast(*color, t.panel.blend(*surface)) < *least
    };
    let name = |(color, surface, least): (Color32, Color32, f64)| {
        format!("{color:?} on {surface:?}: {:.2} of {least}", contrast(color, t.panel.blend(surface)))
    };
    pairs.into_iter().filter(is_unreadable).map(name).collect()
}

fn both() -> [(&'static Tokens, Style); 2] {
    [(&DARK, style(&DARK, Visuals::dark())), (&LIGHT, style(&LIGHT, Visuals::light()))]
}

#[test]
fn text_can_be_read_on_every_surface() {
    for (t, style) in both() {
        assert_eq!(unreadable(t, &style), Vec::<String>::new());
    }
}

/// Coordinates of a color in Oklab (B. Ottosson, 2020), in which equal distances look about equally large.
fn oklab([red, green, blue]: [f64; 3]) -> [f64; 3] {
    let l = (0.412_221 * red + 0.536_333 * green + 0.051_446 * blue).cbrt();
    let m = (0.211_903 * red + 0.680_700 * green + 0.107_397 * blue).cbrt();
    let s = (0.088_302 * red + 0.281_719 * green + 0.629_979 * blue).cbrt();
    [
        0.210_454 * l + 0.793_618 * m - 0.004_072 * s,
        1.977_998 * l - 2.428_592 * m + 0.450_594 * s,
        0.025_904 * l + 0.782_772 * m - 0.808_676 * s,
    ]
}

/// A color as seen without the receptors for green light (G. Machado et al., 2009).
fn without_green([red, green, blue]: [f64; 3]) -> [f64; 3] {
    [
        0.367_322 * red + 0.860_646 * green - 0.227_968 * blue,
        0.280_085 * red + 0.672_501 * green + 0.047_413 * blue,
        -0.011_820 * red + 0.042_940 * green + 0.968_881 * blue,
    ]
    .map(|c| c.clamp(0.0, 1.0))
}

#[test]
fn compared_lines_can_be_told_apart() {
    let distance = |a: [f64; 3], b: [f64; 3]| -> f64 {
        let (a, b) = (oklab(a), oklab(b));
        (0..3).map(|i| (a[i] - b[i]).powi(2)).sum::<f64>().sqrt()
    };
    for (t, _) in both() {
        let looks: Vec<_> = (0..8).map(compared_line).collect();
        for (i, (mark, tone)) in looks.iter().enumerate() {
            for (other_mark, other) in &looks[..i] {
                let [a, b] = [*tone, *other].map(|tone| linear(tone_color(t, tone)));
                // About four times the smallest difference between large patches, for thin lines.
                let all = distance(a, b);
                assert!(all > 0.08, "{tone:?} and {other:?}: {all}");
                // The same for people who see fewer colors, unless the style differs.
                let few = distance(without_green(a), without_green(b));
                assert!(mark != other_mark || few > 0.03, "{tone:?} and {other:?}: {few}");
            }
        }
    }
}

/// A higher value is lighter, whatever its hue.
#[test]
fn a_map_gets_lighter_all_the_way() {
    let lights: Vec<f64> = (0..=20).map(|i| luminance(map_color(i as f32 / 20.0))).collect();
    assert!(lights.windows(2).all(|pair| pair[1] > pair[0]), "{lights:?}");
}

/// Without an outline, a button of the light theme could hardly be told from the canvas below it.
#[test]
fn controls_differ_from_the_canvas_and_from_text_fields() {
    for t in [&DARK, &LIGHT] {
        assert!(contrast(t.control_line, t.background) > 1.5 && t.control_line.is_opaque(), "{t:?}");
        assert!(contrast(t.control, t.field) > 1.2, "{t:?}");
    }
}

/// Negative control: accent text on a lighter shade of the accent, a former style of tabs, is detected in both
/// themes.
#[test]
fn a_tab_that_cannot_be_read_is_found() {
    for (t, mut style) in both() {
        style.visuals.selection.bg_fill = t.accent.gamma_multiply(0.45);
        style.visuals.selection.stroke.color = t.accent;
        assert!(!unreadable(t, &style).is_empty());
    }
}
