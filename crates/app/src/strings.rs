//! All user-visible text of the window.

#![allow(missing_docs, reason = "the text of a constant says what it is for")]

use shagreen_core::space::SpacePoint;
use shagreen_core::space::signal_axes::SignalAxis;

pub mod about;
pub mod authored;
pub mod axes;
pub mod browse;
pub mod build;
pub mod clipboard;
pub mod compare;
pub mod conflict;
pub mod devices;
pub mod differences;
pub mod digits;
pub mod document;
pub mod edits;
pub mod export;
pub mod gallery;
pub mod help;
pub mod import;
pub mod map;
pub mod motion;
pub mod networks;
pub mod papers;
pub mod path;
pub mod prompt;
pub mod relief;
pub mod rig;
pub mod scope;
pub mod shape;
pub mod signal;
pub mod signals;
pub mod stroke;
pub mod studies;
pub mod textures;
pub mod view;

pub const OUTPUT_BUSY: &str = "The output is busy; try again";
pub const APP: &str = "Shagreen";

// Axes of the space.
pub const ROUGH: &str = "rough";
pub const SMOOTH: &str = "smooth";
pub const HARD: &str = "hard";
pub const SOFT: &str = "soft";
pub const ROUGH_SMOOTH: &str = "Rough to smooth";
pub const ROUGH_SMOOTH_HELP: &str = "0 is the roughest texture of the space, 100 the smoothest.";
pub const HARD_SOFT: &str = "Hard to soft";
pub const HARD_SOFT_HELP: &str = "0 is the hardest texture of the space, 100 the softest.";

// Workspaces.

// Libraries.
pub const LIBRARIES: &str = "Libraries";
pub const LIBRARIES_HELP: &str = "Opens another library. The authored point and the textures added to the project are kept. Undo restores the previous library.";
pub const NEW_TEXTURE: &str = "New texture";
pub const DAMAGED_LIBRARY: &str = "A built-in library is damaged; reinstall Shagreen";
pub const SEARCH: &str = "Search textures";
pub const SEARCH_HINT: &str = "Search…";
pub const NO_MATCH: &str = "No texture of this list contains these words in its name or tags. Authored textures, above, are not searched.";
pub const PARENTS: &str = "Contributions";
pub const PARENTS_HELP: &str = "Textures that contribute at this point, with their weights in percent. In the mode Field every texture contributes; distant ones slightly negatively. At the position of a pinned texture, only that texture plays.";

// Canvas.
pub const CANVAS: &str = "Space of textures";
pub const POINT: &str = "Authored point";
pub const POINT_HELP: &str = "Drag it, or move it with the arrow keys (Shift for larger steps).";
pub const CLAMPED: &str =
    "Outside the convex hull of the textures: the texture at the nearest point of the hull plays.";
pub const NAME: &str = "Name of the texture";
pub const BLEND: &str = "Mode";

// Pad and automatic stroke.
pub const PAD: &str = "Stroke pad";
pub const PAD_HELP: &str =
    "Stroke here with the mouse or a pen to feel the texture. The mouse wheel sets the normal force, in N.";
pub const LAY: &str = "Direction of the lay";
pub const LAY_HELP: &str = "The texture feels different along these lines and across them. The control \"Direction\" of the shape rotates them.";
pub const HAND_START: &str = "Stroke";
pub const HAND_STOP: &str = "Stop";
pub const HAND_HELP: &str = "Starts or stops the automatic stroke: it moves along the selected path at the set speed and normal force (Space).";
pub const HAND_SPEED: &str = "Speed of the automatic stroke";
pub const HAND_FORCE: &str = "Normal force of the automatic stroke";
pub const HAND_PATH: &str = "Path of the automatic stroke";
pub const DISMISS: &str = "Click to dismiss this message.";

