//! Pens and microcontrollers.

use shagreen_device::operating_system::OperatingSystem;
use shagreen_device::pen_backend::Access;
use shagreen_device::stylus::{StylusInfo, StylusKind};

use super::{Facts, Line, State, denied};
use crate::pen_backends::{backend_name, provided};

/// Lines about pens and serial ports.
pub(super) fn lines(facts: &Facts) -> Vec<Line> {
    let mut lines = pens(facts);
    lines.push(serial_ports(facts));
    lines
}

fn pens(facts: &Facts) -> Vec<Line> {
    let topic = "pens";
    let mut lines: Vec<Line> = Vec::new();
    if let Some(warning) = &facts.styluses.warning {
        lines.push(
            Line::new(topic, State::Fails, warning.message())
                .with("check the permissions of input devices, and run `shagreen doctor` again"),
        );
    }
    let pens = facts.styluses.styluses.iter().filter(|stylus| stylus.kind == StylusKind::Pen);
    lines.extend(pens.map(pen));
    if lines.is_empty() {
        lines.push(Line::new(
            topic,
            State::Absent,
            "no pen is connected; the mouse strokes with a set force",
        ));
    }
    lines
}

fn pen(pen: &StylusInfo) -> Line {
    let (backend, provided) = (backend_name(pen.backend), provided(&pen.provides));
    let seen = format!("{} ({}), by {backend}: {provided}", pen.name, pen.id);
    match &pen.advice {
        None => Line::new("pens", State::Works, seen),
        // The system passes on what it reads itself, so that such a pen works in another way.
        Some(advice) if pen.access == Access::Exclusive => {
            Line::new("pens", State::Limited, format!("{seen}; the system keeps it for itself")).with(advice)
        }
        Some(advice) => Line::new("pens", State::Fails, format!("{seen}; it may not be read")).with(advice),
    }
}

fn serial_ports(facts: &Facts) -> Line {
    let topic = "serial ports";
    let ports = match &facts.serial_ports {
        Err(reason) => {
            return Line::new(topic, State::Unknown, reason)
                .with("run `shagreen devices` again after connecting the microcontroller");
        }
        Ok(ports) if ports.is_empty() => {
            return Line::new(topic, State::Absent, "there is none, which only microcontrollers need");
        }
        Ok(ports) => ports,
    };
    let refused = denied(ports, |port| port.port.as_str());
    if refused.is_empty() {
        let names: Vec<&str> = ports.iter().map(|(port, _)| port.name.as_str()).collect();
        return Line::new(topic, State::Works, names.join(", "));
    }
    let line = Line::new(topic, State::Fails, format!("no permission for {}", refused.join(", ")));
    match facts.system {
        OperatingSystem::Linux => line
            .with("join the group with `sudo usermod -aG dialout $USER` (on Arch, `uucp`), and log in again"),
        _ => line.with("close the program that uses the port, or allow access in the settings of the system"),
    }
}
