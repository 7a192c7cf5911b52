//! Voice coil actuators: response to a voltage, limits, and the inverse filter that compensates the response.
//!
//! A mass on a spring moves within a case that is fixed to the load, such as a stylus. Driven by a voltage, the
//! acceleration of the case is a second-order high-pass ([`Response`]). It peaks at the resonance, is flat far above it
//! and falls by 40 dB per decade below it. The load affects the response: on a lighter stylus all accelerations are
//! larger ([`Actuator::at_load`]).

mod data_sheet;
mod drive;
mod headroom;
mod inverse;
mod response;

pub use crate::actuator::voice_coil::data_sheet::{DataSheet, Mechanics};
pub use crate::actuator::voice_coil::drive::{Drive, drive_config, limited_drive};
pub use crate::actuator::voice_coil::headroom::Headroom;
pub use crate::actuator::voice_coil::inverse::{inverse, inverse_gain_bound};
pub use crate::actuator::voice_coil::response::Response;

use crate::actuator::friction_display::{FRICTION_CARRIERS_HZ, FRICTION_CHANNELS, FrictionDisplay};
use crate::actuator::named_channel::{NamedChannel, problem_of_channels};
use crate::units::{Hertz, Kilograms, Volts};

/// Default lowest frequency of the inverse filter.
pub const USUAL_LOWEST: Hertz = Hertz(20.0);

/// Default thermal time constant of the coil in seconds, for a few grams of copper and iron.
pub const USUAL_THERMAL_SECS: f64 = 10.0;

/// Actuator profile: identity, response and limits. Unknown values are `None`.
#[derive(Clone, Debug, PartialEq)]
pub struct Actuator {
    /// Unique and stable identifier of lower-case letters, digits and hyphens.
    pub id: String,
    /// Display name.
    pub name: String,
    /// Manufacturer; may be empty.
    pub maker: String,
    /// Source of the values, in one sentence.
    pub source: String,
    /// License of the values; may be empty.
    pub license: String,
    /// Response on a load; `None` until measured.
    pub measured: Option<Measured>,
    /// Electrical limits.
    pub limits: Limits,
    /// Physical parameters.
    pub physical: Physical,
    /// Lowest frequency that the inverse filter reproduces.
    pub lowest: Hertz,
    /// Accuracy of the response, if it was fitted to a recording.
    pub calibrated: Option<Calibrated>,
    /// Display that renders friction beside the coil, if there is one.
    pub friction: Option<FrictionDisplay>,
    /// Channels of a device with several actuators; empty for a single actuator on any channel.
    pub channels: Vec<NamedChannel>,
}

/// Measured response of an actuator, and the load during the measurement.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Measured {
    /// Acceleration of the case for a voltage.
    pub response: Response,
    /// Mass that the case was fixed to, without the actuator; `None` if unknown.
    pub load: Option<Kilograms>,
}

/// Electrical limits of a coil.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Limits {
    /// Maximum continuous voltage, root mean square.
    pub rated_volts_rms: Option<Volts>,
    /// Maximum continuous current, root mean square, in A.
    pub rated_amps_rms: Option<f64>,
    /// Maximum instantaneous voltage.
    pub peak_volts: Option<Volts>,
    /// Thermal time constant of the coil in seconds, the averaging time of the root mean square.
    pub thermal_secs: f64,
}

/// Physical parameters of an actuator.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Physical {
    /// Moving mass.
    pub moving_mass: Option<Kilograms>,
    /// Mass of the case, including all fixed parts.
    pub body_mass: Option<Kilograms>,
    /// Resistance of the coil in Ω.
    pub resistance_ohm: Option<f64>,
    /// Inductance of the coil in H.
    pub inductance_h: Option<f64>,
    /// Force factor Bl, in N/A.
    pub force_factor_n_per_a: Option<f64>,
    /// Stiffness of the spring in N/m.
    pub stiffness_n_per_m: Option<f64>,
    /// Damping of the suspension in N s/m, without the electromagnetic damping of the coil.
    pub damping_n_s_per_m: Option<f64>,
}

/// Accuracy of a response that was fitted to a recording.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Calibrated {
    /// Root mean square deviation of the recording from the response, in dB.
    pub fit_error_db: f64,
    /// Standard error of the resonance frequency in Hz.
    pub resonance_error_hz: f64,
    /// Standard error of the quality factor Q.
    pub q_error: f64,
    /// Standard error of the gain in (m/s²)/V.
    pub gain_error_mps2_per_v: f64,
    /// Voltage at digital full scale that the fit assumed.
    pub full_scale: Volts,
}

