//! Summary of how a prompt was understood.

use shagreen_core::surfaces::prompt::PromptInterpretation;
use shagreen_core::words::counted;

/// Returns a summary of how a prompt was understood.
pub(crate) fn prompt_summary(understood: &PromptInterpretation) -> String {
    let mut said = Vec::new();
    let taken: Vec<String> = understood
        .words
        .iter()
        .map(|word| {
            let not = if word.is_denied { "not " } else { "" };
            if word.text == word.taken_for {
                format!("{not}{}", word.text)
            } else {
                format!("{not}{} ({})", word.text, word.taken_for)
            }
        })
        .collect();
    if understood.is_about_touch() {
        said.push(format!("understood: {}", taken.join(", ")));
    } else {
        said.push(
            "the prompt contains no words about touch: all attribute values are equally likely".to_owned(),
        );
    }
    if !understood.unknown.is_empty() {
        said.push(format!("not understood: {}", understood.unknown.join(", ")));
    }
    if !understood.disputed.is_empty() {
        said.push(format!("the words contradict each other in {}", understood.disputed.join(", ")));
    }
    if understood.n_left_out > 0 {
        said.push(format!("{} at the end were ignored", counted(understood.n_left_out, "word")));
    }
    said.push("the attributes are estimates from words: no person rated them".to_owned());
    format!("\n{}", said.join("\n"))
}
