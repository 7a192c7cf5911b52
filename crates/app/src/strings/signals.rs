//! Every word of the workspace Signals.

use shagreen_core::quality::Feature;

use crate::signals::Slot;
use crate::signals::editor::Tool;
use crate::signals::page::View;

/// Name of the workspace.
pub const SIGNALS: &str = "Signals";
/// What the workspace is for.
pub const SIGNALS_HELP: &str = "Compare, compress and paint signals by how they feel";

/// Letter of a place with what is done.
fn of(what: &str, slot: Slot) -> String {
    format!("{what} {}", slot.name())
}

/// Lets the pen feel a signal.
pub const FEEL: &str = "Feel";
/// Accessible name of the button.
pub fn feel(slot: Slot) -> String {
    of(FEEL, slot)
}
/// What the button does.
pub fn feel_help(slot: Slot) -> String {
    let key = match slot {
        Slot::A => "1",
        Slot::B => "2",
    };
    format!(
        "The pen, the mouse on the pad or the automatic hand feels it place by place, as fast and as hard as they go ({key}); pressed once more, they feel what is authored again"
    )
}
/// Plays a signal.
pub const PLAY: &str = "Play";
/// Ends that.
pub const STOP: &str = "Stop";
/// Accessible name of the button.
pub fn stop(slot: Slot) -> String {
    of(STOP, slot)
}
/// Accessible name of the button.
pub fn play(slot: Slot) -> String {
    of(PLAY, slot)
}
/// What the button does.
pub const PLAY_HELP: &str = "Plays it as it was recorded, whatever the pen does";
/// Takes what is heard.
pub const TAKE_HEARD: &str = "Authored";
/// Accessible name of the button.
pub fn take_heard(slot: Slot) -> String {
    format!("Take what is authored as {}", slot.name())
}
/// What the button does.
pub const TAKE_HEARD_HELP: &str =
    "Takes what is authored, stroked for 5 s at the speed and force of the hand";
/// Looks for a file.
pub const OPEN: &str = "Open…";
/// Accessible name of the button.
pub fn open(slot: Slot) -> String {
    of("Open a file as", slot)
}
/// What may be opened.
pub const OPEN_HELP: &str = "A recording (.wav), a profile of positions and values (.csv), or a photo or height map (.png, .jpg), of which a row is taken. Files can also be dropped on the window.";
/// Hint in the field for a path.
pub const PATH_HINT: &str = "or a path…";
/// Accessible name of the field for a path.
pub fn path_of(slot: Slot) -> String {
    of("Path of", slot)
}
/// Title of the sheet that looks for a file.
pub const OPEN_TITLE: &str = "Open a signal";
/// Hint in its field.
pub const OPEN_PATH_HINT: &str = "Path of a .wav, .csv, .png or .jpg file…";
/// Takes a signal away.
pub fn remove(slot: Slot) -> String {
    of("Remove", slot)
}
/// Nothing lies in a place.
pub const NOTHING_THERE: &str = "nothing yet";
/// Something is being worked out.
pub const MAKING: &str = "Working it out…";
/// What a signal is, in figures.
pub fn facts(seconds: f64, length_mm: f64, level_mps2: f64, mm_per_s: f64) -> String {
    format!("{seconds:.2} s at {mm_per_s:.0} mm/s: {length_mm:.1} mm, {level_mps2:.2} m/s² rms")
}
/// A signal was cut.
pub fn cut(seconds: f64) -> String {
    format!("only its first {seconds:.1} s are taken: the bench has no room for more")
}
/// How fast the stroke is.
pub const SPEED: &str = "speed";
/// What that decides on.
pub const SPEED_HELP: &str =
    "How fast it was recorded, or is to be stroked: it makes places of times, and times of places";
/// How hard the stroke is.
pub const FORCE: &str = "force";
/// What that decides on.
pub const FORCE_HELP: &str = "The force at which it is as strong as it says; it grows with the force";
/// How strong a line without a unit is felt.
pub const LEVEL: &str = "level";
/// What that decides on.
pub const LEVEL_HELP: &str =
    "Heights, brightness and friction are no accelerations: this is the root mean square that they get";
/// What a sample of 1.0 is.
pub const FULL_SCALE: &str = "1.0 is";
/// When that is asked.
pub const FULL_SCALE_HELP: &str = "What a sample of 1.0 is, where no .json beside the recording says it";
/// Which channel is the signal.
pub const CHANNEL: &str = "channel";
/// What that decides on.
pub const CHANNEL_HELP: &str =
    "The channel that is the signal; all are taken for its axes, which are combined";
