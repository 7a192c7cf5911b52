//! Access to the HID devices of this machine with the library `hidapi`.
//!
//! On Linux, its pure-Rust backend is used, which links no system library.

use std::ffi::CString;
use std::time::Duration;

use hidapi::{BusType, DeviceInfo, HidApi, HidDevice, HidError};

use crate::error::{DeviceError, DeviceErrorKind};
use crate::hid::descriptor::{self, MAX_DESCRIPTOR_BYTES};
use crate::hid::identity::{HidBus, HidPen, denied, with_ids};
use crate::hid::live::{PenBus, ReportSource};
use crate::hid::pen::{PenDecoder, is_known_pen};

/// The pens that are connected to this machine.
#[derive(Clone, Copy, Debug, Default)]
pub struct SystemPens;

impl PenBus for SystemPens {
    fn list(&mut self) -> Result<Vec<HidPen>, DeviceError> {
        let api = HidApi::new().map_err(|error| unavailable(&error))?;
        Ok(with_ids(api.device_list().filter_map(pen_of).collect()))
    }

    fn open(&mut self, pen: &HidPen) -> Result<Box<dyn ReportSource>, DeviceError> {
        let gone = || {
            DeviceError::new(
                DeviceErrorKind::NotFound,
                format!("the pen {} is not connected; plug it in", pen.name),
            )
        };
        let path = CString::new(pen.path.clone()).map_err(|_| gone())?;
        let api = HidApi::new().map_err(|error| unavailable(&error))?;
        let device = api.open_path(&path).map_err(|error| match opening_failed(&error) {
            DeviceErrorKind::Denied => denied(pen),
            DeviceErrorKind::NotFound => gone(),
            kind => DeviceError::new(
                kind,
                format!("the pen {} cannot be opened: {error}; plug it in again", pen.name),
            ),
        })?;
        Ok(Box::new(SystemPen { device, name: pen.name.clone() }))
    }
}

/// An open pen.
struct SystemPen {
    device: HidDevice,
    name: String,
}

impl ReportSource for SystemPen {
    fn descriptor(&mut self) -> Result<Vec<u8>, DeviceError> {
        let mut bytes = vec![0; MAX_DESCRIPTOR_BYTES];
        let length = self.device.get_report_descriptor(&mut bytes).map_err(|error| self.lost(&error))?;
        bytes.truncate(length);
        Ok(bytes)
    }

    fn read(&mut self, buffer: &mut [u8], timeout: Duration) -> Result<usize, DeviceError> {
        let millis = i32::try_from(timeout.as_millis()).unwrap_or(i32::MAX);
        self.device.read_timeout(buffer, millis).map_err(|error| self.lost(&error))
    }
}

impl SystemPen {
    fn lost(&self, error: &HidError) -> DeviceError {
        let message = format!("the pen {} is disconnected ({error}); plug it in again", self.name);
        DeviceError::new(DeviceErrorKind::Lost, message)
    }
}

fn unavailable(error: &HidError) -> DeviceError {
    let message = format!("the system cannot list its input devices: {error}; try again");
    DeviceError::new(DeviceErrorKind::Unavailable, message)
}

/// Maps an error at opening to its kind. The backends report it as text only, with the system's error number if there
/// is one.
fn opening_failed(error: &HidError) -> DeviceErrorKind {
    let words = error.to_string().to_lowercase();
    let has = |parts: &[&str]| parts.iter().any(|part| words.contains(part));
    if has(&[
        "permission denied",
        "os error 13)",
        "not permitted",
        "os error 1)",
        "access is denied",
        "privilege",
    ]) {
        DeviceErrorKind::Denied
    } else if has(&[
        "no such file",
        "no such device",
        "os error 2)",
        "os error 6)",
        "os error 19)",
        "not found",
    ]) {
        DeviceErrorKind::NotFound
    } else if has(&["busy", "os error 16)", "exclusive", "sharing violation"]) {
        DeviceErrorKind::Busy
    } else {
        DeviceErrorKind::Backend
    }
}

