//! Permission of macOS to read input devices. It was compiled, but never tried.

use crate::pen_backend::Access;

#[link(name = "IOKit", kind = "framework")]
unsafe extern "C" {
    fn IOHIDCheckAccess(request: u32) -> u32;
}

/// Request to receive the reports of input devices.
const LISTEN: u32 = 1;

/// State of *Privacy & Security > Input Monitoring* for this program.
pub(super) fn access() -> Access {
    // SAFETY: the function takes a number, returns a number, and is available since macOS 10.15.
    match unsafe { IOHIDCheckAccess(LISTEN) } {
        0 => Access::Granted,
        1 => Access::Denied,
        _ => Access::Unknown,
    }
}
