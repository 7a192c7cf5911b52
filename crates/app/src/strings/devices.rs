//! Sheet of devices: output, actuator, pen, latency and calibration.

pub const OPEN: &str = "Devices…";
pub const OPEN_HELP: &str = "Output, actuator, pen and latency";
pub const TITLE: &str = "Devices";
pub const CLOSE: &str = "Close";

// Output.
pub const OUTPUT: &str = "Output";
pub const DEVICE: &str = "Device";
pub const BUFFER: &str = "Buffer";
pub const BUFFER_HELP: &str = "Length of one output block. A shorter block lowers the latency but makes dropouts more likely. The device may choose another length.";
pub const CHANNELS: &str = "Channels";
pub const CHANNELS_HELP: &str =
    "Output channels that the actuator is connected to. All other channels stay silent.";
pub const FIRST_TWO: &str = "first two";
pub const METER: &str = "Drive";
pub const METER_HELP: &str = "Recent peak of the drive signal, as a share of the device's full scale. The limiter begins at four fifths of its ceiling.";
pub const TONE: &str = "Test tone";
pub const TONE_HZ: &str = "Frequency of the test tone";
pub const TONE_LEVEL: &str = "Acceleration of the test tone";
pub const PLAY_TONE: &str = "Play tone";
pub const STOP_TONE: &str = "Stop tone";
pub const TONE_HELP: &str = "Plays a sine of this acceleration for 2 s instead of the texture. It passes through the equalizer and the limiter.";

// Latency.
pub const LATENCY: &str = "Latency, pen to drive";
pub const LATENCY_UNIT: &str = "ms";
pub const NO_TOUCH: &str = "Stroke the pad or use a pen: the latency of every touch is measured.";

// Actuator.
pub const ACTUATOR: &str = "Actuator";
pub const UNCALIBRATED: &str = "Unknown (proportional drive)";
pub const MISSING: &str = "Last used actuator (unavailable)";
pub const ACTUATOR_HELP: &str = "Actuator on this output. A known actuator is equalized and kept within its limits; for an unknown one the drive is proportional to acceleration. The command \"shagreen calibrate\" writes profiles of your own.";
pub const EQUALIZE: &str = "Equalize the actuator response";
pub const EQUALIZE_HELP: &str = "Drives less at the resonance and more away from it, so that the played acceleration matches the measured one";
pub const VOLTS: &str = "Voltage at full scale";
pub const VOLTS_HELP: &str = "Peak voltage at the actuator's terminals when the output is at full scale. Measure it with a test tone and a meter: every limit depends on it.";
pub const LOAD: &str = "Load";
pub const LOAD_HELP: &str = "Mass that the actuator moves: the pen or a test mass, in g";
pub const MEASURED_LOAD: &str = "Load during measurement";
pub const FULL_SCALE: &str = "Acceleration at full scale";
pub const FULL_SCALE_HELP: &str = "Acceleration that drives the output to full scale, in m/s²";
pub const PROFILE_PATH: &str = "Profile file";
pub const PROFILE_HINT: &str = "profile.toml from shagreen calibrate";
pub const OPEN_PROFILE: &str = "Open";
pub const READING_BROKEN: &str = "reading the profile stopped unexpectedly; try again";

// Pen.
pub const PEN: &str = "Pen";
pub const MOUSE_ONLY: &str = "Mouse and window only";
pub const PEN_HELP: &str =
    "Pen that is read directly, faster than through the window. The mouse keeps working.";
pub const PEN_READ: &str = "is connected";
pub const ACTIVATION: &str = "Force at first touch";
pub const FULL: &str = "Force at full pressure";
pub const BEND: &str = "Curvature";
pub const CURVE_HELP: &str = "Maps pressure to force for pens that do not report newtons. Press on a kitchen scale and adjust the curve until both agree: 100 g are 0.98 N.";
pub const CURVE: &str = "Pressure to force";
pub const WIDTH: &str = "Width of the pen's area";
pub const HEIGHT: &str = "Height of the pen's area";
pub const NO_SIZE: &str =
    "The pen does not report its size, so its speed is unknown. Measure its active area and enter it below.";
