//! Titles of figures, split into lines that fit their width.

/// Approximate width of a character of a title in pixels, for a wide font.
const CHARACTER: f64 = 9.0;
/// Maximum number of lines; the rest of a longer title is cut and marked by an ellipsis.
const MAX_LINES: usize = 3;

/// Splits a title at spaces into lines of at most `width` pixels; at least one line, which may be empty.
pub(super) fn lines(title: &str, width: f64) -> Vec<String> {
    let n_fit = ((width / CHARACTER) as usize).max(1);
    let mut lines = vec![String::new()];
    for word in title.split(' ') {
        let n_lines = lines.len();
        let Some(line) = lines.last_mut() else { break };
        if line.is_empty() {
            word.clone_into(line);
        } else if line.chars().count() + 1 + word.chars().count() <= n_fit {
            line.push(' ');
            line.push_str(word);
        } else if n_lines < MAX_LINES {
            lines.push(word.to_owned());
        } else {
            line.push('…');
            break;
        }
    }
    for line in &mut lines {
        if line.chars().count() > n_fit + 1 {
            *line = line.chars().take(n_fit).chain(['…']).collect();
        }
    }
    lines
}

#[cfg(test)]
mod tests {
    use proptest::prelude::{prop_assert, proptest};

    use super::{MAX_LINES, lines};

    #[test]
    fn a_long_title_stands_on_several_lines() {
        // Ten characters fit.
        assert_eq!(lines("one two three four", 95.0), ["one two", "three four"]);
        assert_eq!(lines("Stress", 95.0), ["Stress"]);
        assert_eq!(lines("", 95.0), [""]);
        assert_eq!(
            lines("aaaaaaaaaa bbbbbbbbbb cccccccccc dd", 95.0),
            ["aaaaaaaaaa", "bbbbbbbbbb", "cccccccccc…"]
        );
        assert_eq!(lines("incomprehensibilities", 95.0), ["incomprehe…"]);
        let title = "rough–smooth: nested cross-validation r 0.68, p = 0.007; r 0.86 with features selected on all textures (human ratings)";
        assert_eq!(lines(title, 544.0).join(" "), title);
    }

    proptest! {
        #[test]
        fn every_line_fits(title in "[a-z ]{0,200}", width in 20.0_f64..900.0) {
            let all = lines(&title, width);
            prop_assert!((1..=MAX_LINES).contains(&all.len()));
            // An ellipsis may stand after the last character that fits.
            prop_assert!(all.iter().all(|line| line.chars().count() as f64 <= (width / 9.0).max(1.0) + 1.0));
        }
    }
}
