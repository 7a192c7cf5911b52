//! Identity of pens: ids that stay the same after replugging, and instructions for refused access.

use crate::error::{DeviceError, DeviceErrorKind};

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
    /// Id by which the pen is chosen: `hid:VENDOR:PRODUCT`, with the serial number if it has one. Pens with equal ids
    /// get the interface number added or, as a last resort, the path, which may change.
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
    /// Whether it reports pressure; `None` if this is unknown before the pen is opened.
    pub has_pressure: Option<bool>,
}

/// Returns the pens with their ids set, sorted by id.
pub fn with_ids(mut pens: Vec<HidPen>) -> Vec<HidPen> {
    pens.sort_by(|a, b| a.path.cmp(&b.path));
    pens.dedup_by(|b, a| a.path == b.path);
    for pen in &mut pens {
        pen.id = format!("hid:{:04x}:{:04x}", pen.vendor_id, pen.product_id);
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
    let message = if cfg!(target_os = "linux") {
        format!(
            "the system does not let you read the pen {} ({}). Write the line\n  {}\ninto {UDEV_RULES_FILE}, for example by\n  echo '{}' | sudo tee {UDEV_RULES_FILE}\nthen run\n  sudo udevadm control --reload && sudo udevadm trigger\nand plug the pen in again",
            pen.name,
            pen.path,
            udev_rule(pen),
            udev_rule(pen)
        )
    } else {
        format!(
            "the system does not let this program read the pen {}; allow it in the system's privacy settings (input monitoring), or use the system's pen driver",
            pen.name
        )
    };
    DeviceError::new(DeviceErrorKind::Denied, message)
}

#[cfg(test)]
mod tests {
    use super::{HidBus, HidPen, denied, udev_rule, with_ids};
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
            has_pressure: None,
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
        let built_in = HidPen { bus: HidBus::I2c, ..usb };
        assert_eq!(udev_rule(&built_in), r#"KERNEL=="hidraw*", KERNELS=="*:056A:0374.*", TAG+="uaccess""#);
    }
}
