//! Trains the codebook tables of the texture codec on the starter library and writes the file that the program embeds:
//!
//! `cargo run --release -p shagreen-formats --example train_codec -- assets/codec/tables.json`
//!
//! Every third texture is held out, so `shagreen evaluate codec` measures them on data that the tables were not trained
//! on.

use std::error::Error;

use shagreen_core::signals::codec::corpus::{CONTACTS, is_held_out, quickened, signal};
use shagreen_core::signals::codec::train::train;
use shagreen_formats::codec_tables::write_tables;
use shagreen_formats::starter::starter_library;

/// Length of each signal in s.
const SECONDS: f64 = 1.6;
/// Rounds of gain codebook training.
const N_ROUNDS: usize = 6;
/// Random seed.
const SEED: u64 = 7;

fn main() -> Result<(), Box<dyn Error>> {
    let path = std::env::args_os()
        .nth(1)
        .ok_or("missing argument: give the output file, for example assets/codec/tables.json")?;
    let mut signals = Vec::new();
    for (index, texture) in starter_library()?.textures.iter().enumerate() {
        if is_held_out(index) {
            continue;
        }
        for contact in CONTACTS {
            let seed = signals.len() as u64;
            signals.push(signal(&texture.model, contact, SECONDS, seed)?);
            signals.extend(quickened(&texture.model, contact, SECONDS, seed)?);
        }
    }
    let tables = train(&signals, N_ROUNDS, SEED)?;
    let trained_on = format!(
        "{} rendered signals of {SECONDS} s: two thirds of the textures of the starter library, at their own rate and at twice that rate",
        signals.len()
    );
    std::fs::write(path, write_tables(&tables, &trained_on))?;
    Ok(())
}