/// Returns a device as a pen, without opening it, from the descriptor or usages that the system lists.
fn pen_of(device: &DeviceInfo) -> Option<HidPen> {
    let (vendor_id, product_id) = (device.vendor_id(), device.product_id());
    let path = device.path().to_str().ok()?; // A path that is not text cannot be chosen.
    let decoder = declared_descriptor(path).map(|bytes| {
        descriptor::parse(&bytes)
            .ok()
            .and_then(|found| PenDecoder::of_device(&found, Some((vendor_id, product_id))))
    });
    let is_pen = match &decoder {
        Some(decoder) => decoder.is_some(),
        // Usages digitizer and pen of the digitizer page.
        None => {
            device.usage_page() == 0x0d && matches!(device.usage(), 1 | 2)
                || is_known_pen(vendor_id, product_id)
        }
    };
    let text = |text: Option<&str>| text.map(str::trim).filter(|text| !text.is_empty()).map(str::to_owned);
    let (maker, product) = (text(device.manufacturer_string()), text(device.product_string()));
    let name = match (maker, product) {
        (Some(maker), Some(product)) if !product.starts_with(&maker) => format!("{maker} {product}"),
        (_, Some(product)) => product,
        (Some(maker), None) => format!("{maker} pen"),
        (None, None) => format!("Pen {vendor_id:04x}:{product_id:04x}"),
    };
    is_pen.then(|| HidPen {
        id: String::new(),
        name,
        vendor_id,
        product_id,
        serial: text(device.serial_number()),
        interface: u8::try_from(device.interface_number()).ok(), // -1 means none.
        path: path.to_owned(),
        bus: match device.bus_type() {
            BusType::Usb => HidBus::Usb,
            BusType::Bluetooth => HidBus::Bluetooth,
            BusType::I2c => HidBus::I2c,
            _ => HidBus::Other,
        },
        has_pressure: decoder.flatten().map(|decoder| decoder.best().pressure.is_some()),
    })
}

/// Returns the report descriptor of a device that is not open, if the system publishes it.
fn declared_descriptor(path: &str) -> Option<Vec<u8>> {
    let node = path.strip_prefix("/dev/").filter(|node| node.starts_with("hidraw"))?;
    let file = format!("/sys/class/hidraw/{node}/device/report_descriptor");
    std::fs::read(file).ok() // Not published: the listed usages are used instead.
}

#[cfg(test)]
mod tests {
    use super::{HidError, SystemPens, opening_failed};
    use crate::error::DeviceErrorKind;
    use crate::hid::identity::{HidBus, HidPen};
    use crate::hid::live::PenBus as _;

    #[test]
    fn pens_are_listed_without_an_error_on_any_machine() {
        for pen in SystemPens.list().unwrap() {
            assert!(pen.id.starts_with("hid:"));
        }
    }

    #[test]
    fn a_pen_that_is_not_there_is_not_found() {
        let pen = HidPen {
            id: "hid:056a:0374".into(),
            name: "Pen".into(),
            vendor_id: 0x056a,
            product_id: 0x0374,
            serial: None,
            interface: None,
            path: "/dev/hidraw-none".into(),
            bus: HidBus::Usb,
            has_pressure: None,
        };
        let error = SystemPens.open(&pen).err().unwrap();
        if cfg!(target_os = "linux") {
            assert_eq!(error.kind(), DeviceErrorKind::NotFound);
        }
    }

    #[test]
    fn the_words_of_the_system_tell_what_to_do() {
        for (words, kind) in [
            (
                "failed to open device with path /dev/hidraw0: Permission denied (os error 13)",
                DeviceErrorKind::Denied,
            ),
            ("failed to open device: No such device (os error 19)", DeviceErrorKind::NotFound),
            ("Device or resource busy (os error 16)", DeviceErrorKind::Busy),
            ("something else (os error 121)", DeviceErrorKind::Backend),
        ] {
            assert_eq!(opening_failed(&HidError::HidApiError { message: words.into() }), kind, "{words}");
        }
    }
}
