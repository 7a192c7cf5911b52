//! Import sheet, and saving a library.

use shagreen_core::recording::fit::{FitReport, HeldOut, Segment, TapFit};
use shagreen_core::units::Contact;
use shagreen_formats::recording::Ask;

// Files.
pub const TITLE: &str = "Import";
/// Kind of file in the dialog of the system.
pub const KIND: &str = "Recordings, models, libraries and pictures";
pub const DROP_HERE: &str = "Drop recordings, photos, models or a library";
pub const DROP_KINDS: &str = "Recordings (CSV, TXT, TSV, WAV), haptic clips (.haptic, AHAP, Macaron), photos (JPEG, PNG, WebP, BMP, TIFF), HaTT models (XML), libraries (JSON), a column map (map.toml), folders";
/// Files that can be imported, below the reason why one cannot be.
pub const ACCEPTED: &str = "Files that can be imported: recordings (CSV, TXT, TSV, WAV), haptic clips (.haptic, AHAP, Macaron), photos (JPEG, PNG, WebP, BMP, TIFF), HaTT models (XML), Shagreen libraries (JSON), a column map (map.toml), and folders of these.";
pub const IS_PROJECT: &str = "this is a project of Shagreen. Open it with File, Open…; to bring one of its authored textures here, copy it there and paste it here";
pub const NOTHING_IN_FOLDER: &str = "this folder has no file that can be imported; folders inside it are not searched. Choose one of these, or another folder";
pub const PATHS: &str = "Paths of files or folders";
pub const PATHS_HINT: &str = "Path of a file or folder…";
pub const READ: &str = "Read";
pub const CANCEL: &str = "Cancel";
pub const ARE_ONE: &str = "Fit as one texture";
pub const ARE_ONE_HELP: &str = "Fits one texture to all recordings together instead of one texture to each.";
pub const READY: &str = "ready";
pub const QUESTION: &str = "incomplete";
pub const GUESSED: &str = "guessed";
pub const WORKING: &str = "working…";
pub const FAILED: &str = "failed";
pub const HELPER: &str = "metadata";
pub const IS_MAP: &str =
    "Column map: it names the columns and units of the recordings that are imported with it.";
pub const IS_SIDECAR: &str = "Sidecar file: it describes the samples of the WAV file of the same name.";
/// What to do about directions whose angle is unknown.
pub const STATE_DIRECTIONS: &str = "add the files of positions, or state the angles with \"shagreen import directional\" and import its library";
pub const BROKEN: &str =
    "Reading stopped unexpectedly; close this sheet and import the files one by one to find the cause.";
pub const READING: &str = "Reading and fitting…";
pub const TERMS_NOT_STATED: &str = "not stated";

// Questions about a file.
pub const ASKS: &str = "Missing from the file";
pub const GUESS: &str = "guess";
pub const GUESS_HELP: &str = "Guessed from the numbers in the file, which does not state it. Select this value to confirm it, or select another one.";
pub const CHOOSE: &str = "choose…";
pub const ANSWERED: &str = "answered";
pub const WRONG: &str = "not usable";
pub const NUMBER_HINT: &str = "number";
pub const SPEED_HINT: &str = "e.g. 100 mm/s";
pub const FORCE_HINT: &str = "e.g. 1 N";
/// Contents of two channels, as an example.
pub const CHANNELS_HINT: &str = "e.g. acceleration, unused";
pub const FOR_ALL: &str = "Apply to all files with the same question";
pub const ANSWER_FIRST: &str = "Answer the marked questions first. Without the answers, the units or the meaning of the numbers in this file are unknown.";

