//! Names and identifiers of textures that join a library.

use crate::strings::import as strings;

/// A name to show, from the name of a file.
pub(super) fn name_from(file: &str) -> String {
    let stem = file.rsplit_once('.').map_or(file, |(stem, _)| stem);
    let words = stem.replace(['_', '-'], " ");
    let mut letters = words.trim().chars();
    match letters.next() {
        Some(first) => first.to_uppercase().chain(letters).collect(),
        None => strings::UNNAMED.to_owned(),
    }
}

/// An identifier from a name: letters and digits in lower case, parted by hyphens.
pub(super) fn slug(name: &str) -> String {
    let lower = name.to_lowercase();
    let words: Vec<&str> = lower.split(|c: char| !c.is_alphanumeric()).filter(|w| !w.is_empty()).collect();
    if words.is_empty() { "texture".to_owned() } else { words.join("-") }
}

/// The identifier, or with a number behind it where it is taken; it is taken then.
pub(super) fn unique_id(wanted: &str, taken: &mut Vec<String>) -> String {
    let numbered = (2..).map(|n| format!("{wanted}-{n}"));
    let id = std::iter::once(wanted.to_owned()).chain(numbered).find(|id| !taken.contains(id));
    // The numbers do not run out before the memory does.
    let id = id.unwrap_or_else(|| wanted.to_owned());
    taken.push(id.clone());
    id
}

#[cfg(test)]
mod tests {
    use super::{name_from, slug, unique_id};

    #[test]
    fn names_and_identifiers_follow_from_files() {
        assert_eq!(name_from("sanded_wood-01.csv"), "Sanded wood 01");
        assert_eq!(name_from(".csv"), crate::strings::import::UNNAMED);
        assert_eq!(slug("Sanded wood, Nº 1"), "sanded-wood-nº-1");
        assert_eq!(slug("—"), "texture");
        let mut taken = vec!["cork".to_owned()];
        assert_eq!(unique_id("cork", &mut taken), "cork-2");
        assert_eq!(unique_id("cork", &mut taken), "cork-3");
        assert_eq!(unique_id("felt", &mut taken), "felt");
    }
}
