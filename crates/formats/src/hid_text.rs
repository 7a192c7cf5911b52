//! Reports of input devices as text, as `hid-recorder` and `usbhid-dump` write them.
//!
//! `hid-recorder`: a line `R:` holds the number of bytes of a report descriptor and the bytes, `N:` a name, `I:` bus,
//! vendor and product, and each `E:` a time in seconds, a number of bytes and a report; `D:` says which of several
//! devices the lines that follow are of, and `#` begins a comment. `usbhid-dump`: a line `BUS:DEVICE:INTERFACE:STREAM
//! TIME` (or `DESCRIPTOR`) is followed by lines of bytes. All bytes are hexadecimal. Text is UTF-8, or UTF-16 with its mark,
//! as some shells write what a program prints.

mod dump;
mod recorder;

use crate::csv_text::{text, text_with_odd_letters};
use crate::imported::Imported;

/// A report and when it came.
#[derive(Clone, Debug, PartialEq)]
pub struct TimedReport {
    /// When, in seconds on the recorder's clock; never before the report ahead of it.
    pub time_secs: f64,
    /// Its bytes, the first of which is its id where the device has several reports.
    pub bytes: Vec<u8>,
}

/// What a file tells of one device.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct HidRecording {
    /// What the file calls it: its number there, or bus, device and interface.
    pub device: String,
    /// Its own name.
    pub name: Option<String>,
    /// Its vendor and product.
    pub identity: Option<(u16, u16)>,
    /// Its report descriptor.
    pub descriptor: Option<Vec<u8>>,
    /// Its reports in the order of time.
    pub reports: Vec<TimedReport>,
}

/// Why text holds nothing of a device.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[non_exhaustive]
pub enum HidTextError {
    /// No line of the kind.
    #[error(
        "this is no recording of an input device; make one with hid-recorder, or with usbhid-dump --entity=all"
    )]
    NotARecording,
    /// Lines of the kind, but none that can be read.
    #[error("line {line}: {problem}; nothing else in the file can be read either: get a complete copy")]
    Unreadable {
        /// The first such line, from one.
        line: usize,
        /// What is wrong with it.
        problem: String,
    },
    /// Neither a descriptor nor a report.
    #[error("the recording holds neither a report descriptor nor a report; record again and move the pen")]
    Empty,
}

/// A line that was not used, and why.
struct Damage {
    line: usize,
    problem: String,
}

/// Warnings of one file at most: what follows is counted.
const MAX_WARNINGS: usize = 20;

/// Whether bytes look like one of these recordings: text with a line that only they have.
pub fn is_hid_text(bytes: &[u8]) -> bool {
    let Ok(text) = text(bytes) else { return false };
    lines(&text).any(|(_, line)| recorder::is_line(line) || dump::heading(line).is_some())
}

/// Reads a recording: the devices of which there is a descriptor or a report, in the order of the file. Lines that are
/// damaged are left out, with a warning.
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
        .map(|Damage { line, problem }| format!("line {line} was left out: {problem}"))
        .collect();
    match damages.count() {
        0 => {}
        n => warnings.push(format!("{n} more lines were left out")),
    }
    Ok(Imported { value: devices, warnings })
}

/// The bytes of a file that is text of nothing but bytes, as [`bytes_of_hex`] reads it; `None` if it is anything else.
pub fn bytes_of_hex_file(bytes: &[u8]) -> Option<Vec<u8>> {
    bytes_of_hex(&text(bytes).ok()?) // What is no text is something else.
}

/// Bytes as pairs of hexadecimal digits, with or without white space, commas and `0x` between; `None` if it is anything
/// else, or empty.
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
            let pair = std::str::from_utf8(pair).ok()?; // Digits are ASCII.
            bytes.push(u8::from_str_radix(pair, 16).ok()?); // They were checked.
        }
    }
    (!bytes.is_empty()).then_some(bytes)
}

/// The lines that say something, with their numbers from one.
fn lines(text: &str) -> impl Iterator<Item = (usize, &str)> {
    let text = text.trim_start_matches('\u{feff}');
    let numbered = text.lines().enumerate().map(|(index, line)| (index + 1, line.trim()));
    numbered.filter(|(_, line)| !line.is_empty() && !line.starts_with('#'))
}

/// The place of a device in the list, which gets it if it is not there.
fn index_of(devices: &mut Vec<HidRecording>, name: &str) -> usize {
    devices.iter().position(|device| device.device == name).unwrap_or_else(|| {
        devices.push(HidRecording { device: name.to_owned(), ..HidRecording::default() });
        devices.len() - 1
    })
}

/// Adds a report, unless time goes back.
fn add_report(device: &mut HidRecording, time_secs: f64, bytes: Vec<u8>) -> Result<(), String> {
    match device.reports.last() {
        Some(last) if time_secs < last.time_secs => {
            Err(format!("time goes back, from {} s to {time_secs} s", last.time_secs))
        }
        _ => {
            device.reports.push(TimedReport { time_secs, bytes });
            Ok(())
        }
    }
}

/// A time in seconds.
fn time(word: &str) -> Result<f64, String> {
    let time = word.parse::<f64>().ok().filter(|time| time.is_finite()); // Anything else is said below.
    time.ok_or_else(|| format!("\"{}\" is no time in seconds", short(word)))
}

/// Text for a message, cut off where it is long.
fn short(text: &str) -> String {
    text.chars().take(40).collect()
}

#[cfg(test)]
mod tests;
