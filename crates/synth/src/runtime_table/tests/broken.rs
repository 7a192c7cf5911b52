//! Bytes that are no table, and textures that cannot be one.

extern crate std;

use super::{LAYERED, PUBLISHED, read, with_layers};
use crate::contact::Contact;
use crate::height_map::HeightMapError;
use crate::relief::ReliefError;
use crate::runtime_table::sections::CHECKSUM;
use crate::runtime_table::{About, Content, Table, TableError, write};
use crate::runtime_voice::{RuntimeVoice, Touch, VoiceSettings};
use crate::tap::Tap;
use crate::texture::tests::{parts, square};
use crate::texture::{MAX_NODES, MAX_ORDER, Node, Parts, Texture, TextureError};
use proptest::prelude::{any, prop, prop_assert, proptest};
use std::vec;
use std::vec::Vec;

/// Name and content of a section.
type Section = ([u8; 4], Vec<u8>);

/// Sections of a table.
fn sections(table: &[u8]) -> Vec<Section> {
    let mut rest = &table[12..table.len() - 4];
    let mut sections = Vec::new();
    while let Some((letters, after)) = rest.split_first_chunk::<4>() {
        let (length, after) = after.split_first_chunk::<4>().unwrap();
        let (content, after) = after.split_at(u32::from_le_bytes(*length) as usize);
        sections.push((*letters, content.to_vec()));
        rest = after;
    }
    sections
}

/// A table of these sections.
fn table_of(sections: &[Section]) -> Vec<u8> {
    let mut bytes = LAYERED[..12].to_vec();
    for (letters, content) in sections {
        bytes.extend(letters);
        bytes.extend((content.len() as u32).to_le_bytes());
        bytes.extend(content);
    }
    bytes.extend([0; 4]);
    sealed(bytes)
}

/// The bytes with the right length and checksum.
fn sealed(mut bytes: Vec<u8>) -> Vec<u8> {
    let length = (bytes.len() as u32).to_le_bytes();
    bytes[8..12].copy_from_slice(&length);
    let end = bytes.len() - 4;
    let checksum = CHECKSUM.checksum(&bytes[..end]).to_le_bytes();
    bytes[end..].copy_from_slice(&checksum);
    bytes
}

fn error(bytes: &[u8]) -> Option<TableError> {
    read(bytes, |_, _| {}).err()
}

/// Error of the layered table with one changed section.
fn error_with(letters: &[u8], change: impl FnOnce(&mut Vec<u8>)) -> Option<TableError> {
    let mut sections = sections(LAYERED);
    let (_, content) = sections.iter_mut().find(|(name, _)| name[..] == *letters).unwrap();
    change(content);
    error(&table_of(&sections))
}

fn put(content: &mut [u8], at: usize, value: f32) {
    content[at..at + 4].copy_from_slice(&value.to_le_bytes());
}

#[test]
fn a_changed_byte_is_found_wherever_it_is() {
    for table in [LAYERED, PUBLISHED] {
        assert_eq!(error(table), None);
        let mut bytes = table.to_vec();
        for i in 0..bytes.len() {
            for mask in [0x01, 0x80, 0xFF] {
                bytes[i] ^= mask;
                let found = Table::open(&bytes).err();
                bytes[i] ^= mask;
                let expected = match i {
                    0..4 => TableError::Foreign,
                    4..6 => TableError::Version,
                    8..12 => TableError::Length,
                    _ => TableError::Checksum,
                };
                assert_eq!(found, Some(expected), "byte {i}");
            }
        }
    }
}

#[test]
fn tables_that_are_cut_off_or_too_long_are_refused() {
    for n in 0..LAYERED.len() {
        let expected = if n < 4 { TableError::Foreign } else { TableError::Length };
        assert_eq!(error(&LAYERED[..n]), Some(expected), "{n} bytes");
    }
    let mut longer = LAYERED.to_vec();
    longer.push(0);
    assert_eq!(error(&longer), Some(TableError::Length));
    assert_eq!(error(b"my notes"), Some(TableError::Foreign));
}

