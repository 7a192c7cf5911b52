//! Splits a prompt into words, lengths and clause breaks.

/// A token of a prompt.
#[derive(Clone, Debug, PartialEq)]
pub(super) enum Token {
    /// A lower-case word.
    Word(String),
    /// A number with a unit of length.
    Length {
        /// Text in the prompt.
        text: String,
        /// Length in m.
        meters: f64,
    },
    /// The end of a clause: modifiers do not apply across it.
    Break,
}

impl Token {
    pub(super) fn word(&self) -> Option<&str> {
        match self {
            Self::Word(word) => Some(word),
            Self::Length { .. } | Self::Break => None,
        }
    }
}

/// Limits of a pattern's period, in m.
const LENGTHS_M: std::ops::RangeInclusive<f64> = 1e-4..=2e-2;

/// Splits a prompt into tokens. Apostrophes are removed, as in "isnt"; hyphens separate words.
pub(super) fn tokens(prompt: &str) -> Vec<Token> {
    let mut tokens = Vec::new();
    let mut word = String::new();
    let lowercase = prompt.to_lowercase();
    let mut letters = lowercase.chars().peekable();
    while let Some(letter) = letters.next() {
        let is_decimal = (letter == '.' || letter == ',')
            && word.chars().last().is_some_and(|c| c.is_ascii_digit())
            && letters.peek().is_some_and(char::is_ascii_digit);
        if is_decimal {
            word.push('.');
        } else if letter.is_alphanumeric() || is_mark(letter) {
            word.push(letter);
        } else if !matches!(letter, '\'' | '\u{2019}') {
            push(&mut tokens, &mut word);
            if matches!(
                letter,
                ',' | '.' | ';' | ':' | '!' | '?' | '(' | ')' | '\n' | '\u{3001}' | '\u{3002}'
            ) {
                tokens.push(Token::Break);
            }
        }
    }
    push(&mut tokens, &mut word);
    tokens
}

/// Whether a character is a combining mark that belongs to the letter before it.
fn is_mark(letter: char) -> bool {
    matches!(letter, '\u{300}'..='\u{36f}' | '\u{900}'..='\u{dff}' | '\u{e31}'..='\u{e4e}')
}

/// Ends a word; a number followed by a unit, with or without a space, becomes a length.
fn push(tokens: &mut Vec<Token>, word: &mut String) {
    if word.is_empty() {
        return;
    }
    let word = std::mem::take(word);
    let digits = word.find(|c: char| !c.is_ascii_digit() && c != '.').unwrap_or(word.len());
    let (number, unit) = word.split_at(digits);
    if let Some(meters) = length(number, unit) {
        tokens.push(Token::Length { meters, text: word });
        return;
    }
    if let Some(Token::Word(before)) = tokens.last()
        && let Some(meters) = length(before, &word)
    {
        let text = format!("{before} {word}");
        tokens.pop();
        tokens.push(Token::Length { text, meters });
        return;
    }
    tokens.push(Token::Word(word));
}

/// Returns a length in m, limited to [`LENGTHS_M`]; `None` unless number and unit are valid.
fn length(number: &str, unit: &str) -> Option<f64> {
    let meters = match unit {
        "mm" | "millimeter" | "millimeters" | "millimetre" | "millimetres" => 1e-3,
        "cm" | "centimeter" | "centimeters" | "centimetre" | "centimetres" => 1e-2,
        "um" | "\u{b5}m" | "\u{3bc}m" | "micron" | "microns" | "micrometer" | "micrometers" => 1e-6,
        "inch" | "inches" => 25.4e-3,
        _ => return None,
    };
    // Text that does not parse as a number is not a length.
    let number: f64 = number.parse().ok()?;
    Some((number * meters).clamp(*LENGTHS_M.start(), *LENGTHS_M.end())).filter(|_| number > 0.0)
}

/// Returns the words a phrase may be an inflection of, most likely first.
///
/// Covers plurals, comparatives, adverbs, and words ending in "-like" and "-ish".
pub(super) fn stems(phrase: &str) -> Vec<String> {
    const ENDINGS: [(&str, &[&str]); 13] = [
        ("ies", &["y"]),
        ("es", &["e", ""]),
        ("s", &[""]),
        ("iest", &["y"]),
        ("ier", &["y"]),
        ("est", &["", "e"]),
        ("er", &["", "e"]),
        ("ily", &["y"]),
        ("ly", &["", "le"]),
        ("ish", &["", "e"]),
        ("like", &[""]),
        ("ness", &[""]),
        ("ed", &["", "e"]),
    ];
    const SHORTEST_STEM: usize = 3;
    let mut stems = Vec::new();
    for (ending, replacements) in ENDINGS {
        let Some(stem) = phrase.strip_suffix(ending).filter(|stem| stem.chars().count() >= SHORTEST_STEM)
        else {
            continue;
        };
        stems.extend(replacements.iter().map(|replacement| format!("{stem}{replacement}")));
        // A doubled final letter is reduced: "flatter" comes from "flat".
        let mut letters = stem.chars().rev();
        if let (Some(last), Some(before)) = (letters.next(), letters.next())
            && last == before
        {
            stems.push(stem[..stem.len() - last.len_utf8()].to_owned());
        }
    }
    stems
}

#[cfg(test)]
mod tests {
    use super::{Token, stems, tokens};

    fn words(prompt: &str) -> Vec<String> {
        let text = |token: Token| match token {
            Token::Word(word) => word,
            Token::Length { meters, .. } => format!("<{:.2} mm>", meters * 1e3),
            Token::Break => "|".to_owned(),
        };
        tokens(prompt).into_iter().map(text).collect()
    }

    #[test]
    fn prompts_are_taken_apart() {
        for (prompt, expected) in [
            ("A rough, soft carpet-like surface", "a rough | soft carpet like surface"),
            ("It isn't smooth!", "it isnt smooth |"),
            ("2mm grooves, 0.5 mm dots; 1,5cm", "<2.00 mm> grooves | <0.50 mm> dots | <15.00 mm>"),
            ("300 \u{b5}m and 40 feet", "<0.30 mm> and 40 feet"),
            ("0 mm, 9999 cm", "0 mm | <20.00 mm>"),
            ("RAU UND WEICH", "rau und weich"),
            ("\u{7c97}\u{3044}\u{3001}\u{67d4}", "\u{7c97}\u{3044} | \u{67d4}"),
            ("", ""),
            ("...", "| | |"),
        ] {
            assert_eq!(words(prompt).join(" "), expected, "{prompt}");
        }
    }

    #[test]
    fn inflections_lead_back() {
        for (word, stem) in [
            ("carpets", "carpet"),
            ("brushes", "brush"),
            ("cherries", "cherry"),
            ("flatter", "flat"),
            ("bumpiest", "bumpy"),
            ("finer", "fine"),
            ("roughly", "rough"),
            ("roughish", "rough"),
            ("glasslike", "glass"),
            ("wrinkled", "wrinkle"),
        ] {
            assert!(stems(word).contains(&stem.to_owned()), "{word}: {:?}", stems(word));
        }
        assert!(stems("as").is_empty() && stems("").is_empty());
    }
}
