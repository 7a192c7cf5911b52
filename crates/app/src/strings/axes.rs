//! Axes of the space: their choice, their evaluation, and what a space with more axes than the canvas shows.

use shagreen_core::space::MOST_AXES;
use shagreen_core::space::signal_axes::SignalAxis;
use shagreen_core::words::counted;
use shagreen_formats::placed_space::is_dimension_name;
use shagreen_formats::project::plain_axis_name;
use shagreen_studio::axes::AxisSource;

use crate::strings::axis_help;

pub const TITLE: &str = "Axes";
pub const SWAP: &str = "Swap the axes of the canvas";
pub const BUTTON: &str = "Axes…";
pub const BUTTON_HELP: &str = "Chooses one to six axes of the space: attributes of the textures, or features of their vibration. The canvas shows the first two; the others are sliders.";
pub const NOTHING_TO_SWAP: &str =
    "The space has one axis, so there is nothing to swap. Choose two axes or more.";
pub const PURPOSE: &str = "The canvas shows the first two axes; the others are sliders. Points keep their coordinates on axes that stay. On a new axis, points on a texture follow it; others lie at the local mean.";
pub const PRESETS: &str = "Presets";
pub const AS_PLACED: &str = "As placed";
pub const AS_PLACED_HELP: &str = "The axes on which the library states the positions of the textures.";
pub const LOADING: &str = "Reading the axes of the textures…";
pub const BROKEN: &str = "Reading the axes stopped unexpectedly; open this sheet again.";
pub const NEEDS_ONE: &str = "A space needs at least one axis.";
pub const SAME_NAME: &str = "An axis of the same name is chosen. Remove it first.";
pub const SWAP_FIRST: &str = "Swap the first two";
pub const SWAP_FIRST_HELP: &str =
    "Swaps the axes of the canvas: the horizontal one becomes the vertical one.";
pub const USE: &str = "Use these axes";
pub const USE_HELP: &str = "Places the textures on these axes and moves all points to them. Undo restores the former axes and points.";
pub const CANCEL: &str = "Cancel";
pub const CHOOSE: &str = "Choose other axes…";
pub const NONE_HAS_ALL: &str =
    "No texture has a value on each of the chosen axes. Choose fewer or other axes.";
pub const NO_TEXTURE: &str = "No texture has a value on each of these axes. Remove an axis.";

pub const EVALUATE: &str = "Evaluate axes";
pub const EVALUATE_HELP: &str = "Predicts each texture from the others (leave-one-out) with the chosen axes, then with further ones, each time the axis that lowers the error most. This takes from seconds to minutes.";
pub const EVALUATING: &str = "Evaluating";
pub const STOP: &str = "Stop";
pub const EVALUATION_BROKEN: &str = "The evaluation stopped unexpectedly; start it again.";
pub const ADDED: &str = "axes";
pub const ERROR: &str = "error in dB";
pub const ERROR_HELP: &str = "Mean spectral distance between each texture and its prediction from the others: with the last number of axes that helped, and with this axis.";
pub const RANK1: &str = "rank 1";
pub const RANK1_HELP: &str =
    "Share of the textures for which the original is the most similar of all textures to the prediction.";
pub const GAIN: &str = "gain in dB";
pub const GAIN_HELP: &str = "Decrease of the error, ± its standard error, compared with the last number of axes that helped. An axis helps if the gain is more than twice its standard error.";
pub const HELPS: &str = "helps";
pub const NO_HELP: &str = "no clear gain";
pub const ADD: &str = "Add";
pub const ADD_HELP: &str =
    "Adds this axis and those of the rows above it: each row has one axis more than the row before.";

pub const FURTHER_HELP: &str =
    "Axes that the canvas does not show. It shows a slice of the space at these coordinates.";
pub const SLICE_HELP: &str = "Textures far from the slice on the further axes are small and faint, relative to the spread of all textures. Triangles and the convex hull exist only with two axes.";
pub const NEEDS_TRIANGLES: &str = "This mode interpolates in triangles, which exist only in a space with one or two axes. Field is used until then; the chosen mode comes back with two axes.";

/// Says that the mode with this name is not used in a space without triangles.
pub fn waits(mode: &str) -> String {
    format!("{mode} needs one or two axes; Field is used.")
}

/// Name of an axis, as it is shown.
pub fn name(axis: &str) -> &str {
    plain_axis_name(axis)
}

/// Says that no texture has a value on these axes.
pub fn missing(axes: &[&str]) -> String {
    let names: Vec<&str> = axes.iter().map(|axis| name(axis)).collect();
    let of = if names.len() == 1 { "the axis" } else { "any of the axes" };
    format!(
        "No texture has a value on {of} {}. Choose other axes, or open another library.",
        names.join(", ")
    )
}

/// Says on which axes a library file states its positions, if the project has chosen others.
pub fn stored(own: &[&str]) -> String {
    format!("Its positions are on the axes {}; only the project stores the chosen axes.", own.join(", "))
}

