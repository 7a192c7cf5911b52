//! Suggestions for unknown names.

use shagreen_formats::library::Library;

/// Largest number of suggestions.
const MOST_SUGGESTED: usize = 3;

/// Returns the error message for an unknown texture, with similar names.
pub fn unknown_texture(library: &Library, id: &str) -> String {
    format!("the library has no texture \"{id}\"; {}", meant(library, id))
}

/// Returns similar names for an unknown texture, as a question, or the command that lists all.
pub fn meant(library: &Library, id: &str) -> String {
    let near = near(library.textures.iter().map(|texture| texture.id.as_str()), id);
    if near.is_empty() {
        "`shagreen library list` shows all textures".to_owned()
    } else {
        format!("did you mean {}?", near.join(", "))
    }
}

/// Returns up to three of these names that are similar to `wanted`, the most similar first.
pub(crate) fn near<'a>(names: impl IntoIterator<Item = &'a str>, wanted: &str) -> Vec<&'a str> {
    let wanted = wanted.to_lowercase();
    let similar = |name: &'a str| {
        let distance = strsim::levenshtein(&wanted, &name.to_lowercase());
        let is_part = wanted.len() > 2 && name.contains(&wanted);
        let is_near = distance <= 1 + wanted.chars().count() / 3;
        (is_part || is_near).then_some((if is_part { 0 } else { distance }, name))
    };
    let mut near: Vec<(usize, &str)> = names.into_iter().filter_map(similar).collect();
    near.sort_unstable();
    near.into_iter().take(MOST_SUGGESTED).map(|(_, name)| name).collect()
}

#[cfg(test)]
mod tests {
    use super::{meant, near};
    use shagreen_formats::starter::starter_library;

    #[test]
    fn near_names_are_offered_nearest_first() {
        let library = starter_library().unwrap();
        assert_eq!(meant(&library, "crok"), "did you mean cork?");
        assert!(meant(&library, "rubber").contains("flat-rubber"), "a part of a name");
        assert!(meant(&library, "zzzzzzzz").contains("library list"));
        assert_eq!(near(["rough-smooth", "hard-soft"], "Rough-Smoth"), ["rough-smooth"]);
    }
}
