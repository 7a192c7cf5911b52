//! Signals workspace.

use shagreen_core::signals::quality::Feature;

use crate::choices::signals::Slot;
use crate::choices::signals::Tool;
use crate::choices::signals::View;

/// Label followed by the letter of the slot.
fn of(what: &str, slot: Slot) -> String {
    format!("{what} {}", slot.name())
}

pub const FEEL: &str = "Feel";

/// Accessible name of the Feel button.
pub fn feel(slot: Slot) -> String {
    of(FEEL, slot)
}

pub fn feel_help(slot: Slot) -> String {
    let key = match slot {
        Slot::A => "1",
        Slot::B => "2",
    };
    format!(
        "Plays this signal by position under the pen, the mouse or the automatic stroke, at its speed and force ({key}). Press again to return to the authored texture."
    )
}

pub const PLAY: &str = "Play";
pub const STOP: &str = "Stop";

/// Accessible name of the Stop button.
pub fn stop(slot: Slot) -> String {
    of(STOP, slot)
}

/// Accessible name of the Play button.
pub fn play(slot: Slot) -> String {
    of(PLAY, slot)
}

pub const PLAY_HELP: &str = "Plays the signal at its own speed, regardless of the pen";
pub const TAKE_HEARD: &str = "Authored";

/// Accessible name of the button that loads the authored texture.
pub fn take_heard(slot: Slot) -> String {
    format!("Use the authored texture as {}", slot.name())
}

pub const TAKE_HEARD_HELP: &str =
    "Renders the authored texture for 5 s at the speed and force of the automatic stroke, and loads it here";
pub const OPEN: &str = "Open…";

/// Accessible name of the Open button.
pub fn open(slot: Slot) -> String {
    of("Open a file as", slot)
}

pub const OPEN_HELP: &str = "A recording (.wav), a profile of positions and values (.csv), or one row of a photo or height map (.png, .jpg). Files can also be dropped on the window.";
pub const PATH_HINT: &str = "or a path…";

/// Accessible name of the path field.
pub fn path_of(slot: Slot) -> String {
    of("Path of", slot)
}

pub const OPEN_TITLE: &str = "Open a signal";
pub const OPEN_PATH_HINT: &str = "Path of a .wav, .csv, .png or .jpg file…";

/// Accessible name of the button that empties a slot.
pub fn remove(slot: Slot) -> String {
    of("Remove", slot)
}

pub const NOTHING_THERE: &str = "empty";
pub const MAKING: &str = "Computing…";

/// Duration, speed, length and level of a signal.
pub fn facts(seconds: f64, length_mm: f64, level_mps2: f64, mm_per_s: f64) -> String {
    format!("{seconds:.2} s at {mm_per_s:.0} mm/s: {length_mm:.1} mm, {level_mps2:.2} m/s² rms")
}

/// Warning about a signal that was truncated.
pub fn cut(seconds: f64) -> String {
    format!("only the first {seconds:.1} s are used: a signal can hold no more")
}

pub const SPEED: &str = "speed";
pub const SPEED_HELP: &str =
    "Stroke speed of the recording, or of the profile: it converts between time and position";
pub const FORCE: &str = "force";
pub const FORCE_HELP: &str = "Force at which the signal has its stated level; the level scales with force";
pub const LEVEL: &str = "level";
pub const LEVEL_HELP: &str =
    "Root mean square acceleration for a signal without a unit, such as heights, brightness or friction";
pub const FULL_SCALE: &str = "full scale";
pub const FULL_SCALE_HELP: &str =
    "Acceleration of a sample value of 1.0, if no .json file of the same name states it";
pub const CHANNEL: &str = "channel";
pub const CHANNEL_HELP: &str =
    "Channel that is the signal. \"all\" combines all channels as the axes of one accelerometer.";

/// Channel number as shown; below 1 all channels.
pub fn channel(channel: f64) -> String {
    if channel < 1.0 { "all".to_owned() } else { format!("{channel:.0}") }
}

pub const WIDTH: &str = "width";
pub const WIDTH_HELP: &str = "Width of the surface that the picture shows, in mm";
pub const ROW: &str = "row";
pub const ROW_HELP: &str = "Pixel row that is stroked, from 0 at the upper edge";

