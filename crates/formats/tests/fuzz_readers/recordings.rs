//! Readers of recordings, including resampling to a uniform sample rate.

use shagreen_core::recording::Recording;
use shagreen_formats::map_toml::read_map;
use shagreen_formats::recording::{ColumnMap, RecordingFile, RecordingFileError, read_recording};

/// Number of rows of the seeds, slightly more than a recording needs.
const N_ROWS: u32 = 120;
/// Answers to all questions about a table.
const TABLE_MAP: &str = "time_unit = \"ms\"\nacceleration_unit = \"g\"\nspeed_unit = \"mm/s\"\n\
    position_unit = \"mm\"\nforce_unit = \"N\"\npressing_is_negative = false\n";
/// Answers to all questions about a WAV file with one or three channels.
pub(crate) const WAV_MAP: &str = "acceleration_unit = \"m/s^2\"\nfull_scale = 20\nconstant_speed = \"100 mm/s\"\n\
    constant_force = \"1 N\"\n";
/// Sidecar of a WAV file with five channels.
const FIVE_CHANNELS: &str = r#"{"units": "g", "full_scale": 20, "channels": ["x", "y", "z", "speed", "force"],
    "speed_units": "mm/s", "speed_full_scale": 400, "force_units": "N", "force_full_scale": 5}"#;

pub(crate) fn map(text: &str) -> ColumnMap {
    read_map(text.as_bytes()).unwrap()
}

/// Simulated acceleration of a row.
fn wave(row: u32) -> f64 {
    (0.01 * f64::from(row * row % 97) * 100.0).round() / 100.0
}

pub(crate) fn table_seeds() -> Vec<Vec<u8>> {
    let table = |head: &str, row: &dyn Fn(u32) -> String| {
        let rows: Vec<String> = (0..N_ROWS).map(row).collect();
        format!("{head}{}\n", rows.join("\n")).into_bytes()
    };
    vec![
        table("time [ms],ax [g],ay [g],speed [mm/s],force [N]\n", &|i| {
            format!("{i},{},{},{},0.5", wave(i), wave(i + 7), 100 + i % 5)
        }),
        table("t;a;x;y;fz;note\ns;m/s2;mm;mm;N;\n", &|i| {
            format!("{:.4};{:.2};{};{};-0.5;ok", f64::from(i) * 0.001_02, wave(i), i / 10, i % 7)
                .replace('.', ",")
        }),
        // Speed and force of slower sensors.
        table("t_ms,a_g,speed_mm_s,force_n\n", &|i| {
            let slow = |every: u32, value: &str| {
                if i.is_multiple_of(every) { value.to_owned() } else { String::new() }
            };
            format!("{i},{},{},{}", wave(i), slow(10, "80"), slow(7, "1.25"))
        }),
        table("", &|i| format!("{i}\t{}\t100\t0.5", wave(i))),
        // An envelope, which becomes a signal.
        table("time [s],amplitude,frequency\n", &|i| {
            format!("{},{},{}", f64::from(i) * 0.01, wave(i), 60 + i)
        }),
    ]
}

pub(crate) fn table_bombs() -> Vec<Vec<u8>> {
    let names: Vec<String> = (0..1000).map(|i| format!("c{i}")).collect();
    let wide = names.join(",");
    let digits = |n: usize, columns: usize| {
        let row =
            |i: usize| (0..columns).map(|c| ((i * i + 3 * c) % 10).to_string()).collect::<Vec<_>>().join(",");
        (0..n).map(|i| row(i) + "\n").collect::<String>()
    };
    vec![
        ",".repeat(1 << 20).into_bytes(),
        "\n".repeat(1 << 20).into_bytes(),
        "0,1,2\n".repeat(1 << 17).into_bytes(),
        // Lines with almost all values missing, in many columns.
        format!("{wide}\n{}", "1\n".repeat(1 << 18)).into_bytes(),
        format!("{wide}\n{}", format!("1{}\n", ",".repeat(999)).repeat(1000)).into_bytes(),
        format!("t_ms,a_g,v [mm/s]\n{}", digits(1 << 18, 3)).into_bytes(),
        digits(1 << 18, 1).into_bytes(),
        "a ".repeat(1 << 20).into_bytes(),
        format!("t,a\n0,\"{}", "1,".repeat(1 << 20)).into_bytes(),
    ]
}

/// A WAV file of one format, with simulated samples.
struct Wav {
    riff: &'static [u8; 4],
    tag: u16,
    channels: u16,
    bits: u16,
    /// Size that the data chunk states, if it differs from its length.
    stated: Option<u32>,
}

