//! The haptic pens of this machine.

use hidapi::{DeviceInfo, HidApi, HidDevice};

use crate::error::{DeviceError, DeviceErrorKind};
use crate::haptic_pen::ID_PREFIX;
use crate::haptic_pen::controller::{HapticController, ReportShape};
use crate::haptic_pen::pen::{HapticPen, HapticPort};
use crate::haptic_pen::simulated::SimulatedPen;
use crate::hid::descriptor::{self, MAX_DESCRIPTOR_BYTES};
use crate::hid::identity::{HID_PREFIX, HidPen, denied_on, with_ids};
use crate::hid::system::{declared_descriptor, identity_of, lost, open_device, unavailable};
use crate::operating_system::OperatingSystem;

/// Id of the simulated haptic pen, which exists on every machine; [`list`] does not list it.
pub const SIMULATED_ID: &str = "haptic:simulated";

/// Lists the haptic pens of this machine. Their ids begin with [`ID_PREFIX`]. None is opened.
///
/// # Errors
/// [`DeviceErrorKind::Unavailable`] if the system cannot list devices.
pub fn list() -> Result<Vec<HidPen>, DeviceError> {
    let api = HidApi::new().map_err(|error| unavailable(&error))?;
    let mut pens = with_ids(api.device_list().filter_map(haptic_pen_of).collect());
    for pen in &mut pens {
        let numbers = pen.id.strip_prefix(HID_PREFIX).unwrap_or(&pen.id);
        pen.id = format!("{ID_PREFIX}{numbers}");
    }
    Ok(pens)
}

/// Opens the haptic pen with this id.
///
/// # Errors
/// [`DeviceErrorKind::NotFound`], [`DeviceErrorKind::Denied`] with instructions, [`DeviceErrorKind::Busy`],
/// [`DeviceErrorKind::Unsupported`] or [`DeviceErrorKind::Backend`].
pub fn open(id: &str) -> Result<HapticPen, DeviceError> {
    if id == SIMULATED_ID {
        return HapticPen::open(Box::new(SimulatedPen::listing()), "simulated pen");
    }
    let Some(pen) = list()?.into_iter().find(|pen| pen.id == id) else {
        let message =
            format!("there is no output `{id}` on this machine; `shagreen devices` lists the available ones");
        return Err(DeviceError::new(DeviceErrorKind::NotFound, message));
    };
    let device = open_device(&pen).map_err(|error| match error.kind() {
        DeviceErrorKind::Denied => {
            DeviceError::new(DeviceErrorKind::Denied, refused_on(OperatingSystem::HERE, &pen))
        }
        _ => error,
    })?;
    let port = SystemPort { device, name: pen.name.clone() };
    HapticPen::open(Box::new(port), &pen.name)
}

/// Says that the system refuses access to a haptic pen, and what to do about it.
pub fn refused_on(system: OperatingSystem, pen: &HidPen) -> String {
    match system {
        // Raw Input passes on what a pen sends, and sends it nothing.
        OperatingSystem::Windows => {
            format!("Windows keeps the haptic pen {} for itself: choose another output", pen.name)
        }
        _ => denied_on(system, pen),
    }
}

fn haptic_pen_of(device: &DeviceInfo) -> Option<HidPen> {
    let found = identity_of(device)?;
    let is_haptic = match declared_descriptor(&found.path) {
        Some(bytes) => descriptor::parse(&bytes)
            .is_ok_and(|declared| HapticController::of_descriptor(&declared).is_some()),
        None => may_be_haptic(device.usage_page(), device.usage()),
    };
    is_haptic.then_some(found)
}

/// Whether a device without a descriptor may be a haptic pen; opening it decides. The controller of such a pen is part
/// of a stylus; one by itself belongs to a mouse.
fn may_be_haptic(usage_page: u16, usage: u16) -> bool {
    (usage_page, usage) == (0x0d, 0x20)
}

/// An open device. `hidapi` takes and returns a zero before reports without an id.
struct SystemPort {
    device: HidDevice,
    name: String,
}

