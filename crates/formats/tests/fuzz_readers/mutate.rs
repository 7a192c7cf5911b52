//! Nearly valid inputs: seeded changes to bytes, tokens, brackets and numbers of valid files.

use std::ops::Range;

use shagreen_core::maths::rng::Random;

/// Maximum length of an input, in bytes.
const MAX_BYTES: usize = 1 << 18;
/// Replacements for a number: limits of every type, and invalid numbers.
const NUMBERS: [&str; 22] = [
    "nan",
    "NaN",
    "-nan",
    "inf",
    "-inf",
    "1e999",
    "-1e999",
    "1e308",
    "1e-320",
    "-0",
    "0",
    "-1",
    "1",
    "0.5",
    "1,5",
    "255",
    "65536",
    "4294967295",
    "9007199254740993",
    "18446744073709551616",
    "3.1415926535897932",
    "",
];
/// Opening brackets with their closing ones.
const BRACKETS: [(u8, u8); 5] = [(b'{', b'}'), (b'[', b']'), (b'<', b'>'), (b'"', b'"'), (b'\n', b'\n')];
/// Texts that nest a parser one level deeper each.
const NESTS: [&str; 6] = ["[", "{\"a\":", "<a>", "<a b=\"", "a.", "\"\""];
/// Words with a special meaning in some format.
const WORDS: [&str; 12] = [
    "null",
    "true",
    "<!DOCTYPE a [<!ENTITY b \"c\">]>",
    "&b;",
    "]]>",
    "<![CDATA[",
    "\u{feff}",
    "\u{0}",
    ";",
    "\t",
    ",",
    "\r\n",
];

/// Returns a mutated copy of one of `seeds`.
pub(crate) fn mutate(seeds: &[Vec<u8>], random: &mut Random) -> Vec<u8> {
    let mut bytes = seeds[below(random, seeds.len())].clone();
    // Mostly one or two changes, because inputs with many are rejected early.
    let most = 1 << below(random, 4);
    let n_changes = 1 + below(random, most);
    for _ in 0..n_changes {
        let other = &seeds[below(random, seeds.len())];
        change(&mut bytes, other, random);
        bytes.truncate(MAX_BYTES);
    }
    bytes
}

/// A random number below `n`; zero if `n` is zero.
fn below(random: &mut Random, n: usize) -> usize {
    (random.next_u64() % (n.max(1) as u64)) as usize
}

fn change(bytes: &mut Vec<u8>, other: &[u8], random: &mut Random) {
    let at = below(random, bytes.len());
    match below(random, 16) {
        0 => bytes.iter_mut().skip(at).take(1).for_each(|byte| *byte ^= 1 << below(random, 8)),
        1 => bytes.iter_mut().skip(at).take(1).for_each(|byte| *byte = below(random, 256) as u8),
        2 => bytes.truncate(at),
        3 => replace(bytes, stretch(bytes.len(), random), b""),
        4 => {
            let copy = bytes[stretch(bytes.len(), random)].to_vec();
            replace(bytes, at..at, &copy);
        }
        5 => {
            let range = stretch(bytes.len(), random);
            replace(bytes, range, &other[stretch(other.len(), random)]);
        }
        6..=8 => {
            let number = NUMBERS[below(random, NUMBERS.len())];
            replace_all(bytes, number_near, number.as_bytes(), random);
        }
        9 => replace(bytes, bracketed(bytes, at), b""),
        10 => {
            let range = bracketed(bytes, at);
            let copy = bytes[range.clone()].repeat(1 + below(random, 3));
            replace(bytes, range.end..range.end, &copy);
        }
        11 => {
            let range = bracketed(bytes, at);
            let source = bracketed(other, below(random, other.len()));
            replace(bytes, range, &other[source]);
        }
        12 => {
            let depth = 1 << below(random, 13);
            let nest = NESTS[below(random, NESTS.len())].repeat(depth);
            replace(bytes, at..at, nest.as_bytes());
        }
        13 => replace(bytes, at..at, WORDS[below(random, WORDS.len())].as_bytes()),
        // Limits of integers in binary files.
        14 => {
            let value =
                [0, 1, 0x7F, 0xFF, 0xFFFF, 0x7FFF_FFFF, u32::MAX, 1 << below(random, 32)][below(random, 8)];
            let width = [1, 2, 4][below(random, 3)];
            let range = at..(at + width).min(bytes.len());
            let ordered = if below(random, 2) == 0 { value.to_le_bytes() } else { value.to_be_bytes() };
            let start = if below(random, 2) == 0 { 0 } else { 4 - width };
            let part = ordered[start..start + range.len()].to_vec();
            replace(bytes, range, &part);
        }
        _ => replace_all(bytes, word_near, b"x", random),
    }
}

