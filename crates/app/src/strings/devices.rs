//! Sheet of devices: output, actuator, pen, latency and calibration.

pub const OPEN: &str = "Devices…";
pub const OPEN_HELP: &str = "Output, actuator, pen and latency";
pub const TITLE: &str = "Devices";
pub const CLOSE: &str = "Close";

// Output.
pub const OUTPUT: &str = "Output";
pub const DEVICE: &str = "Device";
pub const BUFFER: &str = "Buffer";
pub const BUFFER_HELP: &str = "Length of one output block, in frames and ms. A shorter block lowers the latency but makes dropouts more likely. The device may use another length.";
pub const CHANNELS: &str = "Channels";
pub const CHANNELS_HELP: &str =
    "Output channels that the actuator is connected to. All other channels stay silent.";
pub const FIRST_TWO: &str = "first two";
pub const METER: &str = "Drive level";
pub const METER_HELP: &str = "Recent peak of the drive signal, in percent of the output's full scale. The limiter starts at 80 % of the limit of the output or the actuator.";
pub const TONE: &str = "Test tone";
pub const TONE_HZ: &str = "Frequency of the test tone";
pub const TONE_LEVEL: &str = "Acceleration amplitude of the test tone";
pub const PLAY_TONE: &str = "Play tone";
pub const STOP_TONE: &str = "Stop tone";
pub const TONE_HELP: &str = "Plays a sine with this acceleration amplitude for 2 s instead of the texture. It passes through the equalizer and the limiter.";

// Latency.
pub const LATENCY: &str = "Latency, pen to output";
pub const LATENCY_UNIT: &str = "ms";
/// Names of the lines of the graph.
pub const LATENCY_OF_STROKES: &str = "strokes";
pub const LATENCY_OF_TAPS: &str = "taps";
pub const NO_TOUCH: &str =
    "Stroke the pad with the mouse or a pen: the latency of every touch then appears here.";

// Actuator.
pub const ACTUATOR: &str = "Actuator";
pub const UNCALIBRATED: &str = "Unknown (proportional drive)";
pub const MISSING: &str = "Last used actuator (unavailable)";
pub const ACTUATOR_HELP: &str = "Actuator on this output. A known actuator is equalized and kept within its limits; for an unknown one the drive is proportional to acceleration. The command \"shagreen calibrate\" writes a profile of your own actuator.";
/// In place of the choice, for a haptic pen.
pub const NO_ACTUATOR_ON_PEN: &str =
    "A haptic pen plays waveforms of its own, so that no actuator profile applies to it.";
/// Removes the choice of an actuator.
pub const LEAVE_ACTUATOR_OUT: &str = "Remove the chosen profile";
pub const EQUALIZE: &str = "Equalize the actuator response";
pub const EQUALIZE_HELP: &str = "Inverts the frequency response of the actuator: less drive at the resonance, more away from it. The acceleration then matches that of the texture.";
pub const VOLTS: &str = "Voltage at full scale";
pub const VOLTS_HELP: &str = "Peak voltage at the actuator's terminals when the output is at full scale, in V. Measure it during a test tone: √2 times the RMS reading of a voltmeter, divided by the drive level. All voltage limits depend on it.";
pub const LOAD: &str = "Load";
pub const LOAD_HELP: &str =
    "Mass that the actuator moves, in g: the pen or a test mass, without the actuator";
pub const MEASURED_LOAD: &str = "Load during measurement";
pub const PROPORTIONAL: &str = "The response of this device is unknown: the drive is proportional to the acceleration until you measure it below.";
pub const FULL_SCALE: &str = "Acceleration at full scale";
pub const FULL_SCALE_HELP: &str = "Acceleration that drives the output to full scale, in m/s²";
/// Kind of file in the dialog of the system.
pub const PROFILES: &str = "Actuator profiles";
pub const PROFILE_PATH: &str = "Profile file";
pub const PROFILE_HINT: &str = "e.g. profile.toml";
pub const OPEN_PROFILE: &str = "Open";
pub const READING_BROKEN: &str = "reading the profile stopped unexpectedly; try again";

// Pen.
pub const PEN: &str = "Pen";
pub const MOUSE_ONLY: &str = "Mouse and window only";
pub const PEN_HELP: &str = "Pen that Shagreen reads directly, with less latency than through the window. The automatic choice is the connected pen that provides most, and strokes only while the window has the focus. The mouse keeps working.";
pub const AUTOMATIC: &str = "Automatic";
pub const WINDOW_POINTER: &str = "Window pointer";
pub const ACTIVATION: &str = "Force at first touch";
pub const FULL: &str = "Force at full pressure";
pub const BEND: &str = "Curvature";
pub const CURVE_HELP: &str = "Maps pressure to force, in N, for pens that do not report newtons. Press the pen on a kitchen scale and adjust the curve until both agree: 100 g correspond to 0.98 N.";
pub const CURVE: &str = "Pressure to force";
pub const WIDTH: &str = "Width of the active area";
pub const HEIGHT: &str = "Height of the active area";
pub const NO_SIZE: &str =
    "The pen does not report its size, so its speed is unknown. Measure its active area and enter it below.";