/// A channel as it is shown; below 1 they are all.
pub fn channel(channel: f64) -> String {
    if channel < 1.0 { "all".to_owned() } else { format!("{channel:.0}") }
}
/// How much surface a picture shows.
pub const WIDTH: &str = "width";
/// What that decides on.
pub const WIDTH_HELP: &str = "How much surface the width of the picture shows";
/// Which row of a picture.
pub const ROW: &str = "row";
/// What that decides on.
pub const ROW_HELP: &str = "The row of pixels that is stroked, from 0 at the upper edge";
/// A row as it is shown; below 0 it is the one in the middle.
pub fn row(row: f64) -> String {
    if row < 0.0 { "middle".to_owned() } else { format!("{row:.0}") }
}
/// The name of a row of a picture.
pub fn row_of(name: &str, row: Option<u32>) -> String {
    row.map_or_else(|| format!("{name}, middle row"), |row| format!("{name}, row {row}"))
}

/// The same signal.
pub const COPY_OF_A: &str = "Copy A to B";
/// What that is for.
pub const COPY_OF_A_HELP: &str = "B is A, to be painted";
/// What the codec leaves.
pub const CODEC: &str = "Codec";
/// What that is for.
pub const CODEC_HELP: &str =
    "B is what the codec leaves of A at this rate: 20 ms frames, what lies below 1 kHz";
/// Accessible name of the choice of a rate.
pub const BITRATE: &str = "Rate of the codec";
/// A rate.
pub fn kbps(kbps: f64) -> String {
    format!("{kbps} kbit/s")
}
/// What a spectrogram leaves.
pub fn remake(window_mm: f64) -> String {
    format!("From spectrogram, {window_mm:.2} mm")
}
/// Accessible name of the button.
pub const REMAKE: &str = "Remake from the spatial spectrogram";
/// What that is for.
pub const REMAKE_HELP: &str = "B is made of the spatial spectrogram of A alone, through windows of this width (tab Places): what the phases said is lost";
/// Unit of refinements.
pub const STEPS: &str = " steps";
/// Accessible name of the number of refinements.
pub const REFINEMENTS: &str = "Steps of refinement";
/// What they do.
pub const REFINEMENTS_HELP: &str =
    "Steps of fast Griffin-Lim from there: the spectra come nearer, places not always";
/// The name of a signal after the codec.
pub fn through_codec(name: &str, kbps: f64) -> String {
    format!("{name}, {kbps} kbit/s")
}
/// The name of a signal that was made of its spectrogram.
pub fn remade(name: &str, window_mm: f64, n_steps: usize) -> String {
    match n_steps {
        0 => format!("{name}, remade through {window_mm:.2} mm"),
        n => format!("{name}, remade through {window_mm:.2} mm in {n} steps"),
    }
}
/// The name of a signal that was painted.
pub fn painted(name: &str) -> String {
    if name.ends_with(", painted") { name.to_owned() } else { format!("{name}, painted") }
}

/// A signal becomes a texture.
pub const KEEP: &str = "Keep as relief";
/// Accessible name of the button.
pub fn keep(slot: Slot) -> String {
    format!("Keep {} as the relief of a texture", slot.name())
}
/// What it does.
pub const KEEP_HELP: &str =
    "A texture that has this at its places joins the textures of the workspace Author";
/// What else is felt of it.
pub const OVER: &str = "over";
/// Accessible name of the choice.
pub const OVER_WHICH: &str = "Texture under the relief";
/// What the choice does.
pub const OVER_HELP: &str =
    "The texture whose noise, friction and taps are felt with it; with nothing it is a relief alone";
/// Nothing lies under it.
pub const NOTHING: &str = "nothing";
/// The name of a texture that has a signal as its relief.
pub fn kept_name(signal: &str, over: Option<&str>) -> String {
    over.map_or_else(|| format!("{signal} (relief)"), |over| format!("{signal} over {over}"))
}
/// A texture was kept.
pub fn kept(name: &str) -> String {
    format!("\"{name}\" joined the textures of the workspace Author.")
}

