//! How fast textures are encoded and decoded: one JSON line a measurement, CPU time per call. There is no peer at these
//! rates; seconds of signal for a second of one core are the figure.
#![allow(clippy::expect_used, reason = "a benchmark stops at what is wrong")]
#![allow(clippy::print_stdout, reason = "a benchmark prints its figures")]

#[path = "common/measure.rs"]
mod measure;

use std::hint::black_box;
use std::sync::Arc;

use measure::bench;
use shagreen_core::codec::bitrate::Bitrate;
use shagreen_core::codec::coded::Coded;
use shagreen_core::codec::corpus::{CONTACTS, signal};
use shagreen_formats::codec_tables::built_in_codebooks;
use shagreen_formats::starter::starter_library;

const SECONDS: f64 = 4.0;

fn main() {
    let library = starter_library().expect("the library");
    let books = Arc::new(built_in_codebooks().expect("the tables"));
    let felt = signal(&library.textures[2].model, CONTACTS[1], SECONDS, 1).expect("a signal");
    for rate in Bitrate::ALL {
        let coded = Coded::encode(&felt, rate, &books).expect("a signal");
        bench(&format!("encoding at {} kbit/s", rate.kbps()), SECONDS, "second of signal", || {
            black_box(Coded::encode(&felt, rate, &books).expect("a signal"));
        });
        bench(&format!("decoding at {} kbit/s", rate.kbps()), SECONDS, "second of signal", || {
            black_box(coded.decode(&books));
        });
    }
}
