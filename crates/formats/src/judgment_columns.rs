//! Column names of the tables of sorts and ratings, and whether a table holds the other kind.

use crate::named_table::NamedTable;
use crate::pair_columns::pair_columns;

/// Accepted names of the participant column.
pub(crate) const PARTICIPANT: [&str; 5] = ["participant", "subject", "rater", "person", "participant_id"];
/// Accepted names of the texture column.
pub(crate) const TEXTURE: [&str; 7] =
    ["texture", "texture_id", "id", "stimulus", "surface", "material", "item"];
/// Accepted names of the column that numbers the sorts of a participant.
pub(crate) const TRIAL: [&str; 4] = ["trial", "sort", "session", "block"];
/// Accepted names of the column with the requested number of groups.
pub(crate) const GROUPS: [&str; 4] = ["groups", "n_groups", "number_of_groups", "clusters"];
/// Accepted names of the column with the group of a texture.
pub(crate) const GROUP: [&str; 4] = ["group", "cluster", "pile", "category"];
/// Accepted names of the column that names adjective pairs.
pub(crate) const ADJECTIVE: [&str; 6] =
    ["adjective", "adjective_pair", "pair", "attribute", "scale", "dimension"];
/// Accepted names of the column with ratings.
pub(crate) const VALUE: [&str; 4] = ["value", "rating", "score", "response"];

/// Whether a table holds ratings and no sorts: it names textures and adjective pairs, and has no groups.
pub(crate) fn are_ratings(table: &NamedTable) -> bool {
    table.find(&TEXTURE).is_some() && table.find(&GROUP).is_none() && has_ratings(table)
}

/// Whether a table holds sorts and no ratings: a line for each texture with its group and without ratings, or a line
/// for each trial with a column for each texture.
pub(crate) fn are_sorts(table: &NamedTable) -> bool {
    match (table.find(&TEXTURE), table.find(&GROUP)) {
        (Some(_), Some(_)) => !has_ratings(table),
        (None, _) => table.find(&TRIAL).or(table.find(&GROUPS)).is_some(),
        (Some(_), None) => false,
    }
}

fn has_ratings(table: &NamedTable) -> bool {
    if table.find(&ADJECTIVE).is_some() && table.find(&VALUE).is_some() {
        return true;
    }
    let others = table.others(&[table.find(&PARTICIPANT), table.find(&TEXTURE)]);
    // An error names a column of values that is meant as an adjective pair.
    pair_columns(table, &others, |field| field.number().is_ok())
        .map_or(true, |columns| !columns.pairs.is_empty())
}
