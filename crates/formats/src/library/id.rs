//! Identifiers of textures: made from names, unique in a library.

use crate::library::Library;

/// The identifier that a name suggests: its letters and digits in lower case, all else as single hyphens.
pub fn id_from_name(name: &str) -> String {
    let words = name.split(|c: char| !c.is_alphanumeric()).filter(|word| !word.is_empty());
    let id = words.map(str::to_lowercase).collect::<Vec<_>>().join("-");
    if id.is_empty() { "texture".to_owned() } else { id }
}

impl Library {
    /// `id` where it is free, else `id-2`, `id-3` and so on.
    pub fn free_id(&self, id: &str) -> String {
        if self.index_of(id).is_none() {
            return id.to_owned();
        }
        // One more than there are textures is tried, so one is free.
        (2..usize::MAX)
            .map(|n| format!("{id}-{n}"))
            .find(|id| self.index_of(id).is_none())
            .unwrap_or_default()
    }
}

#[cfg(test)]
mod tests {
    use super::id_from_name;
    use crate::starter::starter_library;

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
    fn a_taken_identifier_gets_a_number() {
        let mut library = starter_library().unwrap();
        assert_eq!(library.free_id("moon"), "moon");
        assert_eq!(library.free_id("glass"), "glass-2");
        library.textures[1].id = "glass-2".to_owned();
        assert_eq!(library.free_id("glass"), "glass-3");
    }
}
