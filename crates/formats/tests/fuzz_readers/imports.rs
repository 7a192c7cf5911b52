//! Haptic clips that become signals.

use crate::clips::{clip_seeds, pattern_seeds};
use crate::recordings::{WAV_MAP, map, read_with};

const MACARON: &str = r#"{"duration": 600, "parameters": {
    "amplitude": {"valueScale": [0, 1], "data": [{"id": 0, "t": 100, "value": 0.75}, {"id": 1, "t": 500, "value": 0.25}]},
    "frequency": {"valueScale": [50, 500], "data": [{"id": 2, "t": 0, "value": 100}, {"id": 3, "t": 600, "value": 300}]}}}"#;

/// Clips of all formats, one of them as the address of its content.
pub(crate) fn signal_seeds() -> Vec<Vec<u8>> {
    let macaron = MACARON.as_bytes().to_vec();
    let address = format!("data:text/json;charset=utf-8,{MACARON}").into_bytes();
    [clip_seeds(), pattern_seeds(), vec![macaron, address]].concat()
}

pub(crate) fn read_a_signal(bytes: &[u8]) -> Result<(), String> {
    ["a.haptic", "a.ahap", "a.json"].iter().try_for_each(|name| read_with(name, bytes, None, &map(WAV_MAP)))
}
