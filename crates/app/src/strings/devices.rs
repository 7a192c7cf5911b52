//! Words of the sheet of devices.

/// Opens the sheet.
pub const OPEN: &str = "Devices…";
/// What the sheet is for.
pub const OPEN_HELP: &str = "The output and its actuator, the pen, and how late they are";
/// Heading of the sheet.
pub const TITLE: &str = "Devices";
/// Closes the sheet.
pub const CLOSE: &str = "Close";
/// Heading of the output.
pub const OUTPUT: &str = "Output";
/// Label of the choice in each part.
pub const DEVICE: &str = "Device";
/// Name of the choice of the size of blocks.
pub const BUFFER: &str = "Buffer";
/// What the size of blocks does.
pub const BUFFER_HELP: &str =
    "Shorter is felt sooner and drops out more easily. The device may take another length.";
/// Name of the choice of channels.
pub const CHANNELS: &str = "Channels";
/// What the choice of channels does.
pub const CHANNELS_HELP: &str = "Where the actuator hangs. Every other channel stays silent.";
/// The usual channels.
pub const FIRST_TWO: &str = "first two";
/// The level of the drive.
pub const METER: &str = "Drive";
/// What the meter shows.
pub const METER_HELP: &str = "Highest drive of late, as a share of the device's full scale. The limiter begins at four fifths of its ceiling.";
/// Heading of the test tone.
pub const TONE: &str = "Test tone";
/// Frequency of the tone.
pub const TONE_HZ: &str = "Frequency of the tone";
/// Level of the tone.
pub const TONE_LEVEL: &str = "Acceleration of the tone";
/// Plays the tone.
pub const PLAY_TONE: &str = "Play tone";
/// Ends the tone.
pub const STOP_TONE: &str = "Stop tone";
/// What the tone does.
pub const TONE_HELP: &str =
    "A sine of this acceleration for two seconds, in the place of the texture, through equalizer and limits";
/// Heading of the latency.
pub const LATENCY: &str = "From hand to drive";
/// Unit of the latency.
pub const LATENCY_UNIT: &str = "ms";
/// Nothing has touched yet.
pub const NO_TOUCH: &str = "Stroke the pad or use a pen: every touch is measured.";
/// Heading of the actuator.
pub const ACTUATOR: &str = "Actuator";
/// No actuator is known.
pub const UNCALIBRATED: &str = "Unknown: in proportion to acceleration";
/// The actuator of last time, which cannot be had.
pub const MISSING: &str = "The one of last time, which cannot be had";
/// What choosing an actuator does.
pub const ACTUATOR_HELP: &str = "A known actuator is equalized, and kept within what it stands. Profiles of your own come from shagreen calibrate.";
/// Turns the equalizer on.
pub const EQUALIZE: &str = "Undo the actuator's response";
/// What the equalizer does.
pub const EQUALIZE_HELP: &str =
    "Drives less at the resonance and more beside it, so that what is felt is what was measured";
/// Volts at full scale.
pub const VOLTS: &str = "Volts at full scale";
/// What the volts are.
pub const VOLTS_HELP: &str = "Peak voltage at the actuator's terminals when the output plays as loud as it can. Measure it with a test tone and a meter: every limit rests on it.";
/// What the actuator carries.
pub const LOAD: &str = "Load";
/// What the load does.
pub const LOAD_HELP: &str = "Mass that the actuator shakes: the pen, or a test mass";
/// What the actuator carries while it is measured.
pub const MEASURED_LOAD: &str = "Load while measured";
/// Acceleration at full scale.
pub const FULL_SCALE: &str = "Acceleration at full scale";
/// What the acceleration at full scale does.
pub const FULL_SCALE_HELP: &str = "How strong a texture must be to drive the output as far as it goes";
/// Field for a profile's file.
pub const PROFILE_PATH: &str = "Profile file";
/// What the field for a file takes.
pub const PROFILE_HINT: &str = "profile.toml of shagreen calibrate";
/// Opens the profile.
pub const OPEN_PROFILE: &str = "Open";
/// Reading ended without a word.
pub const READING_BROKEN: &str = "reading the profile failed for no reason that is known; try again";
/// Heading of the pen.
pub const PEN: &str = "Pen";
/// Only the mouse is used.
pub const MOUSE_ONLY: &str = "Mouse and window only";
/// What choosing a pen does.
pub const PEN_HELP: &str = "A pen is read directly, faster than the window could; the mouse goes on working";
/// The pen is read.
pub const PEN_READ: &str = "is read";
/// Force at the lowest pressure.
pub const ACTIVATION: &str = "Force at first touch";
/// Force at full pressure.
pub const FULL: &str = "Force at full pressure";
/// Bend of the curve.
pub const BEND: &str = "Bend";
/// What the curve does.
pub const CURVE_HELP: &str = "From pressure to force, for pens that do not tell newtons. Press on a kitchen scale and bend the curve until both agree: 100 g are 0.98 N.";
/// Heading of the curve.
pub const CURVE: &str = "Pressure to force";
/// Width of the pen's area.
pub const WIDTH: &str = "Width of the pen's area";
/// Height of the pen's area.
pub const HEIGHT: &str = "Height of the pen's area";
/// The size is not known.
pub const NO_SIZE: &str =
    "The pen does not tell its size. Without it there is no speed: measure its active area.";
