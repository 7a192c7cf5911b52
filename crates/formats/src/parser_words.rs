//! Messages of the parsers of JSON and TOML, in the words of their users.

/// Messages of the JSON parser that stand alone.
const SENTENCES: [(&str, &str); 22] = [
    ("EOF while parsing a list", "it ends too early"),
    ("EOF while parsing an object", "it ends too early"),
    ("EOF while parsing a string", "it ends too early"),
    ("EOF while parsing a value", "it ends too early"),
    ("expected `:`", "a colon is missing"),
    ("expected `,` or `]`", "a comma or `]` is missing"),
    ("expected `,` or `}`", "a comma or `}` is missing"),
    ("expected ident", "a value is missing or is not valid"),
    ("expected value", "a value is missing or is not valid"),
    ("expected `\"`", "a quotation mark is missing"),
    ("invalid escape", "a text contains an escape that JSON does not have"),
    ("invalid number", "a number is not valid"),
    ("number out of range", "a number is too large"),
    ("invalid unicode code point", "a text contains the escape of a character that does not exist"),
    ("lone leading surrogate in hex escape", "a text contains the escape of a character that does not exist"),
    ("unexpected end of hex escape", "a text contains the escape of a character that does not exist"),
    (
        "control character (\\u0000-\\u001F) found while parsing a string",
        "a text contains a line break or another control character",
    ),
    ("key must be a string", "the name of a field is not in quotation marks"),
    ("trailing comma", "a comma follows the last value"),
    ("trailing characters", "more text follows its end"),
    ("recursion limit exceeded", "its lists and objects are nested too deeply"),
    ("duplicate key", "a field is given twice"),
];

/// Words of the parsers for what was found.
const FOUND: [(&str, &str); 5] = [
    ("map", "an object"),
    ("sequence", "a list"),
    ("null", "no value (null)"),
    ("unit value", "no value (null)"),
    ("byte array", "a list of bytes"),
];

/// Words of the parsers for what is needed. Other types have the words of this program.
const NEEDED: [(&str, &str); 20] = [
    ("f32", "a number"),
    ("f64", "a number"),
    ("u8", "a whole number, 0 or greater"),
    ("u16", "a whole number, 0 or greater"),
    ("u32", "a whole number, 0 or greater"),
    ("u64", "a whole number, 0 or greater"),
    ("usize", "a whole number, 0 or greater"),
    ("i8", "a whole number"),
    ("i16", "a whole number"),
    ("i32", "a whole number"),
    ("i64", "a whole number"),
    ("isize", "a whole number"),
    ("a string", "a text"),
    ("a borrowed string", "a text"),
    ("string", "a text"),
    ("a boolean", "true or false"),
    ("a sequence", "a list"),
    ("a map", "an object"),
    ("map", "an object"),
    ("string or map", "a text or an object"),
];

/// Returns a message of the parsers as a clause for "the file is damaged: …", with its line and column at the end.
pub(crate) fn plain(message: &str) -> String {
    let message = message.replace('\n', " ");
    let located = message.rsplit_once(" at line ").and_then(|(words, place)| {
        let (line, column) = place.split_once(" column ")?;
        let is_number = |text: &str| text.bytes().all(|byte| byte.is_ascii_digit());
        (is_number(line) && is_number(column)).then(|| (words, format!(" (line {line}, column {column})")))
    });
    match located {
        Some((words, place)) => clause(words) + &place,
        None => clause(&message),
    }
}

fn clause(words: &str) -> String {
    if let Some((_, ours)) = SENTENCES.iter().find(|(theirs, _)| *theirs == words) {
        return (*ours).to_owned();
    }
    if let Some(name) = words.strip_prefix("missing field ") {
        return format!("the field {name} is missing");
    }
    if let Some(name) = words.strip_prefix("duplicate field ") {
        return format!("the field {name} is given twice");
    }
    if let Some(rest) = words.strip_prefix("unknown field ") {
        return match rest.split_once(", expected ") {
            Some((name, known)) => {
                format!("the field {name} is unknown; the known fields are {}", without_one_of(known))
            }
            None => format!("the field {} is unknown", rest.split(", ").next().unwrap_or(rest)),
        };
    }
    if let Some((name, known)) =
        words.strip_prefix("unknown variant ").and_then(|rest| rest.split_once(", expected "))
    {
        return format!("{name} is unknown; the known words are {}", without_one_of(known));
    }
    for prefix in ["invalid type: ", "invalid value: "] {
        // A text that was found may contain these words itself.
        if let Some((found, needed)) =
            words.strip_prefix(prefix).and_then(|rest| rest.rsplit_once(", expected "))
        {
            return format!("it has {} where {} is needed", found_words(found), needed_words(needed));
        }
    }
    if let Some((n, needed)) =
        words.strip_prefix("invalid length ").and_then(|rest| rest.split_once(", expected "))
    {
        return format!("it has a list of length {n} where {} is needed", needed_words(needed));
    }
    if words.starts_with("data did not match any variant of untagged enum") {
        return "a value has none of the possible forms".to_owned();
    }
    match words.rsplit_once(", expected ") {
        Some((wrong, needed)) => format!("{wrong}; it needs {needed}"),
        None => words.to_owned(),
    }
}

