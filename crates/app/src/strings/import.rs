//! Every word of the import sheet and of saving a library.

use shagreen_core::fit::{FitReport, Segment, TapFit};
use shagreen_core::units::Contact;

/// Heading of the sheet.
pub const TITLE: &str = "Import";
/// Shown while files hover over the window.
pub const DROP_HERE: &str = "Drop recordings, photos, models or a library";
/// What can be dropped.
pub const DROP_KINDS: &str = "CSV, TXT, TSV or WAV recordings · JPEG or PNG photos · HaTT XML models · a Shagreen library (JSON) · a map.toml for columns · a folder of them";
/// Accessible name of the field for paths.
pub const PATHS: &str = "Paths of files or folders";
/// Hint in the field for paths.
pub const PATHS_HINT: &str = "Path of a file or folder…";
/// Reads the files of the paths.
pub const READ: &str = "Read";
/// Closes the sheet without adding anything.
pub const CANCEL: &str = "Cancel";
/// Choice: all recordings are of one texture.
pub const ARE_ONE: &str = "All are one texture";
/// What the choice does.
pub const ARE_ONE_HELP: &str = "Fits one texture to all recordings together, instead of one to each.";
/// A file that can join the library.
pub const READY: &str = "ready";
/// A file that waits for an answer.
pub const QUESTION: &str = "asks";
/// A file that is ready, with guesses for what it does not say.
pub const GUESSED: &str = "guessed";
/// A file that is read or fitted.
pub const WORKING: &str = "working…";
/// A file that cannot be used.
pub const FAILED: &str = "failed";
/// A file that serves others.
pub const HELPER: &str = "used";
/// A map.
pub const IS_MAP: &str = "A map: it says what the columns of the recordings that came with it are.";
/// Units beside a WAV file.
pub const IS_SIDECAR: &str = "Says what the WAV file beside it holds.";
/// The worker is gone.
pub const BROKEN: &str =
    "Reading broke off; close this sheet and import the files one by one to find the one that does it.";
/// Something is read or fitted.
pub const READING: &str = "Reading and fitting…";
/// Terms of a texture that nobody stated.
pub const TERMS_NOT_STATED: &str = "not stated";

/// Heading of the questions.
pub const ASKS: &str = "The file does not say";
/// A guess that was gone on with.
pub const GUESS: &str = "guess";
/// What a guess is.
pub const GUESS_HELP: &str =
    "Taken from the numbers of the file, not stated by it. Choose it to make it certain, or another.";
/// No answer yet.
pub const CHOOSE: &str = "choose…";
/// An answer is taken.
pub const ANSWERED: &str = "answered";
/// Hint in the field of a number.
pub const NUMBER_HINT: &str = "number";
/// Hint in the field of a constant speed.
pub const SPEED_HINT: &str = "or e.g. 100 mm/s";
/// Hint in the field of a constant force.
pub const FORCE_HINT: &str = "or e.g. 1 N";
/// Answers go to all files that ask the same.
pub const FOR_ALL: &str = "Same answer for all files that ask it";
/// Before a required answer is given.
pub const ANSWER_FIRST: &str =
    "Without the answers marked above, no number of this file has a meaning, so nothing is shown yet.";

/// Heading of the trace of acceleration.
pub const ACCELERATION: &str = "Acceleration";
/// Its unit.
pub const ACCELERATION_UNIT: &str = "m/s²";
/// Heading of the trace of speed.
pub const SPEED: &str = "Speed";
/// Its unit.
pub const SPEED_UNIT: &str = "mm/s";
/// Heading of the trace of force.
pub const FORCE: &str = "Force";
/// Its unit.
pub const FORCE_UNIT: &str = "N";
/// What shading is.
pub const EXCLUDED: &str = "shaded: not usable";
/// Heading of the plane.
pub const PLANE: &str = "Segments";
/// Axes of the plane.
pub const PLANE_UNIT: &str = "N over mm/s · click one";
/// Heading of the plane of a model.
pub const NODES: &str = "Measured speeds and forces";
/// Heading of the spectrum.
pub const SPECTRUM: &str = "Spectrum";
/// Its unit.
pub const SPECTRUM_UNIT: &str = "dB re 1 (m/s²)²/Hz";
/// The line of the data.
pub const MEASURED_LINE: &str = "measured";
/// The line of the model.
pub const MODEL_LINE: &str = "model";
/// The line of the model that a held-out segment is compared with.
pub const HELD_OUT_LINE: &str = "model without this segment";
/// A good fit in the legend of the plane.
pub const GOOD: &str = "GFC ≥ 0.95";
/// A fair fit.
pub const FAIR: &str = "0.8 to 0.95";
/// A bad fit.
pub const BAD: &str = "below 0.8";
/// The segment before.
pub const PREVIOUS_SEGMENT: &str = "Previous segment";
/// The segment after.
pub const NEXT_SEGMENT: &str = "Next segment";

