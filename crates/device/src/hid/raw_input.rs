//! Pens by Raw Input on Windows, which opens pens exclusively but passes their reports on.
//!
//! Windows states the values of a report, not its layout; they are repacked ([`Repacked`]). A thread owns an invisible
//! window, to which Windows sends the reports of all pens. This was compiled, but never tried with a device.

mod window;

use std::ptr::null_mut;
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::mpsc::{Receiver, RecvTimeoutError, channel};
use std::thread::JoinHandle;
use std::time::Duration;

use windows_sys::Win32::Devices::HumanInterfaceDevice::{
    HIDP_BUTTON_CAPS, HIDP_CAPS, HIDP_STATUS_SUCCESS, HIDP_VALUE_CAPS, HidP_GetButtonCaps, HidP_GetCaps,
    HidP_GetValueCaps, HidP_Input, PHIDP_PREPARSED_DATA,
};
use windows_sys::Win32::Foundation::HANDLE;
use windows_sys::Win32::UI::Input::{
    GetRawInputDeviceInfoW, GetRawInputDeviceList, RAW_INPUT_DEVICE_INFO_COMMAND, RAWINPUTDEVICELIST,
    RID_DEVICE_INFO, RIDI_DEVICEINFO, RIDI_DEVICENAME, RIDI_PREPARSEDDATA, RIM_TYPEHID,
};

use crate::error::{DeviceError, DeviceErrorKind};
use crate::hid::descriptor::Usage;
use crate::hid::identity::{HidBus, HidPen};
use crate::hid::live::ReportSource;
use crate::hid::repacked::{Repacked, SystemField};
use crate::pen_backend::{Access, Backend, Provides};

/// Usage page of pens, and the usages of their collections: digitizer and pen.
const DIGITIZERS: u16 = 0x0d;
const PENS: [u16; 2] = [1, 2];

/// Pens that Windows lists.
pub(crate) fn list() -> Vec<HidPen> {
    devices().into_iter().filter_map(|device| pen_of(device.0)).collect()
}

/// Opens a pen of [`list`].
///
/// # Errors
/// [`DeviceErrorKind::NotFound`], [`DeviceErrorKind::Unsupported`] or [`DeviceErrorKind::Unavailable`].
pub(crate) fn open(pen: &HidPen) -> Result<Box<dyn ReportSource>, DeviceError> {
    let stop = Arc::new(AtomicBool::new(false));
    let (opened, is_open) = channel();
    let (reports_in, reports) = channel();
    let (path, stopped) = (pen.path.clone(), Arc::clone(&stop));
    let listen = move || window::listen(&path, &opened, &reports_in, &stopped);
    let thread = std::thread::Builder::new().name("raw input".to_owned()).spawn(listen);
    let failed = |why: &str| {
        let message =
            format!("the pen {} cannot be read by Raw Input: {why}; use the window pointer", pen.name);
        DeviceError::new(DeviceErrorKind::Unavailable, message)
    };
    let thread = thread.map_err(|error| failed(&error.to_string()))?;
    // The thread sends a result before it waits for reports.
    let repacked = is_open.recv().map_err(|_| failed("its thread ended"))?;
    match repacked {
        Ok(repacked) => Ok(Box::new(RawPen {
            descriptor: repacked.descriptor(),
            name: pen.name.clone(),
            reports,
            stop,
            thread: Some(thread),
        })),
        Err(why) => Err(failed(why)),
    }
}

/// A pen whose reports a thread receives.
struct RawPen {
    descriptor: Vec<u8>,
    name: String,
    reports: Receiver<Vec<u8>>,
    stop: Arc<AtomicBool>,
    thread: Option<JoinHandle<()>>,
}

impl ReportSource for RawPen {
    fn descriptor(&mut self) -> Result<Vec<u8>, DeviceError> {
        Ok(self.descriptor.clone())
    }