// Output.
pub const MUTE_HELP: &str = "Silences the output; everything else keeps running (M).";
pub const LIMITING_HELP: &str = "The signal exceeds a limit of the output or the actuator and is attenuated. Reduce the normal force or the speed, or choose a weaker texture.";
pub const SOLO: &str = "S";
pub const SOLO_HELP: &str = "Plays this texture alone, as stored in the library. Press again to return to the interpolated texture. The authored point does not move.";
pub const OUTPUT: &str = "Output";
pub const OUTPUT_HELP: &str = "Output that drives the actuator. Shagreen never selects another output by itself: if this one disappears, nothing plays.";
pub const OPENING: &str = "Opening the output…";
pub const RESET_LIMITER: &str = "Reset limiter";
pub const TRIPPED: &str = "Silenced: invalid sample (infinite or NaN)";
pub const TO_LIGHT: &str = "Light theme";
pub const TO_DARK: &str = "Dark theme";
pub const UNDO: &str = "Undo";
pub const REDO: &str = "Redo";
pub const MUTE: &str = "Mute";
pub const UNMUTE: &str = "Unmute";
pub const NO_SOUND: &str = "The silent output is used, because no audio output could be opened";
pub const TAKE_OVER: &str = "Take over";
pub const TAKE_OVER_HELP: &str = "Plays on this output instead of the other Shagreen, which then goes silent";
pub const OPENING_FAILED: &str = "Opening the output failed; choose it again or choose another";
pub const NO_TEXTURES: &str = "This library has no textures.";
pub const NO_PLACES: &str =
    "No texture of this library has a position. Build a space, or open another library.";
pub const NO_OUTPUT: &str = "Choose an output";

// Interpolation modes.
pub const FIELD: &str = "Field";
pub const PARAMETRIC: &str = "Parametric";
pub const SHARED: &str = "Shared excitation";
pub const POWER: &str = "Power";
pub const PAPER: &str = "Paper";
pub const FIELD_SHORT: &str = "smooth, all textures";
pub const PARAMETRIC_SHORT: &str = "mean of neighbors";
pub const SHARED_SHORT: &str = "3 signals";
pub const POWER_SHORT: &str = "3 signals, level kept";
pub const PAPER_SHORT: &str = "as published";
pub const FIELD_HELP: &str = "Computes one texture from a smooth field over all textures, without jumps or kinks. At the position of a texture, its neighbors smooth the field, unless the texture is pinned.";
pub const PARAMETRIC_HELP: &str = "Computes one texture with the weighted mean of the spectral envelopes and levels of the textures around the point. Exact at each texture; its slope changes abruptly at triangle edges.";
pub const SHARED_HELP: &str = "Mixes the signals of the three textures around the point, all with the same noise excitation. The spectra are interpolated without a loss of level.";
pub const POWER_HELP: &str = "Mixes the signals of the three textures around the point, each with its own noise excitation. The level is corrected to the weighted mean of their levels.";
pub const PAPER_HELP: &str = "As published: mixes the signals of three textures with inverse-distance weights, each with its own noise excitation. The level drops between textures and jumps at triangle edges.";
pub const BLEND_MODE: &str = "Interpolation mode";
pub const BEYOND: &str = "Extrapolate outside hull";
pub const BEYOND_HELP: &str = "Extrapolates the field outside the convex hull of the textures, up to where the estimate becomes too uncertain. When off, the texture at the nearest point of the hull plays.";
pub const NATURAL: &str = "Natural neighbors";
pub const NATURAL_HELP: &str = "Weights all textures around the point by the Voronoi area that the point takes from each (Sibson weights). The texture then has no kink at triangle edges.";
pub const THREE_SIGNALS: &str = "mixes the signals at the triangle corners";
pub const PREPARING: &str = "computing the field…";
pub const PREPARING_HELP: &str =
    "The field over all textures is being computed. Until then, the previous texture keeps playing.";
pub const SMOOTHED: &str = "In the mode Field, neighbors smooth this texture at its own position. Pin it (right-click) to reproduce it exactly.";
pub const LOCKED: &str = "Pinned: the field passes through this texture exactly at its position.";
pub const LOCK_HELP: &str = "At the position of a pinned texture, you get exactly this texture; the interpolation around it (the field) is adjusted. An unpinned texture is smoothed by its neighbors.";
pub const EXTRAPOLATED: &str = "extrapolated";
pub const EXTRAPOLATED_HERE: &str =
    "Extrapolated: the point is outside the convex hull of the textures, so its texture is uncertain.";
pub const JUMPS_HERE: &str =
    "Mode Paper: the texture changes abruptly where the point crosses this triangle edge.";
pub const JUMPS: &str = "Mode Paper: the texture changes abruptly where the point crosses a triangle edge.";
pub const NO_TEXTURE_HERE: &str =
    "No texture can be computed at this point; move the point closer to the textures";
