//! Profiles as tables: evenly spaced positions in mm, and a value at each.
//!
//! ```csv
//! x_mm,value
//! 0.00,0.5
//! 0.01,0.7
//! ```
//!
//! The first column is the position and the second the value, whatever their names. Positions are in mm unless the
//! column name ends in another unit: `x_m`, `x_cm`, `x_um`.

use std::fmt::Write as _;

use shagreen_core::texture::profile::{Profile, ProfileError};

use crate::csv_text::{self, TableTextError, line_of, number};

/// Header line of written tables.
const HEADER: &str = "x_mm,value\n";
/// Tolerated deviation of a position from the even grid, in steps.
const TOLERANCE_STEPS: f64 = 0.2;

/// Why bytes are not a profile.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum ProfileCsvError {
    /// Not text.
    #[error(transparent)]
    Text(#[from] TableTextError),
    /// A row is not a position and a value.
    #[error("line {line} must hold exactly two numbers, a position in mm and a value; correct the line")]
    Row {
        /// The line, from one.
        line: u64,
    },
    /// The first column is not a position.
    #[error(
        "the first column is {name:?}, which is not a position; use positions in mm there, or use a signal (.wav) with its speed"
    )]
    NoPosition {
        /// Name of the column.
        name: String,
    },
    /// Positions are not evenly spaced.
    #[error(
        "the position in line {line} is {found}, but equal steps require {wanted:.6}; resample the profile at equal steps"
    )]
    Uneven {
        /// The line, from one.
        line: u64,
        /// The position in the file.
        found: f64,
        /// The position on an even grid.
        wanted: f64,
    },
    /// The rows do not form a valid profile.
    #[error("{0}; each row needs a position in mm, in ascending order, and a value")]
    Profile(#[from] ProfileError),
}

/// Reads a profile. Its positions may start anywhere; the returned profile starts at zero.
///
/// # Errors
/// See [`ProfileCsvError`].
pub fn read_profile_csv(bytes: &[u8]) -> Result<Profile, ProfileCsvError> {
    let text = csv_text::text(bytes)?;
    let (delimiter, text, records) = csv_text::records(&text);
    let mut rows: Vec<(u64, f64, f64)> = Vec::new();
    let mut unit_m = 1e-3;
    for (index, record) in records.enumerate() {
        let line = || line_of(text, &record);
        // A delimiter at the end of a row adds no field.
        let fields: Vec<&str> = record.iter().collect();
        let fields = fields.strip_suffix(&[""]).unwrap_or(&fields);
        let &[x, value] = fields else { return Err(ProfileCsvError::Row { line: line() }) };
        let is_header = index == 0 && [x, value].iter().all(|field| field.parse::<f64>().is_err());
        match (number(x, delimiter), number(value, delimiter)) {
            (Some(x), Some(value)) => rows.push((line(), x, value)),
            (None, None) if is_header => {
                unit_m = unit_of(x)
                    .ok_or_else(|| ProfileCsvError::NoPosition { name: x.chars().take(40).collect() })?;
            }
            _ => return Err(ProfileCsvError::Row { line: line() }),
        }
    }
    let [(_, first, _), .., (_, last, _)] = rows.as_slice() else {
        return Err(ProfileError::Short { n: rows.len() }.into());
    };
    let profile = Profile::new(
        unit_m * (last - first) / (rows.len() - 1) as f64,
        rows.iter().map(|row| row.2).collect(),
    )?;
    // The median step is robust against single wrong positions.
    let mut steps: Vec<f64> = rows.windows(2).map(|pair| pair[1].1 - pair[0].1).collect();
    let middle = (steps.len() - 1) / 2;
    let step = *steps.select_nth_unstable_by(middle, f64::total_cmp).1;
    for pair in rows.windows(2) {
        let ((_, before, _), (line, found, _)) = (pair[0], pair[1]);
        let wanted = before + step;
        // The profile was accepted, so positions and their differences are finite.
        if (found - wanted).abs() > TOLERANCE_STEPS * step {
            return Err(ProfileCsvError::Uneven { line, found, wanted });
        }
    }
    Ok(profile)
}

