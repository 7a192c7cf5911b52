//! Detection of adjective-pair columns: tables of experiments also have other columns, such as `age` or `start_time`.

use shagreen_core::people::ratings::{AdjectivePair, PairNameError};

use crate::named_table::{Field, NamedTable};

/// Columns of a table, classified by their names.
pub(crate) struct PairColumns {
    /// Columns named by two adjectives.
    pub(crate) pairs: Vec<(usize, AdjectivePair)>,
    /// All other columns.
    pub(crate) unused: Vec<usize>,
}

/// Words for data that experiments record besides judgments. None of them is an adjective for a surface.
const NOT_FELT: [&str; 53] = [
    "age",
    "begin",
    "block",
    "clicks",
    "code",
    "comment",
    "comments",
    "condition",
    "date",
    "datetime",
    "day",
    "device",
    "duration",
    "email",
    "end",
    "finish",
    "gender",
    "group",
    "groups",
    "hand",
    "handedness",
    "hour",
    "id",
    "index",
    "latency",
    "mail",
    "material",
    "minutes",
    "ms",
    "name",
    "nr",
    "num",
    "number",
    "order",
    "participant",
    "rating",
    "reaction",
    "rep",
    "repetition",
    "response",
    "rt",
    "score",
    "sec",
    "seconds",
    "session",
    "sex",
    "start",
    "stimulus",
    "subject",
    "texture",
    "time",
    "timestamp",
    "trial",
];

/// Classifies the columns `others`. A name with several hyphens counts as an adjective pair if `is_value` holds for
/// every field of the column.
///
/// # Errors
/// The name of a column of values can be split into two adjectives in several ways.
pub(crate) fn pair_columns(
    table: &NamedTable,
    others: &[usize],
    is_value: impl Fn(Field<'_>) -> bool,
) -> Result<PairColumns, PairNameError> {
    let mut columns = PairColumns { pairs: Vec::new(), unused: Vec::new() };
    for &column in others {
        let name = &table.columns[column];
        match name.parse::<AdjectivePair>() {
            Ok(pair) if is_felt(&pair.low) && is_felt(&pair.high) => columns.pairs.push((column, pair)),
            Ok(_) | Err(PairNameError::OnePole { .. }) => columns.unused.push(column),
            Err(error) => {
                let could_be_felt = name.split(|c: char| !c.is_alphabetic()).all(|word| !is_recorded(word));
                if could_be_felt && table.rows().all(|row| is_value(row.at(column))) {
                    return Err(error);
                }
                columns.unused.push(column);
            }
        }
    }
    Ok(columns)
}

/// Returns whether a column is an attribute named by a single adjective: the name is not in [`NOT_FELT`], and the
/// column holds values.
pub(crate) fn is_attribute(
    table: &NamedTable,
    column: usize,
    value: impl Fn(Field<'_>) -> Option<f64>,
) -> bool {
    let fields = || table.rows().map(|row| row.at(column));
    let is_blank = |field: Field<'_>| matches!(field.number(), Ok(None));
    is_felt(&table.columns[column])
        && fields().all(|field| is_blank(field) || value(field).is_some())
        && !fields().all(is_blank)
}

/// Returns whether a pole can be an adjective: it contains letters, and at least one word that is not in [`NOT_FELT`].
fn is_felt(pole: &str) -> bool {
    let mut words = pole.split(|c: char| !c.is_alphabetic()).filter(|word| !word.is_empty());
    words.any(|word| !is_recorded(word))
}

fn is_recorded(word: &str) -> bool {
    NOT_FELT.contains(&word.to_lowercase().as_str())
}

/// A warning that names the unused columns; `None` if there are none.
pub(crate) fn unused_warning(table: &NamedTable, unused: &[usize], used: &str) -> Option<String> {
    let names: Vec<&str> = unused.iter().map(|column| table.columns[*column].as_str()).collect();
    match names[..] {
        [] => None,
        [name] => Some(format!("the column {name} is not used; {used}")),
        _ => Some(format!("the columns {} are not used; {used}", names.join(", "))),
    }
}

/// The naming rule of adjective pairs, for [`unused_warning`].
pub(crate) const NAME_BOTH_POLES: &str =
    "attribute columns are named by two adjectives joined by a hyphen, such as rough-smooth";

#[cfg(test)]
mod tests {
    use super::{NAME_BOTH_POLES, pair_columns, unused_warning};
    use crate::named_table::{Field, NamedTable};

    fn told_apart(first: &str, row: &str) -> Result<(Vec<String>, Option<String>), String> {
        let table = NamedTable::read(format!("{first}\n{row}\n").as_bytes(), "id", "texture").unwrap();
        let is_value = |field: Field<'_>| field.number().is_ok();
        let columns =
            pair_columns(&table, &table.others(&[]), is_value).map_err(|error| error.to_string())?;
        let names = columns.pairs.iter().map(|(_, pair)| pair.name()).collect();
        Ok((names, unused_warning(&table, &columns.unused, NAME_BOTH_POLES)))
    }

    #[test]
    fn what_is_recorded_beside_a_judgment_is_no_pair() {
        for name in [
            "age",
            "start-time",
            "start_time",
            "Reaction Time (ms)",
            "RT-ms",
            "date-of-birth",
            "trial_nr",
            "user-id",
            "start-end",
            "2026-11",
            "e-mail-address",
            "Comment",
        ] {
            let (names, warning) = told_apart(&format!("rough-smooth,{name}"), "3,12:30").unwrap();
            assert_eq!(names, ["rough-smooth"], "{name}");
            assert!(warning.unwrap().starts_with(&format!("the column {name} is not used; ")), "{name}");
        }
        let warning = told_apart("age,hard-soft,sex", "30,50,f").unwrap().1.unwrap();
        assert!(warning.starts_with("the columns age, sex are not used; "), "{warning}");
    }

    #[test]
    fn adjectives_of_any_language_are_pairs() {
        for name in [
            "rough-smooth",
            "rau-glatt",
            "粗い-滑らか",
            "no friction - much friction",
            "small size/large size",
            "no_time - some feeling",
        ] {
            assert_eq!(
                told_apart(name, "3").unwrap(),
                (vec![name.parse::<shagreen_core::people::ratings::AdjectivePair>().unwrap().name()], None)
            );
        }
        assert!(told_apart("non-stick-sticky", "3").unwrap_err().contains("several ways"));
        // A column without values is not an adjective pair with an ambiguous name.
        assert!(told_apart("one-two-three,hard-soft", "x,3").unwrap().1.is_some());
    }
}
