//! Display, graphics, libraries of the system and file dialogs.

use shagreen_device::operating_system::OperatingSystem;

use super::{DisplayFact, Facts, Line, State, denied};

/// Part of the window that needs a library.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum NeededBy {
    /// A window on an X11 display.
    X11,
    /// A window on a Wayland display.
    Wayland,
    /// Every window.
    Window,
}

/// A library of Linux that the program loads when it opens a window.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct KnownLibrary {
    /// Name of its file.
    pub file: &'static str,
    /// Package of Debian and Ubuntu that contains it.
    pub package: &'static str,
    /// What needs it.
    pub needed_by: NeededBy,
}

const fn library(file: &'static str, package: &'static str, needed_by: NeededBy) -> KnownLibrary {
    KnownLibrary { file, package, needed_by }
}

/// The two libraries of OpenGL. A window on an X11 display needs one of them, one on a Wayland display the first.
const EGL: &str = "libEGL.so.1";
const GLX: &str = "libGL.so.1";

/// Libraries of Linux that the program loads when it opens a window.
pub const KNOWN_LIBRARIES: [KnownLibrary; 10] = [
    library("libX11.so.6", "libx11-6", NeededBy::X11),
    library("libX11-xcb.so.1", "libx11-xcb1", NeededBy::X11),
    library("libXcursor.so.1", "libxcursor1", NeededBy::X11),
    library("libXi.so.6", "libxi6", NeededBy::X11),
    library("libxkbcommon-x11.so.0", "libxkbcommon-x11-0", NeededBy::X11),
    library("libwayland-client.so.0", "libwayland-client0", NeededBy::Wayland),
    library("libwayland-egl.so.1", "libwayland-egl1", NeededBy::Wayland),
    library("libxkbcommon.so.0", "libxkbcommon0", NeededBy::Window),
    library(EGL, "libegl1", NeededBy::Window),
    library(GLX, "libgl1", NeededBy::X11),
];

/// Lines about the window.
pub(super) fn lines(facts: &Facts) -> Vec<Line> {
    let mut lines = vec![display(facts)];
    if facts.system == OperatingSystem::Linux {
        lines.push(graphics(facts));
        lines.push(libraries(facts));
        lines.push(dialogs(facts));
    }
    lines
}

fn display(facts: &Facts) -> Line {
    let topic = "display";
    if facts.system != OperatingSystem::Linux {
        return Line::new(topic, State::Works, "the window system of this computer");
    }
    let (name, variable, fact) = match (facts.displays.wayland, facts.displays.x11) {
        (DisplayFact::Unset, x11) => ("X11", "DISPLAY", x11),
        (wayland, _) => ("Wayland", "WAYLAND_DISPLAY", wayland),
    };
    match fact {
        DisplayFact::Responds => Line::new(topic, State::Works, name),
        DisplayFact::Unset => Line::new(
            topic,
            State::Fails,
            "there is none (neither DISPLAY nor WAYLAND_DISPLAY is set); the window cannot open",
        )
        .with("start the window from a graphical session; the commands work without a display"),
        DisplayFact::Silent => Line::new(
            topic,
            State::Fails,
            format!("no {name} display responds where {variable} says; the window cannot open"),
        )
        .with(format!("start the window from a graphical session, or correct {variable}")),
        DisplayFact::Untried => Line::new(topic, State::Unknown, format!("{name}, on another computer"))
            .with("open the window to try it"),
    }
}

fn graphics(facts: &Facts) -> Line {
    let topic = "graphics";
    if facts.graphics_cards.is_empty() {
        return Line::new(
            topic,
            State::Limited,
            "there is no graphics card; the processor draws the window, which may be slow",
        )
        .with("install the driver of the graphics card, if the computer has one");
    }
    let refused = denied(&facts.graphics_cards, String::as_str);
    if refused.is_empty() {
        let names: Vec<&str> = facts.graphics_cards.iter().map(|(card, _)| card.as_str()).collect();
        return Line::new(topic, State::Works, names.join(", "));
    }
    Line::new(
        topic,
        State::Limited,
        format!("no permission for {}; the processor draws the window", refused.join(", ")),
    )
    .with("join the groups with `sudo usermod -aG video,render $USER`, and log in again")
}

fn libraries(facts: &Facts) -> Line {
    let topic = "libraries";
    let Some(installed) = &facts.libraries else {
        return Line::new(topic, State::Unknown, "the system has no list of its libraries")
            .with("if the window does not open, its error message names the missing library");
    };
    // The window is on the Wayland display wherever the environment names one.
    let is_wayland = facts.displays.wayland.is_named();
    let is_needed = |library: &&KnownLibrary| match library.needed_by {
        NeededBy::X11 => facts.displays.x11.is_named() && !is_wayland,
        NeededBy::Wayland => is_wayland,
        NeededBy::Window => true,
    };
    let has = |file: &str| installed.iter().any(|known| known == file);
    let has_opengl = !is_wayland && (has(EGL) || has(GLX));
    let is_missing = |library: &&KnownLibrary| {
        let is_replaced = has_opengl && [EGL, GLX].contains(&library.file);
        !has(library.file) && !is_replaced
    };
    let missing: Vec<_> = KNOWN_LIBRARIES.iter().filter(is_needed).filter(is_missing).collect();
    if missing.is_empty() {
        return Line::new(topic, State::Works, "all that a window needs are installed");
    }
    let files: Vec<&str> = missing.iter().map(|library| library.file).collect();
    let packages: Vec<&str> = missing.iter().map(|library| library.package).collect();
    Line::new(topic, State::Fails, format!("missing: {}", files.join(", "))).with(format!(
        "on Debian and Ubuntu, run `sudo apt install {}`; elsewhere, install the packages with these libraries",
        packages.join(" ")
    ))
}

fn dialogs(facts: &Facts) -> Line {
    let topic = "file dialogs";
    match (facts.has_portal, facts.has_zenity) {
        (true, _) => Line::new(topic, State::Works, "the portal of the desktop shows them"),
        (false, true) => Line::new(topic, State::Works, "zenity shows them"),
        (false, false) => Line::new(
            topic,
            State::Limited,
            "there is neither a desktop session with a portal nor zenity; paths must be typed",
        )
        .with("install zenity, or start the window from a desktop session with xdg-desktop-portal"),
    }
}
