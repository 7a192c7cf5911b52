//! Signals workspace.

use crate::choices::signals::Slot;
use crate::choices::signals::Tool;
use crate::choices::signals::View;
use crate::strings::digits::three_digits;

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
        "Plays this signal as a function of tip position, driven by the pen, the mouse or the automatic stroke ({key}). It follows the speed and force of the stroke. Press again to return to the authored texture."
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

pub const PLAY_HELP: &str = "Plays the signal over time at its stroke speed. The pen has no effect.";
pub const TAKE_HEARD: &str = "Use texture";

/// Accessible name of the button that loads the audible texture.
pub fn take_heard(slot: Slot) -> String {
    format!("Use texture as {}", slot.name())
}

pub const TAKE_HEARD_HELP: &str = "Renders the texture that is audible in Author for 5 s, at the speed and force of the automatic stroke (or the means of the recorded stroke), and loads the signal here";
pub const OPEN: &str = "Open…";

/// Accessible name of the Open button.
pub fn open(slot: Slot) -> String {
    of("Open a file as", slot)
}

pub const OPEN_HELP: &str = "Opens a recording (.wav), a profile of positions and values (.csv), or one row of a photo or height map (JPEG, PNG, WebP, BMP, TIFF). Files can also be dropped on the window.";
pub const PATH_HINT: &str = "or a path…";

/// Accessible name of the path field.
pub fn path_of(slot: Slot) -> String {
    of("Path of", slot)
}

pub const OPEN_TITLE: &str = "Open a signal";
/// Kind of file in the dialog of the system.
pub const OPEN_KIND: &str = "Signals, surface profiles and pictures";
pub const OPEN_PATH_HINT: &str = "Path of a .wav or .csv file, a photo or a height map…";

/// Accessible name of the button that removes signal A or B.
pub fn remove(slot: Slot) -> String {
    of("Remove", slot)
}

pub const NOTHING_THERE: &str = "empty";
pub const MAKING: &str = "Computing…";

/// Duration, speed, length and level of a signal.
pub fn facts(seconds: f64, length_mm: f64, level_mps2: f64, mm_per_s: f64) -> String {
    let [seconds, mm_per_s, length_mm, level_mps2] =
        [seconds, mm_per_s, length_mm, level_mps2].map(three_digits);
    format!("{seconds} s at {mm_per_s} mm/s: {length_mm} mm, {level_mps2} m/s² rms")
}

/// Warning about a signal that was truncated.
pub fn cut(seconds: f64) -> String {
    format!("the signal is too long; only the first {} s are used", three_digits(seconds))
}

pub const SPEED: &str = "speed";
pub const SPEED_HELP: &str =
    "Stroke speed of the recording or for the profile, in mm/s. It converts between time and position.";
pub const FORCE: &str = "force";
pub const FORCE_HELP: &str =
    "Normal force at which the signal has its stated level, in N. The level scales with the force.";
pub const LEVEL: &str = "level";
pub const LEVEL_HELP: &str = "Root mean square acceleration, in m/s², for a signal that is not an acceleration, such as height, brightness or friction";
pub const FULL_SCALE: &str = "full scale";
pub const FULL_SCALE_HELP: &str =
    "Acceleration of a sample value of 1.0, in m/s², if no .json file of the same name states it";
pub const CHANNEL: &str = "channel";
pub const CHANNEL_HELP: &str = "Channel to use. \"all\" takes the channels as the axes of one accelerometer and combines them into one signal by DFT321.";

/// Channel number as shown; below 1 all channels.
pub fn channel(channel: f64) -> String {
    if channel < 1.0 { "all".to_owned() } else { format!("{channel:.0}") }
}

pub const WIDTH: &str = "width";
pub const WIDTH_HELP: &str = "Width of the surface that the picture shows, in mm";
pub const ROW: &str = "row";
pub const ROW_HELP: &str = "Pixel row that becomes the profile, counted from 0 at the upper edge";

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
    "Encodes and decodes A at this bit rate and stores the result in B (20 ms frames, band below 1 kHz)";
pub const BITRATE: &str = "Bit rate of the codec";

pub fn kbps(kbps: f64) -> String {
    format!("{kbps} kbit/s")
}

