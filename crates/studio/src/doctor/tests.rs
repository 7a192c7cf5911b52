use std::path::PathBuf;

use shagreen_device::error::{DeviceError, DeviceErrorKind};
use shagreen_device::hid::identity::{HidBus, HidPen, denied_on};
use shagreen_device::operating_system::OperatingSystem;
use shagreen_device::output::{OutputInfo, OutputKind};
use shagreen_device::pen_backend::{Access, Backend, PositionUnit, Provides};
use shagreen_device::serial::{SerialPortInfo, SerialPortKind};
use shagreen_device::sound_server::SoundServer;
use shagreen_device::stylus::{StylusInfo, StylusList};

use super::{
    DisplayFact, DisplayFacts, Facts, FolderFact, KNOWN_LIBRARIES, Line, NetworkFacts, State, lines,
};

fn output(id: &str, kind: OutputKind, is_default: bool) -> OutputInfo {
    OutputInfo { id: id.to_owned(), name: format!("Output {id}"), kind, is_default }
}

fn hid_pen(id: &str, access: Access) -> HidPen {
    HidPen {
        id: id.to_owned(),
        name: "Test pen".to_owned(),
        vendor_id: 0x056a,
        product_id: 0x0374,
        serial: None,
        interface: None,
        path: "/dev/hidraw3".to_owned(),
        bus: HidBus::Usb,
        backend: Backend::Hid,
        provides: Provides {
            position: Some(PositionUnit::Millimeters),
            pressure: Some(true),
            tilt: Some(true),
            clock: Some(false),
        },
        access,
    }
}

fn pen(access: Access) -> StylusInfo {
    let pen = hid_pen("hid:056a:0374", access);
    let advice = (!access.may_open()).then(|| denied_on(OperatingSystem::Linux, &pen));
    StylusInfo { advice, ..pen.into() }
}

fn port(access: Access) -> (SerialPortInfo, Access) {
    let info = SerialPortInfo {
        id: "serial:/dev/ttyACM0".to_owned(),
        port: "/dev/ttyACM0".to_owned(),
        name: "Microcontroller".to_owned(),
        kind: SerialPortKind::Unknown,
    };
    (info, access)
}

fn displays(x11: DisplayFact, wayland: DisplayFact) -> DisplayFacts {
    DisplayFacts { x11, wayland }
}

/// A machine on which everything works.
fn whole() -> Facts {
    let folder = |content| FolderFact {
        content,
        path: Some(PathBuf::from("/home/a/.config/shagreen")),
        access: Access::Granted,
    };
    Facts {
        system: OperatingSystem::Linux,
        sound_server: SoundServer::Responds("PulseAudio (on PipeWire 1.4)".to_owned()),
        outputs: vec![
            output("null", OutputKind::Null, false),
            output("pulse:a", OutputKind::Audio, true),
            output("haptic:1", OutputKind::HapticPen, false),
        ],
        refused_outputs: Vec::new(),
        haptic_pens: vec![hid_pen("haptic:1", Access::Granted)],
        n_inputs: 2,
        refused_inputs: Vec::new(),
        has_priority: true,
        styluses: StylusList { styluses: vec![pen(Access::Granted)], warning: None },
        serial_ports: Ok(vec![port(Access::Granted)]),
        displays: displays(DisplayFact::Responds, DisplayFact::Responds),
        graphics_cards: vec![("/dev/dri/renderD128".to_owned(), Access::Granted)],
        libraries: Some(KNOWN_LIBRARIES.iter().map(|library| library.file.to_owned()).collect()),
        has_portal: true,
        has_zenity: false,
        folders: vec![folder("settings"), folder("networks")],
        networks: NetworkFacts {
            pictures: Ok(Some("EfficientNet-Lite0".to_owned())),
            diffusion: Ok(Some("model".to_owned())),
        },
    }
}

