//! Words of the scope.

use shagreen_formats::thresholds::ThresholdKind;

use crate::scope::view::View;

/// Accessible names of the two choices of what is shown.
pub const VIEWS: [&str; 2] = ["Left view of the scope", "Right view of the scope"];
/// What the choices do.
pub const VIEW_HELP: &str = "What the scope shows here. Point at a plot to read its values; drag across it to measure, and click it to measure no longer.";
/// Holds the picture.
pub const FREEZE: &str = "Freeze";
/// What that does.
pub const FREEZE_HELP: &str = "Hold what the scope shows, to measure or save it; the texture sounds on (F).";
/// The menu of thresholds.
pub const THRESHOLD: &str = "Threshold";
/// What it does.
pub const THRESHOLD_HELP: &str = "What can just be felt, that level and spectrum are seen against. These are approximate curves of the literature, to 3 dB or so, not measurements of you or of your actuator.";
/// The menus of files.
pub const SAVE: &str = "Save";
/// Accessible names of the two menus of files.
pub const SAVES: [&str; 2] = ["Save the left view", "Save the right view"];
/// What they do.
pub const SAVE_HELP: &str = "Save what is shown here as a picture or as numbers.";
/// The series of the waveform.
pub const PLAYED: &str = "sent";
/// The blend's line in the spectrum.
pub const BLEND_LINE: &str = "blend (model)";
/// The measured line in the spectrum.
pub const LIVE_LINE: &str = "live";
/// The line of what can just be felt.
pub const THRESHOLD_LINE: &str = "threshold";
/// The level.
pub const LEVEL_LINE: &str = "level, dB re 1 m/s²";
/// The level above the threshold.
pub const ABOVE_LINE: &str = "above threshold, dB";
/// The speed.
pub const SPEED_LINE: &str = "speed, mm/s";
/// The force.
pub const FORCE_LINE: &str = "force, cN";
/// Horizontal axis of frequencies.
pub const FREQUENCY_AXIS: &str = "frequency in Hz";
/// Horizontal axis of times.
pub const TIME_AXIS: &str = "time in s";
/// Horizontal axis of short times.
pub const SHORT_TIME_AXIS: &str = "time in ms";
/// A value of the spectrogram.
pub const DENSITY: &str = "density";
/// Its unit.
pub const DENSITY_UNIT: &str = "dB re 1 (m/s²)²/Hz";
/// The places that decide on what is shown are those of simulated raters.
pub const SIMULATED: &str = "in a space of simulated raters";

/// The name of a threshold.
pub fn threshold(kind: ThresholdKind) -> &'static str {
    match kind {
        ThresholdKind::HeldTool => "Hand on a tool",
        ThresholdKind::Pacinian => "Skin, Pacinian channel",
        ThresholdKind::Composite => "Skin, most sensitive channel",
    }
}

/// What a threshold is.
pub fn threshold_help(kind: ThresholdKind) -> &'static str {
    match kind {
        ThresholdKind::HeldTool => {
            "For a stylus: what bare skin needs, less 15 dB, which is a rule of thumb for a hand around a vibrating tool"
        }
        ThresholdKind::Pacinian => {
            "What bare skin feels on a large contactor, by the channel that serves high frequencies"
        }
        ThresholdKind::Composite => "The same with the channels that serve low frequencies",
    }
}

/// The name of a view.
pub fn view(view: View) -> &'static str {
    match view {
        View::Waveform => "Acceleration",
        View::Spectrum => "Spectrum",
        View::Spectrogram => "Spectrogram",
        View::Level => "Level",
        View::Contact => "Speed and force",
    }
}

/// The unit of the upright axis of a view.
pub fn unit(view: View) -> &'static str {
    match view {
        View::Waveform => "m/s²",
        View::Spectrum => "dB re 1 (m/s²)²/Hz",
        View::Spectrogram => "Hz",
        View::Level => "dB",
        View::Contact => "mm/s, cN",
    }
}

/// The unit of the level axis of a view, as it stands behind a number.
pub fn x_unit(view: View) -> &'static str {
    match view {
        View::Waveform => "ms",
        View::Spectrum => "Hz",
        View::Spectrogram | View::Level | View::Contact => "s",
    }
}

/// A place in the spectrogram.
pub fn place(secs: f64, hz: f64) -> String {
    format!("{secs:.2} s, {hz:.0} Hz")
}

/// What a view shows.
pub fn view_help(view: View) -> &'static str {
    match view {
        View::Waveform => {
            "The acceleration that is sent to the output, before mute and limits, over the last quarter of a second"
        }
        View::Spectrum => {
            "The neighbors in their colors and the blend of them by their models, and what is sent to the output; with what can just be felt, as a noise a third of an octave wide"
        }
        View::Spectrogram => {
            "The spectrum of what was sent to the output over the last five seconds; lighter is stronger, from -60 to 0 dB re 1 (m/s²)²/Hz"
        }
        View::Level => {
            "How strong what is sent to the output is, before mute and limits, and how far above what can just be felt"
        }
        View::Contact => "How fast and how hard the tip stroked; 100 cN are 1 N",
    }
}

/// The title of the figure of the spectra at one contact.
pub fn spectrum_title(texture: &str, mm_per_s: f64, force_n: f64) -> String {
    format!("{} ({mm_per_s:.0} mm/s, {force_n:.2} N)", title(View::Spectrum, texture))
}

/// The title of a figure.
pub fn title(view: View, texture: &str) -> String {
    format!("{} of {texture}", self::view(view))
}

/// Which threshold a figure is seen against.
pub fn against(kind: ThresholdKind) -> String {
    format!("threshold: {}, approximate", threshold(kind))
}

/// The newest level, and how many times stronger than the threshold it is.
pub fn level_now(level_db: f64, multiple: f64) -> String {
    format!("{level_db:.0} dB · {}×", times(multiple))
}

/// The same in full.
pub fn level_now_in_full(level_db: f64, multiple: f64) -> String {
    format!(
        "{level_db:.1} dB re 1 m/s² over the last half second: {} times what can just be felt (approximate)",
        times(multiple)
    )
}

/// A multiple of the threshold.
fn times(multiple: f64) -> String {
    if multiple < 9.95 { format!("{multiple:.1}") } else { format!("{multiple:.0}") }
}

/// What a measured span says.
pub fn measured_help(view: View) -> &'static str {
    match view {
        View::Spectrum => "The level of the blend (model) between two frequencies, in dB re 1 m/s²",
        View::Waveform => "The time between two moments, and the frequency with that period",
        View::Spectrogram | View::Level | View::Contact => "The time between two moments",
    }
}

/// What lies between two moments, in s.
pub fn between_times(from_secs: f64, to_secs: f64) -> String {
    let secs = (to_secs - from_secs).abs();
    if secs < 0.25 {
        format!("{:.1} ms = {:.1} Hz", 1e3 * secs, 1.0 / secs.max(1e-6))
    } else {
        format!("{secs:.2} s")
    }
}

/// What lies between two frequencies, in Hz, and the level of the blend there.
pub fn between_frequencies(low_hz: f64, high_hz: f64, level_db: f64) -> String {
    format!("blend {low_hz:.0}–{high_hz:.0} Hz: {level_db:.1} dB")
}

/// A value under the pointer.
pub fn value(name: &str, value: f64) -> String {
    let value = if value.abs() < 10.0 { format!("{value:.2}") } else { format!("{value:.1}") };
    format!("{name}  {value}")
}
