//! The built-in detection thresholds of vibration: approximate tables.
//!
//! They have the shape of curves in the literature: flat to 40 Hz, then falling by 12 dB per octave to a minimum near
//! 250 Hz. Their numbers do not come from the table of a single study, so errors of ±3 dB are well possible. Nobody was
//! measured for them. A hand that holds a tool is known to be more sensitive: by 9.8 dB at 40 Hz and 18.5 dB at 300 Hz
//! relative to a 1 mm probe (Brisben 1999). The 15 dB used here is a rule of thumb.

use shagreen_core::dsp::threshold::{Threshold, ThresholdError};
use shagreen_core::units::Hertz;

/// Sensitivity advantage of a hand that holds a tool over the skin table, in dB.
const HELD_TOOL_DB: f64 = 15.0;
/// Text of the built-in tables.
const PACINIAN: &str = include_str!("../../../assets/thresholds/pacinian.csv");
const COMPOSITE: &str = include_str!("../../../assets/thresholds/composite.csv");

/// A built-in detection threshold.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum ThresholdKind {
    /// The Pacinian channel, in a hand that holds a tool.
    #[default]
    HeldTool,
    /// The Pacinian channel, for a large contactor on bare skin.
    Pacinian,
    /// The most sensitive channel at each frequency, for the same contactor.
    Composite,
}

/// Why a built-in table is invalid; the program file is then damaged.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum ThresholdTableError {
    /// A line is not two numbers.
    #[error("line {line} of a built-in threshold table is not two numbers; reinstall the program")]
    Line {
        /// The line, from one.
        line: usize,
    },
    /// The numbers do not form a threshold.
    #[error(transparent)]
    Threshold(#[from] ThresholdError),
}

impl ThresholdKind {
    /// All thresholds, in menu order.
    pub const ALL: [Self; 3] = [Self::HeldTool, Self::Pacinian, Self::Composite];

    /// Identifier on the command line.
    pub fn id(self) -> &'static str {
        match self {
            Self::HeldTool => "held-tool",
            Self::Pacinian => "pacinian",
            Self::Composite => "composite",
        }
    }

    /// Returns the threshold with this [`ThresholdKind::id`].
    pub fn from_id(id: &str) -> Option<Self> {
        Self::ALL.into_iter().find(|each| each.id() == id)
    }

    /// Reads the threshold.
    ///
    /// # Errors
    /// Fails only if the program file is damaged.
    pub fn read(self) -> Result<Threshold, ThresholdTableError> {
        Ok(match self {
            Self::HeldTool => read(PACINIAN)?.lowered(HELD_TOOL_DB),
            Self::Pacinian => read(PACINIAN)?,
            Self::Composite => read(COMPOSITE)?,
        })
    }
}

fn read(table: &str) -> Result<Threshold, ThresholdTableError> {
    let point = |(i, line): (usize, &str)| {
        let numbers = line.split_once(',').and_then(|(hz, db)| Some((hz.parse().ok()?, db.parse().ok()?)));
        numbers.map(|(hz, db)| (Hertz(hz), db)).ok_or(ThresholdTableError::Line { line: i + 1 })
    };
    let points: Result<Vec<_>, _> = table.lines().enumerate().skip(1).map(point).collect();
    Ok(Threshold::new(&points?)?)
}

#[cfg(test)]
mod tests {
    use super::{ThresholdKind, ThresholdTableError, read};
    use serde_json::Value;
    use shagreen_core::dsp::threshold::displacement_db_um;
    use shagreen_core::units::Hertz;

    /// Displacements and accelerations from an independent script, at thirteen frequencies inside and outside the
    /// tables.
    #[test]
    fn the_tables_are_those_of_the_reference() {
        let vectors = include_str!("../../../vectors/h_thresh/quality_vectors.json");
        let vectors: Value = serde_json::from_str(vectors).unwrap();
        let numbers = |name: &str| -> Vec<f64> {
            let list = vectors["T"][name].as_array().unwrap();
            list.iter().map(|value| value.as_f64().unwrap()).collect()
        };
        let [pacinian, composite, held] =
            [ThresholdKind::Pacinian, ThresholdKind::Composite, ThresholdKind::HeldTool]
                .map(|kind| kind.read().unwrap());
        let (p, a, c) = (numbers("P_dB_um"), numbers("P_acc_mps2_peak"), numbers("composite_dB_um"));
        for (i, hz) in numbers("f").into_iter().map(Hertz).enumerate() {
            assert!((pacinian.displacement_db_um(hz) - p[i]).abs() < 1e-9);
            assert!((pacinian.peak_mps2(hz) / a[i] - 1.0).abs() < 1e-12);
            assert!((composite.displacement_db_um(hz) - c[i]).abs() < 1e-9);
            assert!((held.displacement_db_um(hz) - (p[i] - 15.0)).abs() < 1e-9);
        }
        let sine = &vectors["sine250"];
        let x = displacement_db_um(Hertz(250.0), 1.0);
        assert!((x - sine["dB_um"].as_f64().unwrap()).abs() < 1e-9);
        let above = x - pacinian.displacement_db_um(Hertz(250.0));
        assert!((above - sine["SL_dB"].as_f64().unwrap()).abs() < 1e-9);
    }

    #[test]
    fn each_is_found_by_its_word() {
        for kind in ThresholdKind::ALL {
            assert_eq!(ThresholdKind::from_id(kind.id()), Some(kind));
        }
        assert_eq!(ThresholdKind::from_id("other"), None);
    }

    #[test]
    fn a_damaged_table_says_where() {
        assert_eq!(read("hz,db\n40,12\n63;4\n"), Err(ThresholdTableError::Line { line: 3 }));
    }
}
