//! Tests of the recording readers, and their shared helpers.

mod answers;
mod channels;
mod clips;
mod dialects;
mod overruled;

use super::{Ask, ColumnMap, RecordingFile, RecordingFileError, read_recording};
use proptest::prelude::{any, prop, proptest};
use shagreen_core::recording::Recording;
use std::path::Path;

fn map(answers: &[(Ask, &str)]) -> ColumnMap {
    let mut map = ColumnMap::default();
    for (what, answer) in answers {
        map.answer(*what, answer).unwrap();
    }
    map
}

#[track_caller]
fn read(text: &str, answers: &[(Ask, &str)]) -> RecordingFile {
    read_recording("a.csv", text.as_bytes(), None, &map(answers)).unwrap()
}

/// The questions without a guess.
fn open(bytes: &[u8], answers: &[(Ask, &str)]) -> Vec<Ask> {
    match read_recording("a.csv", bytes, None, &map(answers)).unwrap_err() {
        RecordingFileError::NeedsAnswers(needed) => {
            needed.questions.iter().filter(|q| q.guess.is_none()).map(|q| q.what).collect()
        }
        other => panic!("{other}"),
    }
}

/// A WAV file with an extra chunk before its samples.
fn wav(tag: u16, channels: u16, bits: u16, data: &[u8]) -> Vec<u8> {
    let block = channels * bits.div_ceil(8);
    let mut bytes = b"RIFF\0\0\0\0WAVEjunk\x03\0\0\0abc\0fmt \x10\0\0\0".to_vec();
    for part in [tag, channels] {
        bytes.extend(part.to_le_bytes());
    }
    bytes.extend(8000_u32.to_le_bytes());
    bytes.extend((8000 * u32::from(block)).to_le_bytes());
    bytes.extend(block.to_le_bytes());
    bytes.extend(bits.to_le_bytes());
    bytes.extend(b"data");
    bytes.extend((data.len() as u32).to_le_bytes());
    bytes.extend(data);
    bytes
}

/// Reads a file of the shared data, if that folder exists next to the checkout.
fn shared(file: &str) -> Option<Vec<u8>> {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("../..");
    let bytes = std::fs::read(root.join("../shared/data").join(file)).ok();
    if bytes.is_none() {
        #[expect(clippy::print_stdout, reason = "a skipped test reports it")]
        {
            println!("skipped: ../shared/data/{file} does not exist");
        }
    }
    bytes
}

#[test]
fn real_files_are_refused_with_all_their_reasons() {
    for (file, words) in [
        (
            "recordings/hapmat/Wood.csv",
            &["acceleration_unit", "speed:", "force:", "rate too low: 100 Hz"][..],
        ),
        ("recordings/force-press-slide/Material_Wood_raw_1.csv", &["no acceleration", "\"Ft\"", "bad clock"]),
        ("wav-oddities/phone_eh.wav", &["acceleration_unit", "full_scale"]),
        ("wav-oddities/wav_bad_fact.wav", &["has no valid format chunk"]),
    ] {
        let Some(bytes) = shared(file) else { continue };
        let message = read_recording(file, &bytes, None, &ColumnMap::default()).unwrap_err().to_string();
        assert!(words.iter().all(|word| message.contains(word)), "{message}");
    }
    let Some(bytes) = shared("recordings/hapmat/Wood.csv") else { return };
    let answers = [(Ask::AccelerationUnit, "g"), (Ask::Speed, "100 mm/s"), (Ask::Force, "1 N")];
    let file = read_recording("Wood.csv", &bytes, None, &map(&answers)).unwrap();
    let error = Recording::from_raw(file.raw).unwrap_err();
    assert_eq!(error.faults[0].name(), "rate too low");
}

proptest! {
    #[test]
    fn mutated_bytes_never_panic(edits in prop::collection::vec((any::<prop::sample::Index>(), any::<u8>()), 1..20)) {
        let table = b"time_ms;ax [g];ay [g];x;y;f\n0;0,5;1;2;3;1\n1;0,25;1;2;3;1\n".to_vec();
        for start in [table, wav(3, 2, 64, &[0; 64]), wav(1, 3, 24, &[7; 36])] {
            let mut bytes = start;
            for (at, byte) in &edits {
                let at = at.index(bytes.len());
                bytes[at] = *byte;
            }
            if let Ok(file) = read_recording("a", &bytes, Some(&bytes), &ColumnMap::default()) {
                let _ = Recording::from_raw(file.raw);
            }
        }
    }
}
