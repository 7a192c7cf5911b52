//! HID report descriptors and recorded pen reports from files.

use std::path::Path;

use anyhow::{Context as _, bail};
use shagreen_device::hid::descriptor::{self, Descriptor};
use shagreen_device::hid::pen::{PenDecoder, PenFormat};
use shagreen_formats::bounded_file::FileKind;
use shagreen_formats::hid_text::{HidRecording, TimedReport, bytes_of_hex_file, is_hid_text, read_hid_text};

use crate::cli::output;
use shagreen_studio::file;

/// Device that a report descriptor in a file describes.
pub(crate) struct DeclaredDevice {
    /// Name of the device, if the file states it.
    pub(crate) name: Option<String>,
    /// Vendor and product identifiers, if the file states them.
    pub(crate) identity: Option<(u16, u16)>,
    /// Parsed report descriptor.
    pub(crate) descriptor: Descriptor,
}

impl DeclaredDevice {
    /// Returns the decoder of the device's pen: as declared, otherwise as known for this product.
    pub(crate) fn pen(&self) -> Option<PenDecoder> {
        PenDecoder::of_device(&self.descriptor, self.identity)
    }
}

/// Reads the report descriptors of a file: raw bytes, the same bytes in hexadecimal, or a recording of `hid-recorder`
/// or `usbhid-dump`.
pub(crate) fn read_descriptors(path: &Path) -> anyhow::Result<Vec<anyhow::Result<DeclaredDevice>>> {
    let bytes = file::read_file(path, FileKind::Table)?;
    let declared = |name: Option<String>, identity, bytes: &[u8]| {
        let descriptor = descriptor::parse(bytes)?;
        Ok(DeclaredDevice { name, identity, descriptor })
    };
    if is_hid_text(&bytes) {
        let recording = read_hid_text(&bytes)?;
        recording.warnings.iter().for_each(|warning| output::warn(warning));
        let found: Vec<_> = recording
            .value
            .into_iter()
            .filter_map(|device| {
                let bytes = device.descriptor?;
                Some(declared(device.name, device.identity, &bytes))
            })
            .collect();
        if found.is_empty() {
            bail!(
                "the recording contains no report descriptor; record again with hid-recorder or usbhid-dump --entity=all"
            );
        }
        return Ok(found);
    }
    let hex = bytes_of_hex_file(&bytes);
    Ok(vec![declared(None, None, hex.as_deref().unwrap_or(&bytes))])
}

/// Reports of one pen, and their decoder.
pub(crate) struct PenRecording {
    /// Decoder of the reports.
    pub(crate) decoder: PenDecoder,
    /// Reports in the order of time.
    pub(crate) reports: Vec<TimedReport>,
}

/// Returns the pen of a recording; of several devices, the one with the most decodable pen reports. `declared` is a
/// descriptor from another file; without it the recording must contain the descriptor, or be of a known device.
/// `size_m` is the size that the user states, in m.
pub(crate) fn read_pen_recording(
    bytes: &[u8],
    declared: Option<&DeclaredDevice>,
    size_m: Option<[f64; 2]>,
) -> anyhow::Result<PenRecording> {
    let recording = read_hid_text(bytes)?;
    recording.warnings.iter().for_each(|warning| output::warn(warning));
    let (mut best, mut n_best) = (None, 0);
    let (mut n_reports, mut n_pens) = (0, 0);
    let mut unlike = None;
    for device in recording.value {
        n_reports += device.reports.len();
        let Some(decoder) = decoder_of(&device, declared)? else { continue };
        n_pens += 1;
        unlike = unlike.or_else(|| Some((report_of(decoder.best()), device.reports.first()?.bytes.clone())));
        let n_decoded =
            device.reports.iter().filter(|report| decoder.decode(&report.bytes).is_some()).count();
        if n_decoded > n_best {
            (best, n_best) = (Some((decoder, device.reports)), n_decoded);
        }
    }
    if n_pens == 0 {
        bail!(
            "no pen is declared; give the report descriptor of the pen, or a recording that contains it (lines R: or DESCRIPTOR)"
        );
    }
    let Some((decoder, reports)) = best else {
        let Some((report, first)) = unlike else {
            bail!("the recording contains no report of the pen; record again and move the pen");
        };
        bail!(
            "none of the {n_reports} reports is from the pen: its descriptor declares {report}, but the first report has {} bytes and begins with {:02x}; record again and move the pen, or give the descriptor of the recorded pen",
            first.len(),
            first.first().copied().unwrap_or(0)
        );
    };
    Ok(PenRecording { decoder: decoder.with_size_m(size_m), reports })
}

/// Describes the format of a pen's reports, for an error message.
fn report_of(format: &PenFormat) -> String {
    let id = format.report_id.map_or("without id".to_owned(), |id| format!("that begin with {id:02x}"));
    format!("reports of {} bytes {id}", format.n_bytes)
}

fn decoder_of(
    device: &HidRecording,
    declared: Option<&DeclaredDevice>,
) -> anyhow::Result<Option<PenDecoder>> {
    if let Some(declared) = declared {
        let identity = device.identity.or(declared.identity);
        return Ok(PenDecoder::of_device(&declared.descriptor, identity));
    }
    match &device.descriptor {
        Some(bytes) => {
            let descriptor = descriptor::parse(bytes)
                .with_context(|| format!("device {} of the recording", device.device))?;
            Ok(PenDecoder::of_device(&descriptor, device.identity))
        }
        None => Ok(device.identity.and_then(|(vendor, product)| PenDecoder::of_known(vendor, product))),
    }
}

/// Parses width and height in mm, such as `216x135`.
pub(crate) fn size_mm(text: &str) -> Result<[f64; 2], String> {
    let sides: Vec<f64> = text.split(['x', 'X']).filter_map(|side| side.trim().parse().ok()).collect(); // Other text changes the count and is rejected below.
    match sides[..] {
        [width, height] if [width, height].iter().all(|side| (1.0..=10_000.0).contains(side)) => {
            Ok([width, height])
        }
        _ => Err("it must be width and height in mm, such as 216x135".to_owned()),
    }
}

/// Converts mm to m.
pub(crate) fn meters(size_mm: Option<[f64; 2]>) -> Option<[f64; 2]> {
    size_mm.map(|sides| sides.map(|side| 1e-3 * side))
}

#[cfg(test)]
mod tests {
    use super::size_mm;

    #[test]
    fn sizes() {
        assert_eq!(size_mm("216x135"), Ok([216.0, 135.0]));
        assert_eq!(size_mm("81.25X58"), Ok([81.25, 58.0]));
        for text in ["", "216", "216x", "0x10", "1x2x3", "-5x10", "nanx1", "axb"] {
            assert!(size_mm(text).is_err(), "{text}");
        }
    }
}
