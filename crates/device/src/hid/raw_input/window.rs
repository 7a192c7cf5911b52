//! Thread with an invisible window that receives the reports of pens.

use std::ffi::c_void;
use std::ptr::{null, null_mut};
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::mpsc::Sender;

use windows_sys::Win32::Devices::HumanInterfaceDevice::{
    HIDP_STATUS_SUCCESS, HidP_GetUsageValue, HidP_GetUsages, HidP_Input,
};
use windows_sys::Win32::Foundation::{HANDLE, HWND};
use windows_sys::Win32::UI::Input::{
    GetRawInputData, HRAWINPUT, RAWINPUT, RAWINPUTDEVICE, RAWINPUTHEADER, RID_INPUT, RIDEV_INPUTSINK,
    RIDEV_REMOVE, RIM_TYPEHID, RegisterRawInputDevices,
};
use windows_sys::Win32::UI::WindowsAndMessaging::{
    CreateWindowExW, DestroyWindow, DispatchMessageW, HWND_MESSAGE, MSG, MsgWaitForMultipleObjects,
    PM_REMOVE, PeekMessageW, QS_ALLINPUT, WM_INPUT,
};

use super::{DIGITIZERS, PENS, Preparsed, device_name, devices, repacked};
use crate::hid::descriptor::Usage;
use crate::hid::repacked::{Repacked, SystemField};

/// Longest wait for a report before the thread checks whether it should end, in milliseconds.
const WAIT_MS: u32 = 20;
/// Most switches of a pen that can be on at the same time.
const MAX_ON: usize = 64;

/// Sends the layout of the pen at `path`, then its reports until `stop` or until it is disconnected.
pub(super) fn listen(
    path: &str,
    opened: &Sender<Result<Repacked, &'static str>>,
    reports: &Sender<Vec<u8>>,
    stop: &AtomicBool,
) {
    let found = || devices().into_iter().find(|device| device_name(device.0).as_deref() == Some(path));
    let Some(device) = found() else {
        opened.send(Err("it is not connected")).ok(); // Nobody waits for it any more.
        return;
    };
    let Some((repacked, preparsed)) = repacked(device.0) else {
        opened.send(Err("Windows does not describe its reports")).ok(); // The same.
        return;
    };
    let Some(window) = Window::open() else {
        opened.send(Err("Windows refuses an invisible window")).ok(); // The same.
        return;
    };
    if opened.send(Ok(repacked.clone())).is_err() {
        return;
    }
    let mut buffer: Vec<u64> = Vec::new();
    let mut n_waits = 0_u32;
    while !stop.load(Ordering::Relaxed) {
        window.wait();
        while let Some(message) = window.next_input() {
            let received = reports_of(message.lParam as HRAWINPUT, device.0, &mut buffer);
            window.pass_on(&message);
            for report in received {
                let packed = pack(&repacked, &preparsed, &report);
                if packed.is_some_and(|packed| reports.send(packed).is_err()) {
                    return;
                }
            }
        }
        // Windows sends no message when a pen is unplugged.
        n_waits += 1;
        if n_waits % 50 == 0 && found().is_none() {
            return;
        }
    }
}

/// An invisible window to which Windows sends the reports of pens.
struct Window(HWND);

impl Window {
    fn open() -> Option<Self> {
        let class: Vec<u16> = "STATIC\0".encode_utf16().collect();
        // SAFETY: the class is one of the system's, its name ends with zero, and all pointers that are null may be.
        let window = unsafe {
            CreateWindowExW(
                0,
                class.as_ptr(),
                null(),
                0,
                0,
                0,
                0,
                0,
                HWND_MESSAGE,
                null_mut(),
                null_mut(),
                null::<c_void>(),
            )
        };
        if window.is_null() {
            return None;
        }
        let window = Self(window);
        window.register(RIDEV_INPUTSINK, window.0).then_some(window)
    }

    /// Asks Windows for the reports of pens, or not to send them any more.
    fn register(&self, flags: u32, target: HWND) -> bool {
        let kinds = PENS.map(|usage| RAWINPUTDEVICE {
            usUsagePage: DIGITIZERS,
            usUsage: usage,
            dwFlags: flags,
            hwndTarget: target,
        });
        let size = size_of::<RAWINPUTDEVICE>() as u32;
        // SAFETY: the list has as many entries of this size as it says.
        unsafe { RegisterRawInputDevices(kinds.as_ptr(), kinds.len() as u32, size) != 0 }
    }

    /// Waits for a message, at most for [`WAIT_MS`].
    fn wait(&self) {
        // SAFETY: there are no handles to wait for.
        unsafe { MsgWaitForMultipleObjects(0, null(), 0, WAIT_MS, QS_ALLINPUT) };
    }

