//! Columns and rows of tables of rated pairs.

use shagreen_core::people::study::same_different::{Correction, Counts, d_prime};
use shagreen_core::signals::quality::{Distances, Feature};

use super::RatedRow;
use super::error::{MOST_COUNT, RatedPairsError};
use crate::named_table::{Field, NamedTable, RowOf};

/// Largest distance: far above those of signals that can be felt, and far below numbers whose squares overflow.
const MOST_DISTANCE: f64 = 1e12;
/// Largest magnitude of a rated d′: an observer with it answers correctly in all trials that a study can have.
const MOST_RATED: f64 = 40.0;
/// Largest weight.
const MOST_WEIGHT: f64 = 1e9;

/// Trials of a pair, in errors.
const DIFFERENT: &str = "different signals";
const IDENTICAL: &str = "identical signals";

/// Columns of a table, by what they contain.
pub(super) struct Columns {
    reference: usize,
    comparison: usize,
    texture: Option<usize>,
    d_prime: Option<usize>,
    counts: Option<CountColumns>,
    weight: Option<usize>,
    simulated: Option<usize>,
    distances: Vec<(Feature, usize)>,
}

/// Columns of counts, in one of two forms.
enum CountColumns {
    /// Answers "same" and "different" to the pair; trials and "different" answers with identical signals.
    Answers { same: usize, different: usize, identical: usize, false_alarms: usize },
    /// "Different" answers and trials, of the pair and of identical signals.
    Trials { hits: usize, different: usize, false_alarms: usize, identical: usize },
}

impl CountColumns {
    /// The columns of counts; `None` if there are none.
    fn find(table: &NamedTable) -> Result<Option<Self>, RatedPairsError> {
        let hits = table.find(&["hits"]);
        let identical = table.find(&["n_trials_identical"]);
        Ok(match (hits, identical) {
            (Some(_), Some(_)) => return Err(RatedPairsError::TwoForms),
            (None, None) => None,
            (None, Some(identical)) => Some(Self::Answers {
                same: table.need(&["n_same"])?,
                different: table.need(&["n_different"])?,
                identical,
                false_alarms: table.need(&["n_different_on_identical"])?,
            }),
            (Some(hits), None) => Some(Self::Trials {
                hits,
                different: table.need(&["n_different"])?,
                false_alarms: table.need(&["false_alarms"])?,
                identical: table.need(&["n_same"])?,
            }),
        })
    }

    fn all(&self) -> [usize; 4] {
        match *self {
            Self::Answers { same, different, identical, false_alarms } => {
                [same, different, identical, false_alarms]
            }
            Self::Trials { hits, different, false_alarms, identical } => {
                [hits, different, false_alarms, identical]
            }
        }
    }

    /// The counts of a row with all of them; the name of the first empty column otherwise.
    fn counts(&self, row: RowOf<'_>) -> Result<Result<Counts, String>, RatedPairsError> {
        let mut numbers = [0; 4];
        for (number, column) in numbers.iter_mut().zip(self.all()) {
            match count(row.at(column))? {
                Some(count) => *number = count,
                None => return Ok(Err(row.at(column).name().to_owned())),
            }
        }
        Ok(Ok(match self {
            Self::Answers { .. } => {
                let [same, different, n_same, false_alarms] = numbers;
                Counts { hits: different, n_different: same + different, false_alarms, n_same }
            }
            Self::Trials { .. } => {
                let [hits, n_different, false_alarms, n_same] = numbers;
                Counts { hits, n_different, false_alarms, n_same }
            }
        }))
    }
}

impl Columns {
    pub(super) fn find(table: &NamedTable) -> Result<Self, RatedPairsError> {
        let of_feature = |feature: Feature| Some((feature, table.find(&[feature.id()])?));
        let columns = Self {
            reference: table.need(&["reference"])?,
            comparison: table.need(&["comparison"])?,
            texture: table.find(&["texture"]),
            d_prime: table.find(&["d_prime", "d'", "d′"]),
            counts: CountColumns::find(table)?,
            weight: table.find(&["weight"]),
            simulated: table.find(&["simulated"]),
            distances: Feature::ALL.into_iter().filter_map(of_feature).collect(),
        };
        if columns.d_prime.is_none() && columns.counts.is_none() {
            return Err(RatedPairsError::NoRatings { found: table.columns.join(", ") });
        }
        Ok(columns)
    }

    /// Features whose distances the table states.
    pub(super) fn features(&self) -> Vec<Feature> {
        self.distances.iter().map(|(feature, _)| *feature).collect()
    }

