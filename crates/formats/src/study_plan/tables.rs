//! Tables of a plan file, read key by key, so that what is wrong with one key does not hide what is wrong with the others.

use serde::de::value::Error as NamesOnly;
use serde::de::{DeserializeOwned, Deserializer, Error as _, Visitor};
use serde::forward_to_deserialize_any;
use shagreen_core::words::near;
use toml::Table;

use super::MOST_PROBLEMS;
use super::key_problem::KeyProblem;
use crate::parser_words::plain;

/// What a table says. Keys that are unknown, or whose values are of another kind, are left out and added to `problems`; `at` is
/// the key of the table, with its final dot. No field of `T` is required.
pub(super) fn read_table<T: DeserializeOwned + Default>(
    table: Table,
    at: &str,
    problems: &mut Vec<KeyProblem>,
) -> T {
    let known = field_names::<T>();
    let mut good = Table::new();
    for (key, value) in table {
        let text = if known.contains(&key.as_str()) {
            match Table::from_iter([(key.clone(), value.clone())]).try_into::<T>() {
                Ok(_) => {
                    good.insert(key, value);
                    continue;
                }
                Err(error) => format!("{}; correct the value", plain(error.message())),
            }
        } else if problems.len() < MOST_PROBLEMS {
            unknown(&key, known)
        } else {
            // Further ones are not reported.
            continue;
        };
        problems.push(KeyProblem::new(format!("{at}{key}"), text));
    }
    // Each key was read by itself, and none is required.
    good.try_into().unwrap_or_default()
}

fn unknown(key: &str, known: &[&str]) -> String {
    let near = near(known.iter().copied(), key);
    if near.is_empty() {
        "the key is unknown; correct its name, or remove it".to_owned()
    } else {
        format!("the key is unknown; did you mean {}?", near.join(", "))
    }
}

/// Names of the fields of a struct, as its derived reader knows them.
fn field_names<T: DeserializeOwned>() -> &'static [&'static str] {
    let mut names = FieldNames(&[]);
    // This reader asks for its fields, and fails because there are no values.
    let _ = T::deserialize(&mut names);
    names.0
}

/// A source of no value, which keeps the names of the fields that it is asked for.
struct FieldNames(&'static [&'static str]);

impl<'de> Deserializer<'de> for &mut FieldNames {
    type Error = NamesOnly;

    fn deserialize_any<V: Visitor<'de>>(self, _visitor: V) -> Result<V::Value, NamesOnly> {
        Err(NamesOnly::custom("there are no values"))
    }

    fn deserialize_struct<V: Visitor<'de>>(
        self,
        _name: &'static str,
        fields: &'static [&'static str],
        visitor: V,
    ) -> Result<V::Value, NamesOnly> {
        self.0 = fields;
        self.deserialize_any(visitor)
    }

    forward_to_deserialize_any! {
        bool i8 i16 i32 i64 i128 u8 u16 u32 u64 u128 f32 f64 char str string bytes byte_buf option unit unit_struct
        newtype_struct seq tuple tuple_struct map enum identifier ignored_any
    }
}

#[cfg(test)]
mod tests {
    use super::{field_names, read_table};
    use serde::Deserialize;

    #[derive(Debug, Default, PartialEq, Deserialize)]
    #[serde(deny_unknown_fields)]
    struct Sample {
        name: Option<String>,
        #[serde(default)]
        level_db: f64,
        #[serde(rename = "pairs")]
        listed: Option<Vec<[String; 2]>>,
    }

    #[test]
    fn fields_have_their_names_in_files() {
        assert_eq!(field_names::<Sample>(), ["name", "level_db", "pairs"]);
    }

    #[test]
    fn one_wrong_key_does_not_hide_the_others() {
        let text = "name = 3\nlevel_db = 2\npears = []\npairs = [[\"a\"]]\nzzzzzz = 1";
        let mut problems = Vec::new();
        let read: Sample = read_table(toml::from_str(text).unwrap(), "part[1].", &mut problems);
        assert_eq!(read, Sample { level_db: 2.0, ..Sample::default() });
        let mut texts: Vec<String> = problems.iter().map(|of| format!("{}: {}", of.key, of.text)).collect();
        texts.sort();
        assert_eq!(
            texts,
            [
                "part[1].name: it has the number 3 where a text is needed; correct the value",
                "part[1].pairs: it has a list of length 1 where a list of length 2 is needed; correct the value",
                "part[1].pears: the key is unknown; did you mean pairs?",
                "part[1].zzzzzz: the key is unknown; correct its name, or remove it",
            ]
        );
    }

    #[test]
    fn a_good_table_is_read_completely() {
        let mut problems = Vec::new();
        let text = "name = \"a\"\nlevel_db = -1.5\npairs = [[\"a\", \"b\"]]";
        let read: Sample = read_table(toml::from_str(text).unwrap(), "", &mut problems);
        let listed = Some(vec![["a".to_owned(), "b".to_owned()]]);
        assert_eq!(read, Sample { name: Some("a".to_owned()), level_db: -1.5, listed });
        assert!(problems.is_empty());
    }
}
