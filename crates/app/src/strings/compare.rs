//! Comparison of two authored textures.

pub const HEADING: &str = "Compare";
pub const HELP: &str = "ABX comparison of two authored textures under the same stroke. Keys 1 and 2 play A and B. Key 3 plays X, which is A or B at random: choose which one it is.";
pub const BLIND: &str = "Blind";
pub const BLIND_HELP: &str =
    "Assigns the two textures to A and B at random and hides the assignment, until you clear this box";
pub const HIDDEN: &str = "Hidden (blind)";
/// Empty part of the inspector in a blind comparison.
pub const HIDDEN_HELP: &str = "The comparison is blind: name, position, shape and contributions of the audible texture are hidden until it ends. Play A, B and X with the buttons on the left, and choose which of A and B is X.";
pub const SELECTED: &str = "Selected: edits apply to this texture after the comparison.";
pub const EDIT: &str = "Edit";
pub const EDIT_HELP: &str = "Ends the comparison and selects this texture, so that you can edit it.";
pub const END: &str = "End comparison";
pub const END_HELP: &str = "Plays the selected texture again, so that you can edit it (Escape).";
pub const RESULT_HELP: &str = "p is the probability of at least as many correct answers by guessing. Below 0.05, guessing is an unlikely explanation. A few answers prove little: five correct ones of five are the first that get there.";
pub const NEEDS_TWO: &str = "A comparison needs two authored textures; add another one";

/// Accessible name of the button that plays a side.
pub fn hear(letter: &str) -> String {
    format!("Play {letter}")
}

/// Side and texture that are audible.
pub fn you_hear(letter: &str, name: &str) -> String {
    format!("You hear {letter}: {name}")
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

/// Probability below which guessing alone is an unlikely explanation of the answers: the usual level of significance.
const UNLIKELY: f64 = 0.05;

/// Number of correct answers, what it means, and `chance`, the probability of at least as many by guessing.
pub fn right(n_right: u64, n_answers: u64, chance: f64) -> String {
    let p = if chance < 0.001 { "p < 0.001".to_owned() } else { format!("p = {chance:.3}") };
    let meaning = if chance < UNLIKELY { "better than guessing" } else { "may be guessing" };
    format!("{n_right} of {n_answers} correct: {meaning} ({p})")
}

#[cfg(test)]
mod tests {
    use super::right;

    #[test]
    fn the_result_says_what_it_means_before_the_probability() {
        assert_eq!(right(1, 2, 0.75), "1 of 2 correct: may be guessing (p = 0.750)");
        assert_eq!(right(5, 5, 0.03125), "5 of 5 correct: better than guessing (p = 0.031)");
        assert!(right(20, 20, 1e-6).ends_with("(p < 0.001)"));
    }
}