fn replace(bytes: &mut Vec<u8>, range: Range<usize>, with: &[u8]) {
    bytes.splice(range, with.iter().copied());
}

/// Replaces the token near a random offset.
fn replace_all(
    bytes: &mut Vec<u8>,
    near: impl Fn(&[u8], usize) -> Range<usize>,
    with: &[u8],
    random: &mut Random,
) {
    let range = near(bytes, below(random, bytes.len()));
    replace(bytes, range, with);
}

/// A short random range, or sometimes a long one.
fn stretch(len: usize, random: &mut Random) -> Range<usize> {
    let start = below(random, len);
    let longest = if below(random, 4) == 0 { len } else { 64 };
    start..(start + below(random, longest)).min(len)
}

/// The first run of matching bytes from `at` on; an empty range at the end if there is none.
fn run_near(bytes: &[u8], at: usize, is_of: impl Fn(&u8) -> bool) -> Range<usize> {
    let start = bytes[at..].iter().position(&is_of).map_or(bytes.len(), |skip| at + skip);
    let len = bytes[start..].iter().position(|byte| !is_of(byte)).unwrap_or(bytes.len() - start);
    start..start + len
}

fn number_near(bytes: &[u8], at: usize) -> Range<usize> {
    run_near(bytes, at, |byte| byte.is_ascii_digit() || b".-+e".contains(byte))
}

fn word_near(bytes: &[u8], at: usize) -> Range<usize> {
    run_near(bytes, at, u8::is_ascii_alphabetic)
}

/// The range from the next opening bracket to its closing one, or to the end.
fn bracketed(bytes: &[u8], at: usize) -> Range<usize> {
    let Some(start) = (at..bytes.len()).find(|i| BRACKETS.iter().any(|(open, _)| *open == bytes[*i])) else {
        return bytes.len()..bytes.len();
    };
    let (open, close) = BRACKETS[BRACKETS.iter().position(|(open, _)| *open == bytes[start]).unwrap_or(0)];
    let mut depth = 0_usize;
    for (i, byte) in bytes.iter().enumerate().skip(start) {
        if *byte == close && (open != close || i > start) {
            depth -= usize::from(open != close);
            if depth == 0 {
                return start..i + 1;
            }
        } else if *byte == open {
            depth += usize::from(open != close);
        }
    }
    start..bytes.len()
}

/// Recomputes the checksum of every PNG chunk, so that the decoder reads its contents.
pub(crate) fn repair_png(bytes: &mut [u8]) {
    let mut at = 8;
    while let Some(length) = bytes.get(at..at + 4).and_then(|b| <[u8; 4]>::try_from(b).ok()) {
        let end = at.saturating_add(8).saturating_add(u32::from_be_bytes(length) as usize);
        let Some(chunk) = bytes.get(at + 4..end) else { return };
        let sum = crc32(chunk).to_be_bytes();
        let Some(place) = bytes.get_mut(end..end + 4) else { return };
        place.copy_from_slice(&sum);
        at = end + 4;
    }
}

/// CRC-32 of ISO 3309, bit by bit, because inputs are short.
fn crc32(bytes: &[u8]) -> u32 {
    !bytes.iter().fold(u32::MAX, |sum, byte| {
        (0..8).fold(sum ^ u32::from(*byte), |sum, _| (sum >> 1) ^ (0xEDB8_8320 & (sum & 1).wrapping_neg()))
    })
}