pub const FIELD_FAILED: &str = "Computing the field failed; open the library again";

// Status bar.
pub const LATENCY_HELP: &str = "Estimated latency from a pen report to the output, in ms: control tick, filters and output buffer (two blocks unless the device reports its delay). The mouse adds one frame of the window; a sound server adds its own buffer.";
pub const LOAD_HELP: &str =
    "Share of the available processing time that audio rendering uses, in percent. At 100 %, dropouts begin.";
pub const DROPOUTS_HELP: &str = "Number of times the output ran out of samples (underruns).";
pub const LEVEL_HELP: &str = "Level of the texture before mute and limiter: root mean square acceleration over about 50 ms, in dB re 1 m/s².";
pub const OUTPUT_LOST: &str = "Output lost";
pub const OPEN_AGAIN: &str = "Open again";
pub const OPEN_AGAIN_HELP: &str = "The output is gone. Connect it again, then open it";
pub const STALLED: &str = "The output has stopped requesting samples; choose it again";
pub const LIMITING: &str = "limiting";
pub const SOURCE_HELP: &str = "Source of the texture positions. Positions from physical labels or simulated raters are not human ratings. Estimates are predicted from words, pictures or vibration. Distances between positions of different sources mean little.";
pub const PREDICTED_FROM_RATINGS: &str = "estimates from human ratings";
pub const MIXED_SOURCES: &str = "mixed, not comparable";
pub const NOBODY_FELT: &str = ", no human data";
pub const SOME_SIMULATED: &str = "; some are simulated";
pub const NO_SOURCE: &str = "not stated";
pub const TEN_MM: &str = "10 mm";

// List of textures.
pub const NOT_PLACED_YET: &str = "no position yet";
pub const NOT_PLACED_HELP: &str = "No position in the space yet. Click to play this texture alone.";
pub const HEARD_ALONE: &str = "solo";
pub const IMPORT: &str = "Import…";
pub const IMPORT_HELP: &str = "Imports recordings, HaTT models, or the textures of another library. Files can also be dropped on the window.";
pub const SAVE_LIBRARY: &str = "Save as…";
pub const SAVE_LIBRARY_HELP: &str = "Saves all textures of the list in one library file, including those that the filter or the search hides.";
pub const DAMAGED_PICTURE: &str = "The picture cannot be read";

// Paths of the automatic stroke.
pub const LINE: &str = "line";
pub const CIRCLE: &str = "circle";
pub const SCRIBBLE: &str = "scribble";

/// Number of underruns, as the status bar shows it.
pub fn dropouts(n: u64) -> String {
    if n == 1 { "1 dropout".to_owned() } else { format!("{n} dropouts") }
}

/// Text with a capital first letter.
pub fn sentence(text: &str) -> String {
    let mut letters = text.chars();
    letters.next().map_or(String::new(), |first| first.to_uppercase().chain(letters).collect())
}

/// Accessible name of an axis from the words at its ends, for example [`ROUGH_SMOOTH`] and [`HARD_SOFT`].
pub fn axis([low, high]: &[String; 2]) -> String {
    if high.is_empty() { sentence(low) } else { sentence(&format!("{low} to {high}")) }
}

pub fn axis_help(ends: &[String; 2]) -> String {
    match ends.each_ref().map(String::as_str) {
        [ROUGH, SMOOTH] => ROUGH_SMOOTH_HELP.to_owned(),
        [HARD, SOFT] => HARD_SOFT_HELP.to_owned(),
        poles => match SignalAxis::ALL.into_iter().find(|axis| axis.poles() == poles) {
            Some(axis) => axes::signal_help(axis),
            None => format!("0 is the most {} texture of the space, 100 the most {}.", poles[0], poles[1]),
        },
    }
}

/// Position of a point for a screen reader; all coordinates run from 0 to 100.
pub fn place_in_words(point: SpacePoint, poles: &[[String; 2]]) -> String {
    let along = |(ends, value): (&[String; 2], &f64)| format!("{} {value:.0}", axis(ends));
    let along: Vec<String> = poles.iter().zip(point.coordinates()).map(along).collect();
    along.join(", ")
}

/// Source of the positions of all textures.
pub fn places_from(source: &str) -> String {
    format!("Positions: {source}")
}