/// A machine without anything, such as a container.
fn stripped() -> Facts {
    Facts {
        sound_server: SoundServer::Missing,
        outputs: vec![output("null", OutputKind::Null, false)],
        haptic_pens: Vec::new(),
        n_inputs: 0,
        has_priority: false,
        styluses: StylusList { styluses: Vec::new(), warning: None },
        serial_ports: Ok(Vec::new()),
        displays: displays(DisplayFact::Unset, DisplayFact::Unset),
        graphics_cards: Vec::new(),
        libraries: Some(Vec::new()),
        has_portal: false,
        folders: vec![FolderFact { content: "settings", path: None, access: Access::Unknown }],
        networks: NetworkFacts { pictures: Ok(None), diffusion: Ok(None) },
        ..whole()
    }
}

/// The only line of a topic.
#[track_caller]
fn line(facts: &Facts, topic: &str) -> Line {
    let mut found: Vec<Line> = lines(facts).into_iter().filter(|line| line.topic == topic).collect();
    assert_eq!(found.len(), 1, "{found:?}");
    found.remove(0)
}

/// The state of a topic; what was seen and the remedy contain these words.
#[track_caller]
fn check(facts: &Facts, topic: &str, state: State, seen: &str, remedy: &str) {
    let line = line(facts, topic);
    assert_eq!(line.state, state, "{line:?}");
    assert!(line.seen.contains(seen), "{line:?}");
    assert!(line.remedy.as_deref().unwrap_or_default().contains(remedy), "{line:?}");
}

#[test]
fn a_whole_machine_needs_nothing() {
    for line in lines(&whole()) {
        assert_eq!((line.state, &line.remedy), (State::Works, &None), "{line:?}");
    }
}

#[test]
fn whatever_is_not_fine_has_a_remedy() {
    let refused = Facts {
        haptic_pens: vec![hid_pen("haptic:1", Access::Exclusive)],
        displays: displays(DisplayFact::Silent, DisplayFact::Untried),
        styluses: StylusList {
            styluses: vec![pen(Access::Denied), pen(Access::Exclusive)],
            warning: Some(DeviceError::new(DeviceErrorKind::Unavailable, "devices cannot be listed")),
        },
        serial_ports: Err("the ports cannot be listed".to_owned()),
        libraries: None,
        networks: NetworkFacts { pictures: Err("damaged".to_owned()), diffusion: Err("damaged".to_owned()) },
        ..stripped()
    };
    for system in
        [OperatingSystem::Linux, OperatingSystem::MacOs, OperatingSystem::Windows, OperatingSystem::Other]
    {
        for facts in [whole(), stripped(), refused.clone()] {
            for line in lines(&Facts { system, ..facts }) {
                let is_fine = matches!(line.state, State::Works | State::Absent);
                assert_eq!(line.remedy.is_none(), is_fine, "{system:?}: {line:?}");
                assert!(!line.seen.is_empty());
            }
        }
    }
}

#[test]
fn a_machine_without_sound() {
    let silent = Facts { sound_server: SoundServer::Missing, outputs: Vec::new(), n_inputs: 0, ..whole() };
    check(&silent, "sound server", State::Fails, "no sound server", "systemctl --user start pipewire");
    check(&silent, "outputs", State::Fails, "no audio output", "aplay -l");
    check(&silent, "audio inputs", State::Absent, "calibrate", "");
    // With outputs of ALSA, the server is missing only for convenience.
    let alsa = Facts { sound_server: SoundServer::Missing, ..whole() };
    check(&alsa, "sound server", State::Limited, "only ALSA", "pipewire");
    let broken = Facts { sound_server: SoundServer::Fails("timed out".to_owned()), ..whole() };
    check(&broken, "sound server", State::Fails, "timed out", "restart");
    let other =
        Facts { system: OperatingSystem::Windows, sound_server: SoundServer::Unused, ..silent.clone() };
    assert!(lines(&other).iter().all(|line| line.topic != "sound server"));
    check(&other, "outputs", State::Fails, "no audio output", "sound settings");
    check(&whole(), "outputs", State::Works, "1 audio output; default: Output pulse:a", "");
    check(&whole(), "haptic pens", State::Works, "Test pen (haptic:1), which plays an approximation", "");
}

/// Outputs or inputs that the system does not open.
fn refusals(what: &str, ids: &[&str], kind: DeviceErrorKind) -> Vec<(String, DeviceError)> {
    let refusal = |id: &&str| {
        let message = format!("the {what} `{id}` cannot be queried for its formats: no card; choose another");
        ((*id).to_owned(), DeviceError::new(kind, message))
    };
    ids.iter().map(refusal).collect()
}

