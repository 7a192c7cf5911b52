//! Length limits of texts in files. A name of megabytes would take gigabytes of memory to draw.

/// Longest identifier, in characters.
pub const MAX_ID: usize = 200;
/// Longest name or tag, in characters.
pub const MAX_NAME: usize = 1000;
/// Longest description, license, origin or notes, in characters.
pub const MAX_NOTES: usize = 200_000;

/// A text that is longer than its limit.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error("{what} \"{begin}…\" has {n} characters, but at most {most} are possible; shorten it")]
pub struct TooLong {
    /// What the text is, for example "the name of a texture".
    pub what: &'static str,
    /// Its first characters.
    pub begin: String,
    /// Its number of characters.
    pub n: usize,
    /// The limit.
    pub most: usize,
}

/// Checks the length of a text in characters.
///
/// # Errors
/// [`TooLong`] above `most`.
pub(crate) fn check(what: &'static str, text: &str, most: usize) -> Result<(), TooLong> {
    // A character has at least one byte, so short texts need no count.
    if text.len() <= most {
        return Ok(());
    }
    let n = text.chars().count();
    if n <= most { Ok(()) } else { Err(TooLong { what, begin: text.chars().take(20).collect(), n, most }) }
}

/// Returns a text without what exceeds `most` characters, so that a file with it can be read again.
pub fn begin_of(text: String, most: usize) -> String {
    match text.char_indices().nth(most) {
        Some((end, _)) => text[..end].to_owned(),
        None => text,
    }
}

/// Returns a text with this sentence at its end, in at most `most` characters: the text is shortened, not the sentence, unless
/// that alone is too long.
pub fn begin_and_end(begin: &str, end: &str, most: usize) -> String {
    let left = most.saturating_sub(end.chars().count() + 1);
    let begin = begin_of(begin.to_owned(), left);
    begin_of(format!("{begin} {end}").trim_start().to_owned(), most)
}

#[cfg(test)]
mod tests {
    use super::{begin_and_end, begin_of, check};

    #[test]
    fn what_is_cut_off_passes_the_check() {
        assert_eq!(begin_of("äöü".to_owned(), 2), "äö");
        assert_eq!(begin_of("äöü".to_owned(), 3), "äöü");
        assert!(check("it", &begin_of("ä".repeat(50), 10), 10).is_ok());
    }

    #[test]
    fn the_sentence_at_the_end_stays() {
        assert_eq!(begin_and_end("About it.", "New.", 99), "About it. New.");
        assert_eq!(begin_and_end("", "New.", 99), "New.");
        assert_eq!(begin_and_end("äöüß", "Neü.", 7), "äö Neü.");
        assert_eq!(begin_and_end("äöü", "New.", 3), "New");
    }

    #[test]
    fn characters_count_and_not_bytes() {
        assert!(check("it", &"ä".repeat(10), 10).is_ok());
        let error = check("it", &"ä".repeat(65_536), 10).unwrap_err().to_string();
        assert!(error.contains("65536 characters") && error.len() < 200, "{error}");
    }
}
