//! Cluster sortings as a table, in long or wide format.
//!
//! One line per texture of each sort:
//!
//! ```csv
//! participant,trial,groups,texture,group
//! p01,1,3,cork,a
//! ```
//!
//! or one line per sort, with a column for each texture that holds its group:
//!
//! ```csv
//! participant,trial,groups,cork,felt,glass
//! p01,1,3,a,a,b
//! ```
//!
//! `groups` is the requested number of groups; without it, the groups in the sort are counted. Without `trial`, the
//! number of groups identifies the sorts of a participant. A texture with an empty group was not sorted.

use std::collections::{HashMap, HashSet};

use shagreen_core::people::sorting::{Grouped, Sort};

use crate::judgment_columns::{GROUP, GROUPS, PARTICIPANT, TEXTURE, TRIAL, are_ratings};
use crate::named_table::{Field, NamedTable, NamedTableError, write_table};
use crate::pair_columns::unused_warning;

/// Sorts, and all textures that they contain.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct SortingTable {
    /// Identifiers of the textures, in the order of first appearance.
    pub textures: Vec<String>,
    /// The sorts, in file order.
    pub sorts: Vec<Sort>,
    /// Sentences for the user, one for each imperfection that leaves the data usable.
    pub warnings: Vec<String>,
}

/// Why a table holds no sortings.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum SortingCsvError {
    /// The table cannot be read.
    #[error(transparent)]
    Table(#[from] NamedTableError),
    /// The table has the columns of ratings.
    #[error(
        "this looks like the ratings table: the columns are {found}, and none is named group; give the sorting table here, with the columns participant, trial, groups, texture and group"
    )]
    Ratings {
        /// Names of the columns.
        found: String,
    },
    /// There are no texture columns, and no column that names textures.
    #[error(
        "no column holds groups; the columns are {found}; use the columns texture and group, or one column per texture"
    )]
    NoGroups {
        /// Names of the columns.
        found: String,
    },
    /// A number of groups is invalid.
    #[error("{column} in line {line} is \"{found}\"; give the requested number of groups, 1 or more")]
    NotACount {
        /// Name of the column.
        column: String,
        /// The line, from one.
        line: u64,
        /// Text of the field.
        found: String,
    },
    /// Lines of one sort contradict each other.
    #[error(
        "participant \"{participant}\", trial \"{trial}\": the number of groups in line {line} differs from earlier lines; correct it"
    )]
    OtherCount {
        /// The participant.
        participant: String,
        /// The trial.
        trial: String,
        /// The line, from one.
        line: u64,
    },
    /// A sort is listed on two lines.
    #[error(
        "line {line} repeats trial \"{trial}\" of participant \"{participant}\"; number the trials, or remove one of the lines"
    )]
    SortTwice {
        /// The participant.
        participant: String,
        /// The trial.
        trial: String,
        /// The line, from one.
        line: u64,
    },
}

/// Reads sortings.
///
/// # Errors
/// See [`SortingCsvError`].
pub fn read_sorting_csv(bytes: &[u8]) -> Result<SortingTable, SortingCsvError> {
    let table = NamedTable::read(bytes, "participant, trial, texture, group", "texture of a sort")?;
    let columns = Columns {
        participant: table.need(&PARTICIPANT)?,
        trial: table.find(&TRIAL),
        groups: table.find(&GROUPS),
    };
    match (table.find(&TEXTURE), table.find(&GROUP)) {
        (Some(texture), Some(group)) => by_texture(&table, &columns, texture, group),
        _ if are_ratings(&table) => Err(SortingCsvError::Ratings { found: table.columns.join(", ") }),
        _ => by_sort(&table, &columns),
    }
}

/// Columns of both formats.
struct Columns {
    participant: usize,
    trial: Option<usize>,
    groups: Option<usize>,
}

/// Textures in the order of first appearance.
#[derive(Default)]
struct Names(Vec<String>, HashSet<String>);

