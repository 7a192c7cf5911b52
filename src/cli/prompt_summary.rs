//! Summary of how a prompt was understood, and of what a picture adds to it.

use shagreen_core::surfaces::generated::Witness;
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

/// Returns a sentence about attributes of which prompt and picture predict different values; `None` without any.
pub(crate) fn disagreement(disputed: &[&str], witness: Witness) -> Option<String> {
    if disputed.is_empty() {
        return None;
    }
    let names = disputed.join(" and ");
    Some(match witness {
        Witness::OnItsOwn => format!("the prompt and the picture predict different values of {names}"),
        Witness::OfTheWords => format!(
            "the procedural picture looks different from the prompt in {names}; the prediction is that of the prompt"
        ),
    })
}

#[cfg(test)]
mod tests {
    use super::disagreement;
    use shagreen_core::surfaces::generated::Witness;

    #[test]
    fn a_picture_that_differs_is_reported_by_what_it_adds() {
        assert_eq!(disagreement(&[], Witness::OnItsOwn), None);
        let both = disagreement(&["rough-smooth", "hard-soft"], Witness::OnItsOwn).unwrap();
        assert!(both.ends_with("different values of rough-smooth and hard-soft"), "{both}");
        let of_the_words = disagreement(&["hard-soft"], Witness::OfTheWords).unwrap();
        assert!(of_the_words.contains("the prediction is that of the prompt"), "{of_the_words}");
    }
}