    /// Columns that are none of these.
    pub(super) fn unused(&self, table: &NamedTable) -> Vec<usize> {
        let single = [self.texture, self.d_prime, self.weight, self.simulated];
        let counts = self.counts.iter().flat_map(CountColumns::all).map(Some);
        let distances = self.distances.iter().map(|(_, column)| Some(*column));
        let taken: Vec<Option<usize>> = [Some(self.reference), Some(self.comparison)]
            .into_iter()
            .chain(single)
            .chain(counts)
            .chain(distances)
            .collect();
        table.others(&taken)
    }

    pub(super) fn row(&self, row: RowOf<'_>) -> Result<RatedRow, RatedPairsError> {
        let reference = row.at(self.reference).word()?.to_owned();
        let texture = self.texture.map(|column| row.at(column).text()).filter(|text| !text.is_empty());
        let (d_prime, counts) = self.rating(row)?;
        Ok(RatedRow {
            line: row.line(),
            comparison: row.at(self.comparison).word()?.to_owned(),
            texture: texture.map_or_else(|| reference.clone(), str::to_owned),
            reference,
            d_prime,
            counts,
            weight: self.weight(row)?,
            is_simulated: self.is_simulated(row)?,
            distances: self.distances(row)?,
        })
    }

    /// The stated d′, or that of the counts with the counts.
    fn rating(&self, row: RowOf<'_>) -> Result<(f64, Option<Counts>), RatedPairsError> {
        let stated = self.d_prime.map(|column| row.at(column));
        if let Some(field) = stated
            && let Some(value) = field.number()?
        {
            let in_range = value.abs() <= MOST_RATED;
            return in_range
                .then_some((value, None))
                .ok_or_else(|| range(field, value, "between -40 and 40"));
        }
        let line = row.line();
        let Some(columns) = &self.counts else {
            return Err(RatedPairsError::NoRating { line, missing: "counts".to_owned() });
        };
        let counts = columns.counts(row)?.map_err(|missing| RatedPairsError::NoRating { line, missing })?;
        let Counts { hits, n_different, false_alarms, n_same } = counts;
        for (answers, trials, kind) in [(hits, n_different, DIFFERENT), (false_alarms, n_same, IDENTICAL)] {
            if trials == 0 {
                return Err(RatedPairsError::NoTrials { line, kind });
            }
            if answers > trials {
                return Err(RatedPairsError::Answers { line, answers, trials, kind });
            }
        }
        match d_prime(counts, Correction::LogLinear) {
            Some(value) => Ok((value, Some(counts))),
            None => Err(RatedPairsError::NoRating { line, missing: "counts".to_owned() }),
        }
    }

    fn weight(&self, row: RowOf<'_>) -> Result<f64, RatedPairsError> {
        let Some(field) = self.weight.map(|column| row.at(column)) else { return Ok(1.0) };
        let weight = field.number()?.unwrap_or(1.0);
        if weight > 0.0 && weight <= MOST_WEIGHT {
            Ok(weight)
        } else {
            Err(range(field, weight, "above 0 and at most 1000000000"))
        }
    }

    fn is_simulated(&self, row: RowOf<'_>) -> Result<bool, RatedPairsError> {
        let Some(field) = self.simulated.map(|column| row.at(column)) else { return Ok(false) };
        let value = field.number()?.unwrap_or(0.0);
        if value == 0.0 || value == 1.0 { Ok(value == 1.0) } else { Err(range(field, value, "0 or 1")) }
    }

    fn distances(&self, row: RowOf<'_>) -> Result<Option<Distances>, RatedPairsError> {
        if self.distances.is_empty() {
            return Ok(None);
        }
        let mut distances = Distances::default();
        for (feature, column) in &self.distances {
            let field = row.at(*column);
            let (line, column) = (field.line(), field.name().to_owned());
            let value = field.number()?.ok_or(RatedPairsError::NoDistance { line, column })?;
            if !(0.0..=MOST_DISTANCE).contains(&value) {
                return Err(range(field, value, "from 0 to 1e12"));
            }
            distances.0[*feature as usize] = value;
        }
        Ok(Some(distances))
    }
}

fn range(field: Field<'_>, found: f64, range: &'static str) -> RatedPairsError {
    RatedPairsError::Range { line: field.line(), column: field.name().to_owned(), found, range }
}

/// The count in a field; `None` if it is empty.
fn count(field: Field<'_>) -> Result<Option<u64>, RatedPairsError> {
    let Some(found) = field.number()? else { return Ok(None) };
    let is_count = found.fract() == 0.0 && (0.0..=MOST_COUNT as f64).contains(&found);
    if is_count {
        Ok(Some(found as u64))
    } else {
        Err(RatedPairsError::Count { line: field.line(), column: field.name().to_owned(), found })
    }
}
