//! Words about comparing two authored textures.

/// Heading.
pub const HEADING: &str = "Compare";
/// What comparing is.
pub const HELP: &str = "Hear two authored textures in turn under the same stroke (keys 1 and 2). X (key 3) is one of the two: say which.";
/// Hides which is which.
pub const BLIND: &str = "Blind";
/// What that does.
pub const BLIND_HELP: &str =
    "Exchanges A and B by chance and hides which is which, until you take the tick away";
/// Nothing may be shown.
pub const HIDDEN: &str = "Hidden while you listen blind";
/// There is nothing to compare.
pub const NEEDS_TWO: &str = "Author two textures to compare them";

/// Accessible name of the button that lets a side be heard.
pub fn hear(letter: &str) -> String {
    format!("Hear {letter}")
}

/// What is on a side.
pub fn is_on(letter: &str, name: &str) -> String {
    format!("{letter}: {name}")
}

/// Answers what X is.
pub fn x_is(letter: &str) -> String {
    format!("X is {letter}")
}

/// Puts a texture on a side.
pub fn compare_as(letter: &str) -> String {
    format!("Compare as {letter}")
}

/// How many answers were right, and how likely that is by chance.
pub fn right(n_right: u64, n_answers: u64, chance: f64) -> String {
    let p = if chance < 0.001 { "p < 0.001".to_owned() } else { format!("p = {chance:.3}") };
    format!("{n_right} of {n_answers} right, {p}")
}