/// Accessible name of the texture's name.
pub const NAME: &str = "Name of the imported texture";
/// Label of the name.
pub const NAME_LABEL: &str = "Name";
/// Accessible name of the tags.
pub const TAGS: &str = "Tags of the imported texture";
/// Label of the tags.
pub const TAGS_LABEL: &str = "Tags";
/// Hint in the field of tags.
pub const TAGS_HINT: &str = "wood, smooth";
/// Heading of what can be adjusted.
pub const FIT: &str = "Fit";
/// Accessible name and label of the choice of rates.
pub const RATE: &str = "Model rate";
/// What the rate is.
pub const RATE_HELP: &str =
    "Samples a second of the model. Automatic: the lowest that keeps the bandwidth of the recording.";
/// Accessible name and label of the choice of orders.
pub const ORDER: &str = "Order";
/// What the order is.
pub const ORDER_HELP: &str = "Order of the predictor, the same at every speed and force. Automatic: by the Bayesian information criterion.";
/// Accessible name and label of the choice of interpolations.
pub const INTERPOLATION: &str = "Interpolation";
/// What the interpolation is.
pub const INTERPOLATION_HELP: &str =
    "How the texture is found between the speeds and forces that were measured.";
/// Linear in triangles.
pub const BARYCENTRIC: &str = "barycentric";
/// Radial basis functions.
pub const RADIAL_BASIS: &str = "radial basis";
/// Left to the program.
pub const AUTOMATIC: &str = "automatic";
/// Heading of the figures.
pub const FIGURES: &str = "How well it fits";
/// Number of segments.
pub const N_SEGMENTS: &str = "segments";
/// Rate of the model.
pub const MODEL_RATE: &str = "model rate";
/// Order of the model.
pub const MODEL_ORDER: &str = "order";
/// Share of the plane.
pub const COVERAGE: &str = "coverage";
/// What coverage is.
pub const COVERAGE_HELP: &str = "Share of the plane of speed and force, from zero to the highest of each, that lies inside the hull of the segments.";
/// Median goodness of fit.
pub const GFC_MEDIAN: &str = "GFC, median";
/// What it is.
pub const GFC_HELP: &str = "Goodness of fit of the measured and the modeled spectrum, 0 to 1.";
/// Median level error.
pub const LEVEL_ERROR: &str = "level error, median";
/// What it is.
pub const LEVEL_ERROR_HELP: &str = "Absolute difference in level between the model and the segments.";
/// The landing.
pub const TAP: &str = "landing";
/// What it is.
pub const TAP_HELP: &str = "The transient when the tip lands: a decaying oscillation.";
/// No landing.
pub const NO_TAP: &str = "none found";
/// Comparisons with data that the model had not seen.
pub const HELD_OUT: &str = "held-out segments: the model compared had not seen them";
/// Comparisons with the model's own data.
pub const NOT_HELD_OUT: &str = "not held-out: too few segments, the model is compared with its own";
/// Heading of warnings.
pub const WARNINGS: &str = "Warnings";
/// Heading of notes of the fit.
pub const NOTES: &str = "Notes of the fit";
/// No segment was found.
pub const NO_FIT: &str = "There is no fit yet";
/// Restricted by the terms of HaTT.
pub const RESTRICTED: &str = "restricted: non-profit research, no redistribution";
/// The same in the list of textures.
pub const RESTRICTED_SHORT: &str = "restricted";
/// Accessible name of the choice of a texture of a file.
pub const TEXTURE_OF_FILE: &str = "Texture of the file";
/// Friction.
pub const FRICTION: &str = "friction coefficient";
/// Terms.
pub const TERMS: &str = "terms";
/// Origin.
pub const ORIGIN: &str = "origin";
/// Not known.
pub const UNKNOWN: &str = "not stated";
/// Where a texture will be.
pub const JOINS_UNPLACED: &str = "It joins the list without a place in the space: a click plays it alone.";
/// Where a texture will be.
pub const KEEPS_PLACE: &str =
    "It keeps its place in the space where that comes from the same source as the places of this library.";
/// Number of nodes.
pub const N_NODES: &str = "speeds and forces";
/// An answer without which the file cannot be read.
pub const NEEDED: &str = "needed";

/// Heading of saving.
pub const SAVE_TITLE: &str = "Save library";
/// Accessible name of the field of the path.
pub const SAVE_PATH: &str = "Path of the library file";
/// Hint in the field of the path.
pub const SAVE_HINT: &str = "/path/to/library.json";
/// Saves.
pub const SAVE: &str = "Save";
/// Replaces a file that is there.
pub const REPLACE: &str = "Replace the file";
/// A file is there.
pub const EXISTS: &str = "There is a library at this path already. Replace it, or choose another path.";
/// Why a folder or a device is no library.
pub const NO_FILE: &str = "it is a folder or a device";
/// It is being saved.
pub const SAVING: &str = "Saving…";
/// Closes the sheet.
pub const CLOSE: &str = "Close";
/// The writer is gone.
pub const SAVE_BROKEN: &str = "Saving broke off; what was there before is untouched. Try again.";