impl Wav {
    fn bytes(&self) -> Vec<u8> {
        let block = self.channels * self.bits / 8;
        let mut data = Vec::new();
        for i in 0..N_ROWS * u32::from(self.channels) {
            let value = wave(i) - 0.4;
            match (self.tag, self.bits) {
                (3, 32) => data.extend((value as f32).to_le_bytes()),
                (3, _) => data.extend(value.to_le_bytes()),
                (_, 8) => data.push((128.0 + 127.0 * value) as u8),
                (_, bits) => {
                    let top = ((value * 2_147_483_647.0) as i32).to_le_bytes();
                    data.extend(&top[4 - usize::from(bits / 8)..]);
                }
            }
        }
        let mut format = Vec::new();
        for part in [if self.tag == 3 { 3 } else { self.tag }, self.channels] {
            format.extend(part.to_le_bytes());
        }
        format.extend(1000_u32.to_le_bytes());
        format.extend((1000 * u32::from(block)).to_le_bytes());
        format.extend(block.to_le_bytes());
        format.extend(self.bits.to_le_bytes());
        if self.tag == 0xFFFE {
            format.extend([22, 0, 24, 0, 4, 0, 0, 0, 1, 0]);
            format.extend(b"\0\0\0\0\x10\0\x80\0\0\xaa\0\x38\x9b\x71");
        }
        let mut bytes = self.riff.to_vec();
        bytes.extend(if self.riff == b"RIFF" { 0_u32 } else { u32::MAX }.to_le_bytes());
        bytes.extend(b"WAVE");
        if self.riff != b"RIFF" {
            bytes.extend(b"ds64\x1c\0\0\0\0\0\0\0\0\0\0\0");
            bytes.extend((data.len() as u64).to_le_bytes());
            bytes.extend([0; 12]);
        }
        bytes.extend(b"fmt ");
        bytes.extend((format.len() as u32).to_le_bytes());
        bytes.extend(format);
        bytes.extend(b"data");
        bytes.extend(self.stated.unwrap_or(data.len() as u32).to_le_bytes());
        bytes.extend(data);
        bytes
    }
}

pub(crate) fn wav_seeds() -> Vec<Vec<u8>> {
    let plain = |tag: u16, channels: u16, bits: u16| Wav { riff: b"RIFF", tag, channels, bits, stated: None };
    vec![
        plain(1, 1, 8).bytes(),
        plain(1, 3, 16).bytes(),
        plain(1, 1, 24).bytes(),
        plain(1, 5, 32).bytes(),
        plain(3, 3, 32).bytes(),
        plain(3, 1, 64).bytes(),
        plain(0xFFFE, 1, 32).bytes(),
        Wav { riff: b"RF64", stated: Some(u32::MAX), ..plain(1, 1, 16) }.bytes(),
        Wav { stated: Some(0), ..plain(1, 1, 16) }.bytes(),
    ]
}

pub(crate) fn wav_bombs() -> Vec<Vec<u8>> {
    let mut long = Wav { riff: b"RIFF", tag: 1, channels: 1, bits: 8, stated: Some(u32::MAX) }.bytes();
    long.extend((0..1_u32 << 18).map(|i| (i.wrapping_mul(i) % 251) as u8));
    let mut chunks = b"RIFF\0\0\0\0WAVE".to_vec();
    chunks.extend(b"junk\0\0\0\0".repeat(1 << 17));
    vec![long, chunks]
}

pub(crate) fn sidecar_seeds() -> Vec<Vec<u8>> {
    let trace = r#"{"format": "shagreen-signal", "version": "1.0", "units": "m/s^2", "full_scale": 8.5,
        "speed_mm_per_s": 100.0, "force_n": 1.0,
        "trace": {"time_s": [0.0, 0.05, 0.1], "speed_mm_per_s": [100.0, 110.0, 90.0], "force_n": [1.0, 1.5, 1.0]}}"#;
    vec![FIVE_CHANNELS.as_bytes().to_vec(), trace.as_bytes().to_vec()]
}

pub(crate) fn map_seeds() -> Vec<Vec<u8>> {
    let table = "separator = \"comma\"\ndecimal_comma = false\nheader = true\ntime = 1\nacceleration = [\"ax\", 3]\n\
        per_count = 0.5\nspeed = \"speed\"\nforce = 5\npositions = [2, 3]\nrate_hz = 1000\n";
    let channels = "channels = [\"acceleration\", \"speed\", \"force\"]\nspeed_full_scale = 200\n\
        speed_unit = \"mm/s\"\nforce_full_scale = 2\nforce_unit = \"N\"\n";
    vec![
        TABLE_MAP.as_bytes().to_vec(),
        format!("{TABLE_MAP}{table}").into_bytes(),
        WAV_MAP.as_bytes().to_vec(),
        format!("{WAV_MAP}{channels}").into_bytes(),
    ]
}

