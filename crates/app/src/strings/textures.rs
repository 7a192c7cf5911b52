//! Words about the textures of the list: how they are found, what can be done with one, and what is known of it.

use shagreen_core::space::LabelSource;
use shagreen_core::texture_path::Along;
use shagreen_core::units::Contact;

use crate::library_filter::{End, Region};
use crate::strings;

/// Opens the menu of filters.
pub const FILTER: &str = "Filter";
/// What the filters do.
pub const FILTER_HELP: &str = "Shows only textures with certain tags, from a part of the space, with a star, or that were added to this project. It changes what is listed, not what is heard.";
/// Heading of the tags.
pub const TAGS: &str = "Tags";
/// What choosing tags does.
pub const TAGS_HELP: &str = "A texture is shown where it has every tag that is chosen.";
/// No texture has a tag.
pub const NO_TAGS: &str = "No texture has a tag.";
/// Heading of the parts of the space.
pub const REGION: &str = "Where it lies";
/// The whole space, and what has no place.
pub const ANYWHERE: &str = "anywhere";
/// Around the authored point.
pub const NEAR_POINT: &str = "near the point";
/// Without a place.
pub const NOT_PLACED: &str = "not placed";
/// Only starred textures.
pub const ONLY_STARRED: &str = "Only with a star";
/// What that does.
pub const ONLY_STARRED_HELP: &str = "Textures that you starred; they stand first in the list anyhow.";
/// Only textures that joined.
pub const ONLY_JOINED: &str = "Only those added to this project";
/// What that does.
pub const ONLY_JOINED_HELP: &str = "Textures that were imported, duplicated or made of a path: they belong to the project, not to the library.";
/// Takes all filters away.
pub const CLEAR: &str = "Clear";
/// No texture passes the filter.
pub const NONE_PASSES: &str = "No texture passes the filter.";
/// No texture passes the filter and has what is searched for.
pub const NONE_FOUND: &str = "No texture that passes the filter has this in its name or tags.";
/// Clears search and filter.
pub const SHOW_ALL: &str = "Show all textures";

/// Opens what is known of a texture.
pub const DETAILS: &str = "Details…";
/// What that is.
pub const DETAILS_HELP: &str =
    "Name, place, terms, the speeds and forces it knows, and plots of what it sounds like";
/// Lets one texture be heard.
pub const HEAR_ALONE: &str = "Hear alone";
/// What that does.
pub const HEAR_ALONE_HELP: &str =
    "Plays this texture in the place of the blend, until the point moves. Stroke the pad to hear it.";
/// Marks a texture.
pub const STAR: &str = "Star";
/// Takes the mark away.
pub const UNSTAR: &str = "Unstar";
/// What a star does.
pub const STAR_HELP: &str = "Textures with a star stand first in the list. The project keeps its stars.";
/// Gives a texture another name.
pub const RENAME: &str = "Rename…";
/// What that does.
pub const RENAME_HELP: &str = "Another name in this project; the file of the library keeps its own.";
/// Makes a copy.
pub const DUPLICATE: &str = "Duplicate";
/// What that does.
pub const DUPLICATE_HELP: &str = "A copy joins the project, with a name of its own and under the same terms. It is at the same place, unless a space that was built is in use: that does not know it.";
/// Takes a texture away.
pub const REMOVE: &str = "Remove";
/// What that does.
pub const REMOVE_HELP: &str = "Takes it out of the project. Undo brings it back.";
/// Why a texture cannot be taken away.
pub const CANNOT_REMOVE: &str =
    "It is a part of the library, which stays whole: only textures that joined the project can be removed.";
/// What the button of a row opens.
pub const MORE_HELP: &str =
    "Everything that can be done with this texture; a right click on it does the same";

/// Heading of the sheet.
pub const TITLE: &str = "Details of a texture";
/// Accessible name of the field of the name.
pub const NAME: &str = "Name of the texture in the list";
/// A name has no letters.
pub const NAME_NEEDED: &str = "A texture needs a name: this one keeps its last until you write another.";
/// What it is called in files.
pub const IDENTIFIER: &str = "identifier";
/// What identifiers are for.
pub const IDENTIFIER_HELP: &str =
    "How files and the command line know it. It stays the same when the name changes.";
/// What it is a part of.
pub const PART_OF: &str = "part of";
/// It joined.
pub const THE_PROJECT: &str = "this project, which it joined";
/// Where it lies.
pub const PLACE: &str = "place";
/// Whom the place comes from.
pub const PLACE_FROM: &str = "place from";
/// The tags.
pub const TAGS_LABEL: &str = "tags";
/// It has none.
pub const NONE: &str = "none";
/// What may be done with it.
pub const PASSING_ON: &str = "may be shared";
/// Its terms are the only bound.
pub const PASSED_ON_FREELY: &str = "under its license";
/// What the terms are for.
pub const TERMS_HELP: &str = "The license under which it may be used and passed on, as its file states it.";
/// Heading of the attributes.
pub const ATTRIBUTES: &str = "Attributes";
/// What attributes are.
pub const ATTRIBUTES_HELP: &str =
    "Values from 0 at the first word to 100 at the second. Any two of them can be the axes of the space.";
/// Heading of the model.
pub const MODEL: &str = "Model";
/// Samples a second.
pub const RATE_HELP: &str =
    "Samples a second of the model: it has no frequencies from half of this number on.";
/// The nodes.
pub const NODES: &str = "speeds and forces";
/// What they are.
pub const NODES_HELP: &str =
    "Pairs of a speed and a force at which it is known. What lies between follows from them.";
