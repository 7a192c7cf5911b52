//! The acceleration of one axis in a recorded file, on a regular clock.

use std::path::Path;

use anyhow::{Context as _, bail};
use shagreen_core::maths::statistics::standard_deviation;
use shagreen_core::recording::{RawClock, RawMotion, RawRecording, RawTrack, Recording, check_clock};
use shagreen_core::units::Hertz;
use shagreen_formats::bounded_file::FileKind;
use shagreen_formats::recording::{AccelerationUnit, Ask, Channel, ColumnMap, read_recording};

use crate::cli::output;
use crate::cli::recording_answers::sidecar;
use shagreen_studio::file::{self, file_name};

/// Recorded response to a sweep.
pub(crate) struct Recorded {
    /// Recorded acceleration, in m/s².
    pub(crate) acceleration_mps2: Vec<f64>,
    /// Sample rate.
    pub(crate) rate: Hertz,
    /// Recorded axis, from 1.
    pub(crate) channel: usize,
}

/// Reads a WAV file or a table. `sensitivity_mps2` or the sidecar states the acceleration of a WAV sample of 1.0.
pub(crate) fn recorded_file(
    path: &Path,
    sensitivity_mps2: Option<f64>,
    channel: Option<usize>,
    answers: &[(Ask, String)],
) -> anyhow::Result<Recorded> {
    let of_file = || file::in_file(path);
    let bytes = file::read_file(path, FileKind::Recording)?;
    let sidecar = sidecar(path).map_err(anyhow::Error::msg).with_context(of_file)?;
    let mut map = ColumnMap::default();
    // A sweep is no stroke: these placeholders keep the reader from asking for speed and force.
    let nothing = [(Ask::Speed, "100 mm/s".to_owned()), (Ask::Force, "1 N".to_owned())];
    for (what, answer) in nothing.iter().chain(answers) {
        map.answer(*what, answer).map_err(|error| output::Usage(error.to_string()))?;
    }
    let n_channels = wav_channels(&bytes);
    if let Some(sensitivity) = sensitivity_mps2 {
        let is_named_wav = path.extension().is_some_and(|ending| ending.eq_ignore_ascii_case("wav"));
        if n_channels.is_none() && !is_named_wav {
            let table = "for a table, state the unit in its header or with --set acceleration_unit=g";
            bail!(output::Usage(format!("--sensitivity is for WAV files and inputs; {table}")));
        }
        if map.full_scale.is_some_and(|full_scale| full_scale != sensitivity) {
            bail!(output::Usage(
                "--sensitivity and --set full_scale contradict each other; give one of them".to_owned()
            ));
        }
        map.full_scale = Some(sensitivity);
        map.acceleration_unit = Some(AccelerationUnit::MetersPerSecondSquared);
    }
    // Of more than three channels, only the requested one is read.
    let mut picked = None;
    if map.channels.is_none() {
        map.channels = n_channels.map(|n| vec![Channel::Acceleration; n]).filter(|all| all.len() <= 3);
        if let (Some(channel), Some(n)) = (channel, n_channels.filter(|n| *n > 3)) {
            if channel > n {
                return Err(no_channel(channel, n)).with_context(of_file);
            }
            let kind = |place| if place + 1 == channel { Channel::Acceleration } else { Channel::Unused };
            map.channels = Some((0..n).map(kind).collect());
            picked = Some(channel);
        }
    }
    let read = read_recording(&file_name(path), &bytes, sidecar.as_deref(), &map);
    let read = read
        .map_err(|error| {
            anyhow::anyhow!(
                "{error}; state missing properties with --sensitivity, --channel or --set KEY=VALUE"
            )
        })
        .with_context(of_file)?;
    for question in &read.questions {
        output::warn(&format!("guessed {question}"));
    }
    for warning in &read.warnings {
        output::warn(warning);
    }
    let recorded = one_axis(read.raw, if picked.is_some() { None } else { channel }).with_context(of_file)?;
    Ok(Recorded { channel: picked.unwrap_or(recorded.channel), ..recorded })
}

fn no_channel(channel: usize, n: usize) -> anyhow::Error {
    let there = if n == 1 {
        "the recording has one; leave --channel out".to_owned()
    } else {
        format!("the recording has {n}; choose --channel 1 to {n}")
    };
    anyhow::anyhow!("there is no channel {channel} of acceleration: {there}")
}

/// Returns the number of channels that a WAV file states; `None` for other files.
fn wav_channels(bytes: &[u8]) -> Option<usize> {
    let at = bytes.windows(4).take(4096).position(|four| four == b"fmt ")?;
    let count = bytes.get(at + 10..at + 12)?.try_into().ok()?;
    bytes.starts_with(b"RIFF").then(|| usize::from(u16::from_le_bytes(count)))
}

fn one_axis(raw: RawRecording, channel: Option<usize>) -> anyhow::Result<Recorded> {
    let mut axes = raw.acceleration_mps2;
    let n_axes = axes.len();
    let place = match channel {
        Some(channel) if channel <= n_axes => channel - 1,
        Some(channel) => return Err(no_channel(channel, n_axes)),
        None => {
            let moves = |place: &usize| {
                let there: Vec<f64> = axes[*place].iter().copied().filter(|a| a.is_finite()).collect();
                standard_deviation(&there)
            };
            let most = (0..n_axes).max_by(|a, b| moves(a).total_cmp(&moves(b))).unwrap_or(0);
            if n_axes > 1 {
                output::note(&format!(
                    "channel {} of {n_axes} varies most and is used; --channel selects another",
                    most + 1
                ));
            }
            most
        }
    };
    let axis = axes.swap_remove(place);
    let channel = channel.unwrap_or(place + 1);
    if let RawClock::Rate(rate) = raw.clock {
        return Ok(Recorded { acceleration_mps2: axis, rate, channel });
    }
    let (odd, _) = check_clock(&raw.clock);
    let raw = RawRecording {
        clock: raw.clock,
        acceleration_mps2: vec![axis.clone()],
        motion: RawMotion::Speed(RawTrack::Constant(0.1)),
        force_n: RawTrack::Constant(1.0),
        full_scale_mps2: None,
    };
    let (recording, findings) = Recording::from_raw(raw).map_err(|error| anyhow::anyhow!("{error}"))?;
    let rate = recording.rate;
    if odd.is_empty() {
        // Rows are samples. The import of strokes drops stretches with the sensor at rest, which here are the silence
        // around the sweep.
        return Ok(Recorded { acceleration_mps2: axis, rate, channel });
    }
    for finding in &findings {
        output::warn(&finding.to_string());
    }
    Ok(Recorded { acceleration_mps2: held(recording.acceleration_mps2), rate, channel })
}

/// Returns a signal with each missing sample replaced by the one before it, or at the start by the first available one.
fn held(mut signal: Vec<f64>) -> Vec<f64> {
    let mut last = signal.iter().copied().find(|sample| sample.is_finite()).unwrap_or(0.0);
    for sample in &mut signal {
        if sample.is_finite() {
            last = *sample;
        } else {
            *sample = last;
        }
    }
    signal
}
