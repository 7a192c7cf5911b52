//! Benchmark of texture encoding and decoding: seconds of signal per CPU second on one core.
//!
//! Prints one JSON line per measurement with CPU time per call. There is no peer at these bit rates.
#![allow(clippy::expect_used, reason = "a benchmark panics on errors")]
#![allow(clippy::print_stdout, reason = "a benchmark prints results")]

#[path = "common/measure.rs"]
mod measure;

use std::hint::black_box;
use std::sync::Arc;

use measure::bench;
use shagreen_core::signals::codec::bitrate::Bitrate;
use shagreen_core::signals::codec::coded::Coded;
use shagreen_core::signals::codec::corpus::{CONTACTS, signal};
use shagreen_formats::codec_tables::built_in_codebooks;
use shagreen_formats::starter::starter_library;

const SECONDS: f64 = 4.0;

fn main() {
    let library = starter_library().expect("no starter library");
    let books = Arc::new(built_in_codebooks().expect("no codec tables"));
    let felt = signal(&library.textures[2].model, CONTACTS[1], SECONDS, 1).expect("rendering failed");
    for rate in Bitrate::ALL {
        let coded = Coded::encode(&felt, rate, &books).expect("encoding failed");
        bench(&format!("encoding at {} kbit/s", rate.kbps()), SECONDS, "second of signal", || {
            black_box(Coded::encode(&felt, rate, &books).expect("encoding failed"));
        });
        bench(&format!("decoding at {} kbit/s", rate.kbps()), SECONDS, "second of signal", || {
            black_box(coded.decode(&books));
        });
    }
}
