//! Whole logs, for sessions that are over before they are written: those of simulated participants.

use super::header::HeaderV1;
use super::line::LineV1;
use super::{LogHeader, TimedEvent};

/// Serializes the log of a session. Reading it gives the same header and events.
///
/// The answers of a person are appended one by one instead ([`super::StudyLog`]), so that none is lost.
pub fn write_study_log(header: &LogHeader, events: &[TimedEvent]) -> Vec<u8> {
    // Keys are strings, and numbers that are not finite become null.
    let mut bytes = serde_json::to_vec(&HeaderV1::of(header)).unwrap_or_default();
    bytes.push(b'\n');
    for event in events {
        bytes.extend(serde_json::to_vec(&LineV1::from(event)).unwrap_or_default());
        bytes.push(b'\n');
    }
    bytes
}