/// Row as shown; below 0 the middle row.
pub fn row(row: f64) -> String {
    if row < 0.0 { "middle".to_owned() } else { format!("{row:.0}") }
}

/// Name of a signal from a row of a picture.
pub fn row_of(name: &str, row: Option<u32>) -> String {
    row.map_or_else(|| format!("{name}, middle row"), |row| format!("{name}, row {row}"))
}

pub const COPY_OF_A: &str = "Copy A to B";
pub const COPY_OF_A_HELP: &str = "Copies A to B, to edit it there";
pub const CODEC: &str = "Codec";
pub const CODEC_HELP: &str =
    "Sets B to A, encoded and decoded by the codec at this bit rate: 20 ms frames, band below 1 kHz";
pub const BITRATE: &str = "Bit rate of the codec";

pub fn kbps(kbps: f64) -> String {
    format!("{kbps} kbit/s")
}

/// Label of the button that resynthesizes B.
pub fn remake(window_mm: f64) -> String {
    format!("Resynthesize, {window_mm:.2} mm")
}

pub const REMAKE: &str = "Resynthesize from the spatial spectrogram";
pub const REMAKE_HELP: &str = "Resynthesizes B from the magnitude of the spatial spectrogram of A, with windows of this width (tab Spatial). The phases are lost.";
pub const STEPS: &str = " steps";
pub const REFINEMENTS: &str = "Griffin-Lim iterations";
pub const REFINEMENTS_HELP: &str = "Iterations of the fast Griffin-Lim algorithm after the resynthesis. They reduce the spectral error, but do not always improve the positions.";

/// Name of a signal after the codec.
pub fn through_codec(name: &str, kbps: f64) -> String {
    format!("{name}, {kbps} kbit/s")
}

/// Name of a resynthesized signal.
pub fn remade(name: &str, window_mm: f64, n_steps: usize) -> String {
    match n_steps {
        0 => format!("{name}, resynthesized at {window_mm:.2} mm"),
        n => format!("{name}, resynthesized at {window_mm:.2} mm in {n} steps"),
    }
}

/// Name of an edited signal.
pub fn painted(name: &str) -> String {
    if name.ends_with(", edited") { name.to_owned() } else { format!("{name}, edited") }
}

pub const KEEP: &str = "Add as relief";

/// Accessible name of the button that adds a signal as a relief.
pub fn keep(slot: Slot) -> String {
    format!("Add {} as a relief texture", slot.name())
}

pub const KEEP_HELP: &str =
    "Adds a texture to the Author workspace that plays this signal as a function of position (a relief)";
pub const OVER: &str = "over";
pub const OVER_WHICH: &str = "Texture under the relief";
pub const OVER_HELP: &str = "Texture whose noise, friction and tap transients are added to the relief; \"none\" plays the relief alone";
pub const NOTHING: &str = "none";

/// Name of a texture with a signal as its relief.
pub fn kept_name(signal: &str, over: Option<&str>) -> String {
    over.map_or_else(|| format!("{signal} (relief)"), |over| format!("{signal} over {over}"))
}

/// Confirmation that a texture was added.
pub fn kept(name: &str) -> String {
    format!("\"{name}\" was added to the textures of the Author workspace.")
}

/// Tab label.
pub fn view(view: View) -> &'static str {
    match view {
        View::Times => "Spectrogram",
        View::Places => "Spatial",
        View::Differences => "Differences",
    }
}

pub fn view_help(view: View) -> &'static str {
    match view {
        View::Times => "Spectrograms: frequency over time, each signal at its own speed",
        View::Places => {
            "Spatial spectrograms: spatial frequency over position, their fidelity by window width, and editing tools"
        }
        View::Differences => "Features of both signals, the predicted d', and the effect of the codec",
    }
}

/// Title of a map.
pub fn map_title(view: View, name: &str, window_mm: f64) -> String {
    match view {
        View::Places => format!("{name}, {window_mm:.2} mm window"),
        View::Times | View::Differences => name.to_owned(),
    }
}

