//! Backends of pens in words: their names, and what each provides.

use shagreen_device::pen_backend::{Access, Backend, PositionUnit, Provides};

/// Id of a backend, for scripts.
pub fn backend_id(backend: Backend) -> &'static str {
    match backend {
        Backend::Hid => "hid",
        Backend::RawInput => "raw-input",
        Backend::Window => "window",
        Backend::Mouse => "mouse",
    }
}

/// Name of a backend.
pub fn backend_name(backend: Backend) -> &'static str {
    match backend {
        Backend::Hid => "HID",
        Backend::RawInput => "Raw Input (untried)",
        Backend::Window => "window pointer",
        Backend::Mouse => "mouse",
    }
}

/// Id of an access, for scripts.
pub fn access_id(access: Access) -> &'static str {
    match access {
        Access::Granted => "granted",
        Access::Denied => "denied",
        Access::Exclusive => "exclusive",
        Access::Unknown => "unknown",
    }
}

/// The quantities that a backend provides, as a list in words.
pub fn provided(provides: &Provides) -> String {
    let position = match provides.position {
        Some(PositionUnit::Millimeters) => "position in mm",
        Some(PositionUnit::Fraction) => "position without a size",
        Some(PositionUnit::WindowPoints) => "position in the window",
        None => "position",
    };
    let quantities = [
        (provides.pressure, "pressure", "set force"),
        (provides.tilt, "tilt", ""),
        (provides.clock, "clock of its own", ""),
    ];
    let words = quantities.iter().filter_map(|(is_provided, name, otherwise)| match is_provided {
        Some(true) => Some((*name).to_owned()),
        Some(false) => (!otherwise.is_empty()).then(|| (*otherwise).to_owned()),
        None => Some(format!("perhaps {name}")),
    });
    std::iter::once(position.to_owned()).chain(words).collect::<Vec<_>>().join(", ")
}

#[cfg(test)]
mod tests {
    use super::{PositionUnit, Provides, provided};

    #[test]
    fn what_a_backend_provides_is_said_in_words() {
        let pen = Provides {
            position: Some(PositionUnit::Millimeters),
            pressure: Some(true),
            tilt: Some(true),
            clock: Some(false),
        };
        assert_eq!(provided(&pen), "position in mm, pressure, tilt");
        assert_eq!(provided(&Provides::MOUSE), "position in the window, set force");
        let unknown = "position, perhaps pressure, perhaps tilt, perhaps clock of its own";
        assert_eq!(provided(&Provides::UNKNOWN), unknown);
    }
}
