//! Haptic pens as outputs: pens with an actuator that plays waveforms of its own, by the haptics page of HID (0x0E).
//!
//! Such a pen takes no samples. It has a list of waveforms, such as the feel of a ball pen, and plays one of them at an
//! intensity. The drive signal is therefore *approximated*: [`translator`] measures its level and its frequency and
//! selects a waveform and an intensity by a rule. [`controller`] finds the fields in the report descriptor and writes
//! the reports, [`pen`] sends them, and [`sender`] does so on a thread of its own.
//!
//! The layout follows the HID usage tables and the published facts about haptic pens: waveforms are numbered by
//! *ordinals*, of which 1 is "none" and 2 is "stop"; further ones are in a list that the pen reports. No real pen was at
//! hand. [`simulated`] is a pen without a device.

pub mod controller;
pub mod pen;
pub mod sender;
pub mod simulated;
pub mod system;
pub mod translator;
pub mod waveform;

/// Prefix of the ids of haptic pens as outputs.
pub const ID_PREFIX: &str = "haptic:";
/// Sample rate at which the drive signal is rendered to be measured, in Hz.
pub const RATE_HZ: u32 = 8000;
/// Buffer size for that, in frames: 8 ms.
pub const BUFFER_FRAMES: u32 = 64;