/// Accessible name of a file in the list.
pub fn file(name: &str, state: &str) -> String {
    format!("File {name}, {state}")
}

/// Accessible name of the button that leaves a file out.
pub fn leave_out(name: &str) -> String {
    format!("Leave {name} out")
}

/// Accepts.
pub fn add(n: usize) -> String {
    match n {
        0 | 1 => "Add to library".to_owned(),
        n => format!("Add {n} textures to library"),
    }
}

/// What is left out by accepting.
pub fn left_out(n: usize) -> String {
    match n {
        0 => String::new(),
        1 => "1 file is left out".to_owned(),
        n => format!("{n} files are left out"),
    }
}

/// Where a texture's recordings come from.
pub fn fitted_to(recordings: &[&str]) -> String {
    format!("Fitted to recordings: {}", recordings.join(", "))
}

/// A fit in a sentence.
pub fn fit_in_words(report: &FitReport) -> String {
    format!(
        "{} segments, {:.0} % of the plane; GFC {:.3} and level error {:.2} dB, medians, {}",
        report.segments.len(),
        100.0 * report.coverage,
        report.gfc_median(),
        report.level_error_db_median(),
        if report.held_out { "held-out" } else { "not held-out" }
    )
}

/// A segment and where it is.
pub fn segment(number: usize, of: usize) -> String {
    format!("segment {number} of {of}")
}

/// Accessible name of the control that answers a question.
pub fn answer_of(key: &str) -> String {
    format!("Answer: {}", key.replace('_', " "))
}

/// An answer as people read it.
pub fn answer(text: &str) -> String {
    text.replace("m/s^2", "m/s²")
}

/// A rate.
pub fn rate(rate_hz: f64) -> String {
    format!("{} Hz", rate_hz.round())
}

/// A texture at another rate than the space.
pub fn other_rate(rate_hz: f64, space_rate_hz: f64) -> String {
    format!(
        "At {} Hz it cannot be blended with the textures of this space, which are at {} Hz: it is heard alone.",
        rate_hz.round(),
        space_rate_hz.round()
    )
}

/// A library was saved.
pub fn saved(path: &str) -> String {
    format!("Saved to {path}")
}

/// Number of textures of a file.
pub fn n_textures(n: usize) -> String {
    format!("{n} textures")
}

/// Accessible name of a field beside a choice.
pub fn typed(name: &str) -> String {
    format!("{name}, typed")
}

/// The figures of a segment.
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

/// A landing.
pub fn tap(fit: &TapFit) -> String {
    format!(
        "{:.0} Hz, decay {:.0} 1/s ({} found, {:.0} % explained)",
        fit.tap.frequency.0,
        fit.tap.decay_per_sec,
        fit.n_landings,
        100.0 * fit.explained
    )
}

/// Orders of a predictor and a moving average.
pub fn orders(ar: usize, ma: usize) -> String {
    if ma == 0 { ar.to_string() } else { format!("{ar}, moving average {ma}") }
}

/// The plot of a spectrum, for those who cannot see which line of a model it shows.
pub fn spectrum_of(model_name: &str) -> String {
    format!("{SPECTRUM}: {model_name}")
}

/// Where a model's spectrum is shown.
pub fn spectrum_at(contact: Contact) -> String {
    format!("{SPECTRUM_UNIT}   at {:.0} mm/s, {:.2} N", contact.speed.mm_per_s(), contact.force.0)
}

/// How much is saved.
pub fn to_save(n_textures: usize) -> String {
    format!("All {n_textures} textures of the list go into one file.")
}

/// A file is there that is no library.
pub fn no_library(reason: &str) -> String {
    format!(
        "Choose another path: what is there is no Shagreen library that can be read, so it is not replaced ({reason})."
    )
}

/// Something is there that cannot be looked into.
pub fn cannot_be_checked(reason: &str) -> String {
    format!("What is at this path cannot be read ({reason}), so it is not replaced. Choose another path.")
}

/// Recordings get places.
pub const PLACE_THEM: &str = "Place recordings by an estimate";
/// What that does.
pub const PLACE_THEM_HELP: &str = "Each recording lands where a texture that vibrates as it does would lie, by those that have a place. Nobody rated it.";

/// Where a recording was placed, by the names of the axes with their estimates.
pub fn placed_by_estimate(axes: &[(&str, f64, f64); 2]) -> String {
    let axis = |(name, mean, deviation): &(&str, f64, f64)| format!("{name} {mean:.0} ± {deviation:.0}");
    format!("Placed by an estimate: {}, {}; nobody rated it.", axis(&axes[0]), axis(&axes[1]))
}
