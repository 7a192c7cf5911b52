//! Comparison of two authored textures.

pub const HEADING: &str = "Compare";
pub const HELP: &str = "Plays two authored textures in turn under the same stroke (keys 1 and 2). X (key 3) is randomly A or B: identify it.";
pub const BLIND: &str = "Blind";
pub const BLIND_HELP: &str = "Assigns A and B at random and hides which is which, until you clear this box";
pub const HIDDEN: &str = "Hidden during a blind comparison";
pub const NEEDS_TWO: &str = "Author two textures to compare them";

/// Accessible name of the button that plays a side.
pub fn hear(letter: &str) -> String {
    format!("Play {letter}")
}

/// Texture that is assigned to a side.
pub fn is_on(letter: &str, name: &str) -> String {
    format!("{letter}: {name}")
}

pub fn x_is(letter: &str) -> String {
    format!("X is {letter}")
}

pub fn compare_as(letter: &str) -> String {
    format!("Compare as {letter}")
}

/// Number of correct answers; `chance` is the probability of at least as many by guessing.
pub fn right(n_right: u64, n_answers: u64, chance: f64) -> String {
    let p = if chance < 0.001 { "p < 0.001".to_owned() } else { format!("p = {chance:.3}") };
    format!("{n_right} of {n_answers} correct, {p}")
}
