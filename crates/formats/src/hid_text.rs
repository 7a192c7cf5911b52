//! HID reports of input devices as text, in the formats of `hid-recorder` and `usbhid-dump`.
//!
//! `hid-recorder`: a line `R:` holds the number of bytes of a report descriptor and the bytes. `N:` holds a name, and
//! `I:` holds bus, vendor and product. Each `E:` holds a time in seconds, a number of bytes and a report. `D:` selects
//! one of several devices for the lines that follow, and `#` begins a comment.
//!
//! `usbhid-dump`: a line `BUS:DEVICE:INTERFACE:STREAM TIME` (or `DESCRIPTOR`) precedes lines of bytes.
//!
//! All bytes are hexadecimal. The text is UTF-8, or UTF-16 with a byte order mark, which some shells use for program
//! output.

mod dump;
mod recorder;

use crate::csv_text::{text, text_with_odd_letters};
use crate::imported::Imported;

/// A report with its time stamp.
#[derive(Clone, Debug, PartialEq)]
pub struct TimedReport {
    /// Time in seconds on the recorder's clock; never before that of the previous report.
    pub time_secs: f64,
    /// Bytes of the report; the first is the report id if the device uses report ids.
    pub bytes: Vec<u8>,
}

/// The recorded data of one device.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct HidRecording {
    /// The file's name for the device: its number, or bus, device and interface.
    pub device: String,
    /// The device's own name.
    pub name: Option<String>,
    /// Vendor and product ids.
    pub identity: Option<(u16, u16)>,
    /// The report descriptor.
    pub descriptor: Option<Vec<u8>>,
    /// The reports in order of time.
    pub reports: Vec<TimedReport>,
}

/// Why text contains no device data.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[non_exhaustive]
pub enum HidTextError {
    /// No line has either format.
    #[error(
        "the file is not a recording of an input device; record one with hid-recorder or usbhid-dump --entity=all"
    )]
    NotARecording,
    /// Lines have the format, but none is readable.
    #[error("line {line}: {problem}; no line of the file is readable; get a complete copy of the file")]
    Unreadable {
        /// The first such line, from one.
        line: usize,
        /// What is wrong with it.
        problem: String,
    },
    /// Neither a descriptor nor a report.
    #[error("the recording has neither a report descriptor nor reports; record again while moving the pen")]
    Empty,
}

/// A line that was ignored, and why.
struct Damage {
    line: usize,
    problem: String,
}

/// Maximum number of separate warnings for one file; further ones are only counted.
const MAX_WARNINGS: usize = 20;

/// Returns whether bytes look like such a recording: text with a characteristic line.
pub fn is_hid_text(bytes: &[u8]) -> bool {
    let Ok(text) = text(bytes) else { return false };
    lines(&text).any(|(_, line)| recorder::is_line(line) || dump::heading(line).is_some())
}

/// Reads a recording. Returns the devices with a descriptor or a report, in file order. Damaged lines are ignored with
/// a warning.
///
/// # Errors
/// See [`HidTextError`].
pub fn read_hid_text(bytes: &[u8]) -> Result<Imported<Vec<HidRecording>>, HidTextError> {
    let text = text_with_odd_letters(bytes);
    let is_dump = lines(&text).any(|(_, line)| dump::heading(line).is_some());
    if !is_dump && !lines(&text).any(|(_, line)| recorder::is_line(line)) {
        return Err(HidTextError::NotARecording);
    }
    let (mut devices, damages) = if is_dump { dump::read(&text) } else { recorder::read(&text) };
    devices.retain(|device| device.descriptor.is_some() || !device.reports.is_empty());
    let mut damages = damages.into_iter();
    if devices.is_empty() {
        return Err(damages.next().map_or(HidTextError::Empty, |Damage { line, problem }| {
            HidTextError::Unreadable { line, problem }
        }));
    }
    let mut warnings: Vec<String> = damages
        .by_ref()
        .take(MAX_WARNINGS)
        .map(|Damage { line, problem }| format!("line {line} is ignored: {problem}"))
        .collect();
    match damages.count() {
        0 => {}
        n => warnings.push(format!("{n} more lines are ignored")),
    }
    Ok(Imported { value: devices, warnings })
}

/// Returns the bytes of a file of hexadecimal text, as [`bytes_of_hex`] reads it; `None` for any other content.
pub fn bytes_of_hex_file(bytes: &[u8]) -> Option<Vec<u8>> {
    bytes_of_hex(&text(bytes).ok()?) // Bytes that are not text are not hexadecimal.
}

/// Parses bytes from pairs of hexadecimal digits, optionally separated by white space, commas and `0x`; `None` for any
/// other content or empty text.
pub fn bytes_of_hex(text: &str) -> Option<Vec<u8>> {
    let words = text.split(|c: char| c.is_whitespace() || c == ',').filter(|word| !word.is_empty());
    let mut bytes = Vec::with_capacity(text.len() / 2);
    for word in words {
        let digits = word.strip_prefix("0x").or(word.strip_prefix("0X")).unwrap_or(word);
        if digits.is_empty()
            || digits.len() % 2 != 0
            || !digits.bytes().all(|digit| digit.is_ascii_hexdigit())
        {
            return None;
        }
        for pair in digits.as_bytes().chunks(2) {
            let pair = std::str::from_utf8(pair).ok()?; // Hexadecimal digits are ASCII.
            bytes.push(u8::from_str_radix(pair, 16).ok()?); // Both are checked digits.
        }
    }
    (!bytes.is_empty()).then_some(bytes)
}

/// The lines with content, numbered from one.
fn lines(text: &str) -> impl Iterator<Item = (usize, &str)> {
    let text = text.trim_start_matches('\u{feff}');
    let numbered = text.lines().enumerate().map(|(index, line)| (index + 1, line.trim()));
    numbered.filter(|(_, line)| !line.is_empty() && !line.starts_with('#'))
}

/// Index of a device in the list; appends the device if it is new.
fn index_of(devices: &mut Vec<HidRecording>, name: &str) -> usize {
    devices.iter().position(|device| device.device == name).unwrap_or_else(|| {
        devices.push(HidRecording { device: name.to_owned(), ..HidRecording::default() });
        devices.len() - 1
    })
}

/// Appends a report; fails if its time is before that of the last report.
fn add_report(device: &mut HidRecording, time_secs: f64, bytes: Vec<u8>) -> Result<(), String> {
    match device.reports.last() {
        Some(last) if time_secs < last.time_secs => {
            Err(format!("the time decreases from {} s to {time_secs} s", last.time_secs))
        }
        _ => {
            device.reports.push(TimedReport { time_secs, bytes });
            Ok(())
        }
    }
}

/// Parses a finite time in seconds.
fn time(word: &str) -> Result<f64, String> {
    let time = word.parse::<f64>().ok().filter(|time| time.is_finite()); // Other text is an error below.
    time.ok_or_else(|| format!("\"{}\" is not a time in seconds", short(word)))
}

/// Text for a message, truncated to 40 characters.
fn short(text: &str) -> String {
    text.chars().take(40).collect()
}

#[cfg(test)]
mod tests;
