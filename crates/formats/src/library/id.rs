//! Unique names and identifiers for textures that are added to a library, derived from file names.

use crate::text_limits::{MAX_ID, begin_of};

/// Derives a name from a file name: without extension, with spaces between words, and capitalized.
pub fn name_from_file(file_name: &str) -> String {
    let stem = file_name.rsplit_once('.').map_or(file_name, |(stem, _)| stem);
    let words = stem.replace(['_', '-'], " ");
    let mut letters = words.trim().chars();
    match letters.next() {
        Some(first) => first.to_uppercase().chain(letters).collect(),
        None => "Texture".to_owned(),
    }
}

/// Derives an identifier from a name: letters and digits in lower case, everything else as single hyphens.
pub fn id_from_name(name: &str) -> String {
    let words = name.split(|c: char| !c.is_alphanumeric()).filter(|word| !word.is_empty());
    let id = words.map(str::to_lowercase).collect::<Vec<_>>().join("-");
    // A number may follow, so that the identifier is free.
    let id = begin_of(id, MAX_ID - 20);
    if id.is_empty() { "texture".to_owned() } else { id }
}

/// Returns `id` if it is free, else `id-2`, `id-3` and so on.
pub fn free_id(id: &str, is_taken: impl Fn(&str) -> bool) -> String {
    first_free(id, '-', is_taken)
}

/// Returns `name` if it is free, else `name 2`, `name 3` and so on.
pub fn free_name(name: &str, is_taken: impl Fn(&str) -> bool) -> String {
    first_free(name, ' ', is_taken)
}

fn first_free(word: &str, separator: char, is_taken: impl Fn(&str) -> bool) -> String {
    let numbered = (2_u64..).map(|n| format!("{word}{separator}{n}"));
    // The numbers cannot run out before the memory does.
    std::iter::once(word.to_owned()).chain(numbered).find(|word| !is_taken(word)).unwrap_or_default()
}

#[cfg(test)]
mod tests {
    use super::{free_id, free_name, id_from_name, name_from_file};

    #[test]
    fn names_become_identifiers() {
        for (name, id) in [
            ("ABS Plastic", "abs-plastic"),
            ("  Cork (No. 2)! ", "cork-no-2"),
            ("Straße Äpfel", "straße-äpfel"),
            ("木", "木"),
            ("***", "texture"),
            ("", "texture"),
        ] {
            assert_eq!(id_from_name(name), id);
        }
    }

    #[test]
    fn files_become_names() {
        for (file, name) in
            [("sanded_wood-01.csv", "Sanded wood 01"), (".csv", "Texture"), ("öl.v2.wav", "Öl.v2")]
        {
            assert_eq!(name_from_file(file), name);
        }
    }

    #[test]
    fn a_taken_identifier_gets_a_number() {
        let taken = ["glass", "glass-2"];
        assert_eq!(free_id("moon", |id| taken.contains(&id)), "moon");
        assert_eq!(free_id("glass", |id| taken.contains(&id)), "glass-3");
        assert_eq!(free_name("glass", |name| taken.contains(&name)), "glass 2");
    }
}