    /// Takes the next waiting message with a report.
    fn next_input(&self) -> Option<MSG> {
        let mut message = MSG::default();
        // SAFETY: the window belongs to this thread, and `message` is written completely.
        while unsafe { PeekMessageW(&raw mut message, self.0, 0, 0, PM_REMOVE) } != 0 {
            if message.message == WM_INPUT {
                return Some(message);
            }
            self.pass_on(&message);
        }
        None
    }

    /// Returns a message to Windows, which frees what belongs to it.
    fn pass_on(&self, message: &MSG) {
        // SAFETY: the message came from the queue of this thread.
        unsafe { DispatchMessageW(message) };
    }
}

impl Drop for Window {
    fn drop(&mut self) {
        // A registration is removed without a window.
        self.register(RIDEV_REMOVE, null_mut());
        // SAFETY: the window belongs to this thread and is destroyed once.
        unsafe { DestroyWindow(self.0) };
    }
}

/// The reports of a message, if they come from `device`. `buffer` is aligned for the structure of Windows.
fn reports_of(input: HRAWINPUT, device: HANDLE, buffer: &mut Vec<u64>) -> Vec<Vec<u8>> {
    let header = size_of::<RAWINPUTHEADER>() as u32;
    let mut size = 0;
    // SAFETY: without a buffer, the function only writes the size.
    let asked = unsafe { GetRawInputData(input, RID_INPUT, null_mut(), &raw mut size, header) };
    if asked == u32::MAX || (size as usize) < size_of::<RAWINPUTHEADER>() {
        return Vec::new();
    }
    buffer.clear();
    buffer.resize((size as usize).max(size_of::<RAWINPUT>()).div_ceil(8), 0);
    // SAFETY: the buffer has at least `size` bytes.
    let n = unsafe { GetRawInputData(input, RID_INPUT, buffer.as_mut_ptr().cast(), &raw mut size, header) };
    if n == u32::MAX {
        return Vec::new();
    }
    // SAFETY: the buffer is aligned to eight bytes, holds at least one structure, and all its bytes were written.
    let raw = unsafe { *buffer.as_ptr().cast::<RAWINPUT>() };
    if raw.header.dwType != RIM_TYPEHID || raw.header.hDevice != device {
        return Vec::new();
    }
    // SAFETY: the type says that the union holds this member.
    let hid = unsafe { raw.data.hid };
    let (length, count) = (hid.dwSizeHid as usize, hid.dwCount as usize);
    // The bytes follow the two numbers of the structure.
    let start = size_of::<RAWINPUTHEADER>() + 2 * size_of::<u32>();
    let bytes: Vec<u8> = buffer.iter().flat_map(|word| word.to_ne_bytes()).take(n as usize).collect();
    let all = bytes.get(start..).unwrap_or_default();
    if length == 0 {
        return Vec::new();
    }
    all.chunks_exact(length).take(count).map(<[u8]>::to_vec).collect()
}

/// Translates a report of the pen into one of our own layout; `None` if it is a report of another kind.
fn pack(repacked: &Repacked, preparsed: &Preparsed, report: &[u8]) -> Option<Vec<u8>> {
    let value = |field: &SystemField| {
        let mut value = 0;
        // SAFETY: the description and the report live as long as the call; the report has the stated length.
        let status = unsafe {
            HidP_GetUsageValue(
                HidP_Input,
                field.usage.page(),
                0,
                field.usage.id(),
                &raw mut value,
                preparsed.handle(),
                report.as_ptr(),
                report.len() as u32,
            )
        };
        (status == HIDP_STATUS_SUCCESS).then_some(value)
    };
    // A report of another kind has no position.
    repacked.fields().iter().any(|field| value(field).is_some()).then_some(())?;
    let mut pages: Vec<u16> = repacked.switches().iter().map(|switch| switch.page()).collect();
    pages.sort_unstable();
    pages.dedup();
    let mut on = Vec::new();
    for page in pages {
        let (mut usages, mut count) = ([0_u16; MAX_ON], MAX_ON as u32);
        // The function takes a pointer for writing, although it only reads the report.
        let mut copy = report.to_vec();
        // SAFETY: the list has room for `count` usages; the description and the report live as long as the call.
        let status = unsafe {
            HidP_GetUsages(
                HidP_Input,
                page,
                0,
                usages.as_mut_ptr(),
                &raw mut count,
                preparsed.handle(),
                copy.as_mut_ptr(),
                copy.len() as u32,
            )
        };
        if status == HIDP_STATUS_SUCCESS {
            on.extend(usages.iter().take(count as usize).map(|id| Usage::new(page, *id)));
        }
    }
    Some(repacked.report(value, &on))
}
