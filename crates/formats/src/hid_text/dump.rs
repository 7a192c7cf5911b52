//! Text format of `usbhid-dump`.

use crate::hid_text::{Damage, HidRecording, add_report, bytes_of_hex, index_of, lines, short, time};

/// The kind of bytes below a heading.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Part {
    Descriptor,
    Stream,
}

/// Splits a heading such as `001:005:000:STREAM 1234567.123456` into device, part and time text.
pub(super) fn heading(line: &str) -> Option<(&str, Part, &str)> {
    let (head, time) = line.split_once(char::is_whitespace)?;
    let (device, part) = head.rsplit_once(':')?;
    let part = match part {
        "DESCRIPTOR" => Part::Descriptor,
        "STREAM" => Part::Stream,
        _ => return None,
    };
    let numbers = device.split(':').filter(|number| number.parse::<u16>().is_ok()).count();
    (numbers == 3 && device.matches(':').count() == 2).then(|| (device, part, time.trim()))
}

/// A heading and the bytes below it so far.
struct Block<'a> {
    line: usize,
    device: &'a str,
    part: Part,
    time: &'a str,
    bytes: Result<Vec<u8>, String>,
}

pub(super) fn read(text: &str) -> (Vec<HidRecording>, Vec<Damage>) {
    let (mut devices, mut damages) = (Vec::new(), Vec::new());
    let mut end = |block: Option<Block<'_>>, damages: &mut Vec<Damage>| {
        if let Some(block) = block {
            let line = block.line;
            if let Err(problem) = block.end(&mut devices) {
                damages.push(Damage { line, problem });
            }
        }
    };
    let mut block: Option<Block<'_>> = None;
    for (line, text) in lines(text) {
        if let Some((device, part, time)) = heading(text) {
            end(block.take(), &mut damages);
            block = Some(Block { line, device, part, time, bytes: Ok(Vec::new()) });
            continue;
        }
        match (&mut block, bytes_of_hex(text)) {
            (Some(Block { bytes: Ok(bytes), .. }), Some(more)) => bytes.extend(more),
            (Some(Block { bytes: Err(_), .. }), _) => {}
            // A message of the program between two blocks.
            (_, None)
                if text.split_whitespace().count() > 1
                    && text.starts_with(char::is_alphabetic)
                    && !is_cut(text) => {}
            (Some(block), _) => {
                block.bytes = Err(format!("\"{}\" below it is not a row of hexadecimal bytes", short(text)));
            }
            (None, _) => {
                damages
                    .push(Damage { line, problem: format!("\"{}\" has no heading above it", short(text)) });
            }
        }
    }
    end(block, &mut damages);
    (devices, damages)
}

/// Returns whether a line is a damaged row of bytes: at least half of its words are bytes.
fn is_cut(text: &str) -> bool {
    let n_bytes =
        text.split_whitespace().filter(|word| word.len() == 2 && bytes_of_hex(word).is_some()).count();
    2 * n_bytes >= text.split_whitespace().count()
}

impl Block<'_> {
    fn end(self, devices: &mut Vec<HidRecording>) -> Result<(), String> {
        let bytes = self.bytes?;
        if bytes.is_empty() {
            return Err("no bytes follow it".to_owned());
        }
        let index = index_of(devices, self.device);
        match self.part {
            Part::Descriptor => devices[index].descriptor = Some(bytes),
            Part::Stream => add_report(&mut devices[index], time(self.time)?, bytes)?,
        }
        Ok(())
    }
}