pub(crate) fn read_a_table(bytes: &[u8]) -> Result<(), String> {
    read_with("a.csv", bytes, None, &ColumnMap::default())?;
    read_with("a.csv", bytes, None, &map(TABLE_MAP))?;
    // Without a time column, and with constants for unmeasured quantities.
    let rest =
        "rate_hz = 1000\nacceleration = [2]\nconstant_speed = \"100 mm/s\"\nconstant_force = \"1 N\"\n";
    read_with("a.csv", bytes, None, &map(&format!("{TABLE_MAP}{rest}")))
}

pub(crate) fn read_a_wav(bytes: &[u8]) -> Result<(), String> {
    read_with("a.wav", bytes, Some(FIVE_CHANNELS.as_bytes()), &ColumnMap::default())?;
    read_with("a.wav", bytes, None, &map(WAV_MAP))
}

pub(crate) fn read_a_wav_sidecar(bytes: &[u8]) -> Result<(), String> {
    for channels in [1, 5] {
        let wav = Wav { riff: b"RIFF", tag: 3, channels, bits: 32, stated: None }.bytes();
        read_with("a.wav", &wav, Some(bytes), &ColumnMap::default())?;
    }
    Ok(())
}

pub(crate) fn read_a_map(bytes: &[u8]) -> Result<(), String> {
    let Ok(map) = read_map(bytes) else { return Ok(()) };
    let table = table_seeds().swap_remove(0);
    read_with("a.csv", &table, None, &map)?;
    let wav = Wav { riff: b"RIFF", tag: 3, channels: 3, bits: 32, stated: None }.bytes();
    read_with("a.wav", &wav, None, &map)
}

/// Reads a recording and resamples it uniformly; returns the violated property as an error.
pub(crate) fn read_with(
    name: &str,
    bytes: &[u8],
    sidecar: Option<&[u8]>,
    map: &ColumnMap,
) -> Result<(), String> {
    let RecordingFile { raw, map, .. } = match read_recording(name, bytes, sidecar, map) {
        Ok(file) => file,
        Err(RecordingFileError::NeedsAnswers(needed)) => {
            let is_open = needed.questions.iter().any(|question| question.guess.is_none());
            return if is_open { Ok(()) } else { Err("it asks for answers without an open question".into()) };
        }
        Err(_) => return Ok(()),
    };
    let n_rows = raw.acceleration_mps2.first().map_or(0, Vec::len);
    match read_recording(name, bytes, sidecar, &map) {
        Ok(again) if again.questions.is_empty() => {
            let same = again
                .raw
                .acceleration_mps2
                .iter()
                .map(Vec::len)
                .eq(raw.acceleration_mps2.iter().map(Vec::len));
            if !same {
                return Err("its own map gives another result".into());
            }
        }
        Ok(again) => return Err(format!("its own map leaves the questions {:?}", again.questions)),
        Err(error) => return Err(format!("its own map gives an error: {error}")),
    }
    let Ok((recording, _)) = Recording::from_raw(raw) else { return Ok(()) };
    check_recording(&recording).map_err(|broken| format!("{broken}, of {n_rows} rows"))
}

/// Checks the properties of a recording that the rest of the program relies on.
fn check_recording(recording: &Recording) -> Result<(), String> {
    let Recording { rate, acceleration_mps2, speed_mps, force_n, usable } = recording;
    let n_samples = acceleration_mps2.len();
    if speed_mps.len() != n_samples || force_n.len() != n_samples {
        return Err("columns of different lengths".into());
    }
    if !(rate.0.is_finite() && rate.0 > 0.0) {
        return Err(format!("a rate of {} Hz", rate.0));
    }
    let mut end = 0;
    for range in usable {
        if range.start < end || range.start >= range.end || range.end > n_samples {
            return Err(format!("{range:?} after {end} of {n_samples} samples"));
        }
        end = range.end;
        let is_sound = |i: usize| {
            acceleration_mps2[i].is_finite()
                && speed_mps[i].is_finite()
                && speed_mps[i] >= 0.0
                && force_n[i].is_finite()
        };
        if let Some(i) = range.clone().find(|i| !is_sound(*i)) {
            let values = [acceleration_mps2[i], speed_mps[i], force_n[i]];
            return Err(format!("sample {i} is {values:?}"));
        }
    }
    Ok(())
}
