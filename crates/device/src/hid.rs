//! Pens by the protocol of human interface devices (HID), without the system's own driver for pens between.
//!
//! [`descriptor`] reads what a device declares, [`pen`] finds the pen in it and reads its reports, [`tracker`] makes
//! touches of them, and [`live`] does this for a device that can come and go. Nothing here trusts a device: reports
//! and descriptors may hold anything.

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