impl Names {
    fn add(&mut self, name: &str) {
        if self.1.insert(name.to_owned()) {
            self.0.push(name.to_owned());
        }
    }
}

/// The requested number of groups, if stated.
fn count(field: Option<Field<'_>>) -> Result<Option<usize>, SortingCsvError> {
    let Some(field) = field else { return Ok(None) };
    if field.text().is_empty() {
        return Ok(None);
    }
    let count = field.text().parse().ok().filter(|n: &usize| *n > 0);
    count.map(Some).ok_or_else(|| SortingCsvError::NotACount {
        column: field.name().to_owned(),
        line: field.line(),
        found: field.text().to_owned(),
    })
}

/// The name that distinguishes a sort from the others of its participant.
fn trial_name(trial: Option<Field<'_>>, n_groups: Option<usize>) -> Result<String, SortingCsvError> {
    match trial {
        Some(field) => Ok(field.word()?.to_owned()),
        None => Ok(n_groups.map_or_else(|| "1".to_owned(), |n| n.to_string())),
    }
}

fn by_texture(
    table: &NamedTable,
    columns: &Columns,
    texture: usize,
    group: usize,
) -> Result<SortingTable, SortingCsvError> {
    let mut names = Names::default();
    let mut sorts: Vec<Sort> = Vec::new();
    let mut at_of: HashMap<(String, String), usize> = HashMap::new();
    for row in table.rows() {
        let participant = row.at(columns.participant).word()?.to_owned();
        let n_groups = count(columns.groups.map(|column| row.at(column)))?;
        let trial = trial_name(columns.trial.map(|column| row.at(column)), n_groups)?;
        let at = *at_of.entry((participant.clone(), trial.clone())).or_insert_with(|| {
            sorts.push(Sort {
                participant: participant.clone(),
                trial: trial.clone(),
                n_groups,
                placements: Vec::new(),
            });
            sorts.len() - 1
        });
        if sorts[at].n_groups != n_groups {
            return Err(SortingCsvError::OtherCount { participant, trial, line: row.line() });
        }
        let texture = row.at(texture).word()?;
        names.add(texture);
        let group = row.at(group).text();
        if !group.is_empty() {
            sorts[at].placements.push(Grouped { texture: texture.to_owned(), group: group.to_owned() });
        }
    }
    let used = [Some(columns.participant), columns.trial, columns.groups, Some(texture), Some(group)];
    let warning =
        unused_warning(table, &table.others(&used), "sorts are read from the columns texture and group");
    Ok(SortingTable { textures: names.0, sorts, warnings: warning.into_iter().collect() })
}

fn by_sort(table: &NamedTable, columns: &Columns) -> Result<SortingTable, SortingCsvError> {
    let textures = table.others(&[Some(columns.participant), columns.trial, columns.groups]);
    if textures.is_empty() {
        return Err(SortingCsvError::NoGroups { found: table.columns.join(", ") });
    }
    let mut names = Names::default();
    for column in &textures {
        names.add(&table.columns[*column]);
    }
    let mut seen = HashSet::new();
    let mut sorts = Vec::new();
    for row in table.rows() {
        let participant = row.at(columns.participant).word()?.to_owned();
        let n_groups = count(columns.groups.map(|column| row.at(column)))?;
        let trial = trial_name(columns.trial.map(|column| row.at(column)), n_groups)?;
        if !seen.insert((participant.clone(), trial.clone())) {
            return Err(SortingCsvError::SortTwice { participant, trial, line: row.line() });
        }
        let fields = textures.iter().map(|column| row.at(*column)).filter(|field| !field.text().is_empty());
        let placement =
            |field: Field<'_>| Grouped { texture: field.name().to_owned(), group: field.text().to_owned() };
        sorts.push(Sort { participant, trial, n_groups, placements: fields.map(placement).collect() });
    }
    Ok(SortingTable { textures: names.0, sorts, warnings: Vec::new() })
}

