//! Suggestions for unknown names.

use shagreen_core::words::near;
use shagreen_formats::library::Library;

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
