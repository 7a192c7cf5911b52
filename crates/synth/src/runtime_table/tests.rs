extern crate std;
use super::{About, Arrays, Content, Lengths, Memory, Table, TableError, write};
use crate::contact::Contact;
use crate::height_map::{self, HeightMap, PATCH_FORCES};
use crate::relief::Relief;
use crate::runtime_voice::{RuntimeVoice, Touch, VoiceSettings};
use crate::stick_slip::Friction;
use crate::tap::Tap;
use crate::texture::tests::{parts, square};
use crate::texture::{Along, Excitation, MAX_MA_ORDER, MAX_ORDER, Node, Parts, Texture, Triangle};
use std::vec;
use std::vec::Vec;

mod broken;

/// Tables of a script that follows the description of the format alone.
const LAYERED: &[u8] = include_bytes!("../../../../vectors/p_runtime_table/layered.shgt");
const PUBLISHED: &[u8] = include_bytes!("../../../../vectors/p_runtime_table/published.shgt");

/// Memory that a table fills.
struct Filled {
    nodes: Vec<Node>,
    triangles: Vec<Triangle>,
    excitations: Vec<Excitation>,
    samples: Vec<f32>,
}

impl Filled {
    /// Memory of these lengths, full of numbers that no texture has.
    fn of(lengths: Lengths) -> Self {
        let lsf = [f32::NAN; MAX_ORDER];
        let triangle =
            Triangle { nodes: [9; 3], neighbors: [9; 3], weights: [f32::NAN; 6], ln_gain: [f32::NAN; 6] };
        Self {
            nodes: vec![Node { level_mps2: f32::NAN, lsf }; lengths.n_nodes],
            triangles: vec![triangle; lengths.n_triangles],
            excitations: vec![
                Excitation {
                    variance: f32::NAN,
                    gain: f32::NAN,
                    ma_lsf: [f32::NAN; MAX_MA_ORDER]
                };
                lengths.n_excitations
            ],
            samples: vec![f32::NAN; lengths.n_samples],
        }
    }

    fn memory(&mut self) -> Memory<'_> {
        let Self { nodes, triangles, excitations, samples } = self;
        Memory { nodes, triangles, excitations, samples }
    }

    fn arrays(&self) -> Arrays<'_> {
        let Self { nodes, triangles, excitations, samples } = self;
        Arrays { nodes, triangles, excitations, samples }
    }
}

fn written(content: &Content<'_>) -> Vec<u8> {
    let n = write(content, &mut []).unwrap();
    let mut bytes = vec![0xA5; n];
    assert_eq!(write(content, &mut bytes), Ok(n));
    bytes
}

/// Reads a table, and lends its texture.
fn read(bytes: &[u8], check: impl FnOnce(Table<'_>, Texture<'_>)) -> Result<(), TableError> {
    let table = Table::open(bytes)?;
    let mut filled = Filled::of(table.lengths());
    table.load(filled.memory())?;
    check(table, table.head().view(filled.arrays()));
    Ok(())
}

