//! Direct input from pens by the human interface device (HID) protocol, without the system's pen driver.
//!
//! [`descriptor`] parses report descriptors. [`pen`] finds the pen in a descriptor and decodes its reports. [`tracker`]
//! converts reports to touches. [`live`] reads a connected pen, which can be unplugged at any time. [`choice`] selects
//! it. No module trusts a device: reports and descriptors may contain any bytes.

pub mod choice;
pub mod clock;
pub mod descriptor;
pub mod identity;
#[cfg(target_os = "macos")]
#[expect(unsafe_code, reason = "a C function of the system states the permission")]
mod input_monitoring;
pub mod landing;
pub mod live;
pub mod pen;
#[cfg(windows)]
#[expect(unsafe_code, reason = "Raw Input consists of C functions that take buffers")]
mod raw_input;
pub mod repacked;
pub mod replay;
pub mod system;
pub mod tracker;
mod units;