/// Name of a tab.
pub fn view(view: View) -> &'static str {
    match view {
        View::Times => "Spectrogram",
        View::Places => "Places",
        View::Differences => "Differences",
    }
}
/// What a tab shows.
pub fn view_help(view: View) -> &'static str {
    match view {
        View::Times => "Frequencies over time, at the own speed of each signal",
        View::Places => {
            "Spatial spectrograms: frequencies over places, how much of the places they keep, and brushes to paint with"
        }
        View::Differences => "Features of both, what they predict, and what the codec would leave",
    }
}
/// The title of a map.
pub fn map_title(view: View, name: &str, window_mm: f64) -> String {
    match view {
        View::Places => format!("{name}, through {window_mm:.2} mm"),
        View::Times | View::Differences => name.to_owned(),
    }
}
/// The axes of a map.
pub fn map_axes(view: View) -> [&'static str; 2] {
    match view {
        View::Places => ["place in mm", "spatial frequency in 1/mm"],
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
/// First part of the name of a map's files.
pub fn stem(view: View, slot: Slot) -> &'static str {
    match (view, slot) {
        (View::Places, Slot::A) => "spatial-spectrogram-a",
        (View::Places, Slot::B) => "spatial-spectrogram-b",
        (_, Slot::A) => "spectrogram-a",
        (_, Slot::B) => "spectrogram-b",
    }
}
/// A place has nothing to show.
pub fn nothing_in(slot: Slot) -> String {
    match slot {
        Slot::A => "Nothing lies in A.".to_owned(),
        Slot::B => "Nothing lies in B. Make it of A, at the left.".to_owned(),
    }
}
/// The quantity of a map.
pub const AMPLITUDE: &str = "amplitude";
/// Its unit.
pub const DB_MPS2: &str = "dB re 1 m/s²";

/// The window of the spatial spectrogram.
pub const WINDOW: &str = "Window";
/// What it does.
pub const WINDOW_HELP: &str = "Wide windows tell frequencies apart, narrow ones places: what a spectrogram keeps of where things are depends on it";
/// Ends zooming.
pub const SHOW_ALL: &str = "Show all";
/// How to zoom.
pub const ZOOM_HELP: &str = "Scroll over a map to see a part of the line from nearer";

/// What the faint curves show.
pub const WAVE: &str = "wave";
/// The window that is looked through.
pub const THIS_WINDOW: &str = "this window";
/// Title of the curve.
pub const FIDELITY: &str = "Where texture is kept";
/// An axis.
pub const WINDOW_MM: &str = "window in mm";
/// An axis.
pub const CORRELATION: &str = "correlation of envelopes";
/// Where the figures come from.
pub const MEASURED: &str = "measured on signals";

/// Title of the curve.
pub const BY_RATE: &str = "What the codec takes away";
/// An axis.
pub const KBPS: &str = "rate in kbit/s";
/// An axis.
pub const D_PRIME: &str = "predicted d'";
/// A limit.
pub const TOLD_APART: &str = "two of three are right";
/// Where the figures come from.
pub const PREDICTED: &str = "predicted by a model, nobody was asked";

/// Columns of the features.
pub const FEATURE_COLUMNS: [&str; 4] = ["A", "B", "distance", "part of d'"];
/// What they hold.
pub const FEATURE_COLUMNS_HELP: [&str; 4] = [
    "Of A itself, where it is a number of one signal",
    "Of B itself, where it is a number of one signal",
    "From A to B, the mean over pieces of 0.8 s",
    "What the distance adds to the predicted d'; features without one are not in the model",
];
/// Title of the features.
pub fn features_title([first, second]: [&str; 2], d_prime: f64) -> String {
    format!("{first} and {second}: predicted d' {d_prime:.2}")
}
/// The prediction.
pub fn d_prime(d_prime: f64) -> String {
    format!("d' {d_prime:.2}")
}
/// What the prediction means.
pub const D_PRIME_HELP: &str = "How well people would tell the two apart, in standard deviations: at 1 about two of three answers are right. A model of published weights predicts it; nobody felt these signals. It is made for a signal and what became of it: two strokes on one texture are far apart by it.";
/// What was compared.
pub fn compared(snr_db: f64, seconds: f64) -> String {
    let noise = if snr_db.is_finite() {
        format!("signal to noise {snr_db:.1} dB")
    } else if snr_db > 0.0 {
        "the same samples".to_owned()
    } else {
        "A is silent".to_owned()
    };
    format!("predicted over {seconds:.1} s; {noise}")
}
/// A feature's name.
pub fn feature(feature: Feature) -> String {
    feature.id().replace('_', " ")
}
/// What a feature is.
pub fn feature_help(feature: Feature) -> &'static str {
    match feature {
        Feature::Roughness => "Logarithm of the mean power",
        Feature::Brightness => "The middle of the spectrum, in Hz",
        Feature::Regularity => "How well it repeats itself after 2 to 50 ms, up to 1",
        Feature::Asymmetry => "Skewness: whether its strong moments point one way",
        Feature::SpectralPower => "Activation of tuned channels by power, compared channel by channel",
        Feature::SpectralAmplitude => "Activation of tuned channels by amplitude",
        Feature::Envelope => "The outline over time up to 20 Hz, compared wherever it fits best",
    }
}
/// A pair is needed.
pub const NEEDS_PAIR: &str = "Two signals are compared; one is missing.";
/// Too little to compare.
pub const TOO_SHORT: &str =
    "0.8 s are compared at once, and it is shorter; take a longer signal, or stroke it slower";
