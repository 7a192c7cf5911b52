//! List of textures: filter, context menu and details.

use shagreen_core::space::LabelSource;
use shagreen_core::space::texture_path::Along;
use shagreen_core::units::Contact;

use crate::choices::textures::{End, Region};
use crate::strings;

pub const CLEAR_SEARCH: &str = "Clear the search";
pub const FILTER: &str = "Filter";
pub const FILTER_HELP: &str = "Lists only textures with the selected tags, in a region of the space, with a star, or added to this project. The audible texture does not change.";
pub const TAGS: &str = "Tags";
pub const TAGS_HELP: &str = "Lists textures that have all selected tags.";
pub const NO_TAGS: &str = "No texture has a tag.";
pub const REGION: &str = "Region";
pub const ANYWHERE: &str = "anywhere";
pub const NEAR_POINT: &str = "near the point";
pub const NOT_PLACED: &str = "no position";
pub const ONLY_STARRED: &str = "Starred only";
pub const ONLY_STARRED_HELP: &str =
    "Lists only textures with a star. Without this filter, starred textures come first.";
pub const ONLY_JOINED: &str = "Added to this project only";
pub const ONLY_JOINED_HELP: &str = "Lists only textures that were imported, duplicated, or added from a path or as a relief. They belong to the project, not to the library.";
pub const CLEAR: &str = "Clear";
pub const NONE_PASSES: &str = "No texture matches the filter.";
pub const NONE_FOUND: &str = "No texture matches both the filter and the search.";
pub const SHOW_ALL: &str = "Show all textures";

pub const DETAILS: &str = "Details…";
pub const DETAILS_HELP: &str =
    "Shows name, position, license, range of speed and force, and plots of level and spectrum";
pub const HEAR_ALONE: &str = "Solo";
pub const HEAR_ALONE_HELP: &str = "Plays this texture alone, as a click on it does. The authored texture does not change; Escape returns to it.";
pub const CHOOSE: &str = "Use exactly this";
pub const CHOOSE_HELP: &str = "Makes the selected authored texture exactly this one: at its position, in the mode Field and pinned, with a neutral shape. A double click on the texture does the same.";
pub const CLICK_HELP: &str = "Click to play it alone; double-click to use exactly this texture.";
pub const BACK: &str = "Back";
pub const BACK_NAME: &str = "Back to the authored texture";
pub const BACK_HELP: &str = "Plays the selected authored texture again (Escape).";
pub const AUTHOR: &str = "Add as authored texture";
pub const AUTHOR_HELP: &str = "Adds an authored texture that is exactly this texture: at its position, in the mode Field and pinned. Dragging the row onto the space does the same.";
pub const NO_POSITION: &str = "This texture has no position in the space. The menu of an added texture can estimate one; ratings give one in Build.";
pub const LOST_PIN: &str = "pinned without effect: no position";
pub const LOST_PIN_HELP: &str = "A pin has an effect only at the position of its texture, and this texture has none in the space. Estimate its position, or choose axes on which it has one.";
pub const ESTIMATE_PLACE: &str = "Estimate position";
pub const ESTIMATE_PLACE_HELP: &str = "Estimates the position from textures with similar vibration and a known position. The texture then contributes to the space. The estimate is not a human rating.";
pub const CANNOT_PLACE: &str = "No position can be estimated: this needs five textures with positions, no built space, no position on other axes than the chosen ones, and a sample rate of the texture that is not above that of the space.";
pub const STAR: &str = "Star";
pub const UNSTAR: &str = "Unstar";
pub const STAR_HELP: &str = "Starred textures come first in the list. The project stores the stars.";
pub const RENAME: &str = "Rename…";
pub const RENAME_HELP: &str =
    "Renames the texture in this project. Its name in the library file does not change.";
pub const DUPLICATE: &str = "Duplicate";
pub const DUPLICATE_HELP: &str = "Adds a copy to the project, with a new name, under the same license and at the same position. If a built space is in use, the copy has no position there.";
pub const REMOVE: &str = "Remove";
pub const REMOVE_HELP: &str = "Removes the texture from the project. Undo restores it.";
pub const CANNOT_REMOVE: &str =
    "This texture is part of the library. Only textures that were added to the project can be removed.";
pub const WHOLE_SPACE: &str = "Use in the whole space";
pub const OWN_HELP: &str = "Its own texture contributes only to this authored texture, and is hidden in the space while another one is selected. To use it like the textures of the library, right-click and choose \"Use in the whole space\".";
pub const MORE_HELP: &str = "Opens the menu of this texture; a right-click on the row does the same";

pub const TITLE: &str = "Texture details";
pub const NAME: &str = "Name of the texture in the list";
pub const NAME_NEEDED: &str = "A texture needs a name: the previous one stays until you enter another.";
pub const IDENTIFIER: &str = "identifier";
pub const IDENTIFIER_HELP: &str =
    "Identifier in files and on the command line. It does not change when the texture is renamed.";
