//! Suggestions for unknown names of textures.

use shagreen_formats::library::Library;

/// Returns the error message for an unknown texture, with similar names.
pub fn unknown_texture(library: &Library, id: &str) -> String {
    format!("the library has no texture \"{id}\"; {}", meant(library, id))
}

/// Returns similar names for an unknown texture, as a question, or the command that lists all.
pub fn meant(library: &Library, id: &str) -> String {
    let near = near_ids(library, id);
    if near.is_empty() {
        "`shagreen library list` shows all textures".to_owned()
    } else {
        format!("did you mean {}?", near.join(", "))
    }
}

/// Returns up to three identifiers similar to `id`, the most similar first.
fn near_ids<'a>(library: &'a Library, id: &str) -> Vec<&'a str> {
    let wanted = id.to_lowercase();
    let mut near: Vec<(usize, &str)> = library
        .textures
        .iter()
        .filter_map(|texture| {
            let distance = strsim::levenshtein(&wanted, &texture.id.to_lowercase());
            let is_part = wanted.len() > 2 && texture.id.contains(&wanted);
            let is_near = distance <= 1 + wanted.chars().count() / 3;
            (is_part || is_near).then_some((if is_part { 0 } else { distance }, texture.id.as_str()))
        })
        .collect();
    near.sort_unstable();
    near.into_iter().take(3).map(|(_, id)| id).collect()
}

#[cfg(test)]
mod tests {
    use super::meant;
    use shagreen_formats::starter::starter_library;

    #[test]
    fn near_names_are_offered_nearest_first() {
        let library = starter_library().unwrap();
        assert_eq!(meant(&library, "crok"), "did you mean cork?");
        assert!(meant(&library, "rubber").contains("flat-rubber"), "a part of a name");
        assert!(meant(&library, "zzzzzzzz").contains("library list"));
    }
}