fn without_one_of(known: &str) -> &str {
    known.strip_prefix("one of ").unwrap_or(known)
}

fn found_words(found: &str) -> String {
    if let Some((_, ours)) = FOUND.iter().find(|(theirs, _)| *theirs == found) {
        return (*ours).to_owned();
    }
    let quoted = |prefix: &str| Some(found.strip_prefix(prefix)?.trim_matches('`'));
    if let Some(number) = quoted("integer ").or_else(|| quoted("floating point ")) {
        return format!("the number {number}");
    }
    if let Some(truth) = quoted("boolean ") {
        return truth.to_owned();
    }
    match found.strip_prefix("string ").or_else(|| found.strip_prefix("character ")) {
        Some(text) => format!("the text {text}"),
        None => found.to_owned(),
    }
}

fn needed_words(needed: &str) -> String {
    if let Some((_, ours)) = NEEDED.iter().find(|(theirs, _)| *theirs == needed) {
        return (*ours).to_owned();
    }
    if needed.starts_with("struct ") {
        return "an object".to_owned();
    }
    let length =
        needed.strip_prefix("an array of length ").or_else(|| needed.strip_prefix("a tuple of size "));
    length.map_or_else(|| needed.to_owned(), |n| format!("a list of length {n}"))
}

#[cfg(test)]
mod tests {
    use super::plain;
    use serde::Deserialize;

    #[test]
    fn messages_are_in_plain_words() {
        for (theirs, ours) in [
            ("missing field `x` at line 1 column 2", "the field `x` is missing (line 1, column 2)"),
            ("invalid type: map, expected f64", "it has an object where a number is needed"),
            (
                "invalid type: string \"a, expected b\", expected u32 at line 3 column 14",
                "it has the text \"a, expected b\" where a whole number, 0 or greater is needed (line 3, column 14)",
            ),
            (
                "invalid value: integer `-1`, expected u8",
                "it has the number -1 where a whole number, 0 or greater is needed",
            ),
            (
                "invalid length 3, expected an array of length 2",
                "it has a list of length 3 where a list of length 2 is needed",
            ),
            (
                "unknown field `a`, expected one of `b`, `c`, `d`",
                "the field `a` is unknown; the known fields are `b`, `c`, `d`",
            ),
            ("unknown field `a`, there are no fields", "the field `a` is unknown"),
            ("unknown variant `a`, expected `b` or `c`", "`a` is unknown; the known words are `b` or `c`"),
            ("EOF while parsing a list at line 7 column 0", "it ends too early (line 7, column 0)"),
            ("key with no value, expected `=`", "key with no value; it needs `=`"),
            ("string values must be quoted", "string values must be quoted"),
        ] {
            assert_eq!(plain(theirs), ours);
        }
    }

    #[derive(Debug, Deserialize)]
    #[serde(deny_unknown_fields)]
    #[expect(dead_code, reason = "only its errors are read")]
    struct Sample {
        number: f64,
        count: u32,
        pair: [f64; 2],
        word: Word,
    }

    #[derive(Debug, Deserialize)]
    #[serde(rename_all = "kebab-case")]
    enum Word {
        One,
        Two,
    }

    /// The parsers still use the words that are translated.
    #[test]
    fn no_word_of_the_parsers_is_left() {
        let good = r#"{"number": 1.5, "count": 2, "pair": [1, 2], "word": "one"}"#;
        assert!(matches!(serde_json::from_str::<Sample>(good), Ok(Sample { word: Word::One, .. })));
        for (from, to) in [
            ("1.5", "{}"),
            ("1.5", "null"),
            ("1.5", "1e999"),
            ("1.5", "x"),
            ("\"count\": 2,", ""),
            ("\"count\": 2", "\"count\": -2"),
            ("\"count\": 2", "\"count\": 2, \"count\": 3"),
            ("\"count\": 2", "\"more\": 2"),
            ("[1, 2]", "[1]"),
            ("[1, 2]", "[1, 2, 3]"),
            ("[1, 2]", "\"both\""),
            ("\"one\"", "\"three\""),
            ("\"one\"", "7"),
            ("}", ""),
            ("}", "} {"),
            (", \"pair\"", " \"pair\""),
            ("\"count\": 2", "\"count\" 2"),
        ] {
            let text = good.replacen(from, to, 1);
            let theirs = serde_json::from_str::<Sample>(&text).unwrap_err().to_string();
            let ours = plain(&theirs);
            for word in ["expected", "invalid", "EOF", " at line ", "f64", "u32", "map", "variant", "ident"] {
                assert!(!ours.contains(word), "{theirs:?} became {ours:?}");
            }
            assert!(ours.contains("(line 1, column "), "{ours}");
        }
    }
}