pub const PART_OF: &str = "part of";
pub const THE_PROJECT: &str = "this project (added)";
pub const PLACE: &str = "position";
pub const PLACE_FROM: &str = "position from";
pub const TAGS_LABEL: &str = "tags";
pub const NONE: &str = "none";
pub const PASSING_ON: &str = "sharing";
const PASSED_ON_FREELY: &str = "allowed under its license";
const PASSED_ON_UNKNOWN: &str = "unknown: its license is not stated";
pub const TERMS_HELP: &str = "License for use and redistribution, as stated in the library file.";
pub const ATTRIBUTES: &str = "Attributes";
pub const ATTRIBUTES_HELP: &str =
    "Values from 0 (first word) to 100 (second word). Any of the attributes can be an axis of the space.";
pub const MODEL: &str = "Model";
pub const RATE_HELP: &str = "Sample rate of the model, in Hz. It contains no frequencies above half of it.";
pub const NODES: &str = "speed-force points";
pub const NODES_HELP: &str =
    "Number of pairs of speed and force with a model. Values between them are interpolated.";
pub const SPEEDS: &str = "speeds";
pub const FORCES: &str = "forces";
pub const RANGE_HELP: &str = "Range of speeds or forces with a model. Above it, the texture does not change any further; below it, it fades to silence.";
pub const FRICTION_HELP: &str = "Ratio of tangential to normal force while the tip slides. A vibrating pen renders only the stick-slip of a slow tip. A friction display renders all of it: its channel is in the profile of the actuator.";
pub const NO_FRICTION: &str = "not known";
pub const NO_LANDING: &str = "not known: taps are silent";
pub const LEVEL_MEASURED: &str = "level at 100 mm/s, 1 N";
pub const STIFFNESS: &str = "stiffness at 1 N";
pub const PHYSICAL_HELP: &str =
    "Physical quantity that replaces a rating. It does not say how people perceive the texture.";
pub const PATH: &str = "path";
pub const PATH_HELP: &str =
    "The texture changes along a stroke. This sheet shows the first texture of the path.";
pub const LEVELS: &str = "Level over speed and force";
pub const LEVELS_HELP: &str = "Level of the vibration, in dB re 1 m/s²: brighter is stronger. Dots are speed-force points with a model; all other values are interpolated. Below the lowest dots, the level fades to silence. Levels and spectra are those of the noise in a stroke across the lay, without stick-slip and reliefs.";
pub const SPECTRA: &str = "Spectra";

/// Whether a texture without restrictions may be passed on under this license, empty if none is stated.
pub fn passed_on(license: &str) -> &'static str {
    if license.trim().is_empty() { PASSED_ON_UNKNOWN } else { PASSED_ON_FREELY }
}

/// What the switch [`WHOLE_SPACE`] changes, in a sentence. `n_changed` authored textures can change; `None` for a texture
/// without a position.
pub fn whole_space_effect(is_everywhere: bool, n_changed: Option<usize>) -> String {
    let change = match n_changed {
        None => "it has no position, so no authored texture changes".to_owned(),
        Some(0) => "no authored texture changes, because all of them pin it".to_owned(),
        Some(1) => "1 authored texture can change".to_owned(),
        Some(n) => format!("{n} authored textures can change"),
    };
    let (state, switched) =
        if is_everywhere { ("in the whole space", "off") } else { ("only where it is pinned", "on") };
    format!("This texture contributes {state}. If you switch this {switched}: {change}.")
}

/// Names the textures that are pinned without effect.
pub fn lost_pins(textures: &[&str]) -> String {
    format!("Pinned without effect (no position in this space): {}", textures.join(", "))
}

/// Note on a texture that takes part only in these authored textures.
pub fn only_in(authored: &[&str]) -> String {
    if authored.is_empty() {
        return "In no authored texture, because none pins it".to_owned();
    }
    format!("Only in {}", authored.join(", "))
}

/// Friction coefficient, and how it is felt: as stick-slip below a speed in mm/s at a force in N, by a friction display, or
/// not at all.
pub fn friction(coefficient: f64, stick_slip: Option<(f64, f64)>, is_rendered: bool) -> String {
    let stick_slip = stick_slip.map_or(String::new(), |(mm_per_s, force_n)| {
        format!(", felt as stick-slip below {mm_per_s:.0} mm/s at {} N", (10.0 * force_n).round() / 10.0)
    });
    let rendered = match (is_rendered, stick_slip.is_empty()) {
        (true, _) => ". The chosen output renders friction.",
        (false, true) => ". The chosen output cannot render friction.",
        (false, false) => "",
    };
    format!("{coefficient:.2}{stick_slip}{rendered}")
}

/// Label of the filter button, with the number of active filters.
pub fn filter(n_on: usize) -> String {
    if n_on == 0 { FILTER.to_owned() } else { format!("{FILTER} · {n_on}") }
}

/// Tag, and the number of textures with it.
pub fn tag(tag: &str, n: usize) -> String {
    format!("{tag} ({n})")
}