/// Writes sortings as a table with one line per texture of each sort.
pub fn sorting_csv(sorts: &[Sort]) -> Vec<u8> {
    let first = ["participant", "trial", "groups", "texture", "group"].map(str::to_owned).to_vec();
    let rows = sorts.iter().flat_map(|sort| {
        let n_groups = sort.n_groups.map_or_else(String::new, |n| n.to_string());
        sort.placements.iter().map(move |Grouped { texture, group }| {
            vec![
                sort.participant.clone(),
                sort.trial.clone(),
                n_groups.clone(),
                texture.clone(),
                group.clone(),
            ]
        })
    });
    write_table(std::iter::once(first).chain(rows))
}

#[cfg(test)]
mod tests {
    use super::{read_sorting_csv, sorting_csv};

    const LONG: &str = "participant,trial,groups,texture,group\n\
                        p1,1,2,cork,a\np1,1,2,felt,a\np1,1,2,glass,b\n\
                        p2,1,2,cork,x\np2,1,2,felt,\np2,1,2,glass,y\n";
    const WIDE: &str = "Participant;Trial;N groups;cork;felt;glass\np1;1;2;a;a;b\np2;1;2;x;;y\n";

    #[test]
    fn both_shapes_say_the_same() {
        let long = read_sorting_csv(LONG.as_bytes()).unwrap();
        assert_eq!(read_sorting_csv(WIDE.as_bytes()), Ok(long.clone()));
        assert_eq!(long.textures, ["cork", "felt", "glass"]);
        assert_eq!(long.sorts.len(), 2);
        assert_eq!(long.sorts[0].n_groups, Some(2));
        assert_eq!(long.sorts[1].placements.len(), 2, "felt was not sorted by p2");
        let again = read_sorting_csv(&sorting_csv(&long.sorts)).unwrap();
        assert_eq!(again.sorts, long.sorts);
    }

    #[test]
    fn other_columns_are_named_and_not_used() {
        let text = "participant,age,texture,group\np1,31,cork,a\np1,31,felt,b\n";
        let table = read_sorting_csv(text.as_bytes()).unwrap();
        assert_eq!(table.textures, ["cork", "felt"]);
        assert!(table.warnings[0].starts_with("the column age is not used;"), "{:?}", table.warnings);
    }

    #[test]
    fn without_trials_the_number_of_groups_tells_sorts_apart() {
        let text = "subject,groups,cork,felt,glass\np1,3,a,b,c\np1,2,a,a,b\n";
        let sorts = read_sorting_csv(text.as_bytes()).unwrap().sorts;
        assert_eq!(sorts.iter().map(|s| s.trial.as_str()).collect::<Vec<_>>(), ["3", "2"]);
    }

    #[test]
    fn what_is_no_sorting_says_why() {
        let check = |text: &str, words: &str| {
            let message = read_sorting_csv(text.as_bytes()).unwrap_err().to_string();
            assert!(message.contains(words), "{message}");
        };
        for ratings in [
            "participant,texture,rough-smooth,hard-soft\np,cork,1,2\np,felt,3,4\n",
            "participant,texture,adjective,value\np,cork,rough-smooth,41\n",
        ] {
            check(ratings, "this looks like the ratings table: the columns are participant, texture");
        }
        check("participant,trial\np,1\n", "no column holds groups");
        check("who,trial,cork\np,1,a\n", "\"participant\"");
        check("participant,trial,groups,cork\np,1,many,a\n", "groups in line 2 is \"many\"");
        check("participant,trial,cork\np,1,a\np,1,b\n", "line 3 repeats");
        check("participant,cork\np,a\np,b\n", "line 3 repeats");
        check("participant,trial,groups,texture,group\np,1,3,a,x\np,1,6,b,x\n", "groups in line 3 differs");
        check("participant,trial,texture,group\n,1,a,x\n", "line 2 has no participant");
    }
}
