//! Choice of the display of the window, and errors without one.

use anyhow::anyhow;
use eframe::EventLoopBuilderHook;

/// Begin of the text of an error of the window system, which goes on with a position in its source code.
const SYSTEM_ERROR: &str = "os error at ";

/// Hook that opens the window on the X11 display; `None` leaves the choice to the environment.
pub(crate) fn builder_hook(is_on_x11: bool) -> Option<EventLoopBuilderHook> {
    #[cfg(target_os = "linux")]
    if is_on_x11 {
        use winit::platform::x11::EventLoopBuilderExtX11 as _;
        return Some(Box::new(|builder| {
            builder.with_x11();
        }));
    }
    #[cfg(not(target_os = "linux"))]
    let _ = is_on_x11;
    None
}

/// Error for a window that was not opened.
pub(crate) fn not_opened(error: &eframe::Error) -> anyhow::Error {
    let is_system_error = error.to_string().contains(SYSTEM_ERROR);
    if cfg!(target_os = "linux") && is_system_error && matches!(error, eframe::Error::WinitEventLoop(_)) {
        let names =
            ["WAYLAND_DISPLAY", "DISPLAY"].map(|name| (name, std::env::var(name).unwrap_or_default()));
        return anyhow::Error::msg(no_display(&names));
    }
    anyhow!("the window could not be opened: {}", without_source(&error.to_string()))
}

/// Says that no display can be opened, with the variables that name displays and their values.
fn no_display(names: &[(&str, String)]) -> String {
    let set: Vec<String> = names
        .iter()
        .filter(|(_, value)| !value.is_empty())
        .map(|(name, value)| format!("{name} is \"{value}\""))
        .collect();
    format!(
        "no display can be opened for the window ({}); start it from a graphical session, or set DISPLAY (X11) or \
         WAYLAND_DISPLAY to a display that responds: `shagreen doctor` checks them",
        if set.is_empty() { "none is named".to_owned() } else { set.join(", ") }
    )
}

/// The text of an error without the position in the source code of the window system.
fn without_source(text: &str) -> String {
    let Some((before, after)) = text.split_once(SYSTEM_ERROR) else { return text.to_owned() };
    let reason = after.split_once(": ").map_or("the system refuses it", |(_, reason)| reason);
    format!("{before}{reason}")
}

#[cfg(test)]
mod tests {
    use super::{builder_hook, no_display, without_source};

    #[test]
    fn an_error_names_the_displays_and_no_source_code() {
        let text = no_display(&[("WAYLAND_DISPLAY", String::new()), ("DISPLAY", ":99".to_owned())]);
        assert!(text.contains("DISPLAY is \":99\"") && text.contains("set DISPLAY"), "{text}");
        assert!(!text.contains("WAYLAND_DISPLAY is"), "{text}");
        let long = "winit error: os error at /a/src/mod.rs:757: no compositor: gone";
        assert_eq!(without_source(long), "winit error: no compositor: gone");
        assert_eq!(without_source("no OpenGL"), "no OpenGL");
    }

    #[test]
    fn x11_is_chosen_only_on_request() {
        assert!(builder_hook(false).is_none());
        assert_eq!(builder_hook(true).is_some(), cfg!(target_os = "linux"));
    }
}
