//! Animations of the window, which the user or the system can turn off.

use egui::style::ScrollAnimation;
use egui::{Context, Label, Spinner, Style, Ui};

use crate::strings::motion as strings;

/// Side of the mark of work in progress, in points.
const BUSY_SIDE: f32 = 16.0;

/// Turns animations off or on: fading, sliding and blinking of controls, and smooth scrolling.
pub(crate) fn set_reduced(ctx: &Context, is_reduced: bool) {
    let usual = Style::default();
    let (animation_time, scroll_animation) = if is_reduced {
        (0.0, ScrollAnimation::none())
    } else {
        (usual.animation_time, usual.scroll_animation)
    };
    ctx.all_styles_mut(|style| {
        (style.animation_time, style.scroll_animation) = (animation_time, scroll_animation);
        style.visuals.text_cursor.blink = !is_reduced;
    });
}

/// Whether animations are off.
pub(crate) fn is_reduced(ctx: &Context) -> bool {
    ctx.global_style().animation_time == 0.0
}

/// Draws the mark of work in progress, which turns only if there are animations.
pub(crate) fn busy_ui(ui: &mut Ui) {
    if is_reduced(ui.ctx()) {
        ui.add(Label::new(strings::BUSY).selectable(false));
    } else {
        ui.add(Spinner::new().size(BUSY_SIDE));
    }
}

#[cfg(test)]
mod tests {
    use super::{is_reduced, set_reduced};
    use egui::{Context, Theme};

    /// Both themes lose their animations, and get those of the toolkit back.
    #[test]
    fn motion_is_reduced_and_restored_in_both_themes() {
        let ctx = Context::default();
        assert!(!is_reduced(&ctx));
        for is_off in [true, false] {
            set_reduced(&ctx, is_off);
            for theme in [Theme::Dark, Theme::Light] {
                ctx.set_theme(theme);
                let (style, usual) = (ctx.style_of(theme), egui::Style::default());
                assert_eq!(is_reduced(&ctx), is_off);
                assert_eq!(style.scroll_animation == usual.scroll_animation, !is_off);
                assert_eq!(style.visuals.text_cursor.blink, !is_off);
            }
        }
    }
}