/// Range of speeds.
pub const SPEEDS: &str = "speeds";
/// Range of forces.
pub const FORCES: &str = "forces";
/// What stands beyond the ranges.
pub const RANGE_HELP: &str = "Faster or harder it stays as it is at the end of this range.";
/// What friction is.
pub const FRICTION_HELP: &str =
    "Force along the surface for each newton onto it. A vibrating pen cannot show it.";
/// It has no friction.
pub const NO_FRICTION: &str = "not known";
/// It has no landing.
pub const NO_LANDING: &str = "not known: landings are silent";
/// What was measured of the surface.
pub const LEVEL_MEASURED: &str = "level at 100 mm/s, 1 N";
/// How stiff it is.
pub const STIFFNESS: &str = "stiffness at 1 N";
/// What physical labels are.
pub const PHYSICAL_HELP: &str =
    "A physical quantity that stands in for ratings. It says nothing of how the texture feels.";
/// It changes along a stroke.
pub const PATH: &str = "along a stroke";
/// What a path is.
pub const PATH_HELP: &str = "It changes along a stroke; what is shown here is its beginning.";
/// Heading of the levels.
pub const LEVELS: &str = "Level over speed and force";
/// What the levels are.
pub const LEVELS_HELP: &str =
    "How strongly it vibrates: brighter is stronger. Dots are where it is known, the rest follows from them.";
/// Heading of the spectra.
pub const SPECTRA: &str = "Spectra";

/// The button of the filters, with how many there are.
pub fn filter(n_on: usize) -> String {
    if n_on == 0 { FILTER.to_owned() } else { format!("{FILTER} · {n_on}") }
}

/// A tag, and how many textures have it.
pub fn tag(tag: &str, n: usize) -> String {
    format!("{tag} ({n})")
}

/// A part of the space, in the words at the ends of its axes.
pub fn region(region: Region, [across, up]: &[[String; 2]; 2]) -> String {
    let word = |[low, high]: &[String; 2], end: End| match end {
        End::Low => low.clone(),
        // An attribute may have one word only.
        End::High if high.is_empty() => format!("not {low}"),
        End::High => high.clone(),
    };
    match region {
        Region::Anywhere => ANYWHERE.to_owned(),
        Region::Quarter([x, y]) => format!("{} and {}", word(across, x), word(up, y)),
        Region::NearPoint => NEAR_POINT.to_owned(),
        Region::NotPlaced => NOT_PLACED.to_owned(),
    }
}

/// What choosing a part of the space does; `near` is in points of the axes.
pub fn region_help(near: f64) -> String {
    format!(
        "A quarter of the space, what lies within {near:.0} points of the texture that you author, or what has no place."
    )
}

/// How many textures are listed, of how many.
pub fn count(n_listed: usize, n: usize) -> String {
    match n {
        _ if n_listed < n => format!("{n_listed} of {n}"),
        1 => "1 texture".to_owned(),
        _ => format!("{n} textures"),
    }
}

/// Accessible name of the button that opens the menu of a texture.
pub fn more(name: &str) -> String {
    format!("More about {name}")
}

/// Whom a place comes from; simulated raters are never taken for people.
pub fn place_from(source: LabelSource) -> String {
    let nobody = if source == LabelSource::SimulatedRaters { strings::NOBODY_FELT } else { "" };
    format!("{}{nobody}", source.label())
}

/// A range of numbers with their unit; one number where both are the same.
pub fn range(low: &str, high: &str, unit: &str) -> String {
    if low == high { format!("{low} {unit}") } else { format!("{low} to {high} {unit}") }
}

/// A landing.
pub fn landing(frequency_hz: f64, decay_per_s: f64) -> String {
    format!("{frequency_hz:.0} Hz, falls to a third in about {:.0} ms", 1e3 / decay_per_s)
}

/// A level.
pub fn level(level_mps2: f64) -> String {
    format!("{level_mps2:.3} m/s²")
}

/// A stiffness.
pub fn stiffness(newtons_per_m: f64) -> String {
    format!("{:.1} N/mm", 1e-3 * newtons_per_m)
}

/// How a texture changes along a stroke.
pub fn path(n_keys: usize, length: f64, along: Along) -> String {
    let (unit, name) = along.unit();
    format!("{n_keys} textures over {:.0} {name}", length / unit)
}

/// The colors of the plot of levels.
pub fn levels_unit((low_db, high_db): (f64, f64)) -> String {
    format!("{low_db:.0} to {high_db:.0} dB re 1 m/s²")
}

/// A place of the plot of levels.
pub fn level_at(contact: Contact, level_mps2: f64) -> String {
    format!("{:.0} mm/s, {:.2} N: {level_mps2:.3} m/s²", contact.speed.mm_per_s(), contact.force.0)
}

/// Where the spectra are.
pub fn spectra_unit(force_n: f64) -> String {
    format!("{}   at {force_n:.2} N", strings::import::SPECTRUM_UNIT)
}

/// The end of an axis of speeds, or the line of a speed.
pub fn speed(mm_per_s: f64) -> String {
    format!("{mm_per_s:.0} mm/s")
}

/// The end of an axis of forces.
pub fn force(force_n: f64) -> String {
    format!("{force_n:.1} N")
}

#[cfg(test)]
mod tests {
    use super::{count, range, region};
    use crate::library_filter::{End, Region};

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
    }

    #[test]
    fn numbers_read_as_they_are_meant() {
        assert_eq!([count(25, 25), count(1, 1), count(0, 1)], ["25 textures", "1 texture", "0 of 1"]);
        assert_eq!([range("1", "1", "N"), range("1", "2", "N")], ["1 N", "1 to 2 N"]);
    }
}