/// Region of the space, named by the words at the ends of the axes of the canvas.
pub fn region(region: Region, poles: &[[String; 2]]) -> String {
    let word = |[low, high]: &[String; 2], end: End| match end {
        End::Low => low.clone(),
        // An attribute may have one word only.
        End::High if high.is_empty() => format!("not {low}"),
        End::High => high.clone(),
    };
    match region {
        Region::Anywhere => ANYWHERE.to_owned(),
        Region::Quarter(ends) => {
            let words: Vec<String> = poles.iter().zip(ends).map(|(poles, end)| word(poles, end)).collect();
            words.join(" and ")
        }
        Region::NearPoint => NEAR_POINT.to_owned(),
        Region::NotPlaced => NOT_PLACED.to_owned(),
    }
}

/// Tooltip of the regions; `near` is in axis points.
pub fn region_help(near: f64) -> String {
    format!(
        "Lists the textures in one quadrant of the space, those within {near:.0} axis points of the authored point, or those without a position."
    )
}

/// Number of listed textures, of all textures.
pub fn count(n_listed: usize, n: usize) -> String {
    match n {
        _ if n_listed < n => format!("{n_listed} of {n}"),
        1 => "1 texture".to_owned(),
        _ => format!("{n} textures"),
    }
}

/// Accessible name of the button that opens the menu of a texture.
pub fn more(name: &str) -> String {
    format!("Menu of {name}")
}

/// Source of a position; simulated raters are marked, so that they are not mistaken for people.
pub fn place_from(source: LabelSource) -> String {
    let nobody = if source == LabelSource::SimulatedRaters { strings::NOBODY_FELT } else { "" };
    format!("{}{nobody}", source.label())
}

/// Range with its unit; one number if both ends are equal.
pub fn range(low: &str, high: &str, unit: &str) -> String {
    if low == high { format!("{low} {unit}") } else { format!("{low} to {high} {unit}") }
}

/// Frequency and decay of a tap transient.
pub fn landing(frequency_hz: f64, decay_per_s: f64) -> String {
    format!("{frequency_hz:.0} Hz, decay time constant {:.0} ms", 1e3 / decay_per_s)
}

pub fn level(level_mps2: f64) -> String {
    format!("{level_mps2:.3} m/s²")
}

pub fn stiffness(newtons_per_m: f64) -> String {
    format!("{:.1} N/mm", 1e-3 * newtons_per_m)
}

/// Number of textures and length of a path.
pub fn path(n_keys: usize, length: f64, along: Along) -> String {
    let (unit, name) = along.unit();
    format!("{n_keys} textures over {:.0} {name}", length / unit)
}

/// Range of the level plot.
pub fn levels_unit((low_db, high_db): (f64, f64)) -> String {
    format!("{low_db:.0} to {high_db:.0} dB re 1 m/s²")
}

/// Level at one speed and force.
pub fn level_at(contact: Contact, level_mps2: f64) -> String {
    format!("{:.0} mm/s, {:.2} N: {level_mps2:.3} m/s²", contact.speed.mm_per_s(), contact.force.0)
}

/// Unit and force of the plot of spectra.
pub fn spectra_unit(force_n: f64) -> String {
    format!("{}   at {force_n:.2} N", strings::import::SPECTRUM_UNIT)
}

/// End of a speed axis, or label of a line.
pub fn speed(mm_per_s: f64) -> String {
    format!("{mm_per_s:.0} mm/s")
}

/// End of a force axis.
pub fn force(force_n: f64) -> String {
    format!("{force_n:.1} N")
}

#[cfg(test)]
mod tests {
    use super::{count, friction, range, region};
    use crate::choices::textures::{End, Region};

    #[test]
    fn friction_says_how_it_is_felt() {
        assert_eq!(friction(0.45, None, false), "0.45. The chosen output cannot render friction.");
        assert_eq!(friction(0.45, None, true), "0.45. The chosen output renders friction.");
        let sticky = Some((35.4, 1.0));
        assert_eq!(friction(0.8, sticky, false), "0.80, felt as stick-slip below 35 mm/s at 1 N");
        let rendered = "0.80, felt as stick-slip below 35 mm/s at 1.5 N. The chosen output renders friction.";
        assert_eq!(friction(0.8, Some((35.4, 1.52)), true), rendered);
    }

    #[test]
    fn a_part_of_the_space_is_named_by_the_words_at_its_ends() {
        let poles = [["rough", "smooth"], ["warm", ""]].map(|ends| ends.map(str::to_owned));
        for (part, words) in [
            (Region::Quarter([End::Low, End::Low]), "rough and warm"),
            (Region::Quarter([End::High, End::High]), "smooth and not warm"),
            (Region::NearPoint, "near the point"),
        ] {
            assert_eq!(region(part, &poles), words);
        }
        assert_eq!(region(Region::Quarter([End::High, End::High]), &poles[..1]), "smooth");
    }

    #[test]
    fn numbers_read_as_they_are_meant() {
        assert_eq!([count(25, 25), count(1, 1), count(0, 1)], ["25 textures", "1 texture", "0 of 1"]);
        assert_eq!([range("1", "1", "N"), range("1", "2", "N")], ["1 N", "1 to 2 N"]);
    }
}