/// Lends the content of the layered table.
fn with_layers(check: impl FnOnce(Content<'_>)) {
    let (nodes, triangles) = square();
    let mut along_nodes = nodes;
    for node in &mut along_nodes {
        node.level_mps2 *= 3.0;
        node.lsf[..2].iter_mut().for_each(|w| *w += 1.0);
    }
    let octaves = [0.5, -0.5, 0.25, -0.25];
    let n_heights = PATCH_FORCES.len() * height_map::length(4);
    let heights: Vec<f32> = (0..n_heights).map(|i| i as f32 * 1e-6).collect();
    check(Content {
        parts: Parts {
            along: Some(Along { nodes: &along_nodes, triangles: &triangles }),
            turn_rad: 0.25,
            relief: Some(Relief::new(1e-4, 1.0, 4, &octaves).unwrap()),
            height_map: Some(HeightMap::new(0.01, 1.0, 1.5, 4, &heights).unwrap()),
            friction: Some(Friction { kinetic: 0.4, static_ratio: 1.5, stribeck_speed_mps: 0.02 }),
            ..parts(&nodes, &triangles)
        },
        tap: Some(Tap { frequency_hz: 180.0, decay_per_sec: 90.0, amplitude_mps2: 6.0 }),
        about: About {
            name: "Square °",
            terms: "CC0-1.0",
            origin: "Made up.",
            created_by: "nobody",
            is_restricted: true,
        },
    });
}

/// Lends the content of the published table.
fn with_excitations(check: impl FnOnce(Content<'_>)) {
    let (nodes, triangles) = square();
    let excitations: [Excitation; 4] = core::array::from_fn(|i| {
        let mut ma_lsf = [0.0; MAX_MA_ORDER];
        ma_lsf[0] = 1.0 + 0.25 * i as f32;
        Excitation { variance: i as f32, gain: 0.5 * i as f32, ma_lsf }
    });
    let parts = Parts { ma_order: 1, excitations: &excitations, ..parts(&nodes, &triangles) };
    check(Content { parts, tap: None, about: About::default() });
}

#[test]
fn tables_are_those_of_the_script_to_the_last_byte() {
    with_layers(|content| assert_eq!(written(&content), LAYERED));
    with_excitations(|content| assert_eq!(written(&content), PUBLISHED));
}

#[test]
fn what_is_read_is_what_was_written() {
    let check = |bytes: &[u8], content: Content<'_>| {
        let same = |table: Table<'_>, texture: Texture<'_>| {
            assert_eq!(texture.parts(), content.parts);
            assert_eq!((table.tap(), table.about()), (content.tap, content.about));
        };
        read(bytes, same).unwrap();
    };
    with_layers(|content| check(LAYERED, content));
    with_excitations(|content| check(PUBLISHED, content));
}

#[test]
fn memory_is_as_long_as_stated_and_never_written_beyond() {
    let table = Table::open(LAYERED).unwrap();
    let lengths = table.lengths();
    let expected = Lengths { n_nodes: 8, n_triangles: 4, n_excitations: 0, n_samples: 4 + 3 * 16 };
    assert_eq!(lengths, expected);
    assert_eq!(lengths.bytes(), 8 * 260 + 4 * 60 + 52 * 4);
    // One more of each.
    let Lengths { n_nodes, n_triangles, n_samples, .. } = lengths;
    let more = Lengths {
        n_nodes: n_nodes + 1,
        n_triangles: n_triangles + 1,
        n_excitations: 1,
        n_samples: n_samples + 1,
    };
    let mut filled = Filled::of(more);
    assert!(table.load(filled.memory()).is_ok());
    assert!(filled.nodes[n_nodes].level_mps2.is_nan() && filled.triangles[n_triangles].nodes == [9; 3]);
    assert!(filled.samples[n_samples].is_nan() && filled.excitations[0].gain.is_nan());
    // One less of one.
    let shorter = [
        Lengths { n_nodes: n_nodes - 1, ..lengths },
        Lengths { n_triangles: n_triangles - 1, ..lengths },
        Lengths { n_samples: n_samples - 1, ..lengths },
    ];
    for lengths in shorter {
        let mut filled = Filled::of(lengths);
        assert_eq!(table.load(filled.memory()).err(), Some(TableError::Memory), "{lengths:?}");
    }
}

/// The length is returned for memory of any length, and bytes that do not fit are not written.
#[test]
fn a_table_needs_memory_of_its_length() {
    with_layers(|content| {
        for n in [0, 1, 11, 12, 300, LAYERED.len() - 1] {
            let mut bytes = vec![0; n];
            assert_eq!(write(&content, &mut bytes), Ok(LAYERED.len()));
            assert!(Table::open(&bytes).is_err());
        }
        let mut longer = vec![7; LAYERED.len() + 3];
        assert_eq!(write(&content, &mut longer), Ok(LAYERED.len()));
        assert!(longer[..LAYERED.len()] == *LAYERED && longer[LAYERED.len()..] == [7; 3]);
    });
}

/// A relief or a height map has no value at a position that is no number, which would silence the voice.
#[test]
fn a_position_that_is_not_finite_counts_as_the_last_one() {
    let play = |second_m: f64| {
        let mut out = [f32::NAN; 960];
        let touch_twice = |table: Table<'_>, texture: Texture<'_>| {
            let settings = VoiceSettings { sample_rate_hz: 48_000.0, max_mps2: 50.0, seed: 1 };
            let mut voice = RuntimeVoice::new(&texture, table.tap(), settings).unwrap();
            let contact = Contact { speed_mps: 0.5, force_n: 0.5 };
            for (x_m, part) in [0.01, second_m].into_iter().zip(out.chunks_mut(480)) {
                voice.process(&texture, &[Touch { x_m, y_m: 0.0, contact }], part);
            }
            assert!(!voice.is_tripped());
        };
        read(LAYERED, touch_twice).unwrap();
        out
    };
    let expected = play(0.01);
    assert!(expected.iter().any(|x| *x != 0.0));
    for second_m in [f64::NAN, f64::INFINITY, f64::NEG_INFINITY] {
        assert_eq!(play(second_m), expected, "{second_m}");
    }
}

/// A view of arrays that belong to another texture is silent or wrong, but nothing worse.
#[test]
fn a_head_with_the_arrays_of_another_texture_does_not_panic() {
    let layered = Table::open(LAYERED).unwrap();
    let published = Table::open(PUBLISHED).unwrap();
    let mut filled = Filled::of(published.lengths());
    published.load(filled.memory()).unwrap();
    let texture = layered.head().view(filled.arrays());
    let settings = VoiceSettings { sample_rate_hz: 48_000.0, max_mps2: 5.0, seed: 1 };
    let mut voice = RuntimeVoice::new(&texture, layered.tap(), settings).unwrap();
    let mut out = vec![f32::NAN; 4800];
    let touch = Touch { x_m: 0.01, y_m: 0.02, contact: Contact { speed_mps: 0.5, force_n: 0.5 } };
    voice.process(&texture, &[touch], &mut out);
    assert!(out.iter().all(|x| x.abs() <= 5.0));
}