    fn read(&mut self, buffer: &mut [u8], timeout: Duration) -> Result<usize, DeviceError> {
        match self.reports.recv_timeout(timeout) {
            Ok(report) => {
                let length = report.len().min(buffer.len());
                buffer[..length].copy_from_slice(&report[..length]);
                Ok(length)
            }
            Err(RecvTimeoutError::Timeout) => Ok(0),
            Err(RecvTimeoutError::Disconnected) => {
                let message = format!("the pen {} is disconnected; plug it in again", self.name);
                Err(DeviceError::new(DeviceErrorKind::Lost, message))
            }
        }
    }
}

impl Drop for RawPen {
    fn drop(&mut self) {
        self.stop.store(true, Ordering::Relaxed);
        if let Some(thread) = self.thread.take() {
            thread.join().ok(); // A panic has been printed already.
        }
    }
}

/// A device in the list of Windows. Its handle is valid while the device is connected.
#[derive(Clone, Copy)]
struct RawDevice(HANDLE);

/// HID devices that Windows lists.
fn devices() -> Vec<RawDevice> {
    let size = size_of::<RAWINPUTDEVICELIST>() as u32;
    let mut count = 0;
    // SAFETY: without a list, the function only writes the number of devices.
    if unsafe { GetRawInputDeviceList(null_mut(), &raw mut count, size) } == u32::MAX {
        return Vec::new();
    }
    let mut found = vec![RAWINPUTDEVICELIST::default(); count as usize];
    // SAFETY: the list has room for `count` entries of `size` bytes.
    let n = unsafe { GetRawInputDeviceList(found.as_mut_ptr(), &raw mut count, size) };
    if n == u32::MAX {
        return Vec::new();
    }
    found.truncate(n as usize);
    found.iter().filter(|entry| entry.dwType == RIM_TYPEHID).map(|entry| RawDevice(entry.hDevice)).collect()
}

fn pen_of(device: HANDLE) -> Option<HidPen> {
    let (vendor_id, product_id) = pen_ids(device)?;
    let path = device_name(device)?;
    let provides = repacked(device).and_then(|(repacked, _)| {
        let declared = crate::hid::descriptor::parse(&repacked.descriptor()).ok()?; // Without a value, it is no pen.
        Some(crate::hid::pen::PenDecoder::of_descriptor(&declared)?.best().provides())
    });
    Some(HidPen {
        id: String::new(),
        name: format!("Pen {vendor_id:04x}:{product_id:04x} (Raw Input)"),
        vendor_id,
        product_id,
        serial: None,
        interface: None,
        path,
        bus: HidBus::Other,
        backend: Backend::RawInput,
        provides: provides.unwrap_or(Provides::UNKNOWN),
        access: Access::Granted,
    })
}

/// Vendor and product id of a device, if it is a pen.
fn pen_ids(device: HANDLE) -> Option<(u16, u16)> {
    let mut info =
        RID_DEVICE_INFO { cbSize: size_of::<RID_DEVICE_INFO>() as u32, ..RID_DEVICE_INFO::default() };
    let mut size = info.cbSize;
    // SAFETY: `info` has `size` bytes.
    let n = unsafe { GetRawInputDeviceInfoW(device, RIDI_DEVICEINFO, (&raw mut info).cast(), &raw mut size) };
    if n == u32::MAX || info.dwType != RIM_TYPEHID {
        return None;
    }
    // SAFETY: the type says that the union holds this member.
    let hid = unsafe { info.Anonymous.hid };
    let is_pen = hid.usUsagePage == DIGITIZERS && PENS.contains(&hid.usUsage);
    is_pen.then_some((hid.dwVendorId as u16, hid.dwProductId as u16))
}

/// Name of a device, to find it again in a later list.
fn device_name(device: HANDLE) -> Option<String> {
    // The length is counted in characters for this command, so that the buffer is long enough.
    let wide = info_of::<u16>(device, RIDI_DEVICENAME)?;
    let end = wide.iter().position(|c| *c == 0).unwrap_or(wide.len());
    String::from_utf16(&wide[..end]).ok() // A name that is not text cannot be chosen.
}

