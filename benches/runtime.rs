//! Benchmark of the runtime: a texture from its table with touches, limiter and gate, against the same stream alone.
//!
//! Prints one JSON line per measurement, as `live`; before them, the memory that tables, textures and voices take.
#![allow(
    clippy::print_stdout,
    clippy::expect_used,
    reason = "a benchmark prints results and panics on errors"
)]

#[path = "common/measure.rs"]
#[expect(dead_code, reason = "here every result has a note, and some belong to a peer")]
mod measure;

use std::hint::black_box;

use measure::{bench_noted, bench_peer};
use shagreen_formats::library::Library;
use shagreen_formats::runtime_table::write_runtime_table;
use shagreen_formats::starter::starter_library;
use shagreen_runtime::synth::contact::{Contact, ContactSource, Place};
use shagreen_runtime::synth::renderer::{Mix, TextureId, Textures};
use shagreen_runtime::synth::runtime_voice::{RuntimeVoice, Touch, VoiceSettings};
use shagreen_runtime::synth::stream::Stream;
use shagreen_runtime::synth::texture::Texture;
use shagreen_runtime::texture::RuntimeTexture;

const RATE_HZ: f32 = 48_000.0;
/// Samples in a block, and blocks in a run.
const BLOCK: usize = 256;
const N_BLOCKS: usize = 48_000 * 10 / BLOCK;
const SETTINGS: VoiceSettings = VoiceSettings { sample_rate_hz: RATE_HZ, max_mps2: 500.0, seed: 7 };

struct One<'a>(&'a RuntimeTexture);

impl Textures for One<'_> {
    fn texture(&self, _id: TextureId) -> Option<Texture<'_>> {
        Some(self.0.view())
    }
}

/// The tip at a block: back and forth at up to 0.2 m/s, with 1 to 2 N.
fn touch_at(block: usize) -> Touch {
    let t = (block * BLOCK) as f64 / f64::from(RATE_HZ);
    let contact =
        Contact { speed_mps: (0.2 * (2.0 * t).cos().abs()) as f32, force_n: (1.5 + 0.5 * t.sin()) as f32 };
    Touch { x_m: 0.1 * (2.0 * t).sin(), y_m: 0.0, contact }
}

/// The touch of the current block.
struct Newest(Touch);

impl ContactSource for Newest {
    fn contact_at(&mut self, _time_secs: f64) -> Contact {
        self.0.contact
    }

    fn place(&self) -> Place {
        Place { x_m: self.0.x_m, y_m: self.0.y_m, n_jumps: 0 }
    }
}

/// Texture of the library from its table, with the number of bytes of the table.
fn loaded(library: &Library, id: &str) -> (RuntimeTexture, usize) {
    let index = library.index_of(id).expect("no such texture");
    let table = write_runtime_table(&library.textures[index], "bench").expect("no table");
    (RuntimeTexture::load(&table).expect("no texture"), table.len())
}

fn main() {
    let library = starter_library().expect("no starter library");
    for entry in &library.textures {
        let (texture, table_bytes) = loaded(&library, &entry.id);
        println!("{}: table {table_bytes} bytes, texture {} bytes", entry.id, texture.memory_bytes());
    }
    println!("voice {} bytes, of which the stream takes {}", size_of::<RuntimeVoice>(), size_of::<Stream>());
    let n_samples = (N_BLOCKS * BLOCK) as f64;
    for id in ["cork", "flat-rubber"] {
        let (texture, _) = loaded(&library, id);
        let case = format!("runtime: {id} at 48 kHz, blocks of 256, one touch a block");
        let mut block = [0.0; BLOCK];
        let mut voice = RuntimeVoice::new(&texture.view(), texture.tap(), SETTINGS).expect("no voice");
        bench_noted(&case, n_samples, "sample", || {
            for i in 0..N_BLOCKS {
                voice.process(&texture.view(), &[touch_at(i)], &mut block);
                black_box(&block);
            }
            String::new()
        });
        let mut stream = Stream::new(texture.view().rate_hz(), RATE_HZ, SETTINGS.seed);
        stream.set_mix(Mix::solo(0));
        bench_peer(&case, "its stream alone", n_samples, "sample", || {
            for i in 0..N_BLOCKS {
                stream.process(&One(&texture), &mut Newest(touch_at(i)), &mut block);
                black_box(&block);
            }
            String::new()
        });
    }
}