/// Error of an actuator operation.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum ActuatorError {
    /// A number is out of range.
    #[error("{what} is {value}, needs {needs}")]
    Number {
        /// Name of the quantity, with its unit.
        what: &'static str,
        /// Value of the quantity.
        value: f64,
        /// Valid values.
        needs: &'static str,
    },
    /// The named channels contradict each other.
    #[error("{problem}")]
    Channels {
        /// Contradiction, with numbers and names.
        problem: String,
    },
    /// The actuator has no response.
    #[error("the response of {id} is unknown; calibrate it")]
    NoResponse {
        /// Identifier of the actuator.
        id: String,
    },
    /// The response on another load cannot be computed from the known values.
    #[error("the response of {id} on another load needs {missing}; calibrate it on the load")]
    NoLoad {
        /// Identifier of the actuator.
        id: String,
        /// Missing value.
        missing: &'static str,
    },
    /// The sample rate is too low for the resonance or the lowest frequency.
    #[error(
        "{what} of {hz} Hz must be below half of the sample rate of {rate_hz} Hz; use a higher sample rate"
    )]
    Rate {
        /// Quantity that is too high.
        what: &'static str,
        /// Its frequency in Hz.
        hz: f64,
        /// Sample rate in Hz.
        rate_hz: f64,
    },
    /// The data sheet values contradict each other.
    #[error("the data sheet values contradict each other: {reason}; check them")]
    Contradiction {
        /// Contradiction, with the values.
        reason: String,
    },
}

/// Limit of an actuator that cannot be enforced.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum LimitsWarning {
    /// The current is rated, but the resistance is unknown, so no voltage limit follows.
    #[error(
        "{id} is rated for {rated_amps_rms} A rms, but its coil resistance is unknown, so this limit is not enforced; \
         state the resistance in Ω"
    )]
    CurrentWithoutResistance {
        /// Identifier of the actuator.
        id: String,
        /// Maximum continuous current, root mean square, in A.
        rated_amps_rms: f64,
    },
}

impl Default for Limits {
    fn default() -> Self {
        Self {
            rated_volts_rms: None,
            rated_amps_rms: None,
            peak_volts: None,
            thermal_secs: USUAL_THERMAL_SECS,
        }
    }
}

impl Actuator {
    /// Whether the actuator is driven in proportion to the acceleration until its response is known: its device has
    /// amplifiers of its own, whose limits nobody can exceed by a digital signal.
    pub fn is_proportional(&self) -> bool {
        self.measured.is_none() && !self.channels.is_empty()
    }

    /// Response on the load of the measurement.
    ///
    /// # Errors
    /// [`ActuatorError::NoResponse`] if the response is unknown.
    pub fn response(&self) -> Result<Response, ActuatorError> {
        let measured = self.measured.as_ref().map(|measured| measured.response);
        measured.ok_or_else(|| ActuatorError::NoResponse { id: self.id.clone() })
    }

    /// Limits in volts: the rated voltage or, without one, the voltage `I R` of the rated current `I` through the coil
    /// resistance `R`.
    ///
    /// The impedance is never below `R`, so that `I R` never drives more than `I`. A rated voltage can exceed the rated
    /// current away from the resonance at which it was rated.
    pub fn limits_in_volts(&self) -> Limits {
        let of_current = || Some(Volts(self.limits.rated_amps_rms? * self.physical.resistance_ohm?));
        Limits { rated_volts_rms: self.limits.rated_volts_rms.or_else(of_current), ..self.limits }
    }

    /// Warning about a limit that [`Actuator::limits_in_volts`] cannot express; show it before the actuator is driven.
    pub fn limits_warning(&self) -> Option<LimitsWarning> {
        let rated_amps_rms = self.limits.rated_amps_rms?;
        let is_known = self.limits_in_volts().rated_volts_rms.is_some();
        (!is_known).then(|| LimitsWarning::CurrentWithoutResistance { id: self.id.clone(), rated_amps_rms })
    }

    /// Actuator on another load, computed from the masses.
    ///
    /// `m_t` is the mass of case and load. `m_r = m_a m_t / (m_a + m_t)` is the reduced mass of it and the moving mass
    /// `m_a`. The gain scales with `1/m_t`; the squared resonance frequency and the resonance width scale with `1/m_r`.
    ///
    /// # Errors
    /// [`ActuatorError`] if the load is not positive, or if the response or a mass is unknown. The load of the
    /// measurement itself needs no masses.
    pub fn at_load(&self, load: Kilograms) -> Result<Self, ActuatorError> {
        check_positive("the load in kg", load.0)?;
        let response = self.response()?;
        let missing = |missing| ActuatorError::NoLoad { id: self.id.clone(), missing };
        let measured_load =
            self.measured.and_then(|m| m.load).ok_or_else(|| missing("the load it was measured on"))?;
        let measured = if measured_load == load {
            response
        } else {
            let moving = self.physical.moving_mass.ok_or_else(|| missing("its moving mass"))?.0;
            let body = self.physical.body_mass.ok_or_else(|| missing("the mass of its case"))?.0;
            let (from, to) = (body + measured_load.0, body + load.0);
            let against = |rest: f64| moving * rest / (moving + rest);
            let ratio = against(from) / against(to);
            // The width ω₀/Q scales with 1/m_r, and ω₀ with its square root.
            Response::new(
                Hertz(response.resonance().0 * ratio.sqrt()),
                response.q() / ratio.sqrt(),
                response.gain_mps2_per_v() * from / to,
            )?
        };
        let measured = Some(Measured { response: measured, load: Some(load) });
        Ok(Self { measured, ..self.clone() })
    }
}

