//! Sound server, outputs, inputs and priority.

use shagreen_device::error::{DeviceError, DeviceErrorKind};
use shagreen_device::haptic_pen::system::refused_on;
use shagreen_device::operating_system::OperatingSystem;
use shagreen_device::output::{OutputInfo, OutputKind};
use shagreen_device::sound_server::SoundServer;

use super::{Facts, Line, State};

/// Limits of real-time priority on Linux: the file, and a line that permits it to the group `audio`.
const LIMITS_FILE: &str = "/etc/security/limits.d/95-shagreen.conf";
const LIMITS_LINE: &str = "@audio - rtprio 20";

/// Lines about sound.
pub(super) fn lines(facts: &Facts) -> Vec<Line> {
    let mut lines = Vec::new();
    lines.extend(server(facts));
    lines.push(outputs(facts));
    lines.extend(haptic_pens(facts));
    lines.push(inputs(facts));
    lines.push(priority(facts));
    lines
}

fn of_kind(facts: &Facts, kind: OutputKind) -> Vec<&OutputInfo> {
    facts.outputs.iter().filter(|output| output.kind == kind).collect()
}

/// Why the system does not open an output.
fn refusal<'a>(facts: &'a Facts, output: &OutputInfo) -> Option<&'a DeviceError> {
    facts.refused_outputs.iter().find(|(id, _)| *id == output.id).map(|(_, error)| error)
}

/// Whether there is an audio output that opens, now or when no other program uses it.
fn has_working(facts: &Facts) -> bool {
    let is_busy = |error: &DeviceError| error.kind() == DeviceErrorKind::Busy;
    of_kind(facts, OutputKind::Audio).into_iter().any(|output| refusal(facts, output).is_none_or(is_busy))
}

fn server(facts: &Facts) -> Option<Line> {
    let topic = "sound server";
    let start = "start it, for example with `systemctl --user start pipewire pipewire-pulse`";
    match &facts.sound_server {
        SoundServer::Unused => None,
        SoundServer::Responds(name) => {
            let name = if name.is_empty() { "a sound server" } else { name.as_str() };
            Some(Line::new(topic, State::Works, format!("{name} responds")))
        }
        SoundServer::Missing if !has_working(facts) => {
            Some(Line::new(topic, State::Fails, "no sound server runs in this session").with(start))
        }
        SoundServer::Missing => Some(
            Line::new(topic, State::Limited, "no sound server runs in this session; only ALSA has outputs")
                .with(format!(
                    "{start}; with a server, an output can be kept although other programs play too"
                )),
        ),
        SoundServer::Fails(reason) => Some(
            Line::new(topic, State::Fails, format!("the sound server does not respond: {reason}"))
                .with("restart it, for example with `systemctl --user restart pipewire pipewire-pulse`"),
        ),
    }
}

fn outputs(facts: &Facts) -> Line {
    let topic = "outputs";
    let audio = of_kind(facts, OutputKind::Audio);
    if audio.is_empty() {
        return Line::new(topic, State::Fails, "there is no audio output").with(connect_one(facts.system));
    }
    let n = audio.len();
    let reasons: Vec<&DeviceError> = audio.iter().filter_map(|output| refusal(facts, output)).collect();
    if reasons.len() == n {
        let (seen, is_busy) = none_opens("output", &reasons);
        return if is_busy {
            Line::new(topic, State::Limited, seen).with("close the program that uses the output")
        } else {
            Line::new(topic, State::Fails, seen).with(connect_one(facts.system))
        };
    }
    let default = audio.iter().find(|output| output.is_default);
    if let Some((output, error)) = default.and_then(|output| Some((output, refusal(facts, output)?))) {
        let working = audio.iter().filter(|output| refusal(facts, output).is_none());
        let ids: Vec<&str> = working.map(|output| output.id.as_str()).collect();
        let seen = format!("the default output, {}, does not open: {}", output.name, error.message());
        return Line::new(topic, State::Limited, seen)
            .with(format!("choose an output that opens: {}", ids.join(", ")));
    }
    let default =
        default.map_or("none is the default".to_owned(), |output| format!("default: {}", output.name));
    let seen = match (n, n - reasons.len()) {
        (1, _) => format!("1 audio output; {default}"),
        (n, n_working) if n_working == n => format!("{n} audio outputs; {default}"),
        (n, n_working) => format!("{n_working} of {n} audio outputs can be opened; {default}"),
    };
    Line::new(topic, State::Works, seen)
}

/// What to do without an audio output.
fn connect_one(system: OperatingSystem) -> &'static str {
    match system {
        OperatingSystem::Linux => {
            "connect a sound card or an amplifier with USB, and check with `aplay -l` that Linux knows it; the silent output always works"
        }
        _ => {
            "connect a sound card or an amplifier with USB, and check it in the sound settings of the system; the silent output always works"
        }
    }
}

/// Says that no output or input opens, with a reason. Returns also whether another program uses one of them.
fn none_opens(what: &str, reasons: &[&DeviceError]) -> (String, bool) {
    let busy = reasons.iter().find(|error| error.kind() == DeviceErrorKind::Busy);
    let reason = busy.or(reasons.first()).map_or("", |error| error.message());
    let seen = match reasons.len() {
        1 => format!("1 audio {what} is listed, and it does not open: {reason}"),
        n => format!("{n} audio {what}s are listed, and none opens; for example, {reason}"),
    };
    (seen, busy.is_some())
}

fn haptic_pens(facts: &Facts) -> impl Iterator<Item = Line> + '_ {
    facts.haptic_pens.iter().map(move |pen| {
        let seen = format!("{} ({}), which plays an approximation", pen.name, pen.id);
        if pen.access.may_open() {
            return Line::new("haptic pens", State::Works, seen);
        }
        Line::new("haptic pens", State::Fails, format!("{seen}; it may not be driven"))
            .with(refused_on(facts.system, pen))
    })
}

fn inputs(facts: &Facts) -> Line {
    let topic = "audio inputs";
    let reasons: Vec<&DeviceError> = facts.refused_inputs.iter().map(|(_, error)| error).collect();
    let seen = match (facts.n_inputs, facts.n_inputs.saturating_sub(reasons.len())) {
        (0, _) => {
            let seen = "there is no audio input, which only `calibrate` and `latency` need";
            return Line::new(topic, State::Absent, seen);
        }
        (_, 0) => {
            let (seen, is_busy) = none_opens("input", &reasons);
            return if is_busy {
                Line::new(topic, State::Limited, seen).with("close the program that uses the input")
            } else {
                let seen = format!("{seen}; only `calibrate` and `latency` need one");
                Line::new(topic, State::Absent, seen)
            };
        }
        (1, _) => "1 audio input".to_owned(),
        (n, n_working) if n_working == n => format!("{n} audio inputs"),
        (n, n_working) => format!("{n_working} of {n} audio inputs can be opened"),
    };
    Line::new(topic, State::Works, seen)
}

fn priority(facts: &Facts) -> Line {
    let topic = "real-time priority";
    if facts.has_priority {
        return Line::new(topic, State::Works, "the system grants it to the threads of outputs and pens");
    }
    let line = Line::new(
        topic,
        State::Limited,
        "the system refuses it; on a busy machine, the output may have dropouts",
    );
    match facts.system {
        OperatingSystem::Linux => line.with(format!(
            "write the line `{LIMITS_LINE}` into {LIMITS_FILE}, join the group with `sudo usermod -aG audio $USER`, and log in again; or use a larger buffer"
        )),
        _ => line.with("close other programs, or use a larger buffer"),
    }
}
