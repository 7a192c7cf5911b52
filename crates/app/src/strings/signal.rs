//! Words of signals that are saved.

/// The entry of the menu.
pub const EXPORT: &str = "Export as WAV…";
/// What that does.
pub const EXPORT_HELP: &str = "What is heard, stroked steadily for 5 s, as samples in m/s²";
/// Nothing can be exported.
pub const NOTHING: &str = "Nothing is heard that may be shown";
/// What is to be exported is not ready.
pub const PREPARING: &str = "What is to be exported is still being prepared; try again in a moment";
/// The title of the sheet that saves a signal.
pub const SAVE_TITLE: &str = "Export as WAV";
/// Accessible name of the field for its path.
pub const SAVE_PATH: &str = "Path of the signal's file";
/// Hint in the field for its path.
pub const SAVE_HINT: &str = "/path/to/texture.wav";
/// There is a signal at the path.
pub const EXISTS: &str = "There is a signal at this path already. Replace it, or choose another path.";
/// Why a file of another kind is not replaced.
pub const NO_SIGNAL: &str = "Choose another path: what is there, or the .json beside it, is no signal of Shagreen, so it is not replaced.";

/// What is saved.
pub fn to_save(secs: f64, mm_per_s: f64, force_n: f64, rate_hz: u32) -> String {
    format!(
        "{secs:.0} s, stroked steadily at {mm_per_s:.0} mm/s and {force_n:.2} N as the hand is set (a recorded stroke by its mean), go into a WAV file of {rate_hz} Hz. A sample of 1 is 1 m/s², and players clip what is above; the .json beside it says what was rendered."
    )
}

/// What is saved of a signal of the bench.
pub fn bench_to_save(name: &str, secs: f64, rate_hz: u32) -> String {
    format!(
        "{name}: {secs:.2} s at its own speed go into a WAV file of {rate_hz} Hz. A sample of 1 is 1 m/s², and players clip what is above; the .json beside it says what it is."
    )
}
