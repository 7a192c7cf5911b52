//! Detection of names that differ only in spelling: `P1`, `p 1` and `p01`.

use std::collections::{BTreeMap, BTreeSet};

use crate::named_table::plain;

/// Returns a warning for each group of look-alike names, in alphabetical order; `what` is the plural of the named
/// things. The names stay distinct, because only a person can tell whether they mean the same.
pub fn look_alikes(names: &[&str], what: &str) -> Vec<String> {
    let mut groups: BTreeMap<String, BTreeSet<&str>> = BTreeMap::new();
    for name in names {
        groups.entry(likeness(name)).or_default().insert(name);
    }
    let sentence = |names: BTreeSet<&str>| {
        let quoted: Vec<String> = names.into_iter().map(|name| format!("\"{name}\"")).collect();
        format!(
            "the {what} {} look alike but are treated as different; if they are the same, use one spelling",
            quoted.join(", ")
        )
    };
    groups.into_values().filter(|names| names.len() > 1).map(sentence).collect()
}

/// Returns a key that look-alikes share: it ignores case, blanks, hyphens, underscores, and leading zeros of numbers.
fn likeness(name: &str) -> String {
    let mut likeness = String::new();
    let mut in_number = false;
    let parted = parted_numbers(name);
    let mut characters = parted.chars().filter(|c| !is_unseen(*c)).peekable();
    while let Some(c) = characters.next() {
        let is_padding = c == '0' && !in_number && characters.peek().is_some_and(char::is_ascii_digit);
        if !is_padding {
            likeness.push(c);
            // Zeros after a decimal point are significant.
            in_number = c.is_ascii_digit() || (in_number && c == '.');
        }
    }
    likeness
}

/// Normalizes a name but keeps a separator between digits: `1-11` differs from `11-1`.
fn parted_numbers(name: &str) -> String {
    let mut parts = name.split([' ', '_', '-', '\u{2013}']).map(plain).filter(|p| !p.is_empty());
    let mut whole = parts.next().unwrap_or_default();
    for part in parts {
        if whole.ends_with(|c: char| c.is_ascii_digit()) && part.starts_with(|c: char| c.is_ascii_digit()) {
            whole.push('-');
        }
        whole.push_str(&part);
    }
    whole
}

/// Returns whether a character is invisible: white space of any kind, including zero width.
fn is_unseen(c: char) -> bool {
    c.is_whitespace() || matches!(c, '\u{200b}'..='\u{200d}' | '\u{2060}' | '\u{feff}')
}

#[cfg(test)]
mod tests {
    use super::look_alikes;

    #[test]
    fn names_that_a_hand_mixes_up_are_told() {
        let told = look_alikes(&["p1", "P1", "p2", "p 01", "P1", "anna"], "participants");
        assert_eq!(told.len(), 1);
        assert!(told[0].starts_with("the participants \"P1\", \"p 01\", \"p1\" look alike"), "{told:?}");
        assert_eq!(look_alikes(&["a_b", "A-B", "x", "X"], "participants").len(), 2);
        assert_eq!(look_alikes(&["a b", "a\u{a0}b", "c", "c\u{200b}"], "participants").len(), 2);
        assert_eq!(look_alikes(&["p1-01", "p1 1"], "participants").len(), 1);
        let different = ["s1-11", "s11-1", "p1.5", "p1.05"];
        assert_eq!(look_alikes(&different, "participants"), [] as [&str; 0]);
        let different = ["p1", "p10", "p100", "p0", "p00x", "p", "1p", "p1a"];
        assert_eq!(look_alikes(&different, "participants"), [] as [&str; 0]);
    }
}
