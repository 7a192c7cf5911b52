//! Notice: a short message in the status bar about what a click has just done. It disappears by itself.

use egui::{Context, Id};

/// Time for which a notice is shown, in seconds.
const SHOWN_SECS: f64 = 6.0;

/// A notice, and the time at which it disappears, in seconds.
#[derive(Clone)]
struct Notice {
    text: String,
    until_secs: f64,
    /// Frame in which it appeared.
    since: u64,
}

fn key() -> Id {
    Id::unique("notice in the status bar")
}

/// Shows a notice in place of an earlier one.
pub(crate) fn show_notice(ctx: &Context, text: String) {
    let until_secs = ctx.input(|i| i.time) + SHOWN_SECS;
    let notice = Notice { text, until_secs, since: ctx.cumulative_frame_nr() };
    ctx.data_mut(|data| data.insert_temp(key(), notice));
    ctx.request_repaint_after_secs(SHOWN_SECS as f32);
}

/// Removes the notice.
pub(crate) fn clear_notice(ctx: &Context) {
    ctx.data_mut(|data| data.remove::<Notice>(key()));
}

/// Removes the notice unless it is about what has happened in this frame.
pub(crate) fn clear_earlier_notice(ctx: &Context) {
    let notice: Option<Notice> = ctx.data(|data| data.get_temp(key()));
    if notice.is_some_and(|notice| notice.since != ctx.cumulative_frame_nr()) {
        clear_notice(ctx);
    }
}

/// Text of the present notice.
pub(crate) fn notice(ctx: &Context) -> Option<String> {
    let now_secs = ctx.input(|i| i.time);
    let notice: Notice = ctx.data(|data| data.get_temp(key()))?;
    (now_secs < notice.until_secs).then_some(notice.text)
}

#[cfg(test)]
mod tests {
    use super::{SHOWN_SECS, clear_earlier_notice, clear_notice, notice, show_notice};
    use egui::{Context, RawInput};

    #[test]
    fn a_notice_disappears_by_itself() {
        let ctx = Context::default();
        let at = |time_secs: f64, is_new: bool| {
            let mut said = None;
            let input = RawInput { time: Some(time_secs), ..RawInput::default() };
            let mut output = ctx.run_ui(input, |ui| {
                if is_new {
                    show_notice(ui.ctx(), "moved".to_owned());
                    clear_earlier_notice(ui.ctx());
                }
                said = notice(ui.ctx());
            });
            output.textures_delta.clear();
            said
        };
        assert_eq!(at(0.0, false), None);
        assert_eq!(at(1.0, true).as_deref(), Some("moved"));
        assert_eq!(at(0.9 + SHOWN_SECS, false).as_deref(), Some("moved"));
        assert_eq!(at(1.1 + SHOWN_SECS, false), None);
        assert!(at(20.0, true).is_some());
        clear_notice(&ctx);
        assert_eq!(at(20.5, false), None);
        assert!(at(21.0, true).is_some() && at(21.5, false).is_some());
        clear_earlier_notice(&ctx);
        assert_eq!(at(21.6, false), None);
    }
}