impl SystemPort {
    fn with_first_byte(id: Option<u8>, report: &[u8]) -> Vec<u8> {
        if id.is_some() { report.to_vec() } else { [&[0][..], report].concat() }
    }
}

impl HapticPort for SystemPort {
    fn descriptor(&mut self) -> Result<Vec<u8>, DeviceError> {
        let mut bytes = vec![0; MAX_DESCRIPTOR_BYTES];
        let length =
            self.device.get_report_descriptor(&mut bytes).map_err(|error| lost(&self.name, &error))?;
        bytes.truncate(length);
        Ok(bytes)
    }

    fn feature(&mut self, shape: ReportShape) -> Result<Vec<u8>, DeviceError> {
        let n_before = usize::from(shape.id.is_none());
        let mut bytes = vec![0; n_before + shape.n_bytes];
        bytes[0] = shape.id.unwrap_or(0);
        let length = self.device.get_feature_report(&mut bytes).map_err(|error| lost(&self.name, &error))?;
        bytes.truncate(length);
        bytes.drain(..n_before.min(bytes.len()));
        Ok(bytes)
    }

    fn set_feature(&mut self, id: Option<u8>, report: &[u8]) -> Result<(), DeviceError> {
        let report = Self::with_first_byte(id, report);
        self.device.send_feature_report(&report).map_err(|error| lost(&self.name, &error))
    }

    fn write(&mut self, id: Option<u8>, report: &[u8]) -> Result<(), DeviceError> {
        let report = Self::with_first_byte(id, report);
        self.device.write(&report).map(|_| ()).map_err(|error| lost(&self.name, &error))
    }
}

#[cfg(test)]
mod tests {
    use super::{ID_PREFIX, SIMULATED_ID, SystemPort, list, may_be_haptic, open, refused_on};
    use crate::error::DeviceErrorKind;
    use crate::hid::identity::{HidBus, HidPen};
    use crate::operating_system::OperatingSystem;
    use crate::pen_backend::{Access, Backend, Provides};

    #[test]
    fn pens_are_listed_without_an_error_on_any_machine() {
        for pen in list().unwrap() {
            assert!(pen.id.starts_with(ID_PREFIX));
        }
        assert_eq!(open("haptic:none").unwrap_err().kind(), DeviceErrorKind::NotFound);
        assert!(open(SIMULATED_ID).unwrap().waveforms().count() > 3);
    }

    #[test]
    fn a_refused_pen_says_what_helps_an_output() {
        let pen = HidPen {
            id: "haptic:045e:0001".to_owned(),
            name: "Test pen".to_owned(),
            vendor_id: 0x045e,
            product_id: 1,
            serial: None,
            interface: None,
            path: "/dev/hidraw9".to_owned(),
            bus: HidBus::Bluetooth,
            backend: Backend::Hid,
            provides: Provides::UNKNOWN,
            access: Access::Denied,
        };
        let rule = r#"KERNEL=="hidraw*", KERNELS=="*:045E:0001.*", TAG+="uaccess""#;
        let on_linux = refused_on(OperatingSystem::Linux, &pen);
        assert!(on_linux.contains(rule), "{on_linux}");
        let on_windows = refused_on(OperatingSystem::Windows, &pen);
        assert!(on_windows.contains("another output") && !on_windows.contains("Raw Input"), "{on_windows}");
    }

    #[test]
    fn a_haptic_mouse_is_not_listed() {
        assert!(may_be_haptic(0x0d, 0x20));
        assert!(!may_be_haptic(0x0e, 0x01) && !may_be_haptic(0x0d, 0x02));
    }

    #[test]
    fn a_report_without_an_id_begins_with_a_zero() {
        assert_eq!(SystemPort::with_first_byte(None, &[1, 2]), [0, 1, 2]);
        assert_eq!(SystemPort::with_first_byte(Some(7), &[7, 2]), [7, 2]);
    }
}
