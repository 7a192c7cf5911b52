//! Every word of the window, in one place.

use shagreen_core::space::SpacePoint;

pub mod authored;
pub mod build;
pub mod commands;
pub mod compare;
pub mod devices;
pub mod document;
pub mod edits;
pub mod gallery;
pub mod help;
pub mod import;
pub mod map;
pub mod path;
pub mod prompt;
pub mod rig;
pub mod scope;
pub mod signal;
pub mod signals;
pub mod stroke;
pub mod textures;
pub mod view;

/// The output takes no more at the moment.
pub const OUTPUT_BUSY: &str = "The output is busy; try again";
/// Name of the program.
pub const APP: &str = "Shagreen";
/// Left end of the first axis.
pub const ROUGH: &str = "rough";
/// Right end of the first axis.
pub const SMOOTH: &str = "smooth";
/// Lower end of the second axis.
pub const HARD: &str = "hard";
/// Upper end of the second axis.
pub const SOFT: &str = "soft";
/// Accessible name of the first slider.
pub const ROUGH_SMOOTH: &str = "Rough to smooth";
/// What the first slider does.
pub const ROUGH_SMOOTH_HELP: &str = "0 is the roughest texture of the space, 100 the smoothest.";
/// Accessible name of the second slider.
pub const HARD_SOFT: &str = "Hard to soft";
/// What the second slider does.
pub const HARD_SOFT_HELP: &str = "0 is the hardest texture of the space, 100 the softest.";
/// Accessible name of the choice of the axis across.
pub const AXIS_ACROSS: &str = "Axis across";
/// Accessible name of the choice of the axis up.
pub const AXIS_UP: &str = "Axis up";
/// What the choice of axes does.
pub const AXES_HELP: &str = "Any two attributes that the textures were rated on can be the axes. Textures that lack one of them have no place then.";
/// The axes are those of the places.
pub const AXES_AS_PLACED: &str = "as placed";
/// Name of the first workspace.
pub const AUTHOR: &str = "Author";
/// What the first workspace is for.
pub const AUTHOR_HELP: &str = "Find a texture in the space and feel it";
/// Name of the second workspace.
pub const BUILD: &str = "Build";
/// What the second workspace is for.
pub const BUILD_HELP: &str = "Make a space of what people sorted and rated";
/// Opens the menu of libraries.
pub const LIBRARIES: &str = "Libraries";
/// What the menu of libraries does.
pub const LIBRARIES_HELP: &str = "Opens another library. The point stays where it is, textures that joined stay too; undo brings the old library back.";
/// The first library of the program.
pub const STARTER: &str = "Starter library";
/// What the first library is.
pub const STARTER_HELP: &str =
    "25 everyday materials. Their places are physical labels, worked out from the model of each material.";
/// The second library of the program.
pub const SIMULATED: &str = "Starter library, simulated panel";
/// What the second library is.
pub const SIMULATED_HELP: &str =
    "The same materials, placed by what SIMULATED raters sorted and rated. Nobody felt anything.";