/// The size can hardly be true.
pub const DOUBTFUL_SIZE: &str = "The size that the pen tells can hardly be true. Measure its active area.";
/// The coil is warm.
pub const HEAT: &str = "Heat";
/// What the heat is.
pub const HEAT_HELP: &str =
    "Root mean square of the drive over the coil's thermal time, as a share of what it stands for long";

/// Heading of the measurement of the actuator.
pub const CALIBRATE: &str = "Measure the actuator";
/// What the measurement does.
pub const CALIBRATE_HELP: &str = "Plays a sweep from 10 to 1000 Hz for 20 s through the actuator on its load, and listens to an accelerometer on an input. The texture is silent meanwhile.";
/// The input that the accelerometer is on.
pub const INPUT: &str = "Accelerometer on";
/// No input is chosen.
pub const CHOOSE_INPUT: &str = "choose an input";
/// A measurement without an input.
pub const NO_INPUT: &str = "choose the input that the accelerometer is on";
/// What a sample of one is.
pub const SENSITIVITY: &str = "Its full scale";
/// What the sensitivity is.
pub const SENSITIVITY_HELP: &str =
    "Acceleration at which the input is at full scale: from the data sheets of the sensor and its amplifier";
/// How loud the sweep is.
pub const AMPLITUDE: &str = "Drive of the sweep";
/// What the drive of the sweep does.
pub const AMPLITUDE_HELP: &str =
    "Peak, as a share of full scale. Begin low: at its resonance an actuator moves far.";
/// Begins the measurement.
pub const START: &str = "Measure";
/// Ends the measurement.
pub const CANCEL: &str = "Cancel";
/// The measurement ended without a word.
pub const CALIBRATION_BROKEN: &str = "the measurement ended for no reason that is known; try again";
/// The sweep was turned down.
pub const CALIBRATION_LIMITED: &str =
    "The limits of the actuator turned the sweep down: measure with less drive.";

/// The output dropped out.
pub fn calibration_dropouts(n: u64) -> String {
    format!("The output dropped out {n} times: close other programs and measure again.")
}

/// What came of a measurement.
pub fn calibrated(fit_error_db: f64) -> String {
    format!("Measured, and in use; the fit is off by {fit_error_db:.2} dB rms.")
}

/// What an actuator is called that was measured.
pub fn calibrated_name(before: Option<&str>) -> String {
    let name = before.unwrap_or("My actuator");
    if name.ends_with(", measured") { name.to_owned() } else { format!("{name}, measured") }
}

/// What the measured sweep was played on.
pub fn played_on(id: &str) -> String {
    format!("played on {id}")
}

/// A profile that cannot be read.
pub fn unreadable_profile(path: &str) -> String {
    format!("the profile {path} cannot be read")
}

/// Length of a buffer.
pub fn buffer(frames: u32, rate_hz: f64) -> String {
    format!("{frames} frames, {:.1} ms", 1e3 * f64::from(frames) / rate_hz)
}

/// One channel, counted from zero.
pub fn channel(channel_idx: usize) -> String {
    format!("only {}", channel_idx + 1)
}

/// Rate, channels and blocks of an output.
pub fn stream(rate_hz: u32, channels: u16, block_frames: Option<u32>) -> String {
    let blocks = block_frames.map_or(String::new(), |frames| format!(", blocks of {frames} frames"));
    format!("{rate_hz} Hz, {channels} channels{blocks}")
}

/// How late strokes are.
pub fn strokes(ms: f32, max_ms: f32) -> String {
    format!("strokes {ms:.0} ms late, at most {max_ms:.0} ms")
}

/// How late taps are.
pub fn taps(ms: f32, is_late: bool) -> String {
    let judgment = if is_late { ": above about 6 ms surfaces feel softer than they are" } else { "" };
    format!("taps {ms:.0} ms late{judgment}")
}

/// What an actuator answers.
pub fn response(resonance_hz: f64, q: f64, gain: f64, load_g: Option<f64>) -> String {
    let load = load_g.map_or(String::new(), |g| format!(" on {g:.0} g"));
    format!("{resonance_hz:.0} Hz, Q {q:.1}, {gain:.2} m/s² for a volt{load}")
}

/// What an actuator stands.
pub fn limits(rated_v: Option<f64>, peak_v: Option<f64>) -> String {
    let rated = rated_v.map(|v| format!("{v:.2} V rms for long"));
    let peak = peak_v.map(|v| format!("{v:.1} V at most"));
    let known: Vec<String> = rated.into_iter().chain(peak).collect();
    if known.is_empty() {
        "its limits are not known: only full scale limits it".to_owned()
    } else {
        known.join(", ")
    }
}

/// A share of what is possible.
pub fn percent(share: f32) -> String {
    format!("{:.0} %", 100.0 * share)
}
