//! Table of one quantity: times and values in SI units.

use crate::recording::RecordingFileError;
use crate::recording::column_map::ColumnMap;
use crate::recording::directional::name::Quantity;
use crate::recording::infer_units::goes_on;
use crate::recording::names::{Meaning, meaning_of};
use crate::recording::table::{Table, read_table};
use crate::recording::units::{AccelerationUnit, ForceUnit, PositionUnit, TimeUnit};

/// Columns of one quantity, each with one value for every time.
#[derive(Debug)]
pub(super) struct QuantityTable {
    /// Times in seconds, as they are written.
    pub(super) times_secs: Vec<f64>,
    /// One to three axes of acceleration in m/s², normal force in N, or one to two axes of position in m.
    pub(super) columns: Vec<Vec<f64>>,
    /// Sentences for the user.
    pub(super) warnings: Vec<String>,
}

/// Reads a table. A header states columns and units; without units, they are s, g, N and mm. Without a header, the first
/// column is the time and the others are the values.
pub(super) fn read_quantity(bytes: &[u8], quantity: Quantity) -> Result<QuantityTable, RecordingFileError> {
    let mut table = read_table(bytes, &ColumnMap::default())?;
    let meanings: Vec<Option<Meaning>> =
        table.names.iter().map(|name| if table.header { meaning_of(name) } else { None }).collect();
    let time = time_column(&table, &meanings)?;
    let values = value_columns(&table, &meanings, time.0, quantity)?;
    let times_secs = take(&mut table, time)?;
    let columns = values.into_iter().map(|column| take(&mut table, column)).collect::<Result<_, _>>()?;
    Ok(QuantityTable { times_secs, columns, warnings: table.warnings })
}

/// Index of a column, and its unit in the SI unit.
type Scaled = (usize, f64);

fn time_column(table: &Table, meanings: &[Option<Meaning>]) -> Result<Scaled, RecordingFileError> {
    let named = meanings.iter().enumerate().find_map(|(index, meaning)| match meaning {
        Some(Meaning::Time(unit)) => Some((index, unit.unwrap_or(TimeUnit::Seconds).si())),
        _ => None,
    });
    let first = || table.columns.first().filter(|column| goes_on(column)).map(|_| (0, 1.0));
    named.or_else(first).ok_or_else(|| {
        let problem = format!(
            "there is no time: no column is named time, and the first does not increase; the columns are {}",
            names(table)
        );
        RecordingFileError::Table { problem, line: None }
    })
}

/// Columns of the quantity: those that the header names, or all but the time if it names none.
fn value_columns(
    table: &Table,
    meanings: &[Option<Meaning>],
    time: usize,
    quantity: Quantity,
) -> Result<Vec<Scaled>, RecordingFileError> {
    let named = |is_first_choice: bool| -> Vec<Scaled> {
        let unit = |meaning: &Option<Meaning>| unit_of((*meaning)?, quantity, is_first_choice);
        let meanings = meanings.iter().enumerate();
        meanings.filter_map(|(index, meaning)| Some((index, unit(meaning)?))).collect()
    };
    let (n_most, usual) = match quantity {
        Quantity::Acceleration => (3, AccelerationUnit::StandardGravity.si()),
        Quantity::Force => (1, ForceUnit::Newtons.si()),
        Quantity::Position => (2, PositionUnit::Millimeters.si()),
    };
    let mut found = named(true);
    if found.is_empty() {
        found = named(false);
    }
    let others: Vec<usize> = (0..table.columns.len()).filter(|index| *index != time).collect();
    let are_unnamed = others.iter().all(|index| meanings[*index].is_none());
    if found.is_empty() && are_unnamed && (1..=n_most).contains(&others.len()) {
        found = others.into_iter().map(|index| (index, usual)).collect();
    }
    if found.is_empty() {
        let problem = format!("there is no column of {}; the columns are {}", quantity.name(), names(table));
        return Err(RecordingFileError::Table { problem, line: None });
    }
    found.truncate(n_most);
    Ok(found)
}