/// The name of a texture that is authored anew.
pub const NEW_TEXTURE: &str = "New texture";
/// A library without a name.
pub const UNNAMED_LIBRARY: &str = "Library without a name";
/// A library that is a part of the project.
pub const INSIDE_HELP: &str = "It is a part of this project.";
/// A library of the program cannot be read.
pub const DAMAGED_LIBRARY: &str = "This library of the program is damaged; install Shagreen again";
/// Accessible name of the search field.
pub const SEARCH: &str = "Search textures";
/// Hint in the search field.
pub const SEARCH_HINT: &str = "Search…";
/// Nothing matches the search.
pub const NO_MATCH: &str = "No texture has this in its name or tags.";
/// Heading of the parents.
pub const PARENTS: &str = "Blended from";
/// What the parents are.
pub const PARENTS_HELP: &str = "What is heard, and how much of it comes from each texture. In the field all textures have a say, far ones a little against it; near its place a locked one sounds by itself.";
/// Accessible name of the canvas.
pub const CANVAS: &str = "Space of textures";
/// Accessible name of the draggable point.
pub const POINT: &str = "Authored point";
/// What the point does.
pub const POINT_HELP: &str = "Drag it, or move it with the arrow keys (Shift for bigger steps).";
/// The point lies outside the hull.
pub const CLAMPED: &str = "Outside the textures of this space: the nearest point of their outline plays.";
/// Accessible name of the texture's name.
pub const NAME: &str = "Name of the texture";
/// Label of the blend modes.
pub const BLEND: &str = "Blend";
/// Accessible name of the pad.
pub const PAD: &str = "Stroke pad";
/// What the pad does.
pub const PAD_HELP: &str = "Stroke here with the mouse to feel the texture. The wheel sets the force.";
/// Start the automatic hand.
pub const HAND_START: &str = "Stroke";
/// Stop the automatic hand.
pub const HAND_STOP: &str = "Stop";
/// What the automatic hand does.
pub const HAND_HELP: &str = "Strokes the pad by itself, at a set speed and force (Space).";
/// Accessible name of the hand's speed.
pub const HAND_SPEED: &str = "Speed of the hand";
/// Accessible name of the hand's force.
pub const HAND_FORCE: &str = "Force of the hand";
/// Accessible name of the choice of paths.
pub const HAND_PATH: &str = "Path of the hand";
/// How a message at the foot goes away.
pub const DISMISS: &str = "Click to take this message away.";
/// What muting does.
pub const MUTE_HELP: &str = "Silences the output and keeps everything else going (M).";
/// What the limiter does.
pub const LIMITING_HELP: &str = "The texture is stronger than the output or the actuator may play, and is turned down. Press less, stroke slower, or choose a weaker texture.";
/// On the button that lets a neighbor be heard alone.
pub const SOLO: &str = "S";
/// What that does.
pub const SOLO_HELP: &str = "Solo: hear this texture by itself, as the library has it; press again to hear the blend. The point stays where it is.";
/// Accessible name of the choice of outputs.
pub const OUTPUT: &str = "Output";
/// What the choice of outputs does.
pub const OUTPUT_HELP: &str = "The output that drives the actuator. It is never changed behind your back: if it goes, Shagreen falls silent.";
/// An output is being opened.
pub const OPENING: &str = "Opening the output…";
/// Resets the latched limiter.
pub const RESET_LIMITER: &str = "Reset limiter";
/// The limiter has latched silence.
pub const TRIPPED: &str = "Silenced: a sample was not a number";
/// Light theme.
pub const TO_LIGHT: &str = "Light theme";
/// Dark theme.
pub const TO_DARK: &str = "Dark theme";
/// Undo.
pub const UNDO: &str = "Undo";
/// Redo.
pub const REDO: &str = "Redo";
/// Mute.
pub const MUTE: &str = "Mute";
/// Sound again.
pub const UNMUTE: &str = "Unmute";
/// There is no sound output; the silent one stands in.
pub const NO_SOUND: &str = "No sound: the silent output is used";
/// Opening an output broke off.
pub const OPENING_FAILED: &str = "Opening the output failed; choose it again, or another";
/// The library is empty.
pub const NO_TEXTURES: &str = "This library has no textures.";
/// No texture of the library lies in the space.
pub const NO_PLACES: &str =
    "No texture of this library has a place in the space, so there is nothing to blend.";
/// No output is open.
pub const NO_OUTPUT: &str = "Choose an output";
/// Name of the mode `field`.
pub const FIELD: &str = "Field";
/// Name of the mode `parametric`.
pub const PARAMETRIC: &str = "Parametric";
/// Name of the mode `shared`.
pub const SHARED: &str = "Shared";
/// Name of the mode `power`.
pub const POWER: &str = "Power";
/// Name of the mode `paper`.
pub const PAPER: &str = "Paper";
/// The mode `field` in a few words.
pub const FIELD_SHORT: &str = "one texture, from all";
/// The mode `parametric` in a few words.
pub const PARAMETRIC_SHORT: &str = "a mean of neighbors";
/// The mode `shared` in a few words.
pub const SHARED_SHORT: &str = "three signals, one noise";
/// The mode `power` in a few words.
pub const POWER_SHORT: &str = "three signals, level kept";
/// The mode `paper` in a few words.
pub const PAPER_SHORT: &str = "as published";
/// What the mode `field` is.
pub const FIELD_HELP: &str = "Every point is a texture of its own, from a smooth field over all textures: no jumps, no \
                              kinks. A texture's own place is smoothed by its neighbors, unless it is locked.";
/// What the mode `parametric` is.
pub const PARAMETRIC_HELP: &str = "Every point is a texture of its own: the mean spectrum and level of the textures \
                                   around it. Exact at each texture, with a kink at the edges of triangles.";
