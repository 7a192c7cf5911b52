//! Selection of the acceleration columns, and of position columns with similar names.

use crate::recording::RecordingFileError;
use crate::recording::column_map::Column;
use crate::recording::from_table::Reading;
use crate::recording::infer_units::unit_by_gravity;
use crate::recording::names::Meaning;
use crate::recording::question::Ask;
use crate::recording::units::AccelerationUnit;

impl Reading {
    /// Returns the acceleration columns: `None` if the user must choose, empty if no column can be acceleration.
    pub(super) fn acceleration_columns(&mut self) -> Result<Option<Vec<usize>>, RecordingFileError> {
        if let Some(columns) = self.inquiry.map.acceleration.clone() {
            if !(1..=3).contains(&columns.len()) {
                let problem = format!("acceleration needs one to three columns, not {}", columns.len());
                return Err(RecordingFileError::Map { problem });
            }
            return self.places(&columns).map(Some);
        }
        let taken = |reading: &mut Self, places: Vec<usize>| {
            let columns = places.iter().map(|place| reading.column(*place)).collect();
            reading.inquiry.map.acceleration = Some(columns);
            Ok(Some(places))
        };
        let meant = self.meant(|meaning| matches!(meaning, Meaning::Acceleration(_)));
        let choices: Vec<String> = self.free_columns();
        let choices: Vec<&str> = choices.iter().map(String::as_str).collect();
        if meant.len() > 3 {
            let text = format!("{} may all be acceleration; choose one to three of them", self.name(&meant));
            self.inquiry.ask(Ask::Acceleration, &choices, text);
            return Ok(None);
        }
        if !meant.is_empty() {
            return taken(self, meant);
        }
        let axes = self.meant(|meaning| meaning == Meaning::Axis);
        let has_speed = self.inquiry.map.speed.is_some()
            || self.inquiry.map.constant_speed.is_some()
            || !self.meant(|meaning| matches!(meaning, Meaning::Speed(_) | Meaning::Position(_))).is_empty();
        if !axes.is_empty() && self.inquiry.map.positions.is_none() {
            let name = self.name(&axes);
            let text = format!("{name} may be positions or accelerations");
            if has_speed {
                let text =
                    format!("{text}; accelerations are assumed, because other columns hold the motion");
                let columns = axes.iter().map(|place| (place + 1).to_string()).collect::<Vec<_>>().join(",");
                self.inquiry.guess(Ask::Acceleration, &columns, &choices, text);
                return taken(self, axes);
            }
            self.inquiry.ask(Ask::Acceleration, &choices, text);
            return Ok(None);
        }
        if self.table.header {
            return Ok(Some(Vec::new()));
        }
        let text =
            "the columns have no names; give the numbers of the acceleration columns, from 1".to_owned();
        self.inquiry.ask(Ask::Acceleration, &choices, text);
        Ok(None)
    }

    /// References to the columns that have no quantity yet.
    fn free_columns(&self) -> Vec<String> {
        (0..self.table.names.len())
            .filter(|place| !self.used.contains(place))
            .map(|place| match self.column(place) {
                Column::Name(name) => name,
                Column::Number(number) => number.to_string(),
            })
            .collect()
    }

    pub(super) fn acceleration(&mut self, places: &[usize]) -> Result<Vec<Vec<f64>>, RecordingFileError> {
        let mut units = places.iter().map(|place| match self.meanings[*place] {
            Some(Meaning::Acceleration(unit)) => unit,
            _ => None,
        });
        let first = units.next().flatten();
        let by_name = first.filter(|first| units.all(|unit| unit == Some(*first)));
        let (what, stated) =
            (format!("the unit of {}", self.name(places)), self.inquiry.map.acceleration_unit);
        self.inquiry.map.acceleration_unit =
            self.inquiry.settle(&what, stated, by_name, |unit| unit.name().to_owned());
        if self.inquiry.map.acceleration_unit.is_none() {
            let names: Vec<&str> = AccelerationUnit::ALL.iter().map(|unit| unit.name()).collect();
            let text = format!("the unit of {} is not stated", self.name(places));
            let columns: Vec<&[f64]> =
                places.iter().map(|place| self.table.columns[*place].as_slice()).collect();
            match unit_by_gravity(&columns, self.inquiry.map.per_count.unwrap_or(1.0)) {
                Some((unit, length)) => {
                    let text =
                        format!("{text}; the mean vector has length {length:.3}, which matches gravity");
                    self.inquiry.guess(Ask::AccelerationUnit, unit.name(), &names, text);
                }
                None => self.inquiry.ask(Ask::AccelerationUnit, &names, text),
            }
        }
        let unit = self.inquiry.map.acceleration_unit.map_or(1.0, AccelerationUnit::si);
        let si = unit * self.inquiry.map.per_count.unwrap_or(1.0);
        places.iter().map(|place| self.take(*place, si)).collect()
    }

    pub(super) fn position_columns(&mut self) -> Result<Vec<usize>, RecordingFileError> {
        if let Some(columns) = self.inquiry.map.positions.clone() {
            return self.places(&columns);
        }
        let has_speed = self.inquiry.map.speed.is_some()
            || self.inquiry.map.constant_speed.is_some()
            || !self.meant(|meaning| matches!(meaning, Meaning::Speed(_))).is_empty();
        if has_speed {
            return Ok(Vec::new());
        }
        let mut meant = self.meant(|meaning| matches!(meaning, Meaning::Position(_)));
        let axes = self.meant(|meaning| meaning == Meaning::Axis);
        let in_acceleration = self.inquiry.map.acceleration.clone().unwrap_or_default();
        let is_free = |place: &usize| !in_acceleration.contains(&self.column(*place));
        if meant.is_empty() && !in_acceleration.is_empty() && axes.iter().all(is_free) && !axes.is_empty() {
            let name = self.name(&axes);
            let text = format!("{name} are read as positions, because other columns hold the acceleration");
            let columns = axes.iter().map(|place| (place + 1).to_string()).collect::<Vec<_>>().join(",");
            self.inquiry.guess(Ask::Positions, &columns, &[], text);
            meant = axes;
        }
        meant.truncate(3);
        if !meant.is_empty() {
            self.inquiry.map.positions = Some(meant.iter().map(|place| self.column(*place)).collect());
        }
        Ok(meant)
    }
}
