//! Trains the tables of the texture codec on the starter library, and writes them where the program takes them from:
//!
//! `cargo run --release -p shagreen-formats --example train_codec -- assets/codec/tables.json`
//!
//! Every third texture is left out, so that what `shagreen evaluate codec` says of these was not learnt.

use std::error::Error;

use shagreen_core::codec::corpus::{CONTACTS, is_held_out, quickened, signal};
use shagreen_core::codec::train::train;
use shagreen_formats::codec_tables::write_tables;
use shagreen_formats::starter::starter_library;

/// Length of each signal in s.
const SECONDS: f64 = 1.6;
/// Rounds in which gains are fitted.
const N_ROUNDS: usize = 6;
/// Start of all that is random.
const SEED: u64 = 7;

fn main() -> Result<(), Box<dyn Error>> {
    let path = std::env::args_os().nth(1).ok_or("give the file to write, assets/codec/tables.json")?;
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
        "{} rendered signals of {SECONDS} s: two thirds of the textures of the starter library, as they are and twice as fast",
        signals.len()
    );
    std::fs::write(path, write_tables(&tables, &trained_on))?;
    Ok(())
}