/// Data of a device of the kind `command`, as elements of the size that the command counts in.
fn info_of<T: Clone + Default>(device: HANDLE, command: RAW_INPUT_DEVICE_INFO_COMMAND) -> Option<Vec<T>> {
    let mut size = 0;
    // SAFETY: without a buffer, the function only writes the size.
    if unsafe { GetRawInputDeviceInfoW(device, command, null_mut(), &raw mut size) } == u32::MAX {
        return None;
    }
    let mut data = vec![T::default(); size as usize];
    // SAFETY: `data` has `size` elements of at least one byte each, which is the size that `size` states.
    let n = unsafe { GetRawInputDeviceInfoW(device, command, data.as_mut_ptr().cast(), &raw mut size) };
    (n != u32::MAX && n > 0).then_some(data)
}

/// Description of the reports of a device by Windows. Its memory is aligned for any content.
struct Preparsed(Vec<u64>);

impl Preparsed {
    fn of(device: HANDLE) -> Option<Self> {
        // This command counts in bytes; elements of eight bytes give more room than that.
        info_of(device, RIDI_PREPARSEDDATA).map(Self)
    }

    fn handle(&self) -> PHIDP_PREPARSED_DATA {
        self.0.as_ptr() as PHIDP_PREPARSED_DATA
    }
}

/// The layout of our own for the reports of a device, and the description by Windows.
fn repacked(device: HANDLE) -> Option<(Repacked, Preparsed)> {
    let preparsed = Preparsed::of(device)?;
    let mut caps = HIDP_CAPS::default();
    // SAFETY: the description is complete and lives as long as the call.
    if unsafe { HidP_GetCaps(preparsed.handle(), &raw mut caps) } != HIDP_STATUS_SUCCESS {
        return None;
    }
    let mut n_values = caps.NumberInputValueCaps;
    let mut values = vec![HIDP_VALUE_CAPS::default(); usize::from(n_values)];
    let mut n_buttons = caps.NumberInputButtonCaps;
    let mut buttons = vec![HIDP_BUTTON_CAPS::default(); usize::from(n_buttons)];
    // SAFETY: both lists have as many entries as the numbers say.
    unsafe {
        HidP_GetValueCaps(HidP_Input, values.as_mut_ptr(), &raw mut n_values, preparsed.handle());
        HidP_GetButtonCaps(HidP_Input, buttons.as_mut_ptr(), &raw mut n_buttons, preparsed.handle());
    }
    values.truncate(usize::from(n_values));
    buttons.truncate(usize::from(n_buttons));
    let fields = values.iter().filter(|caps| caps.IsAbsolute).flat_map(|caps| {
        // SAFETY: `IsRange` says which member the union holds.
        let (first, last) = unsafe {
            if caps.IsRange {
                (caps.Anonymous.Range.UsageMin, caps.Anonymous.Range.UsageMax)
            } else {
                (caps.Anonymous.NotRange.Usage, caps.Anonymous.NotRange.Usage)
            }
        };
        (first..=last).map(move |id| SystemField {
            usage: Usage::new(caps.UsagePage, id),
            bit_size: u32::from(caps.BitSize),
            logical: [caps.LogicalMin, caps.LogicalMax],
            physical: [caps.PhysicalMin, caps.PhysicalMax],
            unit: caps.Units,
            unit_exponent: caps.UnitsExp,
        })
    });
    let switches = buttons.iter().flat_map(|caps| {
        // SAFETY: `IsRange` says which member the union holds.
        let (first, last) = unsafe {
            if caps.IsRange {
                (caps.Anonymous.Range.UsageMin, caps.Anonymous.Range.UsageMax)
            } else {
                (caps.Anonymous.NotRange.Usage, caps.Anonymous.NotRange.Usage)
            }
        };
        (first..=last).map(move |id| Usage::new(caps.UsagePage, id))
    });
    let repacked = Repacked::new(fields.collect(), switches.collect());
    Some((repacked, preparsed))
}
