//! Export of signals as WAV.

pub const EXPORT: &str = "Export as WAV…";
pub const EXPORT_HELP: &str =
    "Renders the audible texture for 5 s at constant speed and force, and saves the acceleration in m/s²";
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

/// Summary of the rendered signal that is saved.
pub fn to_save(secs: f64, mm_per_s: f64, force_n: f64, rate_hz: u32) -> String {
    format!(
        "Saves {secs:.0} s as a WAV file at {rate_hz} Hz. Speed {mm_per_s:.0} mm/s and force {force_n:.2} N are those of the automatic stroke, or the means of the recorded stroke. A sample value of 1.0 is 1 m/s²; audio players clip larger values. A .json file of the same name describes the rendering."
    )
}

/// Summary of the signal of the Signals workspace that is saved.
pub fn bench_to_save(name: &str, secs: f64, rate_hz: u32) -> String {
    format!(
        "Saves {secs:.2} s of {name} at its stroke speed, as a WAV file at {rate_hz} Hz. A sample value of 1.0 is 1 m/s²; audio players clip larger values. A .json file of the same name describes the signal."
    )
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
