//! Options whose values are words.

use clap::builder::{PossibleValuesParser, TypedValueParser};

/// Returns a parser that maps words to values.
pub(crate) fn words<T: Copy + Send + Sync + 'static, const N: usize>(
    all: [T; N],
    id: fn(T) -> &'static str,
) -> impl TypedValueParser<Value = T> {
    PossibleValuesParser::new(all.map(id)).try_map(move |word| {
        let found = all.into_iter().find(|each| id(*each) == word);
        found.ok_or_else(|| format!("{word} is unknown"))
    })
}
