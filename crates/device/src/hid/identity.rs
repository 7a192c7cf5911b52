//! Identity of pens: ids that stay the same after replugging, and instructions for refused access.

use crate::error::{DeviceError, DeviceErrorKind};
use crate::operating_system::OperatingSystem;
use crate::pen_backend::{Access, Backend, Provides};

/// Connection type of a device.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum HidBus {
    /// USB cable.
    Usb,
    /// Bluetooth.
    Bluetooth,
    /// I2C bus (built-in device).
    I2c,
    /// Any other connection.
    Other,
}

/// A pen of this machine.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct HidPen {
    /// Id by which the pen is chosen: `hid:VENDOR:PRODUCT` (`raw:VENDOR:PRODUCT` for Raw Input), with the serial number
    /// if it has one. Pens with equal ids get the interface number added or, as a last resort, the path, which may
    /// change.
    pub id: String,
    /// Display name.
    pub name: String,
    /// Vendor id, assigned by the USB Implementers Forum.
    pub vendor_id: u16,
    /// Product id, assigned by the vendor.
    pub product_id: u16,
    /// Serial number, if it has one.
    pub serial: Option<String>,
    /// Interface number, if the device has several interfaces.
    pub interface: Option<u8>,
    /// Current device path in the system.
    pub path: String,
    /// Connection type.
    pub bus: HidBus,
    /// How it is read.
    pub backend: Backend,
    /// Quantities that it provides, as far as they are known before it is opened.
    pub provides: Provides,
    /// Whether this program may read it.
    pub access: Access,
}

/// Prefix of the ids of pens that are read by HID.
pub const HID_PREFIX: &str = "hid:";
/// Prefix of the ids of pens that are read by Raw Input.
pub const RAW_PREFIX: &str = "raw:";

/// Returns the pens with their ids set, sorted by id.
pub fn with_ids(mut pens: Vec<HidPen>) -> Vec<HidPen> {
    pens.sort_by(|a, b| (&a.path, a.backend).cmp(&(&b.path, b.backend)));
    pens.dedup_by(|b, a| a.path == b.path && a.backend == b.backend);
    for pen in &mut pens {
        let prefix = if pen.backend == Backend::RawInput { RAW_PREFIX } else { HID_PREFIX };
        pen.id = format!("{prefix}{:04x}:{:04x}", pen.vendor_id, pen.product_id);
        if let Some(serial) = pen.serial.as_deref().map(str::trim).filter(|serial| !serial.is_empty()) {
            // Ids are typed and stored, so they have no spaces or control characters.
            let plain = serial.chars().map(|c| if c.is_ascii_graphic() { c } else { '_' });
            pen.id.push(':');
            pen.id.extend(plain.take(64));
        }
    }
    tell_apart(&mut pens, |pen| pen.interface.map(|interface| format!("#{interface}")));
    tell_apart(&mut pens, |pen| Some(format!("@{}", pen.path)));
    pens.sort_by(|a, b| a.id.cmp(&b.id));
    pens
}

/// Appends a distinguishing suffix to ids that occur more than once.
fn tell_apart(pens: &mut [HidPen], what: impl Fn(&HidPen) -> Option<String>) {
    let ids: Vec<String> = pens.iter().map(|pen| pen.id.clone()).collect();
    for pen in pens {
        if ids.iter().filter(|id| **id == pen.id).count() > 1
            && let Some(what) = what(pen)
        {
            pen.id.push_str(&what);
        }
    }
}

/// Path of the file for the rule of [`udev_rule`].
pub const UDEV_RULES_FILE: &str = "/etc/udev/rules.d/70-shagreen-pen.rules";

/// The udev rule that lets the logged-in person read the pen.
pub fn udev_rule(pen: &HidPen) -> String {
    let (vendor_id, product_id) = (pen.vendor_id, pen.product_id);
    let device = match pen.bus {
        HidBus::Usb => {
            format!("ATTRS{{idVendor}}==\"{vendor_id:04x}\", ATTRS{{idProduct}}==\"{product_id:04x}\"")
        }
        // Only USB devices have these attributes; others are matched by the name of their parent device.
        _ => format!("KERNELS==\"*:{vendor_id:04X}:{product_id:04X}.*\""),
    };
    format!("KERNEL==\"hidraw*\", {device}, TAG+=\"uaccess\"")
}

/// Error for a pen whose access the system refuses, with instructions.
pub(crate) fn denied(pen: &HidPen) -> DeviceError {
    DeviceError::new(DeviceErrorKind::Denied, denied_on(OperatingSystem::HERE, pen))
}

