//! Backends: the ways to read a stylus, what each provides, and whether the system permits it.

/// Way to read a stylus. The order is that of preference between ways that provide the same.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Backend {
    /// Reports of the device, read by HID: see [`crate::hid`].
    Hid,
    /// Reports of the device that Windows passes on (Raw Input), because it opens pens exclusively. This backend was
    /// compiled, but never tried with a device.
    RawInput,
    /// Pointer events of the window system.
    Window,
    /// The mouse, with a set force.
    Mouse,
}

/// Unit of the positions that a backend states.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum PositionUnit {
    /// Millimeters on the active area of the device.
    Millimeters,
    /// Fractions of an active area whose size the device does not declare.
    Fraction,
    /// Points of the window.
    WindowPoints,
}

/// Quantities that a backend provides. `None` is unknown until the device is read.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Provides {
    /// Unit of the positions.
    pub position: Option<PositionUnit>,
    /// Whether pressure or force is reported.
    pub pressure: Option<bool>,
    /// Whether tilt is reported.
    pub tilt: Option<bool>,
    /// Whether reports carry the time of the device's own clock.
    pub clock: Option<bool>,
}

impl Provides {
    /// A device that has not been read.
    pub const UNKNOWN: Self = Self { position: None, pressure: None, tilt: None, clock: None };
    /// The mouse.
    pub const MOUSE: Self = Self {
        position: Some(PositionUnit::WindowPoints),
        pressure: Some(false),
        tilt: Some(false),
        clock: Some(false),
    };
    /// Pointer events of the window system. Only Windows passes on the pressure of pens; none passes on their tilt.
    pub const WINDOW: Self = Self { pressure: Some(cfg!(windows)), ..Self::MOUSE };
}

/// Whether this program may read a device, as far as the system states it without opening the device.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Access {
    /// Permitted.
    Granted,
    /// Refused by the system's permissions.
    Denied,
    /// The system reads the device itself and lets no program open it.
    Exclusive,
    /// Unknown before the device is opened.
    Unknown,
}

impl Access {
    /// Whether it is worth while to open the device.
    pub fn may_open(self) -> bool {
        matches!(self, Self::Granted | Self::Unknown)
    }

    /// Permission of this process to read and write the file `path`, which is not opened. Unknown on systems without
    /// file permissions for devices.
    pub fn to_file(path: &str) -> Self {
        #[cfg(unix)]
        {
            use rustix::fs::{Access as Flags, access};
            use rustix::io::Errno;
            match access(path, Flags::READ_OK | Flags::WRITE_OK) {
                Ok(()) => Self::Granted,
                Err(Errno::ACCESS | Errno::PERM | Errno::ROFS) => Self::Denied,
                Err(_) => Self::Unknown,
            }
        }
        #[cfg(not(unix))]
        {
            let _ = path;
            Self::Unknown
        }
    }
}

#[cfg(test)]
mod tests {
    use super::Access;

    #[test]
    fn the_permission_of_a_file_is_told_without_opening_it() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("device");
        std::fs::write(&path, "").unwrap();
        let told = |path: &std::path::Path| Access::to_file(path.to_str().unwrap());
        if cfg!(unix) {
            assert_eq!(told(&path), Access::Granted);
        }
        assert_eq!(told(&folder.path().join("none")), Access::Unknown);
        assert!(Access::Granted.may_open() && Access::Unknown.may_open());
        assert!(!Access::Denied.may_open() && !Access::Exclusive.may_open());
    }
}
