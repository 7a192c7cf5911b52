//! Export of signals as WAV.

use shagreen_formats::wav_encoding::{Level, SampleType};

pub const EXPORT: &str = "Export as WAV…";
pub const EXPORT_HELP: &str = "Renders the audible texture, or all authored ones, as WAV files: length, loop, rate, samples and level are chosen";
pub const NOTHING: &str = "No signal is available. Play a texture, or end the blind comparison.";
pub const EXPORT_TEXTURE: &str = "Export texture";
pub const NO_MODEL: &str = "This interpolation mode mixes signals, so there is no texture model to export; choose Field or Parametric.";
pub const SAVE_TEXTURE_TITLE: &str = "Export texture";
pub const SAVE_TEXTURE_PATH: &str = "Path of the texture file";
pub const SAVE_TEXTURE_HINT: &str = "/path/to/texture";
pub const PREPARING: &str = "The texture is still being computed; try again in a moment";
pub const SAVE_TITLE: &str = "Export as WAV";
pub const SAVE_PATH: &str = "Path of the signal file";
pub const SAVE_HINT: &str = "/path/to/texture.wav";
pub const EXISTS: &str = "A signal file exists at this path. Replace it, or choose another path.";
pub const NO_SIGNAL: &str = "The file at this path, or the .json file of the same name, is not a Shagreen signal and is not replaced. Choose another path.";

/// Accessible name of the choice of the motion.
pub const MOTION: &str = "Motion of the tip";
/// Label of the duration.
pub const LENGTH: &str = "Length";
/// Option.
pub const LOOP: &str = "Loop";
/// Explanation of the option.
pub const LOOP_HELP: &str = "The end goes on into the beginning, so that the signal repeats without a click";
/// Label of the sample rate.
pub const RATE: &str = "Rate";
/// Label of the type of the samples.
pub const SAMPLES: &str = "Samples";
/// Label of the level.
pub const LEVEL: &str = "Level";
/// Explanation of the option that exports all authored textures.
pub const ALL_HELP: &str =
    "One file for each authored texture, with its name, in the folder of the path above";

/// Choice of the motion.
pub fn motion(follows_stroke: bool) -> &'static str {
    if follows_stroke { "Recorded stroke" } else { "Steady motion" }
}

/// Sample rate in Hz.
pub fn rate(rate_hz: u32) -> String {
    format!("{rate_hz} Hz")
}

/// Type of the samples.
pub fn samples(of: SampleType) -> &'static str {
    match of {
        SampleType::Float32 => "32-bit float",
        SampleType::Pcm24 => "24-bit",
        SampleType::Pcm16 => "16-bit",
    }
}

/// Choice of the level.
pub fn level(level: Level) -> &'static str {
    match level {
        Level::Peak => "Peak at −1 dB",
        Level::Kept => "m/s²",
    }
}

/// Explanation of the choice of the level.
pub fn level_help(level: Level) -> &'static str {
    match level {
        Level::Peak => {
            "For players: the highest peak is 1 dB below full scale. The .json file states the acceleration at full scale."
        }
        Level::Kept => {
            "For analysis: a sample of 1 is 1 m/s². Players clip what exceeds 1. Only for 32-bit floats."
        }
    }
}

/// Option that exports all authored textures.
pub fn all_of(n: usize) -> String {
    format!("All {n} authored textures")
}

/// What will be saved: a signal of `secs` at a steady contact, or along the recorded stroke.
pub fn to_save(secs: f64, contact: Option<(f64, f64)>) -> String {
    let motion = match contact {
        Some((mm_per_s, force_n)) => format!("at {mm_per_s:.0} mm/s and {force_n:.2} N"),
        None => "along the recorded stroke".to_owned(),
    };
    format!(
        "Saves {secs:.2} s {motion}. A .json file with the unit, the motion and the textures is saved beside it."
    )
}

/// What will be saved: a signal of the Signals workspace.
pub fn bench_to_save(name: &str, secs: f64) -> String {
    format!("Saves {name}, {secs:.2} s. A .json file with the unit is saved beside it.")
}

/// Why a file is not replaced.
pub fn not_replaced(path: &str) -> String {
    format!("This file is not a Shagreen signal and is not replaced. Choose another path: {path}")
}

/// Summary of the texture that is exported.
pub fn texture_to_save(name: &str, format: &str, lost: &[String]) -> String {
    let lost = if lost.is_empty() {
        String::new()
    } else {
        format!(" The file does not contain: {}.", lost.join("; "))
    };
    format!("Saves \"{name}\" as {format}.{lost}")
}

/// Question before a file of the same format is replaced.
pub fn texture_exists(format: &str) -> String {
    format!("A {format} exists at this path. Replace it, or choose another path.")
}

/// Reason why a file of another kind is not replaced.
pub fn no_texture(format: &str) -> String {
    format!("The file at this path is not a {format} and is not replaced. Choose another path.")
}
