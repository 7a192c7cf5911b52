//! Whole logs, for sessions that are over before they are written: those of simulated participants.

use super::header::header_lines;
use super::line::LineV1;
use super::{LogHeader, TimedEvent};

/// Serializes the log of a session. Reading it gives the same header and events.
///
/// The answers of a person are appended one by one instead ([`super::StudyLog`]), so that none is lost.
pub fn write_study_log(header: &LogHeader, events: &[TimedEvent]) -> Vec<u8> {
    let mut bytes = Vec::new();
    for line in header_lines(header) {
        bytes.extend(line);
        bytes.push(b'\n');
    }
    for event in events {
        // Keys are strings, and numbers that are not finite become null.
        bytes.extend(serde_json::to_vec(&LineV1::from(event)).unwrap_or_default());
        bytes.push(b'\n');
    }
    bytes
}
