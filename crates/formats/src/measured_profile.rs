//! The actuator profile from a calibration, with a sentence that states the source of its figures.

use shagreen_core::actuator::calibration::{Fit, fitted_actuator};
use shagreen_core::actuator::{Actuator, Drive};
use shagreen_core::units::Kilograms;

use crate::library::id_from_name;

/// Text before the source of the figures that were not measured. Saved profiles contain it, so it must not change.
const REST: &str = "; everything else from ";

/// The conditions of a calibration measurement.
#[derive(Clone, Debug, PartialEq)]
pub struct CalibrationConditions {
    /// New name of the actuator.
    pub name: String,
    /// Description of the output or the recording that was measured.
    pub heard: String,
    /// Mass of the load, if known.
    pub load: Option<Kilograms>,
    /// Conversion of samples to volts.
    pub drive: Drive,
    /// Whether the voltage is assumed instead of measured.
    pub is_drive_assumed: bool,
}

/// Returns the profile of a calibrated actuator: `base`, or an otherwise unknown actuator, with the fitted response, a
/// new name and identifier, and the source of its figures. Figures that were not measured keep their source in `base`,
/// even if `base` was calibrated itself.
pub fn measured_profile(base: Option<Actuator>, fit: &Fit, how: CalibrationConditions) -> Actuator {
    let CalibrationConditions { name, heard, load, drive, is_drive_assumed } = how;
    let on = load.map_or("an unknown load".to_owned(), |load| format!("{} g", load.g()));
    let assumed = if is_drive_assumed { ", which is assumed, not measured" } else { "" };
    let volts = drive.full_scale.0;
    let rest = base.as_ref().and_then(|base| match base.calibrated {
        None => Some(format!("{REST}the profile {}: {}", base.id, base.source)),
        // The response of `base` is replaced, so only the source of its other figures remains.
        Some(_) => base.source.find(REST).map(|at| base.source[at..].to_owned()),
    });
    let source = format!(
        "Response measured on {on} with a swept sine ({heard}), with {volts} V at digital full scale{assumed}{}",
        rest.unwrap_or_default()
    );
    Actuator { id: id_from_name(&name), name, source, ..fitted_actuator(base, fit, load, drive) }
}

#[cfg(test)]
mod tests {
    use super::{CalibrationConditions, measured_profile};
    use crate::actuator_toml::built_in_actuators;
    use shagreen_core::actuator::Drive;
    use shagreen_core::actuator::calibration::Fit;
    use shagreen_core::units::{Hertz, Kilograms, Volts};

    #[test]
    fn the_source_of_what_was_not_measured_is_kept_once() {
        let base = built_in_actuators().unwrap().into_iter().find(|a| a.measured.is_some()).unwrap();
        let source = base.source.clone();
        let fit = Fit {
            response: base.measured.unwrap().response,
            error_db: 0.1,
            resonance_error_hz: 0.1,
            q_error: 0.1,
            gain_error_mps2_per_v: 0.1,
            band: (Hertz(10.0), Hertz(1000.0)),
            n_points: 100,
        };
        let how = |heard: &str| CalibrationConditions {
            name: "Mine, measured".to_owned(),
            heard: heard.to_owned(),
            load: Some(Kilograms::from_g(40.0)),
            drive: Drive::new(Volts(2.0)).unwrap(),
            is_drive_assumed: false,
        };
        let once = measured_profile(Some(base), &fit, how("one.wav"));
        assert!(
            once.source.contains("40 g") && once.source.contains("one.wav") && once.source.contains("2 V")
        );
        assert!(once.source.ends_with(&source), "{}", once.source);
        let twice = measured_profile(Some(once.clone()), &fit, how("two.wav"));
        assert_eq!(twice.source, once.source.replace("one.wav", "two.wav"));
        assert_eq!(twice.id, "mine-measured");
        assert!(measured_profile(None, &fit, how("x")).source.ends_with("full scale"));
    }
}