/// What the mode `shared` is.
pub const SHARED_HELP: &str = "The three textures around the point sound together, driven by one noise, so that their \
                               spectra blend without a loss of level.";
/// What the mode `power` is.
pub const POWER_HELP: &str = "The three textures around the point sound together, each with a noise of its own; the \
                              level is made up to the mean of their levels.";
/// What the mode `paper` is.
pub const PAPER_HELP: &str = "As printed in the paper: three textures by inverse distance, each with a noise of its own. \
                              Sinks in level between textures and jumps at the edges of triangles.";
/// Accessible name of the choice of modes.
pub const BLEND_MODE: &str = "Blend mode";
/// The field goes on outside the outline of the textures.
pub const BEYOND: &str = "Go beyond the textures";
/// What going beyond the textures does.
pub const BEYOND_HELP: &str = "Outside the outline of the textures the field goes on, as far as the textures support a \
                               guess; otherwise the nearest point of the outline plays.";
/// All natural neighbors have a say.
pub const NATURAL: &str = "Natural neighbors";
/// What natural neighbors are.
pub const NATURAL_HELP: &str = "All textures around the point have a say, by the area that the point would take from \
                                each: no kink at the edges of triangles.";
/// What stands where a mode that mixes signals has no choices.
pub const THREE_SIGNALS: &str = "from the corners of the triangle";
/// The field is not there yet.
pub const PREPARING: &str = "preparing the field…";
/// What plays until the field is there.
pub const PREPARING_HELP: &str =
    "What a field over all textures needs is being worked out. Until then, what sounded goes on.";
/// A texture of the field's own place is not that texture.
pub const SMOOTHED: &str =
    "In the field its place is smoothed by its neighbors. Lock it (right click) to meet it exactly.";
/// A texture is locked.
pub const LOCKED: &str = "Locked: the field meets it exactly at its place.";
/// What the lock of a texture does.
pub const LOCK_HELP: &str = "A locked texture is met exactly at its own place, and the field gives way to it around there. \
                             Unlocked, it is smoothed by its neighbors.";
/// The point lies outside the hull, and the field goes on there.
pub const EXTRAPOLATED: &str = "extrapolated";
/// What is extrapolated is a guess.
pub const EXTRAPOLATED_HERE: &str =
    "Extrapolated: no texture was measured beyond the outline, so this is a guess.";
/// Where the mode `paper` jumps.
pub const JUMPS_HERE: &str = "Paper: the texture jumps where the point crosses this edge.";
/// That the mode `paper` jumps.
pub const JUMPS: &str = "Paper: the texture jumps where the point crosses an edge of the triangles.";
/// The field has no texture at the point.
pub const NO_TEXTURE_HERE: &str = "No texture can be made at this point; move it nearer to the textures";
/// Working out the field broke off.
pub const FIELD_FAILED: &str = "The field broke off; open the library again";
/// What the latency is.
pub const LATENCY_HELP: &str = "From a movement of the hand to the output: control tick, filters and two blocks. The mouse \
                                adds a frame of the window, a sound server its own buffer.";
/// What the load is.
pub const LOAD_HELP: &str = "Share of the time allotted to the sound that is used.";
/// What dropouts are.
pub const DROPOUTS_HELP: &str = "Times that the output ran out of samples.";
/// What the level is.
pub const LEVEL_HELP: &str = "Level of the texture, root mean square.";
/// The output no longer asks for samples.
pub const STALLED: &str = "The output has stopped asking for sound";
/// The limiter bends the signal.
pub const LIMITING: &str = "limiting";
/// Where positions come from.
pub const SOURCE_HELP: &str =
    "Where the places of the textures come from. Physical labels and simulated raters are no human ratings.";
/// Positions come from several sources.
pub const MIXED_SOURCES: &str = "mixed: never compare them";
/// Added to the source of places that nobody felt.
pub const NOBODY_FELT: &str = ", nobody felt them";
/// Added where somebody felt some of the places.
pub const SOME_SIMULATED: &str = "; some are simulated";
/// Nothing says where positions come from.
pub const NO_SOURCE: &str = "not stated";
/// The scale bar of the pad.
pub const TEN_MM: &str = "10 mm";
/// A texture without a place in the space, in the list.
pub const NOT_PLACED_YET: &str = "not placed yet";
/// What clicking on a texture without a place does.
pub const NOT_PLACED_HELP: &str = "Not placed in the space yet: a click plays it alone.";
/// The one texture that is heard, in the list.
pub const HEARD_ALONE: &str = "heard alone";
/// Opens the import sheet.
pub const IMPORT: &str = "Import…";
/// What importing does.
pub const IMPORT_HELP: &str =
    "Makes textures of recordings, HaTT models or another library. Files can also be dropped on the window.";