/// Length in m of one position unit, from the column name; `None` if the name is not a position.
fn unit_of(name: &str) -> Option<f64> {
    let name = name.trim().trim_end_matches([')', ']']).to_lowercase();
    match name.rsplit(['_', ' ', '(', '[']).next().unwrap_or("") {
        "m" => Some(1.0),
        "cm" => Some(1e-2),
        "um" | "µm" | "μm" => Some(1e-6),
        "s" | "ms" | "t" | "time" => None,
        _ => Some(1e-3),
    }
}

/// Returns whether bytes are a table that [`profile_csv`] wrote.
pub fn is_profile_csv(bytes: &[u8]) -> bool {
    bytes.starts_with(HEADER.as_bytes())
}

/// Writes a profile as a table that [`read_profile_csv`] reads.
pub fn profile_csv(profile: &Profile) -> String {
    let mut text = String::from(HEADER);
    for (i, value) in profile.values().iter().enumerate() {
        // Rounded to a picometer, finer than any step. Writing to a string cannot fail.
        let x_mm = (1e12 * profile.step_m() * i as f64).round() / 1e9;
        let _ = writeln!(text, "{x_mm},{value}");
    }
    text
}

#[cfg(test)]
mod tests {
    use super::{ProfileCsvError, profile_csv, read_profile_csv};
    use proptest::prelude::{prop, prop_assert, prop_assert_eq, proptest};
    use shagreen_core::texture::profile::{Profile, ProfileError};

    #[test]
    fn tables_of_spreadsheets_are_read() {
        let wanted = [0.5, 0.75, -1.0];
        for table in [
            "x_mm,height\n0,0.5\n0.01,0.75\n0.02,-1\n",
            "10;0,5\r\n10,01;0,75\r\n\r\n10,02;-1\r\n",
            "sep=\t\nx\tv\n-1\t.5\n-0.99\t.75\n-0.98\t-1e0",
        ] {
            let profile = read_profile_csv(table.as_bytes()).unwrap();
            assert_eq!(profile.values(), wanted, "{table}");
            assert!((profile.step_m() - 1e-5).abs() < 1e-15);
        }
        let micrometers = read_profile_csv(b"x (um),height\n0,0.5\n10,0.75\n20,-1\n").unwrap();
        assert!((micrometers.step_m() - 1e-5).abs() < 1e-15);
    }

    #[test]
    fn what_is_no_profile_is_named_with_its_line() {
        let error = |table: &str| read_profile_csv(table.as_bytes()).unwrap_err();
        assert_eq!(error("x,v\n0,1\n1,2\nend\n"), ProfileCsvError::Row { line: 4 });
        assert_eq!(error("0,1\n1\n"), ProfileCsvError::Row { line: 2 });
        assert_eq!(error("NaN,inf\n0,1\n1,1\n"), ProfileCsvError::Row { line: 1 });
        assert_eq!(error("x,y,z\n0,1,5\n1,1,5\n"), ProfileCsvError::Row { line: 1 });
        assert_eq!(
            error("0,1\n1,1\n5,1\n6,1\n8,1\n"),
            ProfileCsvError::Uneven { line: 3, found: 5.0, wanted: 2.0 }
        );
        assert!(matches!(error("t_s,v\n0,1\n1,1\n"), ProfileCsvError::NoPosition { .. }));
        assert_eq!(error("x,v\n"), ProfileError::Short { n: 0 }.into());
        assert!(matches!(error("1,1\n0,1\n"), ProfileCsvError::Profile(ProfileError::Step { .. })));
        assert!(matches!(error("a\0b"), ProfileCsvError::Text(_)));
    }

    proptest! {
        #[test]
        fn what_is_written_is_read(
            values in prop::collection::vec(-1e3_f64..1e3, 2..200),
            step_m in 1e-7_f64..1e-2,
        ) {
            let profile = Profile::new(step_m, values).unwrap();
            let read = read_profile_csv(profile_csv(&profile).as_bytes()).unwrap();
            prop_assert_eq!(read.values(), profile.values());
            prop_assert!((read.step_m() / step_m - 1.0).abs() < 1e-4);
        }
    }
}
