//! Direct input from pens by the human interface device (HID) protocol, without the system's pen driver.
//!
//! [`descriptor`] parses report descriptors. [`pen`] finds the pen in a descriptor and decodes its reports. [`tracker`]
//! converts reports to touches. [`live`] reads a connected pen, which can be unplugged at any time. No module trusts a
//! device: reports and descriptors may contain any bytes.

pub mod clock;
pub mod descriptor;
pub mod identity;
pub mod landing;
pub mod live;
pub mod pen;
pub mod replay;
pub mod system;
pub mod tracker;
mod units;
