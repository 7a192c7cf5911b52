//! Exported signals and their options.

use shagreen_formats::wav_encoding::{Level, SampleType};

pub const NOTHING: &str = "No signal is available. Play a texture, or end the blind comparison.";
pub const NO_MODEL: &str = "This interpolation mode mixes signals, so there is no texture model to export; choose Field or Parametric.";
pub const NO_TEXTURE: &str =
    "No texture can be interpolated at this point; move the point, or choose another interpolation mode.";
pub const PREPARING: &str = "The texture is still being computed; try again in a moment";

/// Warning about an exported signal of the Signals workspace.
pub const SILENT: &str = "the signal is silent: all its accelerations are 0; paint it, or choose another one";

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
/// Option for several files.
pub const ONE_SCALE: &str = "One scale for all";
/// Explanation of the option.
pub const ONE_SCALE_HELP: &str = "Divides all signals by the same acceleration, so that weaker textures stay weaker. Otherwise each file has its own full scale.";
/// When the option is not available.
pub const NO_ONE_SCALE: &str = "For an export of all authored textures whose level is \"Peak at −1 dB\"";
/// Label of the level.
pub const LEVEL: &str = "Level";

/// Origin of an exported texture with a shape.
pub fn shaped(origin: &str, shape: &str) -> String {
    format!("{origin} Shape: {shape}.")
}

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
        Level::Peak => "Peak at −1 dB (for players)",
        Level::Kept => "As measured, 1.0 = 1 m/s² (for analysis)",
    }
}

/// Explanation of the choice of the level.
pub fn level_help(level: Level) -> &'static str {
    match level {
        Level::Peak => {
            "The highest peak is 1 dB below full scale. The .json file states the acceleration at full scale."
        }
        Level::Kept => "A sample of 1.0 is 1 m/s². Players clip what exceeds 1. Only for 32-bit floats.",
    }
}

/// What is saved: a signal of `secs` at a steady contact, or along the recorded stroke.
pub fn to_save(secs: f64, contact: Option<(f64, f64)>) -> String {
    let motion = match contact {
        Some((mm_per_s, force_n)) => format!("at {mm_per_s:.0} mm/s and {force_n:.2} N"),
        None => "along the recorded stroke".to_owned(),
    };
    format!("{secs:.2} s {motion}")
}

/// What is saved: a signal of the Signals workspace.
pub fn bench_to_save(name: &str, secs: f64) -> String {
    format!("{name}, {secs:.2} s")
}

/// What will be saved, in which format. Samples get a file that describes them.
pub fn saved_as(what: &str, format: &str, is_samples: bool) -> String {
    let beside = if is_samples {
        " A .json file with the unit, the motion and the textures is saved beside it."
    } else {
        " Full scale is the highest amplitude of the signal."
    };
    format!("Saves {what} as {format}.{beside}")
}

#[cfg(test)]
mod tests {
    use super::level;
    use shagreen_formats::wav_encoding::Level;

    #[test]
    fn both_levels_name_their_purpose_and_the_kept_one_its_unit() {
        assert!(level(Level::Peak).contains("for players"));
        assert!(level(Level::Kept).contains("1.0 = 1 m/s²") && level(Level::Kept).contains("for analysis"));
    }
}