pub const DOUBTFUL_SIZE: &str =
    "The size that the pen reports is implausible. Measure its active area and enter it below.";
pub const HEAT: &str = "Thermal load";
pub const HEAT_HELP: &str = "Root mean square of the drive signal over the thermal time constant of the coil, in percent of the rated continuous value";

// Calibration.
pub const CALIBRATE: &str = "Measure the actuator";
pub const CALIBRATE_HELP: &str = "Plays a 20 s sine sweep from 10 to 1000 Hz through the loaded actuator and records the accelerometer on an input. No texture plays during the measurement.";
pub const INPUT: &str = "Accelerometer input";
pub const CHOOSE_INPUT: &str = "choose an input";
pub const NO_INPUT: &str = "choose the input of the accelerometer";
pub const SENSITIVITY: &str = "Full scale of the input";
pub const SENSITIVITY_HELP: &str = "Full-scale acceleration, in m/s²: the acceleration that gives a sample value of 1.0. Compute it from the data sheets of the sensor, its amplifier and the input. It is not the sensitivity of the sensor in V per m/s².";
pub const AMPLITUDE: &str = "Sweep amplitude";
pub const AMPLITUDE_HELP: &str = "Peak of the sweep, as a share of full scale (0 to 1). Start low: the displacement is large at resonance.";
pub const START: &str = "Measure";
pub const CANCEL: &str = "Cancel";
pub const CALIBRATION_BROKEN: &str = "the measurement stopped unexpectedly; try again";
pub const CALIBRATION_LIMITED: &str =
    "The sweep was attenuated to the limits of the actuator. Measure again with a lower sweep amplitude.";

/// How strokes are read, and what this provides.
pub fn pen_read(name: &str, backend: &str, provided: &str) -> String {
    format!("{name} is read by {backend}: {provided}")
}

/// A pen in the list, with how it is read.
pub fn pen_choice(name: &str, backend: &str) -> String {
    format!("{name}, {backend}")
}

/// What the pointer of the window provides.
pub fn window_pointer(provided: &str) -> String {
    format!("{WINDOW_POINTER}: {provided}")
}

/// What a haptic pen plays instead of the signal.
pub fn haptic_pen(waveform: &str, percent: u8) -> String {
    format!("Approximation: the pen plays its waveform \"{waveform}\" at {percent} %")
}

pub const HAPTIC_PEN_SILENT: &str = "Approximation: the pen plays the one of its own waveforms that is nearest to the texture. Now it is silent.";

pub fn calibration_dropouts(n: u64) -> String {
    format!("Number of dropouts during the measurement: {n}. Close other programs and measure again.")
}

pub fn calibrated(fit_error_db: f64) -> String {
    format!("Measured and in use; fit error {fit_error_db:.2} dB rms.")
}

/// Name of the measured actuator; `before` is its name in the profile.
pub fn calibrated_name(before: Option<&str>) -> String {
    let name = before.unwrap_or("My actuator");
    if name.ends_with(", measured") { name.to_owned() } else { format!("{name}, measured") }
}

/// Note of the output that played the measured sweep.
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
    format!("channel {}", channel_idx + 1)
}

/// One channel with its name; `channel_idx` starts at 0.
pub fn named_channel(channel_idx: usize, name: &str) -> String {
    format!("{}, {name}", channel(channel_idx))
}

pub fn stream(rate_hz: u32, channels: u16, block_frames: Option<u32>) -> String {
    let blocks = block_frames.map_or(String::new(), |frames| format!(", blocks of {frames} frames"));
    format!("{rate_hz} Hz, {channels} channels{blocks}")
}

/// Highest latencies that are not felt, as lines of the graph.
pub fn latency_limits(stroke_ms: f32, tap_ms: f32) -> String {
    format!("limits: {stroke_ms:.0} ms for strokes, {tap_ms:.0} ms for taps")
}

/// Stroke latency of the last touch, and the highest since the output was opened.
pub fn strokes(ms: f32, max_ms: f32) -> String {
    format!("stroke latency {ms:.0} ms, highest {max_ms:.0} ms")
}

/// Tap latency of the last touch.
pub fn taps(ms: f32, is_late: bool) -> String {
    let judgment = if is_late { "; above about 6 ms, surfaces feel softer than they are" } else { "" };
    format!("tap latency {ms:.0} ms{judgment}")
}

pub fn response(resonance_hz: f64, q: f64, gain: f64, load_g: Option<f64>) -> String {
    let load = load_g.map_or(String::new(), |g| format!(" with a load of {g:.0} g"));
    format!("resonance {resonance_hz:.0} Hz, Q {q:.1}, {gain:.2} m/s² per volt{load}")
}

pub fn limits(rated_v: Option<f64>, peak_v: Option<f64>) -> String {
    let rated = rated_v.map(|v| format!("{v:.2} V rms continuous"));
    let peak = peak_v.map(|v| format!("{v:.1} V peak"));
    let known: Vec<String> = rated.into_iter().chain(peak).collect();
    if known.is_empty() {
        "limits unknown: only full scale limits the drive".to_owned()
    } else {
        known.join(", ")
    }
}

pub fn percent(share: f32) -> String {
    format!("{:.0} %", 100.0 * share)
}