/// Says that the system refuses access to a pen, and what to do about it.
pub fn denied_on(system: OperatingSystem, pen: &HidPen) -> String {
    let HidPen { name, path, .. } = pen;
    match system {
        OperatingSystem::Linux => {
            let rule = udev_rule(pen);
            format!(
                "the system does not let you read the pen {name} ({path}). Write the line\n  {rule}\ninto {UDEV_RULES_FILE}, for example by\n  echo '{rule}' | sudo tee {UDEV_RULES_FILE}\nthen run\n  sudo udevadm control --reload && sudo udevadm trigger\nand plug the pen in again"
            )
        }
        OperatingSystem::MacOs => format!(
            "macOS does not let this program read the pen {name}: open System Settings > Privacy & Security > Input Monitoring, turn on Shagreen, or the terminal that started it, and start Shagreen again"
        ),
        OperatingSystem::Windows => format!(
            "Windows opens pens exclusively, so that {name} cannot be read by HID: select the same pen with Raw Input, or the window pointer"
        ),
        OperatingSystem::Other => format!(
            "the system does not let you read the pen {name} ({path}): ask its administrator for permission to read this device"
        ),
    }
}

#[cfg(test)]
mod tests {
    use super::{
        Access, Backend, HidBus, HidPen, OperatingSystem, Provides, denied, denied_on, udev_rule, with_ids,
    };
    use crate::error::DeviceErrorKind;

    fn pen(path: &str, serial: Option<&str>, interface: Option<u8>) -> HidPen {
        HidPen {
            id: String::new(),
            name: "Pen".into(),
            vendor_id: 0x056a,
            product_id: 0x0374,
            serial: serial.map(str::to_owned),
            interface,
            path: path.into(),
            bus: HidBus::Usb,
            backend: Backend::Hid,
            provides: Provides::UNKNOWN,
            access: Access::Unknown,
        }
    }

    fn ids(pens: Vec<HidPen>) -> Vec<String> {
        with_ids(pens).into_iter().map(|pen| pen.id).collect()
    }

    #[test]
    fn names_do_not_depend_on_where_a_pen_is() {
        let one = ids(vec![pen("/dev/hidraw3", Some("8JH 01\n"), Some(0))]);
        assert_eq!(one, ["hid:056a:0374:8JH_01_".trim_end_matches('_')]);
        assert_eq!(one, ids(vec![pen("/dev/hidraw7", Some("8JH 01"), Some(0))]));
        assert_eq!(ids(vec![pen("/dev/hidraw3", Some("  "), None)]), ["hid:056a:0374"]);
        // The system lists a pen once for each of its usages.
        assert_eq!(ids(vec![pen("a", None, None), pen("a", None, None)]), ["hid:056a:0374"]);
    }

    #[test]
    fn equal_pens_are_told_apart() {
        let both = ids(vec![pen("b", Some("1"), None), pen("a", Some("2"), None)]);
        assert_eq!(both, ["hid:056a:0374:1", "hid:056a:0374:2"]);
        let interfaces = ids(vec![pen("a", None, Some(0)), pen("b", None, Some(1))]);
        assert_eq!(interfaces, ["hid:056a:0374#0", "hid:056a:0374#1"]);
        let paths = ids(vec![pen("a", None, Some(0)), pen("b", None, Some(0))]);
        assert_eq!(paths, ["hid:056a:0374#0@a", "hid:056a:0374#0@b"]);
        assert_eq!(
            ids(vec![pen("a", None, None), pen("b", None, None)]),
            ["hid:056a:0374@a", "hid:056a:0374@b"]
        );
    }

    #[test]
    fn a_refused_pen_says_what_to_do() {
        let usb = pen("/dev/hidraw3", None, None);
        let rule = r#"KERNEL=="hidraw*", ATTRS{idVendor}=="056a", ATTRS{idProduct}=="0374", TAG+="uaccess""#;
        assert_eq!(udev_rule(&usb), rule);
        let error = denied(&usb);
        assert_eq!(error.kind(), DeviceErrorKind::Denied);
        if cfg!(target_os = "linux") {
            for part in [rule, "/etc/udev/rules.d/70-shagreen-pen.rules", "udevadm control --reload"] {
                assert!(error.message().contains(part), "{part}");
            }
        }
        for (system, part) in [
            (OperatingSystem::Linux, "udevadm trigger"),
            (OperatingSystem::MacOs, "Privacy & Security > Input Monitoring"),
            (OperatingSystem::Windows, "Raw Input"),
            (OperatingSystem::Other, "administrator"),
        ] {
            let told = denied_on(system, &usb);
            assert!(told.contains(part) && told.contains("Pen"), "{told}");
        }
        let raw = HidPen { backend: Backend::RawInput, ..usb.clone() };
        assert_eq!(ids(vec![raw]), ["raw:056a:0374"]);
        let built_in = HidPen { bus: HidBus::I2c, ..usb };
        assert_eq!(udev_rule(&built_in), r#"KERNEL=="hidraw*", KERNELS=="*:056A:0374.*", TAG+="uaccess""#);
    }
}