/// Help for an axis with this name and these words at its ends.
pub fn help(axis: &str, ends: &[String; 2]) -> String {
    let name = name(axis);
    if is_dimension_name(name) {
        return format!(
            "Coordinate on {name} of the perceptual space: 0 is the lowest of all textures, 100 the highest. The direction has no meaning."
        );
    }
    axis_help(ends)
}

/// Words at both ends of an axis, unless its name says them, or they say its name.
pub fn ends(axis: &str, [low, high]: &[String; 2]) -> Option<String> {
    let name = name(axis);
    let is_said = |end: &String| name.contains(end.as_str()) || end.contains(name);
    (!is_said(low) || !is_said(high)).then(|| format!("{low} to {high}"))
}

/// Lowest and highest coordinate of the textures on an axis.
pub fn range([low, high]: [f64; 2]) -> String {
    format!("Textures: {low:.0} to {high:.0}.")
}

/// Help for an axis that is computed from the vibration, with the values at its ends.
pub fn signal_help(axis: SignalAxis) -> String {
    let [low, high] = axis.range();
    match axis {
        SignalAxis::Centroid => {
            format!("Spectral centroid of the vibration: 0 is {low} Hz, 100 is {high} Hz (logarithmic).")
        }
        SignalAxis::SpeedExponent => format!(
            "Exponent of the vibration level over the tip speed: 0 is {low} (the same at any speed), 100 is {high}."
        ),
        SignalAxis::ForceExponent => format!(
            "Exponent of the vibration level over the normal force: 0 is {low} (the same at any force), 100 is {high}."
        ),
        SignalAxis::TapFrequency => {
            format!("Frequency of the tap transient: 0 is {low} Hz, 100 is {high} Hz (logarithmic).")
        }
    }
}

/// Heading of the sliders of the further axes.
pub fn further(n: usize) -> String {
    format!("Further axes ({n})")
}

/// Legend of a canvas that shows two of several axes.
pub fn slice(n_axes: usize) -> String {
    format!("Slice through {n_axes} axes")
}

/// Says that the nearest point of the hull plays: the axis on which it differs most from the authored point, and its coordinates
/// there, as whole numbers unless these are equal.
pub fn nearest(axis: &str, used: f64, wanted: f64) -> String {
    let shown = |value: f64| {
        if used.round() == wanted.round() { format!("{value:.1}") } else { format!("{:.0}", value.round()) }
    };
    format!(
        "Outside the convex hull of the textures: the nearest point plays, with {} {} instead of {}.",
        name(axis),
        shown(used),
        shown(wanted)
    )
}

/// Accessible name of the button that moves the point to the local mean on an axis.
pub fn reset(axis: &str) -> String {
    format!("Reset {} to the local mean", name(axis))
}

/// What that button does.
pub fn reset_help(axis: &str) -> String {
    format!(
        "Moves the point on the axis {} to the mean of the textures near it on the other axes.",
        name(axis)
    )
}

/// Notice that other axes were chosen. Points have no coordinates on the `dropped` ones any more; `keys` are those of undo.
pub fn chosen(n: usize, dropped: &[String], keys: &str) -> String {
    if !dropped.is_empty() {
        return coordinates_dropped(dropped, keys);
    }
    let axes = if n == 1 { "1 axis".to_owned() } else { format!("{n} axes") };
    format!("The space has {axes} now. Undo: {keys}")
}

/// Notice that points have no coordinates on these axes any more; `keys` are those of undo.
pub fn coordinates_dropped(axes: &[String], keys: &str) -> String {
    format!("Coordinates on {} are dropped. Undo: {keys}", names(axes, ", "))
}

/// Says that these coordinates of a point are estimated from the textures.
pub fn local_means(axes: &[String]) -> String {
    format!("Coordinates on {} are local means.", names(axes, ", "))
}

/// Place of a chosen axis, by its index.
pub fn place(axis: usize) -> String {
    match axis {
        0 => "1 · horizontal".to_owned(),
        1 => "2 · vertical".to_owned(),
        _ => format!("{} · slider", axis + 1),
    }
}

/// Accessible name of the buttons that move a chosen axis by one place.
pub fn earlier(axis: &str) -> String {
    format!("Move {} to the place before", name(axis))
}

pub fn later(axis: &str) -> String {
    format!("Move {} to the next place", name(axis))
}

/// Source of an axis, and how many textures have a value.
pub fn source(source: Option<AxisSource>, n_known: usize, n: usize) -> String {
    let of = match source {
        Some(AxisSource::Position(_)) => "position",
        Some(AxisSource::Attribute) => "attribute",
        Some(AxisSource::Signal(_)) => "vibration",
        None => "unknown",
    };
    if n_known == n { of.to_owned() } else { format!("{of}, {n_known} of {n} textures") }
}