/// Label of the button that resynthesizes B.
pub fn remake(window_mm: f64) -> String {
    format!("Resynthesize, {} mm", three_digits(window_mm))
}

pub const REMAKE: &str = "Resynthesize from the spatial spectrogram";
pub const REMAKE_HELP: &str = "Resynthesizes A from the magnitude of its spatial spectrogram and stores the result in B. Phases are lost. The tab Spatial sets the window width.";
pub const STEPS: &str = " iterations";
pub const REFINEMENTS: &str = "Griffin-Lim iterations";
pub const REFINEMENTS_HELP: &str = "Iterations of the fast Griffin-Lim algorithm after the resynthesis. They reduce the spectral error, but do not always improve how well events are localized.";

/// Name of a signal after the codec.
pub fn through_codec(name: &str, kbps: f64) -> String {
    format!("{name}, {kbps} kbit/s")
}

/// Name of a resynthesized signal.
pub fn remade(name: &str, window_mm: f64, n_steps: usize) -> String {
    let window_mm = three_digits(window_mm);
    match n_steps {
        0 => format!("{name}, resynthesized at {window_mm} mm"),
        n => format!("{name}, resynthesized at {window_mm} mm, {n} iterations"),
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

pub const KEEP_HELP: &str = "Adds a texture to the Author workspace with this signal as its relief: acceleration as a function of tip position";
pub const OVER: &str = "base";
pub const OVER_WHICH: &str = "Base texture of the relief";
pub const OVER_HELP: &str = "Base texture: its noise, friction and tap transients are added to the relief. \"none\" plays the relief alone.";
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
        View::Times => "Spectrograms: frequency over time, each signal at its stroke speed",
        View::Places => {
            "Spatial spectrograms (spatial frequency over position), fidelity of the resynthesis by window width, and editing tools"
        }
        View::Differences => {
            "Features of both signals, the predicted discriminability d', and d' by bit rate of the codec"
        }
    }
}

/// Title of a spectrogram.
pub fn map_title(view: View, name: &str, window_mm: f64) -> String {
    match view {
        View::Places => format!("{name}, {} mm window", three_digits(window_mm)),
        View::Times | View::Differences => name.to_owned(),
    }
}

/// Labels of the horizontal and the vertical axis of a spectrogram.
pub fn map_axes(view: View) -> [&'static str; 2] {
    match view {
        View::Places => ["position in mm", "spatial frequency in 1/mm"],
        View::Times | View::Differences => ["time in s", "frequency in Hz"],
    }
}

/// Accessible name of a spectrogram.
pub fn map_name(slot: Slot) -> &'static str {
    match slot {
        Slot::A => "Spectrogram of A",
        Slot::B => "Spectrogram of B",
    }
}

/// First part of the file names of a spectrogram.
pub fn stem(view: View, slot: Slot) -> &'static str {
    match (view, slot) {
        (View::Places, Slot::A) => "spatial-spectrogram-a",
        (View::Places, Slot::B) => "spatial-spectrogram-b",
        (_, Slot::A) => "spectrogram-a",
        (_, Slot::B) => "spectrogram-b",
    }
}

/// Text in place of the spectrogram if there is no signal.
pub fn nothing_in(slot: Slot) -> String {
    match slot {
        Slot::A => "A is empty.".to_owned(),
        Slot::B => "B is empty. Create it from A with the controls on the left.".to_owned(),
    }
}

pub const AMPLITUDE: &str = "amplitude";
pub const DB_MPS2: &str = "dB re 1 m/s²";

pub const WINDOW: &str = "Window";
pub const WINDOW_HELP: &str = "Window width of the spatial spectrogram, in mm. Wide windows resolve frequency; narrow windows resolve position.";
pub const SHOW_ALL: &str = "Show all";
pub const ZOOM_HELP: &str = "Scroll over a spectrogram to zoom in on a part of the signal";

pub const WAVE: &str = "waveform";
pub const THIS_WINDOW: &str = "current window width";
pub const FIDELITY: &str = "Fidelity";
pub const WINDOW_MM: &str = "window width in mm";
pub const CORRELATION: &str = "correlation (A, B: envelope)";
pub const MEASURED: &str = "from these signals";