// Plots.
pub const ACCELERATION: &str = "Acceleration";
pub const ACCELERATION_UNIT: &str = "m/s²";
pub const SPEED: &str = "Speed";
pub const SPEED_UNIT: &str = "mm/s";
pub const FORCE: &str = "Force";
pub const FORCE_UNIT: &str = "N";
pub const EXCLUDED: &str = "shaded: excluded";
pub const PLANE: &str = "Segments";
pub const PLANE_UNIT: &str = "N over mm/s · click to select";
pub const NODES: &str = "Measured speeds and forces";
pub const SPECTRUM: &str = "Spectrum";
pub const SPECTRUM_UNIT: &str = "dB re 1 (m/s²)²/Hz";
pub const MEASURED_LINE: &str = "measured";
pub const MODEL_LINE: &str = "model";
pub const HELD_OUT_LINE: &str = "model without this segment";
pub const GOOD: &str = "GFC ≥ 0.95";
pub const FAIR: &str = "0.8 to 0.95";
pub const BAD: &str = "below 0.8";
pub const PREVIOUS_SEGMENT: &str = "Previous segment";
pub const NEXT_SEGMENT: &str = "Next segment";

// Texture and fit.
pub const NAME: &str = "Name of the imported texture";
pub const NAME_LABEL: &str = "Name";
pub const TAGS: &str = "Tags of the imported texture";
pub const TAGS_LABEL: &str = "Tags";
pub const TAGS_HINT: &str = "e.g. wood, smooth";
pub const FIT: &str = "Fit";
pub const RATE: &str = "Sample rate";
pub const RATE_HELP: &str =
    "Sample rate of the model, in Hz. Automatic: the lowest rate that keeps the bandwidth of the recording.";
pub const ORDER: &str = "Order";
pub const ORDER_HELP: &str = "Order of the autoregressive model, the same at every speed and force. Automatic: the lowest order that predicts held-out segments about as well as the best one.";
pub const INTERPOLATION: &str = "Interpolation";
pub const INTERPOLATION_HELP: &str =
    "Interpolation of the model between the measured pairs of speed and force.";
pub const BARYCENTRIC: &str = "barycentric";
pub const RADIAL_BASIS: &str = "radial basis";
pub const AUTOMATIC: &str = "automatic";
pub const FIGURES: &str = "Quality of the fit";
pub const N_SEGMENTS: &str = "segments";
pub const MODEL_RATE: &str = "sample rate";
pub const MODEL_ORDER: &str = "order";
pub const COVERAGE: &str = "coverage";
pub const COVERAGE_HELP: &str = "Share of the speed-force plane, from zero to the highest speed and force, that lies inside the convex hull of the segments, in percent.";
pub const GFC_MEDIAN: &str = "GFC, median";
pub const GFC_HELP: &str = "Goodness-of-fit criterion (GFC) of the measured and the modeled power spectral density, 0 to 1. It is 1 if both have the same shape, whatever their levels.";
pub const LEVEL_ERROR: &str = "level error, median";
pub const LEVEL_ERROR_HELP: &str = "Absolute difference in level between the model and the segments, in dB.";
pub const TAP: &str = "tap transient";
pub const TAP_HELP: &str = "Transient when the tip hits the surface: a decaying oscillation, stated for a landing at 100 mm/s. Recordings do not state how fast the tip landed, so this speed is assumed for them.";
pub const NO_TAP: &str = "none found";
pub const HELD_OUT: &str = "held-out segments: the compared model was fitted without them";
pub const HELD_OUT_BLOCKS: &str =
    "few segments: held out in blocks of a quarter of a second, while the rest of each stroke was fitted";
pub const NOT_HELD_OUT: &str =
    "not held-out: too few segments, so the model is compared with the data that it was fitted to";
pub const WARNINGS: &str = "Warnings";
pub const NOTES: &str = "Notes on the fit";
pub const NO_FIT: &str = "There is no fit yet";
pub const RESTRICTED: &str = "restricted: non-profit research only, no redistribution";
pub const RESTRICTED_SHORT: &str = "restricted";
pub const TEXTURE_OF_FILE: &str = "Texture of the file";
pub const FRICTION: &str = "friction coefficient";
pub const TERMS: &str = "license";
pub const ORIGIN: &str = "origin";
pub const UNKNOWN: &str = "not stated";
pub const JOINS_UNPLACED: &str =
    "It is added to the list without a position in the space. Click it in the list to play it alone.";