#[test]
fn other_minor_versions_are_read_and_other_major_ones_are_not() {
    let with = |at: usize, version: u8| {
        let mut bytes = LAYERED.to_vec();
        bytes[at] = version;
        error(&sealed(bytes))
    };
    assert_eq!((with(6, 9), with(4, 2)), (None, Some(TableError::Version)));
}

#[test]
fn further_sections_and_fields_are_skipped() {
    let mut more = sections(LAYERED);
    more.insert(3, (*b"LATR", vec![1, 2, 3]));
    for (letters, content) in &mut more {
        if [b"HEAD", b"FRIC", b"TAPS"].contains(&&*letters) {
            content.extend([0xFF; 5]);
        }
    }
    more.reverse();
    with_layers(|content| {
        let same = |table: Table<'_>, texture: Texture<'_>| {
            assert_eq!((texture.parts(), table.tap()), (content.parts, content.tap));
        };
        read(&table_of(&more), same).unwrap();
    });
}

#[test]
fn sections_that_are_missing_or_repeated_are_refused() {
    let all = sections(LAYERED);
    for (i, (letters, _)) in all.iter().enumerate() {
        let mut fewer = all.clone();
        fewer.remove(i);
        let needed = [b"HEAD", b"NODE", b"TRIA", b"NODL", b"TRIL"].contains(&letters);
        assert_eq!(error(&table_of(&fewer)), needed.then_some(TableError::Section), "{letters:?}");
        let mut twice = all.clone();
        twice.push(all[i].clone());
        assert_eq!(error(&table_of(&twice)), Some(TableError::Section), "{letters:?}");
    }
    // A section that reaches beyond the others.
    let mut bytes = LAYERED.to_vec();
    bytes[16] = 0xFF;
    assert_eq!(error(&sealed(bytes)), Some(TableError::Section));
}

#[test]
fn sections_with_parts_of_a_number_or_of_a_record_are_refused() {
    for letters in [b"HEAD", b"NODE", b"TRIA", b"NODL", b"TRIL", b"RELI", b"HMAP", b"FRIC", b"TAPS"] {
        let shorter = error_with(letters, |content| content.truncate(content.len() - 1));
        assert_eq!(shorter, Some(TableError::Section), "{letters:?}");
    }
    // Whole samples, but not those of all octaves; and a number of samples whose octaves no memory holds.
    for letters in [b"RELI", b"HMAP"] {
        let shorter = error_with(letters, |content| content.truncate(content.len() - 4));
        assert_eq!(shorter, Some(TableError::Section), "{letters:?}");
    }
    for (letters, at) in [(b"RELI", 8), (b"HMAP", 16)] {
        for n in [0_u32, 3, 1 << 16, 1 << 31, u32::MAX] {
            let error = error_with(letters, |content| content[at..at + 4].copy_from_slice(&n.to_le_bytes()));
            assert_eq!(error, Some(TableError::Section), "{letters:?} of {n}");
        }
    }
}

#[test]
fn numbers_that_are_no_texture_are_refused() {
    let bad = f32::NAN;
    for order in [0, MAX_ORDER as u8 + 1] {
        let error = error_with(b"HEAD", |content| content[16] = order);
        assert_eq!(error, Some(TableError::Texture(TextureError::Order)));
    }
    let check = |letters, at, value, expected| {
        assert_eq!(error_with(letters, |content| put(content, at, value)), Some(expected), "{letters:?}");
    };
    check(b"HEAD", 0, bad, TableError::Texture(TextureError::Range));
    check(b"HEAD", 12, bad, TableError::Texture(TextureError::Layer));
    check(b"NODE", 0, -1.0, TableError::Texture(TextureError::Number));
    check(b"NODE", 4, bad, TableError::Texture(TextureError::Number));
    check(b"TRIA", 12, bad, TableError::Texture(TextureError::Number));
    check(b"TRIL", 0, bad, TableError::Texture(TextureError::Triangle));
    check(b"FRIC", 0, -1.0, TableError::Texture(TextureError::Layer));
    check(b"RELI", 0, 0.0, TableError::Relief(ReliefError::Range));
    check(b"RELI", 12, bad, TableError::Relief(ReliefError::Number));
    check(b"HMAP", 8, 0.0, TableError::HeightMap(HeightMapError::Range));
    check(b"HMAP", 20, bad, TableError::HeightMap(HeightMapError::Number));
    check(b"TAPS", 8, f32::INFINITY, TableError::Tap);
    check(b"TAPS", 0, -1.0, TableError::Tap);
    for text in [&[0xC3][..], b"a\0b"] {
        let error = error_with(b"NAME", |content| *content = text.to_vec());
        assert_eq!(error, Some(TableError::Text));
    }
}