/// Opens the sheet that saves the library.
pub const SAVE_LIBRARY: &str = "Save as…";
/// What saving does.
pub const SAVE_LIBRARY_HELP: &str = "Writes all textures of the list into one file.";
/// Pictures that could not be read.
pub const DAMAGED_PICTURE: &str = "The picture cannot be read";
/// The straight path of the hand.
pub const LINE: &str = "line";
/// The round path of the hand.
pub const CIRCLE: &str = "circle";
/// The path of the hand that covers the pad.
pub const SCRIBBLE: &str = "scribble";

/// How often the output ran out of samples.
pub fn dropouts(n: u64) -> String {
    if n == 1 { "1 dropout".to_owned() } else { format!("{n} dropouts") }
}

/// Accessible name of an axis by the words at its ends: [`ROUGH_SMOOTH`] and [`HARD_SOFT`] are two of them.
pub fn axis([low, high]: &[String; 2]) -> String {
    let words = if high.is_empty() { low.clone() } else { format!("{low} to {high}") };
    let mut letters = words.chars();
    letters.next().map_or(String::new(), |first| first.to_uppercase().chain(letters).collect())
}

/// What the slider of an axis does.
pub fn axis_help(ends: &[String; 2]) -> String {
    match ends.each_ref().map(String::as_str) {
        [ROUGH, SMOOTH] => ROUGH_SMOOTH_HELP.to_owned(),
        [HARD, SOFT] => HARD_SOFT_HELP.to_owned(),
        [low, high] => format!("0 is the most {low} of the space, 100 the most {high}."),
    }
}

/// A place in the space, as a screen reader says it.
pub fn place_in_words(point: SpacePoint, [across, up]: &[[String; 2]; 2]) -> String {
    format!("{} {:.0}, {} {:.0}", axis(across), point.rough_smooth, axis(up), point.hard_soft)
}

/// Whom the places that are shown come from.
pub fn places_from(source: &str) -> String {
    format!("Places: {source}")
}

/// Where a texture lies, and where that comes from.
pub fn lies_at(point: SpacePoint, source: &str) -> String {
    format!("{point} ({source})")
}

/// Accessible name of a texture on the canvas: a click moves the point there.
pub fn go_to(texture: &str) -> String {
    format!("Go to {texture}")
}

/// Accessible name of a texture in the list.
pub fn texture(name: &str) -> String {
    format!("Texture {name}")
}

/// Accessible name of a parent and its weight in percent.
pub fn parent(name: &str, percent: f64) -> String {
    format!("{name}, {percent:.1} percent")
}

/// A weight in the list of textures, in percent.
pub fn of_the_blend(percent: f64) -> String {
    format!("{percent:.0} % of the blend")
}

/// One texture is heard alone.
pub fn plays_alone(texture: &str) -> String {
    format!("{texture} plays alone. Move the point to hear the blend again.")
}

/// The lock of a texture: the accessible name of what sets or opens it, and the name of that edit.
pub fn lock(texture: &str, is_to_be_locked: bool) -> String {
    format!("{} {texture}", if is_to_be_locked { "Lock" } else { "Unlock" })
}

/// Undo or redo, and what: names keep their capitals.
pub fn verb(verb: &str, label: &str) -> String {
    let mut letters = label.chars();
    let first = letters.next().into_iter().flat_map(char::to_lowercase);
    format!("{verb} {}{}", first.collect::<String>(), letters.as_str())
}

/// The textures of a field that have no card, and what they give in percent.
pub fn more_parents(n_more: usize, percent: f64) -> String {
    // Rounded first, so that nothing reads "-0 %".
    format!("and {n_more} more, together {:.0} %", percent.round() + 0.0)
}

/// How much of what sounds is a locked texture, in percent.
pub fn locked_share(texture: &str, percent: f64) -> String {
    format!("{texture} (locked) sounds to {percent:.0} %")
}

/// Where extrapolation stopped.
pub fn extrapolated_to(at: SpacePoint) -> String {
    format!("Extrapolated as far as the textures support a guess: it stops at {at}.")
}

/// Accessible name of the button that lets a texture be heard alone.
pub fn solo(name: &str) -> String {
    format!("Hear {name} alone")
}