pub const JOINS_PLACED: &str = "It is added to the list with an estimated position in the space.";
pub const KEEPS_PLACE: &str =
    "It keeps its position if the position has the same source as those of the open library.";
pub const N_NODES: &str = "speed-force points";
pub const NEEDED: &str = "required";

// Saving.
pub const SAVE_TITLE: &str = "Save library";
pub const SAVE_PATH: &str = "Path of the library file";
pub const SAVE_HINT: &str = "e.g. /path/to/library.json";
pub const SAVE: &str = "Save";
pub const REPLACE: &str = "Replace the file";
pub const EXISTS: &str = "A library file exists at this path. Replace it, or choose another path.";
pub const NO_FILE: &str = "this is a folder or a device";
pub const SAVING: &str = "Saving…";
pub const CLOSE: &str = "Close";
pub const SAVE_BROKEN: &str = "Saving stopped unexpectedly; the previous file is unchanged. Try again.";

/// Accessible name of a file in the list.
pub fn file(name: &str, state: &str) -> String {
    format!("File {name}, {state}")
}

/// Accessible name of the button that excludes a file.
pub fn leave_out(name: &str) -> String {
    format!("Exclude {name}")
}

/// Label of the button that adds the textures.
pub fn add(n: usize) -> String {
    match n {
        0 | 1 => "Add to library".to_owned(),
        n => format!("Add {n} textures to library"),
    }
}

/// Number of files that are not imported.
pub fn left_out(n: usize) -> String {
    match n {
        0 => String::new(),
        1 => "1 file is not imported".to_owned(),
        n => format!("{n} files are not imported"),
    }
}

/// Description of a texture: the recordings it is fitted to.
pub fn fitted_to(recordings: &[&str]) -> String {
    format!("Fitted to recordings: {}", recordings.join(", "))
}

/// Description of a texture: the quality of its fit.
pub fn fit_in_words(report: &FitReport) -> String {
    format!(
        "{} segments, coverage {:.0} %; GFC {:.3} and level error {:.2} dB (medians, {})",
        report.segments.len(),
        100.0 * report.coverage,
        report.gfc_median(),
        report.level_error_db_median(),
        match report.held_out {
            HeldOut::Segments => "held-out",
            HeldOut::Blocks => "held-out in blocks of the same strokes",
            HeldOut::Nothing => "not held-out",
        }
    )
}

pub fn segment(number: usize, of: usize) -> String {
    format!("segment {number} of {of}")
}

/// Accessible name of the control that answers a question.
pub fn answer_of(key: &str) -> String {
    format!("Answer: {}", key.replace('_', " "))
}

/// Answer with units as they are printed.
pub fn answer(text: &str) -> String {
    text.replace("m/s^2", "m/s²")
}

/// Message about an unusable answer: what the question needs, with an example.
pub fn not_understood(what: Ask, answer: &str, needs: &str) -> String {
    let example = match what {
        Ask::PerCount | Ask::FullScale | Ask::SpeedFullScale | Ask::ForceFullScale => ", such as 20",
        Ask::RateHz => ", such as 10000",
        Ask::Channels => ", separated by commas, such as \"acceleration, unused\"",
        _ => "",
    };
    format!("\"{answer}\" cannot be used: give {needs}{example}")
}

/// Message about an answer that is not a speed or force.
pub fn no_quantity(what: Ask, answer: &str) -> String {
    let (quantity, example) = if what == Ask::Speed { ("speed", "100 mm/s") } else { ("force", "1 N") };
    format!("\"{answer}\" is not a {quantity}: give a number with its unit, such as {example}")
}

/// Message about an answer that does not fit the file.
pub fn misfit(what: Ask, problem: &str) -> String {
    let instead = match what {
        Ask::Speed => "; or give a constant speed, such as 100 mm/s",
        Ask::Force => "; or give a constant force, such as 1 N",
        _ => "; give another answer",
    };
    format!("{problem}{instead}")
}