/// Unit of a column with this meaning, in the SI unit; `None` if it is not of the quantity. A force along z is the normal
/// force if there is no other.
fn unit_of(meaning: Meaning, quantity: Quantity, is_first_choice: bool) -> Option<f64> {
    match (quantity, meaning) {
        (Quantity::Acceleration, Meaning::Acceleration(unit)) => {
            Some(unit.unwrap_or(AccelerationUnit::StandardGravity).si())
        }
        (Quantity::Acceleration, Meaning::Axis) => Some(AccelerationUnit::StandardGravity.si()),
        (Quantity::Force, Meaning::Force(unit)) => Some(unit.unwrap_or(ForceUnit::Newtons).si()),
        (Quantity::Force, Meaning::ForceZ(unit)) if !is_first_choice => {
            Some(unit.unwrap_or(ForceUnit::Newtons).si())
        }
        (Quantity::Position, Meaning::Position(unit)) => Some(unit.unwrap_or(PositionUnit::Millimeters).si()),
        (Quantity::Position, Meaning::Axis) => Some(PositionUnit::Millimeters.si()),
        _ => None,
    }
}

/// Takes the values of a column out of the table, in SI units.
fn take(table: &mut Table, (index, si): Scaled) -> Result<Vec<f64>, RecordingFileError> {
    let cells = table.not_numbers[index];
    if cells.n > 0 {
        let problem = format!("{} cells of {:?} are not numbers, the first", cells.n, table.names[index]);
        return Err(RecordingFileError::Table { problem, line: Some(cells.first_line) });
    }
    let mut values = std::mem::take(&mut table.columns[index]);
    for value in &mut values {
        *value *= si;
    }
    Ok(values)
}

fn names(table: &Table) -> String {
    table.names.iter().map(|name| format!("{name:?}")).collect::<Vec<_>>().join(", ")
}

#[cfg(test)]
mod tests {
    use super::{Quantity, QuantityTable, read_quantity};

    fn read(text: &str, quantity: Quantity) -> Result<QuantityTable, String> {
        read_quantity(text.as_bytes(), quantity).map_err(|error| error.to_string())
    }

    #[test]
    fn columns_and_units_are_those_of_the_header_or_the_usual_ones() {
        let check = |text: &str, quantity: Quantity, first: &[f64]| {
            let table = read(text, quantity).unwrap();
            assert_eq!(table.times_secs[..2], [0.0, 0.5], "{text}");
            let row: Vec<f64> = table.columns.iter().map(|column| column[0]).collect();
            assert_eq!(row.len(), first.len(), "{text}");
            for (value, expected) in row.iter().zip(first) {
                assert!((value - expected).abs() < 1e-12, "got {value}, expected {expected}: {text}");
            }
        };
        let g = 9.806_65;
        check("time,X,Y,Z\n0,1,2,-1\n0.5,0,0,0\n", Quantity::Acceleration, &[g, 2.0 * g, -g]);
        check("0,1,2\n0.5,0,0\n1,0,0\n", Quantity::Position, &[1e-3, 2e-3]);
        check("t_ms;acc_x [m/s^2]\n0;3\n500;4\n", Quantity::Acceleration, &[3.0]);
        check("time,force\n0,0.2\n0.5,0.3\n", Quantity::Force, &[0.2]);
        check("time,Fx,Fy,Fz [mN]\n0,5,5,200\n0.5,1,1,1\n", Quantity::Force, &[0.2]);
        check("time,X,Y\n0,10,20\n0.5,0,0\n", Quantity::Position, &[0.01, 0.02]);
        check("time,x [m],y [m],z [m]\n0,1,2,3\n0.5,0,0,0\n", Quantity::Position, &[1.0, 2.0]);
        check("stamp,left,right\n0,1,2\n0.5,1,2\n1,1,2\n", Quantity::Acceleration, &[g, 2.0 * g]);
    }

    #[test]
    fn what_cannot_be_read_says_where() {
        let fails = |text: &str, quantity: Quantity, words: &[&str]| {
            let reason = read(text, quantity).unwrap_err();
            assert!(words.iter().all(|word| reason.contains(word)), "{reason}");
        };
        fails("time,force\n0,0.2\n0.1,bad\n0.2,bad\n", Quantity::Force, &["2 cells of \"force\"", "line 3"]);
        fails("time,X,Y\n0,1,2\n0.1,1,2,3,4\n", Quantity::Position, &["line 3"]);
        fails("time,force\n0,0.2\n0.1,0.2\n", Quantity::Position, &["no column of position", "\"force\""]);
        fails("X,Y\n3,0.2\n1,0.2\n", Quantity::Position, &["no time"]);
        fails("time,a1,b2,c3\n0,1,2,3\n1,1,2,3\n", Quantity::Force, &["no column of force"]);
        fails("", Quantity::Force, &["the file is empty"]);
    }
}
