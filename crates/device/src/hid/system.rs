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
use crate::pen_backend::{Access, Backend, Provides};

/// The pens that are connected to this machine.
#[derive(Clone, Copy, Debug, Default)]
pub struct SystemPens;

impl PenBus for SystemPens {
    fn list(&mut self) -> Result<Vec<HidPen>, DeviceError> {
        let api = HidApi::new().map_err(|error| unavailable(&error))?;
        let pens = api.device_list().filter_map(pen_of);
        #[cfg(windows)]
        let pens = pens.chain(crate::hid::raw_input::list());
        Ok(with_ids(pens.collect()))
    }

    fn open(&mut self, pen: &HidPen) -> Result<Box<dyn ReportSource>, DeviceError> {
        #[cfg(windows)]
        if pen.backend == Backend::RawInput {
            return crate::hid::raw_input::open(pen);
        }
        Ok(Box::new(SystemPen { device: open_device(pen)?, name: pen.name.clone() }))
    }
}

/// Opens a device for reading and writing.
///
/// # Errors
/// [`DeviceErrorKind::Denied`] with instructions, [`DeviceErrorKind::NotFound`], [`DeviceErrorKind::Busy`] or
/// [`DeviceErrorKind::Backend`].
pub(crate) fn open_device(pen: &HidPen) -> Result<HidDevice, DeviceError> {
    let gone = || {
        DeviceError::new(
            DeviceErrorKind::NotFound,
            format!("the pen {} is not connected; plug it in", pen.name),
        )
    };
    let path = CString::new(pen.path.clone()).map_err(|_| gone())?;
    let api = HidApi::new().map_err(|error| unavailable(&error))?;
    api.open_path(&path).map_err(|error| match opening_failed(&error) {
        DeviceErrorKind::Denied => denied(pen),
        DeviceErrorKind::Busy if pen.access == Access::Exclusive => denied(pen),
        DeviceErrorKind::NotFound => gone(),
        kind => DeviceError::new(
            kind,
            format!("the pen {} cannot be opened: {error}; plug it in again", pen.name),
        ),
    })
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
        lost(&self.name, error)
    }
}

/// Error for an open device `name` that is disconnected.
pub(crate) fn lost(name: &str, error: &HidError) -> DeviceError {
    let message = format!("the pen {name} is disconnected ({error}); plug it in again");
    DeviceError::new(DeviceErrorKind::Lost, message)
}

pub(crate) fn unavailable(error: &HidError) -> DeviceError {
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
    let found = identity_of(device)?;
    let ids = (found.vendor_id, found.product_id);
    let decoder = declared_descriptor(&found.path).map(|bytes| {
        descriptor::parse(&bytes).ok().and_then(|declared| PenDecoder::of_device(&declared, Some(ids)))
    });
    let is_pen = match &decoder {
        Some(decoder) => decoder.is_some(),
        None => has_pen_usage(device) || is_known_pen(ids.0, ids.1),
    };
    let provides = decoder.flatten().map_or(Provides::UNKNOWN, |decoder| decoder.best().provides());
    is_pen.then_some(HidPen { provides, ..found })
}

/// Returns the identity of a device without an id. `None` if its path is not text and it cannot be chosen.
pub(crate) fn identity_of(device: &DeviceInfo) -> Option<HidPen> {
    let (vendor_id, product_id) = (device.vendor_id(), device.product_id());
    let path = device.path().to_str().ok()?; // A path that is not text cannot be chosen.
    let text = |text: Option<&str>| text.map(str::trim).filter(|text| !text.is_empty()).map(str::to_owned);
    let (maker, product) = (text(device.manufacturer_string()), text(device.product_string()));
    let name = match (maker, product) {
        (Some(maker), Some(product)) if !product.starts_with(&maker) => format!("{maker} {product}"),
        (_, Some(product)) => product,
        (Some(maker), None) => format!("{maker} pen"),
        (None, None) => format!("Pen {vendor_id:04x}:{product_id:04x}"),
    };
    Some(HidPen {
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
        backend: Backend::Hid,
        provides: Provides::UNKNOWN,
        access: access_of(device, path),
    })
}

/// Whether the system lists a device with the usage digitizer or pen of the digitizer page.
fn has_pen_usage(device: &DeviceInfo) -> bool {
    device.usage_page() == 0x0d && matches!(device.usage(), 1 | 2)
}

#[cfg(target_os = "macos")]
fn access_of(_device: &DeviceInfo, _path: &str) -> Access {
    crate::hid::input_monitoring::access()
}

#[cfg(windows)]
fn access_of(device: &DeviceInfo, _path: &str) -> Access {
    if has_pen_usage(device) { Access::Exclusive } else { Access::Unknown }
}

#[cfg(not(any(target_os = "macos", windows)))]
fn access_of(_device: &DeviceInfo, path: &str) -> Access {
    Access::to_file(path)
}

/// Returns the report descriptor of a device that is not open, if the system publishes it.
pub(crate) fn declared_descriptor(path: &str) -> Option<Vec<u8>> {
    let node = path.strip_prefix("/dev/").filter(|node| node.starts_with("hidraw"))?;
    let file = format!("/sys/class/hidraw/{node}/device/report_descriptor");
    std::fs::read(file).ok() // Not published: the listed usages are used instead.
}

#[cfg(test)]
mod tests {
    use super::{Access, Backend, HidError, Provides, SystemPens, opening_failed};
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
            backend: Backend::Hid,
            provides: Provides::UNKNOWN,
            access: Access::Unknown,
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
