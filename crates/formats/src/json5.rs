//! JSON5 as JSON: comments, names without quotes, texts in single quotes, commas after the last value, and signs and points of
//! numbers that JSON does not allow.

use std::iter::Peekable;
use std::str::Chars;

/// Returns a text of JSON5 as JSON, with its lines. Errors stay for the parser of JSON to find, and so do hexadecimal and
/// infinite numbers, which JSON does not have.
pub(crate) fn json_of_json5(text: &str) -> String {
    let json = String::with_capacity(text.len());
    let mut converter = Converter { rest: text.chars().peekable(), json, has_comma: false };
    converter.convert();
    converter.json
}

struct Converter<'a> {
    rest: Peekable<Chars<'a>>,
    json: String,
    /// Whether a comma was read but not written: one before the end of a list or an object is left out.
    has_comma: bool,
}

impl Converter<'_> {
    fn convert(&mut self) {
        while let Some(found) = self.rest.next() {
            match found {
                '/' if self.rest.peek() == Some(&'/') => self.skip_line(),
                '/' if self.rest.peek() == Some(&'*') => self.skip_comment(),
                ',' if !self.has_comma => self.has_comma = true,
                ']' | '}' => {
                    self.has_comma = false;
                    self.json.push(found);
                }
                '\n' => self.json.push('\n'),
                // The byte order mark is a space of JSON5 too.
                _ if found.is_whitespace() || found == '\u{feff}' => self.json.push(' '),
                _ => self.token(found),
            }
        }
        self.write_comma();
    }

    fn token(&mut self, first: char) {
        self.write_comma();
        match first {
            '"' | '\'' => self.text(first),
            '+' | '-' | '.' | '0'..='9' => self.number(first),
            _ if is_in_name(first) => self.word(first),
            _ => self.json.push(first),
        }
    }

    fn write_comma(&mut self) {
        if self.has_comma {
            self.json.push(',');
        }
        self.has_comma = false;
    }

    fn skip_line(&mut self) {
        while self.rest.next_if(|found| *found != '\n').is_some() {}
    }

    fn skip_comment(&mut self) {
        // The star, which must not end the comment.
        self.rest.next();
        let mut before = ' ';
        for found in self.rest.by_ref() {
            if before == '*' && found == '/' {
                break;
            }
            if found == '\n' {
                self.json.push('\n');
            }
            before = found;
        }
    }

    fn text(&mut self, quote: char) {
        self.json.push('"');
        while let Some(found) = self.rest.next() {
            match found {
                _ if found == quote => {
                    self.json.push('"');
                    return;
                }
                '"' => self.json.push_str("\\\""),
                '\\' => match self.rest.next() {
                    // After a backslash, a text goes on in the next line.
                    Some('\n') | None => {}
                    Some('\'') => self.json.push('\''),
                    Some(escaped) => self.json.extend(['\\', escaped]),
                },
                _ => self.json.push(found),
            }
        }
    }

    fn number(&mut self, first: char) {
        let mut number = String::from(first);
        let is_in_number = |found: &char| found.is_ascii_alphanumeric() || matches!(*found, '+' | '-' | '.');
        while let Some(found) = self.rest.next_if(is_in_number) {
            number.push(found);
        }
        let (sign, digits) = match number.strip_prefix('-') {
            Some(digits) => ("-", digits),
            None => ("", number.strip_prefix('+').unwrap_or(&number)),
        };
        self.json.push_str(sign);
        if digits.starts_with('.') {
            self.json.push('0');
        }
        self.json.push_str(digits);
        if digits.ends_with('.') {
            self.json.push('0');
        }
    }

    /// A name, which gets quotes, or one of the words of JSON.
    fn word(&mut self, first: char) {
        let mut word = String::from(first);
        while let Some(found) = self.rest.next_if(|found| is_in_name(*found) || found.is_ascii_digit()) {
            word.push(found);
        }
        if matches!(&*word, "true" | "false" | "null") {
            self.json.push_str(&word);
        } else {
            self.json.extend(["\"", word.as_str(), "\""]);
        }
    }
}

fn is_in_name(found: char) -> bool {
    found.is_alphabetic() || matches!(found, '_' | '$')
}

#[cfg(test)]
mod tests {
    use super::json_of_json5;
    use proptest::prelude::{any, prop_assert_eq, proptest};
    use serde_json::{Value, json};

    fn read(text: &str) -> Result<Value, serde_json::Error> {
        serde_json::from_str(&json_of_json5(text))
    }

    #[test]
    fn json5_is_read_as_json() {
        let text = "\u{feff}{\n  // A comment, with \"quotes\" and {brackets}.\n  name: 'it\\'s \"it\"', /* two\n lines */ list_2: [+1, -.5, 2., 1e-3,],\n  yes: true, $none: null,\n  \"quoted // text\": \"a\\\nb\",\n}\n";
        let expected = json!({
            "name": "it's \"it\"", "list_2": [1, -0.5, 2.0, 1e-3], "yes": true, "$none": null, "quoted // text": "ab",
        });
        assert_eq!(read(text).unwrap(), expected);
        for wrong in
            ["", "{", "{a: }", "[1,,2]", "'a", "{a: 0x10}", "[Infinity, -Infinity]", "/* {}", "my notes"]
        {
            assert!(read(wrong).is_err(), "{wrong}");
        }
        // An error is in the line in which it was.
        let error = read("{\n /* a\n b */\n a: ?}").unwrap_err();
        assert_eq!(error.line(), 4);
    }

    proptest! {
        /// JSON is JSON5.
        #[test]
        fn json_stays_what_it_is(text in ".{0,20}", number in any::<f64>(), more in any::<i64>()) {
            let value = json!({"a": [text.clone(), number, {text: more}, null], "b": true});
            let back = read(&value.to_string());
            prop_assert_eq!(back.unwrap(), value);
        }

        #[test]
        fn any_text_is_converted(text in "[\\PC\n]{0,60}") {
            let _ = json_of_json5(&text);
        }
    }
}