/// Number of the textures that have all chosen axes.
pub fn n_placed(n_placed: usize, n: usize) -> String {
    format!("{n_placed} of {} on these axes.", counted(n, "texture"))
}

/// Why no further axis can be chosen.
pub fn most() -> String {
    format!("A space has at most {MOST_AXES} axes. Remove one first.")
}

/// Names of the axes with which an evaluation began, one a line.
pub fn first_axes(axes: &[String]) -> String {
    names(axes, ",\n")
}

/// Name of a row of an evaluation: the axis that it adds to those of the rows above.
pub fn added(axis: &str) -> String {
    format!("+ {}", name(axis))
}

/// Says that an evaluation began with other axes than the chosen ones.
pub fn of_another_choice(first: &[String]) -> String {
    format!(
        "These errors are those of another choice, which began with {}. Evaluate the axes again to add some.",
        names(first, ", ")
    )
}

fn names(axes: &[String], between: &str) -> String {
    axes.iter().map(|axis| name(axis)).collect::<Vec<_>>().join(between)
}

/// Accessible name of the button that adds an evaluated axis.
pub fn add(axis: &str) -> String {
    format!("Add {}", name(axis))
}

/// Error before and after an axis is added, in dB; the first axes have no error before.
pub fn errors(before: Option<f64>, after: f64) -> String {
    before.map_or_else(|| format!("{after:.2}"), |before| format!("{before:.2} to {after:.2}"))
}

/// Gain by an axis and its standard error, in dB.
pub fn gain(gain: Option<[f64; 2]>) -> String {
    gain.map_or_else(String::new, |[gain, error]| format!("{gain:.2} ± {error:.2}"))
}

pub fn percent(share: f64) -> String {
    format!("{:.0} %", 100.0 * share)
}

/// How many textures were evaluated.
pub fn evaluated(n: usize) -> String {
    format!("Measured on {}, not rated by people.", counted(n, "texture"))
}

/// Axes that were left out of the evaluation, because too few textures have them.
pub fn left_out(axes: &[&str]) -> String {
    let names: Vec<&str> = axes.iter().map(|axis| name(axis)).collect();
    format!("Not evaluated, because too few textures have them: {}.", names.join(", "))
}

/// An axis of which an estimate says nothing, with the local mean that takes its place.
pub fn untold(axis: &str, mean: f64) -> String {
    format!("{}: not described, local mean {mean:.0}", name(axis))
}

#[cfg(test)]
mod tests {
    use super::{ends, errors, gain, help, n_placed, nearest, place, range, source, untold};
    use shagreen_core::space::signal_axes::SignalAxis;
    use shagreen_studio::axes::{AxisSource, axis_poles};

    #[test]
    fn figures_read_as_they_are_meant() {
        assert_eq!([errors(Some(2.6), 2.021), errors(None, 3.5)], ["2.60 to 2.02", "3.50"]);
        assert_eq!([gain(Some([0.58, 0.104])), gain(None)], ["0.58 ± 0.10", ""]);
        assert_eq!([place(0), place(4)], ["1 · horizontal", "5 · slider"]);
        assert_eq!(source(Some(AxisSource::Attribute), 25, 25), "attribute");
        assert_eq!(source(None, 0, 25), "unknown, 0 of 25 textures");
        assert_eq!(n_placed(1, 1), "1 of 1 texture on these axes.");
        assert!(nearest("centroid", 62.04, 33.9).ends_with("with centroid 62 instead of 34."));
        assert!(nearest("attribute:a-b", 34.23, 34.41).ends_with("with a-b 34.2 instead of 34.4."));
        assert_eq!(untold("sticky-slippery", 43.2), "sticky-slippery: not described, local mean 43");
    }

    #[test]
    fn an_axis_has_the_words_at_its_ends_unless_its_name_says_them() {
        let of = |axis: &str| ends(axis, &axis_poles(axis));
        assert_eq!(of("centroid").as_deref(), Some("dull to bright"));
        assert_eq!(["attribute:flat-bumpy", "warm", "dimension 2"].map(of), [None, None, None]);
        assert_eq!(range([50.7, 81.2]), "Textures: 51 to 81.");
    }

    #[test]
    fn a_computed_axis_states_the_values_at_its_ends() {
        let of = |axis: &str| help(axis, &axis_poles(axis));
        assert!(of(SignalAxis::Centroid.name()).contains("0 is 30 Hz, 100 is 400 Hz"));
        assert!(of(SignalAxis::ForceExponent.name()).contains("100 is 1.5"));
        let dimensions = ["dimension 1", "attribute:dimension 2"].map(of);
        assert!(dimensions[0].contains("on dimension 1 of") && dimensions[1].contains("on dimension 2 of"));
        let rated = of("warm-cold");
        assert_eq!(rated, "0 is the most warm texture of the space, 100 the most cold.");
    }
}