/// Position of one texture, its standard deviation on both axes of the canvas if that is known, and the source of the position.
/// With more axes, each coordinate is named.
pub fn lies_at(
    point: SpacePoint,
    poles: &[[String; 2]],
    deviation: Option<[f64; 2]>,
    source: &str,
) -> String {
    let uncertain = deviation.map_or_else(String::new, |[across, up]| format!(" ± {across:.0}, {up:.0}"));
    if point.n_axes() <= 2 {
        return format!("{point}{uncertain} ({source})");
    }
    format!("{}{uncertain} ({source})", place_in_words(point, poles))
}

/// Accessible name of a texture on the canvas; a click plays it alone.
pub fn play_texture(texture: &str) -> String {
    format!("Play {texture}")
}

/// Accessible name of a texture in the list.
pub fn texture(name: &str) -> String {
    format!("Texture {name}")
}

/// Accessible name of a contributing texture and its weight, in percent.
pub fn parent(name: &str, percent: f64) -> String {
    format!("{name}, {percent:.1} percent")
}

/// Weight of a texture in the list, in percent.
pub fn of_the_blend(percent: f64) -> String {
    format!("weight {percent:.0} %")
}

/// Notice that a click has moved an authored texture; `keys` are those of undo.
pub fn moved_by_click(name: &str, keys: &str) -> String {
    format!("{name} moved. Undo: {keys}")
}

pub fn plays_alone(texture: &str) -> String {
    format!("Only {texture} plays")
}

/// Label of the control that pins or unpins a texture, and the name of that edit.
pub fn lock(texture: &str, is_to_be_locked: bool) -> String {
    format!("{} {texture}", if is_to_be_locked { "Pin" } else { "Unpin" })
}

/// Undo or redo, followed by the edit. Only the first letter of the label changes, so names keep their capitals.
pub fn verb(verb: &str, label: &str) -> String {
    let mut letters = label.chars();
    let first = letters.next().into_iter().flat_map(char::to_lowercase);
    format!("{verb} {}{}", first.collect::<String>(), letters.as_str())
}

/// Number of contributing textures without a card.
pub fn more_parents(n_more: usize) -> String {
    format!("and {n_more} more")
}

/// Weight of the pinned texture near the point, in percent.
pub fn locked_share(texture: &str, percent: f64) -> String {
    format!("{texture} (pinned): {percent:.0} %")
}

pub fn extrapolated_to(at: SpacePoint) -> String {
    format!("The point is beyond the limit of extrapolation: the texture at {at} plays.")
}

/// Accessible name of the solo button of a texture.
pub fn solo(name: &str) -> String {
    format!("Solo {name}")
}

#[cfg(test)]
mod tests {
    use super::{build, devices, document, export, import, lies_at, networks, papers, stroke};
    use shagreen_core::space::SpacePoint;

    #[test]
    fn an_estimated_position_has_its_standard_deviation() {
        let at = SpacePoint::plane(65.7, 58.8);
        let poles =
            [["rough", "smooth"], ["hard", "soft"], ["dull", "bright"]].map(|ends| ends.map(str::to_owned));
        assert_eq!(lies_at(at, &poles, Some([9.6, 51.6]), "estimates"), "65.7, 58.8 ± 10, 52 (estimates)");
        assert_eq!(lies_at(at, &poles, None, "human ratings"), "65.7, 58.8 (human ratings)");
        let further = lies_at(at.on(3).with(2, 43.2), &poles, None, "human ratings");
        assert_eq!(further, "Rough to smooth 66, Hard to soft 59, Dull to bright 43 (human ratings)");
    }

    /// A file name in an empty field would be taken for its value.
    #[test]
    fn example_file_names_say_that_they_are_examples() {
        for hint in [
            build::SAVE_HINT,
            build::BLANK_HINT,
            devices::PROFILE_HINT,
            document::OPEN_HINT,
            document::SAVE_HINT,
            document::OTHER_LIBRARY_HINT,
            export::HINT,
            export::FOLDER_HINT,
            import::SAVE_HINT,
            networks::FILE_HINT,
            papers::FOLDER_HINT,
            stroke::SAVE_HINT,
            stroke::OPEN_HINT,
        ] {
            assert!(hint.starts_with("e.g. "), "{hint}");
        }
    }
}
