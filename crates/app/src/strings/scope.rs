//! Oscilloscope.

use shagreen_core::words::two_digits;
use shagreen_formats::thresholds::ThresholdKind;

use crate::choices::scope::View;

/// Accessible names of the choices of the left and the right view.
pub const VIEWS: [&str; 2] = ["Left view of the scope", "Right view of the scope"];
pub const VIEW_HELP: &str = "Quantity in this view. Point at the plot to read values; drag across it to measure, and click to clear the measurement.";
pub const FREEZE: &str = "Freeze";
pub const FREEZE_HELP: &str =
    "Stops the plots, so that you can measure or save them. The texture keeps playing (F).";
pub const THRESHOLD: &str = "Threshold";
pub const THRESHOLD_HELP: &str = "Detection threshold for vibration, shown in the spectrum and used for the level. The curves are from the literature and approximate (about ±3 dB). They were not measured on you or your actuator.";
pub const SAVE: &str = "Save";
/// Accessible names of the Save menus of the left and the right view.
pub const SAVES: [&str; 2] = ["Save the left view", "Save the right view"];
pub const SAVE_HELP: &str = "Saves this view as a picture (SVG, PNG) or as a table (CSV).";
pub const PLAYED: &str = "output";
pub const BLEND_LINE: &str = "interpolated (model)";
pub const LIVE_LINE: &str = "live";
pub const THRESHOLD_LINE: &str = "threshold";
pub const LEVEL_LINE: &str = "level, dB re 1 m/s²";
pub const ABOVE_LINE: &str = "above threshold, dB";
pub const SPEED_LINE: &str = "speed, mm/s";
pub const FORCE_LINE: &str = "force, cN";
pub const FREQUENCY_AXIS: &str = "frequency in Hz";
pub const TIME_AXIS: &str = "time in s";
pub const SHORT_TIME_AXIS: &str = "time in ms";
pub const DENSITY: &str = "PSD";
pub const DENSITY_UNIT: &str = "dB re 1 (m/s²)²/Hz";
pub const SIMULATED: &str = "positions from simulated raters";

pub fn threshold(kind: ThresholdKind) -> &'static str {
    match kind {
        ThresholdKind::HeldTool => "Hand-held tool",
        ThresholdKind::Pacinian => "Skin, Pacinian channel",
        ThresholdKind::Composite => "Skin, most sensitive channel",
    }
}

pub fn threshold_help(kind: ThresholdKind) -> &'static str {
    match kind {
        ThresholdKind::HeldTool => {
            "For a stylus: the Pacinian threshold of bare skin minus 15 dB, a rule of thumb for a hand-held vibrating tool"
        }
        ThresholdKind::Pacinian => "Bare skin on a large contactor, Pacinian channel (high frequencies)",
        ThresholdKind::Composite => {
            "Bare skin on a large contactor, most sensitive channel at each frequency"
        }
    }
}

pub fn view(view: View) -> &'static str {
    match view {
        View::Waveform => "Acceleration",
        View::Spectrum => "Spectrum",
        View::Spectrogram => "Spectrogram",
        View::Level => "Level",
        View::Contact => "Speed and force",
    }
}

/// Unit of the vertical axis.
pub fn unit(view: View) -> &'static str {
    match view {
        View::Waveform => "m/s²",
        View::Spectrum => "dB re 1 (m/s²)²/Hz",
        View::Spectrogram => "Hz",
        View::Level => "dB",
        View::Contact => "mm/s, cN",
    }
}

/// The same where there is little room.
pub fn short_unit(view: View) -> &'static str {
    match view {
        View::Spectrum => "dB",
        _ => unit(view),
    }
}

/// Number on the frequency axis; only the first has its unit.
pub fn frequency_mark(hz: f64, first_hz: f64) -> String {
    if hz < 1.1 * first_hz { format!("{hz:.0} Hz") } else { format!("{hz:.0}") }
}

/// Unit of the horizontal axis.
pub fn x_unit(view: View) -> &'static str {
    match view {
        View::Waveform => "ms",
        View::Spectrum => "Hz",
        View::Spectrogram | View::Level | View::Contact => "s",
    }
}

/// Point of the spectrogram.
pub fn place(secs: f64, hz: f64) -> String {
    format!("{secs:.2} s, {hz:.0} Hz")
}

pub fn view_help(view: View) -> &'static str {
    match view {
        View::Waveform => "Output signal in m/s², before mute and limiter, over the last 0.25 s",
        View::Spectrum => {
            "Power spectral densities: the models of the contributing textures (in their colors) and of the interpolated texture, the output signal (live), and the detection threshold for one-third-octave noise"
        }
        View::Spectrogram => {
            "Spectrogram of the output signal over the last 5 s. Lighter is stronger; the colors cover -60 to 0 dB re 1 (m/s²)²/Hz"
        }
        View::Level => {
            "Level of the output signal before mute and limiter, in dB re 1 m/s², and its height above the detection threshold, in dB"
        }
        View::Contact => "Tip speed, in mm/s, and normal force, in cN (100 cN = 1 N)",
    }
}

/// Title of the figure of spectra at one speed and force.
pub fn spectrum_title(texture: &str, mm_per_s: f64, force_n: f64) -> String {
    format!("{} ({mm_per_s:.0} mm/s, {force_n:.2} N)", title(View::Spectrum, texture))
}

pub fn title(view: View, texture: &str) -> String {
    format!("{} of {texture}", self::view(view))
}

/// Note of the threshold that a figure shows.
pub fn against(kind: ThresholdKind) -> String {
    format!("threshold: {}, approximate", threshold(kind))
}

/// Latest level, and its multiple of the detection threshold.
pub fn level_now(level_db: f64, multiple: f64) -> String {
    format!("{level_db:.0} dB · {}×", two_digits(multiple))
}

/// The same as [`level_now`], as a sentence.
pub fn level_now_in_full(level_db: f64, multiple: f64) -> String {
    format!(
        "{level_db:.1} dB re 1 m/s² over the last 0.5 s: about {} times the detection threshold",
        two_digits(multiple)
    )
}

pub fn measured_help(view: View) -> &'static str {
    match view {
        View::Spectrum => {
            "Level of the interpolated texture (model) in the band between two frequencies, in dB re 1 m/s²"
        }
        View::Waveform => "Time between two instants, and the frequency whose period it is",
        View::Spectrogram | View::Level | View::Contact => "Time between two instants",
    }
}

/// Time between two instants in s; below 0.25 s also the frequency with that period.
pub fn between_times(from_secs: f64, to_secs: f64) -> String {
    let secs = (to_secs - from_secs).abs();
    if secs < 0.25 {
        format!("{:.1} ms = {:.1} Hz", 1e3 * secs, 1.0 / secs.max(1e-6))
    } else {
        format!("{secs:.2} s")
    }
}

/// Level of the interpolated texture in a band; frequencies in Hz.
pub fn between_frequencies(low_hz: f64, high_hz: f64, level_db: f64) -> String {
    format!("model {low_hz:.0}–{high_hz:.0} Hz: {level_db:.1} dB")
}

/// Value under the pointer.
pub fn value(name: &str, value: f64) -> String {
    let value = if value.abs() < 10.0 { format!("{value:.2}") } else { format!("{value:.1}") };
    format!("{name}  {value}")
}