/// Labels of the horizontal and the vertical axis of a map.
pub fn map_axes(view: View) -> [&'static str; 2] {
    match view {
        View::Places => ["position in mm", "spatial frequency in 1/mm"],
        View::Times | View::Differences => ["time in s", "frequency in Hz"],
    }
}

/// Accessible name of a map.
pub fn map_name(slot: Slot) -> &'static str {
    match slot {
        Slot::A => "Map of A",
        Slot::B => "Map of B",
    }
}

/// First part of the file names of a map.
pub fn stem(view: View, slot: Slot) -> &'static str {
    match (view, slot) {
        (View::Places, Slot::A) => "spatial-spectrogram-a",
        (View::Places, Slot::B) => "spatial-spectrogram-b",
        (_, Slot::A) => "spectrogram-a",
        (_, Slot::B) => "spectrogram-b",
    }
}

/// Text in place of the map of an empty slot.
pub fn nothing_in(slot: Slot) -> String {
    match slot {
        Slot::A => "A is empty.".to_owned(),
        Slot::B => "B is empty. Create it from A on the left.".to_owned(),
    }
}

pub const AMPLITUDE: &str = "amplitude";
pub const DB_MPS2: &str = "dB re 1 m/s²";

pub const WINDOW: &str = "Window";
pub const WINDOW_HELP: &str = "Window width of the spatial spectrogram. Wide windows resolve frequency, narrow windows resolve position.";
pub const SHOW_ALL: &str = "Show all";
pub const ZOOM_HELP: &str = "Scroll over a map to zoom in on a part of the signal";

pub const WAVE: &str = "waveform";
pub const THIS_WINDOW: &str = "this window";
pub const FIDELITY: &str = "Fidelity by window width";
pub const WINDOW_MM: &str = "window in mm";
pub const CORRELATION: &str = "correlation of envelopes";
pub const MEASURED: &str = "computed from these signals";

pub const BY_RATE: &str = "Predicted d' by codec bit rate";
pub const KBPS: &str = "bit rate in kbit/s";
pub const D_PRIME: &str = "predicted d'";
pub const TOLD_APART: &str = "d' = 1, about 2 of 3 correct";
pub const PREDICTED: &str = "predicted by a model, no human data";

pub const FEATURE_COLUMNS: [&str; 4] = ["A", "B", "distance", "part of d'"];
pub const FEATURE_COLUMNS_HELP: [&str; 4] = [
    "Value of A, if the feature is defined for one signal",
    "Value of B, if the feature is defined for one signal",
    "Distance between A and B, mean over segments of 0.8 s",
    "Contribution of the distance to the predicted d'; features without a value are not in the model",
];

/// Title of the table of features.
pub fn features_title([first, second]: [&str; 2], d_prime: f64) -> String {
    format!("{first} and {second}: predicted d' {d_prime:.2}")
}

pub fn d_prime(d_prime: f64) -> String {
    format!("d' {d_prime:.2}")
}

pub const D_PRIME_HELP: &str = "Predicted discriminability of A and B, in standard deviations: at 1, about two of three answers are correct. A model with published weights predicts it; nobody felt these signals. The model compares a signal with a processed version of it: two strokes on the same texture already give a large d'.";

/// Duration and signal-to-noise ratio of the comparison.
pub fn compared(snr_db: f64, seconds: f64) -> String {
    let noise = if snr_db.is_finite() {
        format!("signal-to-noise ratio {snr_db:.1} dB")
    } else if snr_db > 0.0 {
        "identical samples".to_owned()
    } else {
        "A is silent".to_owned()
    };
    format!("predicted over {seconds:.1} s; {noise}")
}

pub fn feature(feature: Feature) -> String {
    feature.id().replace('_', " ")
}

pub fn feature_help(feature: Feature) -> &'static str {
    match feature {
        Feature::Roughness => "Logarithm (base 10) of the mean power in (m/s²)²",
        Feature::Brightness => "Spectral centroid, in Hz",
        Feature::Regularity => "Largest autocorrelation at lags of 2 to 50 ms, at most 1",
        Feature::Asymmetry => "Skewness of the samples",
        Feature::SpectralPower => "Activation of tuned channels (power), compared channel by channel",
        Feature::SpectralAmplitude => "Activation of tuned channels (amplitude)",
        Feature::Envelope => "Temporal envelope up to 20 Hz, compared at the best lag",
    }
}