pub const DOUBTFUL_SIZE: &str =
    "The size that the pen reports is implausible. Measure its active area and enter it below.";
pub const HEAT: &str = "Heat";
pub const HEAT_HELP: &str = "Root mean square of the drive over the coil's thermal time constant, as a share of the rated continuous value";

// Calibration.
pub const CALIBRATE: &str = "Measure the actuator";
pub const CALIBRATE_HELP: &str = "Plays a sweep from 10 to 1000 Hz for 20 s through the loaded actuator and records an accelerometer on an input. The texture is silent during the measurement.";
pub const INPUT: &str = "Accelerometer input";
pub const CHOOSE_INPUT: &str = "choose an input";
pub const NO_INPUT: &str = "choose the input of the accelerometer";
pub const SENSITIVITY: &str = "Full scale of the input";
pub const SENSITIVITY_HELP: &str = "Acceleration at which the input reaches full scale, in m/s²: from the data sheets of the sensor and its amplifier";
pub const AMPLITUDE: &str = "Sweep amplitude";
pub const AMPLITUDE_HELP: &str =
    "Peak of the sweep, as a share of full scale. Start low: an actuator moves far at its resonance.";
pub const START: &str = "Measure";
pub const CANCEL: &str = "Cancel";
pub const CALIBRATION_BROKEN: &str = "the measurement stopped unexpectedly; try again";
pub const CALIBRATION_LIMITED: &str =
    "The limits of the actuator attenuated the sweep: measure again with a lower amplitude.";

pub fn calibration_dropouts(n: u64) -> String {
    format!("The output dropped out {n} times: close other programs and measure again.")
}

pub fn calibrated(fit_error_db: f64) -> String {
    format!("Measured and in use; fit error {fit_error_db:.2} dB rms.")
}

/// Name of the measured actuator; `before` is its name in the profile.
pub fn calibrated_name(before: Option<&str>) -> String {
    let name = before.unwrap_or("My actuator");
    if name.ends_with(", measured") { name.to_owned() } else { format!("{name}, measured") }
}

/// Output that played the measured sweep.
pub fn played_on(id: &str) -> String {
    format!("played on {id}")
}

pub fn unreadable_profile(path: &str) -> String {
    format!("the profile {path} cannot be read")
}

pub fn buffer(frames: u32, rate_hz: f64) -> String {
    format!("{frames} frames, {:.1} ms", 1e3 * f64::from(frames) / rate_hz)
}

/// One channel; `channel_idx` starts at 0.
pub fn channel(channel_idx: usize) -> String {
    format!("only {}", channel_idx + 1)
}

pub fn stream(rate_hz: u32, channels: u16, block_frames: Option<u32>) -> String {
    let blocks = block_frames.map_or(String::new(), |frames| format!(", blocks of {frames} frames"));
    format!("{rate_hz} Hz, {channels} channels{blocks}")
}

/// Stroke latency of the last touch, and the highest since the output was opened.
pub fn strokes(ms: f32, max_ms: f32) -> String {
    format!("stroke latency {ms:.0} ms, highest {max_ms:.0} ms")
}

/// Tap latency of the last touch.
pub fn taps(ms: f32, is_late: bool) -> String {
    let judgment = if is_late { ": above about 6 ms, surfaces feel softer than they are" } else { "" };
    format!("tap latency {ms:.0} ms{judgment}")
}

pub fn response(resonance_hz: f64, q: f64, gain: f64, load_g: Option<f64>) -> String {
    let load = load_g.map_or(String::new(), |g| format!(" with {g:.0} g"));
    format!("{resonance_hz:.0} Hz, Q {q:.1}, {gain:.2} m/s² per volt{load}")
}

pub fn limits(rated_v: Option<f64>, peak_v: Option<f64>) -> String {
    let rated = rated_v.map(|v| format!("{v:.2} V rms continuous"));
    let peak = peak_v.map(|v| format!("{v:.1} V peak"));
    let known: Vec<String> = rated.into_iter().chain(peak).collect();
    if known.is_empty() {
        "its limits are unknown: only full scale limits the drive".to_owned()
    } else {
        known.join(", ")
    }
}

pub fn percent(share: f32) -> String {
    format!("{:.0} %", 100.0 * share)
}
