//! What there is to say of how a prompt was understood.

use shagreen_core::prompt::Understood;
use shagreen_core::words::counted;

/// What there is to say of how words were understood.
pub(crate) fn said_of(understood: &Understood) -> String {
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
        said.push("nothing was said that can be felt: any surface is as likely".to_owned());
    }
    if !understood.unknown.is_empty() {
        said.push(format!("not understood: {}", understood.unknown.join(", ")));
    }
    if !understood.disputed.is_empty() {
        said.push(format!("the words disagree about {}", understood.disputed.join(", ")));
    }
    if understood.n_left_out > 0 {
        said.push(format!("{} at the end were left out", counted(understood.n_left_out, "word")));
    }
    said.push("estimates of words: nobody rated them".to_owned());
    format!("\n{}", said.join("\n"))
}