#[test]
fn an_output_works_only_if_it_opens() {
    let refused = |ids: &[&str], kind| {
        let outputs = vec![
            output("null", OutputKind::Null, false),
            output("alsa:a", OutputKind::Audio, true),
            output("alsa:b", OutputKind::Audio, false),
        ];
        Facts { outputs, refused_outputs: refusals("output", ids, kind), ..whole() }
    };
    let gone = DeviceErrorKind::NotFound;
    let none = refused(&["alsa:a", "alsa:b"], gone);
    check(&none, "outputs", State::Fails, "2 audio outputs are listed, and none opens", "aplay -l");
    check(&none, "outputs", State::Fails, "`alsa:a` cannot be queried", "the silent output always works");
    check(&refused(&["alsa:a"], gone), "outputs", State::Limited, "the default output", "opens: alsa:b");
    check(&refused(&["alsa:b"], gone), "outputs", State::Works, "1 of 2 audio outputs can be opened", "");
    check(&refused(&[], gone), "outputs", State::Works, "2 audio outputs; default", "");
    let busy = refused(&["alsa:a", "alsa:b"], DeviceErrorKind::Busy);
    check(&busy, "outputs", State::Limited, "none opens", "close the program");
    let missing = Facts { sound_server: SoundServer::Missing, ..none };
    check(&missing, "sound server", State::Fails, "no sound server", "pipewire");
}

#[test]
fn an_input_works_only_if_it_opens() {
    let refused = |ids: &[&str], kind| Facts { refused_inputs: refusals("input", ids, kind), ..whole() };
    let (topic, gone) = ("audio inputs", DeviceErrorKind::NotFound);
    let none = refused(&["alsa:a", "alsa:b"], gone);
    check(&none, topic, State::Absent, "2 audio inputs are listed, and none opens", "");
    check(&none, topic, State::Absent, "`alsa:a` cannot be queried", "");
    check(&none, topic, State::Absent, "only `calibrate` and `latency` need one", "");
    check(&refused(&["alsa:b"], gone), topic, State::Works, "1 of 2 audio inputs can be opened", "");
    check(&refused(&[], gone), topic, State::Works, "2 audio inputs", "");
    let busy = refused(&["alsa:a", "alsa:b"], DeviceErrorKind::Busy);
    check(&busy, topic, State::Limited, "none opens", "close the program");
}

#[test]
fn a_machine_without_a_display() {
    let dark = stripped();
    check(&dark, "display", State::Fails, "neither DISPLAY nor WAYLAND_DISPLAY", "graphical session");
    check(&dark, "graphics", State::Limited, "no graphics card", "driver");
    // Without a display, only the libraries of every window are missed.
    check(&dark, "libraries", State::Fails, "missing: libxkbcommon.so.0, libEGL.so.1", "apt install");
    check(&dark, "file dialogs", State::Limited, "typed", "zenity");
    let x11 = Facts { displays: displays(DisplayFact::Responds, DisplayFact::Unset), ..stripped() };
    check(&x11, "display", State::Works, "X11", "");
    check(&x11, "libraries", State::Fails, "libX11.so.6", "libx11-6 libx11-xcb1");
    assert!(line(&x11, "libraries").seen.ends_with("libEGL.so.1, libGL.so.1"));
    // The window is on the Wayland display if there are both.
    let wayland = whole();
    check(&wayland, "display", State::Works, "Wayland", "");
    check(&wayland, "libraries", State::Works, "all", "");
    let missing = Facts { libraries: Some(Vec::new()), ..wayland };
    check(&missing, "libraries", State::Fails, "libwayland-client.so.0", "libwayland-egl1");
    let seen = line(&missing, "libraries").seen;
    assert!(!seen.contains("libX11") && !seen.contains("libGL.so"), "{seen}");
    // Other systems have their window system, and neither cards nor libraries of Linux.
    let mac = Facts { system: OperatingSystem::MacOs, ..stripped() };
    check(&mac, "display", State::Works, "window system", "");
    assert!(lines(&mac).iter().all(|line| !["graphics", "libraries", "file dialogs"].contains(&line.topic)));
}

