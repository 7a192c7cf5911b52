//! Direct input from pens by the human interface device (HID) protocol, without the system's pen driver.
//!
//! [`descriptor`] parses report descriptors, [`pen`] finds the pen in one and decodes its reports, [`tracker`] converts
//! them to touches, and [`live`] does this for a device that can be unplugged. No module trusts a device: reports and
//! descriptors may hold any bytes.

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