pub const BY_RATE: &str = "Predicted d' by codec bit rate";
pub const KBPS: &str = "bit rate in kbit/s";
pub const D_PRIME: &str = "predicted d'";
pub const TOLD_APART: &str = "d' = 1: 69 % correct (yes-no, unbiased)";
pub const PREDICTED: &str = "model prediction, not rated by people";

pub const NEEDS_PAIR: &str = "A comparison needs two signals: load A and B.";
pub const TOO_SHORT: &str = "the signal is shorter than 0.8 s, the minimum for a comparison; use a longer signal or a lower stroke speed";
pub const TOO_SHORT_TO_DRAW: &str = "the signal is too short for a spectrogram; use a longer signal";
pub const BROKE_OFF: &str = "the computation stopped unexpectedly; this is a bug, please report it";

/// Error about a stretch factor that is too large.
pub fn too_long(factor: f64) -> String {
    format!("the stretch factor is too large; the maximum for this signal is {}", three_digits(factor))
}

pub const BEYOND_TOUCH: &str =
    "the signal levels are too large or too small for the model; check their units (m/s²)";

pub const PAINT_B: &str = "Edit B";
pub const PAINT_B_HELP: &str = "The tools change the spatial spectrogram of B at the current window width. B is resynthesized after each change.";

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
        Tool::Louder => {
            "Drag over the spectrogram of B to amplify the part under the brush; repeated drags add gain"
        }
        Tool::Softer => {
            "Drag over the spectrogram of B to attenuate the part under the brush; repeated drags remove gain"
        }
        Tool::Erase => "Drag a rectangle on the spectrogram of B to erase its content",
        Tool::Copy => "Drag a rectangle on the spectrogram of B to copy its content",
        Tool::Paste => {
            "Click on the spectrogram of B to paste the copied part. It starts at that position and keeps its frequencies."
        }
    }
}

pub const BRUSH_WIDTH: &str = "half-width";
pub const BRUSH_WIDTH_HELP: &str = "Half-width of the brush along the position axis, in mm";
pub const BRUSH_HEIGHT: &str = "half-height";
pub const BRUSH_HEIGHT_HELP: &str = "Half-height of the brush along the frequency axis, in octaves";
pub const BRUSH_GAIN: &str = "gain";
pub const BRUSH_GAIN_HELP: &str =
    "Gain at the center of one brush touch, in dB. A drag consists of overlapping touches.";
pub const STRETCH: &str = "Stretch";
pub const STRETCH_HELP: &str = "Stretches B by this factor: events become longer, frequencies stay the same";
pub const STRETCH_FACTOR: &str = "Stretch factor";
// Names of edits, as they follow the words "Undo" and "Redo".
pub const AMPLIFYING: &str = "Amplify part of B";
pub const ATTENUATING: &str = "Attenuate part of B";
pub const ERASING: &str = "Erase part of B";
pub const PASTING: &str = "Paste into B";
pub const REPLACING: &str = "Replace B";
pub const STRETCHING: &str = "Stretch B";
pub const NOTHING_COPIED: &str = "the rectangle is too small; drag over a larger area";
pub const NOTHING_TO_PASTE: &str = "Nothing has been copied yet; use the tool Copy first";
pub const PAINTED_MAP: &str = "Spatial spectrogram of B, editable";

pub const EMPTY_TITLE: &str = "Compare and compress signals";
pub const EMPTY_STEPS: [&str; 4] = [
    "Load a signal into A: the audible texture, a recording, a profile (values over position), or one row of a photo or height map. Files can be dropped here.",
    "Create B from A with the codec or by resynthesis from its spatial spectrogram, or load another signal into B.",
    "Feel A and B in turn on the stroke pad (keys 1 and 2), compare their spectrograms, and read the predicted discriminability d'.",
    "Edit the spatial spectrogram of B and feel the change at once. Add B to a texture as its relief: acceleration as a function of tip position.",
];
pub const DROP_HERE: &str = "Drop signals here";
pub const DROP_KINDS: &str =
    "recordings (.wav), profiles (.csv), photos or height maps (JPEG, PNG, WebP, BMP, TIFF)";