/// The lengths of a table never demand memory out of proportion to its bytes.
#[test]
fn more_nodes_than_indices_reach_are_refused_before_there_is_memory_for_them() {
    let opened = |table: &[u8], letters: &[u8], n_bytes: usize| {
        let mut sections = sections(table);
        let (_, content) = sections.iter_mut().find(|(name, _)| name[..] == *letters).unwrap();
        content.resize(n_bytes, 0);
        Table::open(&table_of(&sections)).err()
    };
    // A node of order 2 has 12 bytes, as has an excitation with one frequency of its moving average.
    for letters in [b"NODE", b"NODL"] {
        assert_eq!(opened(LAYERED, letters, 12 * MAX_NODES), None, "{letters:?}");
        let expected = Some(TableError::Texture(TextureError::Triangle));
        assert_eq!(opened(LAYERED, letters, 12 * (MAX_NODES + 1)), expected, "{letters:?}");
    }
    let expected = Some(TableError::Texture(TextureError::Excitation));
    assert_eq!(opened(PUBLISHED, b"EXCI", 12 * 5), expected);
}

#[test]
fn what_cannot_be_read_is_not_written() {
    let (nodes, triangles) = square();
    let good = Content { parts: parts(&nodes, &triangles), tap: None, about: About::default() };
    assert!(write(&good, &mut []).is_ok());
    let negative = Tap { frequency_hz: 100.0, decay_per_sec: -1.0, amplitude_mps2: 1.0 };
    assert_eq!(write(&Content { tap: Some(negative), ..good }, &mut []), Err(TableError::Tap));
    let about = About { origin: "a\0b", ..About::default() };
    assert_eq!(write(&Content { about, ..good }, &mut []), Err(TableError::Text));
    let none: &[Node] = &[];
    let parts = Parts { nodes: none, ..good.parts };
    let expected = Err(TableError::Texture(TextureError::Triangle));
    assert_eq!(write(&Content { parts, ..good }, &mut []), expected);
}

#[test]
fn every_error_says_what_to_do() {
    for error in [
        TableError::Foreign,
        TableError::Version,
        TableError::Length,
        TableError::Checksum,
        TableError::Section,
        TableError::Text,
        TableError::Tap,
        TableError::Memory,
        TableError::Texture(TextureError::Order),
        TableError::Relief(ReliefError::Range),
        TableError::HeightMap(HeightMapError::Range),
    ] {
        assert_eq!(error.text().split("; ").count(), 2, "{error:?}");
    }
}

proptest! {
    /// A table that someone has changed and sealed again is refused, or its texture stays within the limit.
    #[test]
    fn changed_tables_are_refused_or_harmless(
        changes in prop::collection::vec((any::<u16>(), any::<u8>()), 1..8),
        is_layered in any::<bool>(),
    ) {
        let table = if is_layered { LAYERED } else { PUBLISHED };
        let mut bytes = table.to_vec();
        let n = bytes.len() - 16;
        for (at, byte) in changes {
            bytes[12 + usize::from(at) % n] = byte;
        }
        let mut is_within = true;
        let play = |table: Table<'_>, texture: Texture<'_>| {
            let settings = VoiceSettings { sample_rate_hz: 8000.0, max_mps2: 5.0, seed: 1 };
            let Ok(mut voice) = RuntimeVoice::new(&texture, table.tap(), settings) else { return };
            voice.tap(Some(0.2));
            let mut out = [f32::NAN; 400];
            for i in 0..4 {
                let contact = Contact { speed_mps: 0.3, force_n: 0.4 };
                voice.process(&texture, &[Touch { x_m: 0.01 * f64::from(i), y_m: 0.0, contact }], &mut out);
                is_within &= out.iter().all(|x| x.abs() <= 5.0);
            }
        };
        // An error is as good.
        let _ = read(&sealed(bytes), play);
        prop_assert!(is_within);
    }
}