/// Too little to draw.
pub const TOO_SHORT_TO_DRAW: &str = "it is too short for a spectrogram";
/// Work came to nothing.
pub const BROKE_OFF: &str = "working it out broke off; this is an error of the program, so please report it";
/// A signal would become too long.
pub fn too_long(factor: f64) -> String {
    format!("it can be drawn out {factor:.2} times at most: the bench has no room for more")
}
/// Nothing that is felt.
pub const BEYOND_TOUCH: &str = "the signals are too far from any touch to be compared; correct their units";

/// What the tools work on.
pub const PAINT_B: &str = "Paint B";
/// What that means.
pub const PAINT_B_HELP: &str =
    "Tools change the spatial spectrogram of B through this window, and B is made of that: felt at once";
/// The name of a tool.
pub fn tool(tool: Tool) -> &'static str {
    match tool {
        Tool::Louder => "Louder",
        Tool::Softer => "Softer",
        Tool::Erase => "Erase",
        Tool::Copy => "Copy part",
        Tool::Paste => "Paste",
    }
}
/// What a tool does.
pub fn tool_help(tool: Tool) -> &'static str {
    match tool {
        Tool::Louder => "Drag over the map of B: what is under the brush gets louder, touch by touch",
        Tool::Softer => "Drag over the map of B: what is under the brush gets softer, touch by touch",
        Tool::Erase => "Drag a rectangle on the map of B: what is in it is gone",
        Tool::Copy => "Drag a rectangle on the map of B: what is in it can be pasted",
        Tool::Paste => "Click on the map of B: what was copied begins there, at its own frequencies",
    }
}
/// Half the width of a brush.
pub const BRUSH_WIDTH: &str = "wide";
/// What it is.
pub const BRUSH_WIDTH_HELP: &str = "How far the brush reaches to either side";
/// Half the height of a brush.
pub const BRUSH_HEIGHT: &str = "high";
/// What it is.
pub const BRUSH_HEIGHT_HELP: &str = "How far the brush reaches up and down, in octaves";
/// What a touch does.
pub const BRUSH_GAIN: &str = "strong";
/// What it is.
pub const BRUSH_GAIN_HELP: &str = "What one touch does in the middle of the brush";
/// Draws out.
pub const STRETCH: &str = "Stretch";
/// What it does.
pub const STRETCH_HELP: &str =
    "Draws B out to so many times its length: what happens takes longer, frequencies stay";
/// Accessible name of the factor.
pub const STRETCH_FACTOR: &str = "Factor of the stretch";
/// Takes back.
pub const UNDO_PAINTING: &str = "Undo";
/// Makes again.
pub const REDO_PAINTING: &str = "Redo";
/// A step that can be taken back.
pub const BRUSH_STROKE: &str = "stroke of the brush";
/// A step that can be taken back.
pub const ERASING: &str = "erase";
/// A step that can be taken back.
pub const PASTING: &str = "paste";
/// A step that can be taken back.
pub const REPLACING: &str = "another B";
/// A step that can be taken back.
pub const STRETCHING: &str = "stretch";
/// Nothing to copy.
pub const NOTHING_COPIED: &str = "there is nothing in this rectangle; drag it over more of the map";
/// Nothing to paste.
pub const NOTHING_TO_PASTE: &str = "Nothing was copied yet";
/// Accessible name of the map that is painted.
pub const PAINTED_MAP: &str = "Spatial spectrogram of B, to be painted";

/// What stands there before there is a signal.
pub const EMPTY_TITLE: &str = "What may be thrown away before a hand notices?";
/// What to do.
pub const EMPTY_STEPS: [&str; 4] = [
    "Put a signal into A: what is authored, a recording, a profile, or a row of a photo or height map. Files can be dropped here.",
    "Make B of it through the codec, or from its spatial spectrogram alone; or put another signal there.",
    "Feel A and B in turn on the pad (1 and 2), look at both, and see how well people are predicted to tell them apart.",
    "Paint the spatial spectrogram of B: it is felt at once. Keep it as the relief of a texture.",
];
/// Where dropped files go.
pub const DROP_HERE: &str = "Drop signals here";
/// What can be dropped.
pub const DROP_KINDS: &str = "recordings (.wav), profiles (.csv), photos or height maps (.png, .jpg)";
