//! Messages of bounded length, whatever the file contains that they quote.

/// Longest message, in characters.
const MOST: usize = 1200;
/// Longest word, in characters. Paths may be longer than names.
const MOST_OF_WORD: usize = 300;
/// Longest run of digits: more than any number of 64 bits has.
const MOST_DIGITS: usize = 24;

/// Returns a message in which long words, long numbers and the message itself are cut in the middle.
pub fn shortened(message: String) -> String {
    if message.len() <= MOST_DIGITS {
        return message;
    }
    let mut text = String::with_capacity(message.len().min(4 * MOST));
    for word in message.split_inclusive(char::is_whitespace) {
        text.push_str(&cut(&without_long_numbers(word), MOST_OF_WORD));
        if text.len() > 64 * MOST {
            break;
        }
    }
    cut(&text, MOST)
}

/// Replaces each long run of digits by its first digits.
fn without_long_numbers(word: &str) -> String {
    let mut text = String::new();
    let mut rest = word;
    while let Some(start) = rest.find(|c: char| c.is_ascii_digit()) {
        let n_digits = rest[start..].bytes().take_while(u8::is_ascii_digit).count();
        let end = start + n_digits;
        if n_digits > MOST_DIGITS {
            text = format!("{text}{}… ({n_digits} digits)", &rest[..start + 6]);
        } else {
            text.push_str(&rest[..end]);
        }
        rest = &rest[end..];
    }
    text + rest
}

/// Keeps the beginning and the end of a text, because an error ends with what to do and where.
fn cut(text: &str, most: usize) -> String {
    let n = text.chars().count();
    if n <= most {
        return text.to_owned();
    }
    let half = most / 2;
    let begin: String = text.chars().take(half).collect();
    let end: String = text.chars().skip(n - half).collect();
    format!("{begin}…{end}")
}

#[cfg(test)]
mod tests {
    use super::{MOST, shortened};

    #[test]
    fn what_a_file_contains_does_not_fill_the_screen() {
        let usual = "cork.csv, line 12: force is -0.4 N; remove the row or fix its sign";
        assert_eq!(shortened(usual.to_owned()), usual);
        let long = format!("the name \"{}\" is taken: /a/b.json", "x".repeat(100_000));
        let short = shortened(long);
        assert!(short.len() < 500 && short.ends_with("/a/b.json") && short.contains('…'), "{short}");
        let huge = format!("{:.1} is out of range", 1e300);
        let short = shortened(huge);
        assert!(short.contains("(301 digits)") && short.ends_with(".0 is out of range"), "{short}");
        assert!(shortened("a b ".repeat(100_000)).chars().count() <= MOST + 1);
        assert_eq!(shortened("ä".repeat(400)).chars().count(), 301);
    }
}