/// Highest limits of a voice coil that vibrates a stylus or a fingertip.
const MAX_VOLTS: f64 = 100.0;
const MAX_AMPS: f64 = 50.0;
/// Highest value of any other number, in its unit.
const MAX_NUMBER: f64 = 1e9;

/// Checks that all numbers are in range.
///
/// # Errors
/// [`ActuatorError::Number`] for the first number out of range.
pub fn validate(actuator: &Actuator) -> Result<(), ActuatorError> {
    let volts = |volts: Option<Volts>| volts.map(|volts| volts.0);
    let kilograms = |mass: Option<Kilograms>| mass.map(|mass| mass.0);
    let Actuator { limits, physical, calibrated, .. } = actuator;
    let numbers = [
        ("the lowest frequency in Hz", Some(actuator.lowest.0)),
        ("the load in kg", actuator.measured.and_then(|m| kilograms(m.load))),
        ("the thermal time constant in s", Some(limits.thermal_secs)),
        ("the moving mass in kg", kilograms(physical.moving_mass)),
        ("the mass of the case in kg", kilograms(physical.body_mass)),
        ("the resistance in Ω", physical.resistance_ohm),
        ("the inductance in H", physical.inductance_h),
        ("the force factor in N/A", physical.force_factor_n_per_a),
        ("the stiffness in N/m", physical.stiffness_n_per_m),
        ("the damping in N s/m", physical.damping_n_s_per_m),
        ("the full scale in V", calibrated.map(|c| c.full_scale.0)),
    ];
    for (what, value) in numbers {
        value.map_or(Ok(()), |value| check_positive(what, value))?;
        if let Some(value) = value.filter(|value| *value > MAX_NUMBER) {
            return Err(ActuatorError::Number { what, value, needs: "a number of at most 1e9" });
        }
    }
    // A limit that no voice coil has would be none.
    let bounded = [
        (
            "the rated voltage in V rms",
            volts(limits.rated_volts_rms),
            MAX_VOLTS,
            "a number above 0, at most 100",
        ),
        ("the rated current in A rms", limits.rated_amps_rms, MAX_AMPS, "a number above 0, at most 50"),
        ("the peak voltage in V", volts(limits.peak_volts), MAX_VOLTS, "a number above 0, at most 100"),
    ];
    for (what, value, most, needs) in bounded {
        if let Some(value) = value.filter(|value| !(*value > 0.0 && *value <= most)) {
            return Err(ActuatorError::Number { what, value, needs });
        }
    }
    if let Some(FrictionDisplay { carrier, channel }) = actuator.friction {
        if !FRICTION_CARRIERS_HZ.contains(&carrier.0) {
            let (what, needs) = ("the carrier of the friction display in Hz", "20 to 80000");
            return Err(ActuatorError::Number { what, value: carrier.0, needs });
        }
        if !FRICTION_CHANNELS.contains(&channel) {
            let (what, needs) = ("the channel of the friction display", "1 to 64");
            return Err(ActuatorError::Number { what, value: f64::from(channel), needs });
        }
    }
    let friction = actuator.friction.map(|display| display.channel);
    if let Some(problem) = problem_of_channels(&actuator.channels, friction) {
        return Err(ActuatorError::Channels { problem });
    }
    let errors = calibrated.map(|c| {
        [
            ("the error of the fit in dB", c.fit_error_db),
            ("the standard error of the resonance in Hz", c.resonance_error_hz),
            ("the standard error of Q", c.q_error),
            ("the standard error of the gain in (m/s²)/V", c.gain_error_mps2_per_v),
        ]
    });
    for (what, value) in errors.into_iter().flatten() {
        if !(value.is_finite() && value >= 0.0) {
            return Err(ActuatorError::Number { what, value, needs: "a number of 0 or more" });
        }
    }
    Ok(())
}

/// Returns an error if the value is not a finite number above zero.
pub(crate) fn check_positive(what: &'static str, value: f64) -> Result<(), ActuatorError> {
    if value.is_finite() && value > 0.0 {
        Ok(())
    } else {
        Err(ActuatorError::Number { what, value, needs: "a number above 0" })
    }
}

#[cfg(test)]
mod tests;