/// Why a file of an unknown kind cannot be imported. It was read as a table of a recording; `reason` says why it is none. What
/// the reason advises is left out: a file of another kind is not to be corrected.
pub fn no_kind(reason: &str) -> String {
    let what = reason.rsplit_once("; ").map_or(reason, |(what, _)| what);
    format!("files of this kind cannot be imported, and this one is not the table of a recording ({what})")
}

/// Note on a texture that was fitted at the rate of the space in Hz.
pub fn placed_at(rate_hz: f64) -> String {
    let rate_hz = rate_hz.round();
    format!(
        "It is added with an estimated position, and therefore fitted at {rate_hz} Hz, the sample rate of this space."
    )
}

/// Why a texture gets no estimated position, and what to do.
pub fn no_place_at(space_rate_hz: f64) -> String {
    let rate_hz = space_rate_hz.round();
    format!(
        "It gets no estimated position. To get one, select the sample rate \"{AUTOMATIC}\" or {rate_hz} Hz."
    )
}

pub fn rate(rate_hz: f64) -> String {
    format!("{} Hz", rate_hz.round())
}

/// Warning about a texture whose sample rate is above that of the space.
pub fn other_rate(rate_hz: f64, space_rate_hz: f64) -> String {
    format!(
        "Its sample rate of {} Hz is above the {} Hz of this space: it cannot be interpolated and plays alone.",
        rate_hz.round(),
        space_rate_hz.round()
    )
}

pub fn saved(path: &str) -> String {
    format!("Saved to {path}")
}

pub fn n_textures(n: usize) -> String {
    format!("{n} textures")
}

/// Accessible name of a text field beside a choice.
pub fn typed(name: &str) -> String {
    format!("{name}, custom value")
}

pub fn of_segment(segment: &Segment) -> String {
    format!(
        "{:.0} mm/s, {:.2} N, {:.2} s at {:.2} s · GFC {:.3} · level error {:+.2} dB",
        segment.speed.mm_per_s(),
        segment.force.0,
        segment.seconds,
        segment.start_secs,
        segment.comparison.gfc,
        segment.comparison.level_error_db
    )
}

pub fn tap(fit: &TapFit) -> String {
    format!(
        "{:.0} Hz, decay {:.0} 1/s (taps found: {}; {:.0} % of their energy explained)",
        fit.tap.frequency.0,
        fit.tap.decay_per_sec,
        fit.n_landings,
        100.0 * fit.explained
    )
}

/// Orders of the autoregressive and the moving-average part.
pub fn orders(ar: usize, ma: usize) -> String {
    if ma == 0 { ar.to_string() } else { format!("{ar}, moving average {ma}") }
}

/// Accessible name of the plot of a spectrum.
pub fn spectrum_of(model_name: &str) -> String {
    format!("{SPECTRUM}: {model_name}")
}

pub fn spectrum_at(contact: Contact) -> String {
    format!("{SPECTRUM_UNIT}   at {:.0} mm/s, {:.2} N", contact.speed.mm_per_s(), contact.force.0)
}

pub fn to_save(n_textures: usize) -> String {
    format!("Saves all {n_textures} textures of the list in one library file.")
}

/// Why an existing file is not replaced.
pub fn no_library(reason: &str) -> String {
    format!(
        "The file at this path is not a readable Shagreen library and is not replaced ({reason}). Choose another path."
    )
}

/// Why a file that cannot be read is not replaced.
pub fn cannot_be_checked(reason: &str) -> String {
    format!("The file at this path cannot be read ({reason}) and is not replaced. Choose another path.")
}

pub const CANNOT_PLACE: &str =
    "Positions are estimated from five or more textures with positions; this library has fewer.";
pub const PLACE_THEM: &str = "Estimate positions";
pub const PLACE_THEM_HELP: &str = "Estimates the position of each recording from textures that have similar vibration and a known position. The estimate is not a human rating.";