pub const NEEDS_PAIR: &str = "A comparison needs two signals; one is missing.";
pub const TOO_SHORT: &str = "a comparison needs at least 0.8 s, and the signal is shorter; use a longer signal or a lower stroke speed";
pub const TOO_SHORT_TO_DRAW: &str = "the signal is too short for a spectrogram";
pub const BROKE_OFF: &str = "the computation stopped unexpectedly; this is a bug, please report it";

/// Error about a stretch factor that is too large.
pub fn too_long(factor: f64) -> String {
    format!("the signal can be stretched by at most {factor:.2}: it would become too long")
}

pub const BEYOND_TOUCH: &str =
    "the levels of the signals are far outside the range of touch; correct their units";

pub const PAINT_B: &str = "Edit B";
pub const PAINT_B_HELP: &str = "The tools change the spatial spectrogram of B at this window width, and B is resynthesized from it at once";

pub fn tool(tool: Tool) -> &'static str {
    match tool {
        Tool::Louder => "Amplify",
        Tool::Softer => "Attenuate",
        Tool::Erase => "Erase",
        Tool::Copy => "Copy",
        Tool::Paste => "Paste",
    }
}

pub fn tool_help(tool: Tool) -> &'static str {
    match tool {
        Tool::Louder => "Drag over the map of B to amplify the part under the brush; each touch adds gain",
        Tool::Softer => {
            "Drag over the map of B to attenuate the part under the brush; each touch removes gain"
        }
        Tool::Erase => "Drag a rectangle on the map of B to erase its content",
        Tool::Copy => "Drag a rectangle on the map of B to copy its content",
        Tool::Paste => {
            "Click on the map of B to paste the copied part from that position on, at its own frequencies"
        }
    }
}

pub const BRUSH_WIDTH: &str = "width";
pub const BRUSH_WIDTH_HELP: &str = "Reach of the brush to either side, in mm";
pub const BRUSH_HEIGHT: &str = "height";
pub const BRUSH_HEIGHT_HELP: &str = "Reach of the brush up and down, in octaves";
pub const BRUSH_GAIN: &str = "gain";
pub const BRUSH_GAIN_HELP: &str = "Gain of one brush touch at the center of the brush, in dB";
pub const STRETCH: &str = "Stretch";
pub const STRETCH_HELP: &str = "Stretches B by this factor: events take longer, frequencies stay the same";
pub const STRETCH_FACTOR: &str = "Stretch factor";
pub const UNDO_PAINTING: &str = "Undo";
pub const REDO_PAINTING: &str = "Redo";
pub const BRUSH_STROKE: &str = "brush stroke";
pub const ERASING: &str = "erase";
pub const PASTING: &str = "paste";
pub const REPLACING: &str = "replace B";
pub const STRETCHING: &str = "stretch";
pub const NOTHING_COPIED: &str = "the rectangle is empty; drag it over a larger part of the map";
pub const NOTHING_TO_PASTE: &str = "Nothing has been copied yet";
pub const PAINTED_MAP: &str = "Spatial spectrogram of B, editable";

pub const EMPTY_TITLE: &str = "Compare and compress signals";
pub const EMPTY_STEPS: [&str; 4] = [
    "Load a signal into A: the authored texture, a recording, a profile, or one row of a photo or height map. Files can be dropped here.",
    "Create B from A with the codec or by resynthesis from its spatial spectrogram, or load another signal into B.",
    "Feel A and B in turn on the pad (1 and 2), compare their spectrograms, and read the predicted discriminability d'.",
    "Edit the spatial spectrogram of B: the change can be felt at once. Add B as the relief of a texture.",
];
pub const DROP_HERE: &str = "Drop signals here";
pub const DROP_KINDS: &str = "recordings (.wav), profiles (.csv), photos or height maps (.png, .jpg)";
