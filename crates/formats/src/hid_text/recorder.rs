//! Text format of `hid-recorder`.

use crate::hid_text::{Damage, HidRecording, add_report, bytes_of_hex, index_of, lines, short, time};

/// Returns whether a line is a valid `R:` or `E:` line, which identify the format.
pub(super) fn is_line(line: &str) -> bool {
    match split(line) {
        Some(('R', rest)) => counted_bytes(rest).is_ok(),
        Some(('E', rest)) => event(rest).is_ok(),
        _ => false,
    }
}

pub(super) fn read(text: &str) -> (Vec<HidRecording>, Vec<Damage>) {
    let (mut devices, mut damages) = (Vec::new(), Vec::new());
    let mut current = "0".to_owned();
    for (line, text) in lines(text) {
        let taken = match split(text) {
            Some(('D', rest)) if rest.parse::<u32>().is_ok() => {
                rest.clone_into(&mut current);
                Ok(())
            }
            Some((letter, rest)) => {
                let index = index_of(&mut devices, &current);
                take(&mut devices[index], letter, rest)
            }
            None => Err(format!("\"{}\" is not a line of a hid-recorder file", short(text))),
        };
        if let Err(problem) = taken {
            damages.push(Damage { line, problem });
        }
    }
    (devices, damages)
}

/// Splits a line into its letter and the text after the colon.
fn split(line: &str) -> Option<(char, &str)> {
    let (letter, rest) = line.split_once(':')?;
    let mut letters = letter.chars();
    let first = letters.next().filter(char::is_ascii_uppercase)?;
    letters.next().is_none().then(|| (first, rest.trim()))
}

fn take(device: &mut HidRecording, letter: char, rest: &str) -> Result<(), String> {
    match letter {
        'R' => device.descriptor = Some(counted_bytes(rest)?),
        'N' => device.name = Some(rest.to_owned()).filter(|name| !name.is_empty()),
        'I' => device.identity = Some(identity(rest)?),
        'E' => {
            let (time_secs, bytes) = event(rest)?;
            add_report(device, time_secs, bytes)?;
        }
        // The connection path, and lines that later versions may add.
        _ => {}
    }
    Ok(())
}

/// Parses a time, a number of bytes, and the bytes.
fn event(rest: &str) -> Result<(f64, Vec<u8>), String> {
    let (time_text, rest) = rest.split_once(char::is_whitespace).ok_or("the line ends after the time")?;
    Ok((time(time_text)?, counted_bytes(rest.trim())?))
}

/// Parses a number of bytes, and that many bytes.
fn counted_bytes(rest: &str) -> Result<Vec<u8>, String> {
    let (count, bytes) = rest.split_once(char::is_whitespace).ok_or("the bytes are missing")?;
    let count: usize = count.parse().map_err(|_| format!("\"{}\" is not a number of bytes", short(count)))?;
    let bytes = bytes_of_hex(bytes).ok_or("the bytes are not hexadecimal")?;
    if bytes.len() == count {
        Ok(bytes)
    } else {
        Err(format!("the line states {count} bytes but has {}", bytes.len()))
    }
}

/// Parses bus, vendor and product, in hexadecimal.
fn identity(rest: &str) -> Result<(u16, u16), String> {
    let numbers: Vec<u16> =
        rest.split_whitespace().filter_map(|word| u16::from_str_radix(word, 16).ok()).collect(); // An invalid word changes the count.
    match numbers[..] {
        [_, vendor_id, product_id] => Ok((vendor_id, product_id)),
        _ => Err(format!("\"{}\" is not a bus, vendor and product", short(rest))),
    }
}
