//! Selection of the columns of speed or position, and of force.

use shagreen_core::recording::{RawMotion, RawTrack};

use crate::recording::RecordingFileError;
use crate::recording::from_table::Reading;
use crate::recording::infer_units::{alternates, is_newtons, largest, median_of};
use crate::recording::names::Meaning;
use crate::recording::question::Ask;
use crate::recording::units::{ForceUnit, PositionUnit, SpeedUnit};

/// Highest plausible hand speed in m/s; also the lowest plausible maximum of a stroke in mm/s.
const FASTEST_MPS: f64 = 2.0;

impl Reading {
    pub(super) fn motion(&mut self, positions: &[usize]) -> Result<RawMotion, RecordingFileError> {
        let named = self.inquiry.map.speed.clone().map(|column| self.place(&column)).transpose()?;
        let meant = self.meant(|meaning| matches!(meaning, Meaning::Speed(_)));
        if let Some(speed) = self.inquiry.map.constant_speed {
            self.leave_out(named.or(meant.first().copied()), "a constant speed");
            return Ok(RawMotion::Speed(RawTrack::Constant(speed.0)));
        }
        if named.is_none() && !positions.is_empty() {
            let by_name = positions.iter().find_map(|place| match self.meanings[*place] {
                Some(Meaning::Position(unit)) => unit,
                _ => None,
            });
            let (what, stated) =
                (format!("the unit of {}", self.name(positions)), self.inquiry.map.position_unit);
            self.inquiry.map.position_unit =
                self.inquiry.settle(&what, stated, by_name, |unit| unit.name().to_owned());
            if self.inquiry.map.position_unit.is_none() {
                let names: Vec<&str> = PositionUnit::ALL.iter().map(|unit| unit.name()).collect();
                let text = format!("the unit of {} is not stated", self.name(positions));
                self.inquiry.ask(Ask::PositionUnit, &names, text);
            }
            let si = self.inquiry.map.position_unit.map_or(1.0, PositionUnit::si);
            let axes: Result<_, _> = positions.iter().map(|place| self.take(*place, si)).collect();
            return Ok(RawMotion::Positions(axes?));
        }
        let Some(place) = named.or(meant.first().copied()) else {
            let text = "the file has neither speed nor positions; name a column, or state a constant speed such as \"100 mm/s\"";
            self.inquiry.ask(Ask::Speed, &[], text.to_owned());
            return Ok(RawMotion::Speed(RawTrack::Missing));
        };
        self.inquiry.map.speed = Some(self.column(place));
        if let Some(Meaning::Speed(unit)) = self.meanings[place] {
            let (what, stated) =
                (format!("the unit of {}", self.name(&[place])), self.inquiry.map.speed_unit);
            self.inquiry.map.speed_unit =
                self.inquiry.settle(&what, stated, unit, |unit| unit.name().to_owned());
        }
        if self.inquiry.map.speed_unit.is_none() {
            let names: Vec<&str> = SpeedUnit::ALL.iter().map(|unit| unit.name()).collect();
            let most = largest(&self.table.columns[place]);
            let text = format!(
                "the unit of {} is not stated; its largest magnitude is {most:.3}",
                self.name(&[place])
            );
            if most > 10.0 * FASTEST_MPS {
                let text = format!("{text}, too fast for a hand in m/s");
                self.inquiry.guess(Ask::SpeedUnit, SpeedUnit::MillimetersPerSecond.name(), &names, text);
            } else if most > 0.0 && most <= 0.5 * FASTEST_MPS {
                let text = format!("{text}, too slow for a stroke in mm/s");
                self.inquiry.guess(Ask::SpeedUnit, SpeedUnit::MetersPerSecond.name(), &names, text);
            } else {
                self.inquiry.ask(Ask::SpeedUnit, &names, text);
            }
        }
        let si = self.inquiry.map.speed_unit.map_or(1.0, SpeedUnit::si);
        Ok(RawMotion::Speed(RawTrack::Column(self.take(place, si)?)))
    }

    /// Warns that a column is not used because a constant is stated.
    fn leave_out(&mut self, place: Option<usize>, said: &str) {
        let Some(place) = place else { return };
        self.used.push(place);
        let name = &self.table.names[place];
        self.inquiry.warnings.push(format!("{name:?} is not used, because {said} is stated"));
    }

    pub(super) fn force(&mut self) -> Result<RawTrack, RecordingFileError> {
        let named = self.inquiry.map.force.clone().map(|column| self.place(&column)).transpose()?;
        let meant = self.meant(|meaning| matches!(meaning, Meaning::Force(_)));
        if let Some(force) = self.inquiry.map.constant_force {
            self.leave_out(named.or(meant.first().copied()), "a constant force");
            return Ok(RawTrack::Constant(force.0));
        }
        let along_z = self.meant(|meaning| matches!(meaning, Meaning::ForceZ(_)));
        let Some(place) = named.or(meant.first().copied()).or(along_z.first().copied()) else {
            let text =
                "the file has no normal force; name a column, or state a constant force such as \"1 N\"";
            self.inquiry.ask(Ask::Force, &[], text.to_owned());
            return Ok(RawTrack::Missing);
        };
        if named.is_none() && meant.is_empty() {
            let text = format!("{} is read as the normal force", self.name(&[place]));
            self.inquiry.guess(Ask::Force, &(place + 1).to_string(), &[], text);
        }
        self.inquiry.map.force = Some(self.column(place));
        if let Some(Meaning::Force(unit) | Meaning::ForceZ(unit)) = self.meanings[place] {
            let (what, stated) =
                (format!("the unit of {}", self.name(&[place])), self.inquiry.map.force_unit);
            self.inquiry.map.force_unit =
                self.inquiry.settle(&what, stated, unit, |unit| unit.name().to_owned());
        }
        let most = largest(&self.table.columns[place]);
        if self.inquiry.map.force_unit.is_none() {
            let names: Vec<&str> = ForceUnit::ALL.iter().map(|unit| unit.name()).collect();
            let text = format!(
                "the unit of {} is not stated; its largest magnitude is {most:.3}",
                self.name(&[place])
            );
            if is_newtons(&self.table.columns[place]) {
                let text = format!(
                    "{text}, too low for contact in other units, and neither counts nor fractions of full scale"
                );
                self.inquiry.guess(Ask::ForceUnit, ForceUnit::Newtons.name(), &names, text);
            } else {
                self.inquiry.ask(Ask::ForceUnit, &names, text);
            }
        }
        let si = self.inquiry.map.force_unit.map_or(1.0, ForceUnit::si);
        let column = &self.table.columns[place];
        if self.inquiry.map.pressing_is_negative.is_none() {
            let name = self.name(&[place]);
            if alternates(column) {
                let text = format!(
                    "{name} is positive part of the time and negative part of the time; state whether pressing is negative, and check that this is the normal force"
                );
                self.inquiry.ask(Ask::PressingIsNegative, &["yes", "no"], text);
            } else if median_of(column) < -0.01 * most {
                let text =
                    format!("{name} is negative most of the time, so pressing is assumed to be negative");
                self.inquiry.guess(Ask::PressingIsNegative, "yes", &["yes", "no"], text);
            }
        }
        let sign = if self.inquiry.map.pressing_is_negative == Some(true) { -1.0 } else { 1.0 };
        Ok(RawTrack::Column(self.take(place, sign * si)?))
    }
}