#[test]
fn a_display_that_does_not_respond_is_a_failure() {
    let with = |x11, wayland| Facts { displays: displays(x11, wayland), ..whole() };
    let silent = with(DisplayFact::Silent, DisplayFact::Unset);
    check(&silent, "display", State::Fails, "no X11 display responds where DISPLAY says", "DISPLAY");
    let silent = with(DisplayFact::Responds, DisplayFact::Silent);
    check(&silent, "display", State::Fails, "no Wayland display", "correct WAYLAND_DISPLAY");
    let away = with(DisplayFact::Untried, DisplayFact::Unset);
    check(&away, "display", State::Unknown, "X11, on another computer", "open the window");
}

#[test]
fn either_library_of_opengl_is_enough_on_x11() {
    for (gone, is_enough_on_wayland) in [("libEGL.so.1", false), ("libGL.so.1", true)] {
        let rest = KNOWN_LIBRARIES.iter().map(|library| library.file).filter(|file| *file != gone);
        let libraries = Some(rest.map(str::to_owned).collect());
        let on_wayland = Facts { libraries, ..whole() };
        let state = if is_enough_on_wayland { State::Works } else { State::Fails };
        assert_eq!(line(&on_wayland, "libraries").state, state, "{gone}");
        let x11 = displays(DisplayFact::Responds, DisplayFact::Unset);
        check(&Facts { displays: x11, ..on_wayland }, "libraries", State::Works, "all", "");
    }
}

#[test]
fn a_machine_without_permissions() {
    let refused = Facts {
        haptic_pens: vec![hid_pen("haptic:1", Access::Denied)],
        styluses: StylusList { styluses: vec![pen(Access::Denied)], warning: None },
        serial_ports: Ok(vec![port(Access::Denied)]),
        graphics_cards: vec![("/dev/dri/renderD128".to_owned(), Access::Denied)],
        has_priority: false,
        folders: vec![FolderFact {
            content: "settings",
            path: Some(PathBuf::from("/nowhere")),
            access: Access::Denied,
        }],
        ..whole()
    };
    check(&refused, "pens", State::Fails, "Test pen (hid:056a:0374), by HID", "KERNEL==\"hidraw*\"");
    let rule = "ATTRS{idVendor}==\"056a\", ATTRS{idProduct}==\"0374\", TAG+=\"uaccess\"";
    check(&refused, "haptic pens", State::Fails, "Test pen (haptic:1)", rule);
    // What the system keeps for itself, it passes on in another way.
    let kept = StylusList { styluses: vec![pen(Access::Exclusive)], warning: None };
    let kept = Facts { styluses: kept, ..whole() };
    check(&kept, "pens", State::Limited, "the system keeps it for itself", "KERNEL");
    check(&refused, "serial ports", State::Fails, "/dev/ttyACM0", "usermod -aG dialout");
    check(&refused, "graphics", State::Limited, "/dev/dri/renderD128", "video,render");
    check(&refused, "real-time priority", State::Limited, "dropouts", "@audio - rtprio");
    check(&refused, "folders", State::Fails, "settings cannot be written to /nowhere", "read-only");
    check(&whole(), "pens", State::Works, "position in mm, pressure, tilt", "");
}

#[test]
fn what_is_not_there_is_no_failure() {
    let bare = stripped();
    check(&bare, "pens", State::Absent, "the mouse", "");
    check(&bare, "serial ports", State::Absent, "microcontrollers", "");
    check(&bare, "image network", State::Absent, "shagreen model fetch", "");
    check(&bare, "diffusion model", State::Absent, "shagreen model add", "");
    check(&bare, "folders", State::Limited, "no home folder", "HOME");
    let damaged = Facts {
        networks: NetworkFacts { pictures: Err("it is damaged".to_owned()), diffusion: Ok(None) },
        ..stripped()
    };
    check(&damaged, "image network", State::Fails, "it is damaged", "shagreen model fetch");
    let ids: Vec<&str> = State::ALL.iter().map(|state| state.id()).collect();
    assert_eq!(ids, ["works", "limited", "fails", "absent", "unknown"]);
}
