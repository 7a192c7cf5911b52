//! Voice coils: what they make of a voltage, what they bear, and the filter that makes up for them.
//!
//! A mass on a spring moves within a case that is fixed to the load, such as a pen. Driven by a voltage, the case
//! accelerates as a second-order high-pass does ([`Response`]): loudest at its resonance, flat far above it, falling by
//! 40 dB a decade below it. The load is part of it: on a lighter pen everything is louder ([`Actuator::at_load`]).

mod data_sheet;
mod drive;
mod headroom;
mod inverse;
mod response;

pub use crate::actuator::data_sheet::{DataSheet, Mechanics};
pub use crate::actuator::drive::{Drive, drive_config, limited_drive};
pub use crate::actuator::headroom::Headroom;
pub use crate::actuator::inverse::{inverse, inverse_gain_bound};
pub use crate::actuator::response::Response;

use crate::units::{Hertz, Kilograms, Volts};

/// The lowest frequency that is reproduced where a profile does not say another.
pub const USUAL_LOWEST: Hertz = Hertz(20.0);

/// Time constant of the coil's heat where a data sheet does not say one, in seconds: a few grams of copper and iron.
pub const USUAL_THERMAL_SECS: f64 = 10.0;

/// An actuator: who made it, what it does and what it bears. Everything that nobody stated is `None`.
#[derive(Clone, Debug, PartialEq)]
pub struct Actuator {
    /// Unique and stable, of lower-case letters, digits and hyphens.
    pub id: String,
    /// What people call it.
    pub name: String,
    /// Who makes it; may be empty.
    pub maker: String,
    /// Where the figures come from, in a sentence.
    pub source: String,
    /// Terms of the figures, where there are any.
    pub license: String,
    /// What it does on a load; `None` until somebody measures it.
    pub measured: Option<Measured>,
    /// What it bears.
    pub limits: Limits,
    /// What it consists of.
    pub physical: Physical,
    /// The lowest frequency that its inverse reproduces.
    pub lowest: Hertz,
    /// How good the response is, where it was fitted to a recording.
    pub calibrated: Option<Calibrated>,
}

/// A response and the load it holds for.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Measured {
    /// What the case does for a volt.
    pub response: Response,
    /// Mass of what the case was fixed to, without the actuator; `None` where nobody weighed it.
    pub load: Option<Kilograms>,
}

/// What a coil bears.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Limits {
    /// Highest root mean square of the voltage in the long run.
    pub rated_volts_rms: Option<Volts>,
    /// Highest root mean square of the current in the long run, in A.
    pub rated_amps_rms: Option<f64>,
    /// Highest voltage at any moment.
    pub peak_volts: Option<Volts>,
    /// Time constant of the coil's heat in seconds: over about so long the root mean square counts.
    pub thermal_secs: f64,
}

/// What an actuator consists of.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Physical {
    /// Mass of what moves within the case.
    pub moving_mass: Option<Kilograms>,
    /// Mass of the case with all that does not move in it.
    pub body_mass: Option<Kilograms>,
    /// Resistance of the coil in Ω.
    pub resistance_ohm: Option<f64>,
    /// Inductance of the coil in H.
    pub inductance_h: Option<f64>,
    /// Force for a current, Bl, in N/A.
    pub force_factor_n_per_a: Option<f64>,
    /// Stiffness of the spring in N/m.
    pub stiffness_n_per_m: Option<f64>,
    /// Damping of the suspension in N s/m, without that of the coil.
    pub damping_n_s_per_m: Option<f64>,
}

/// How good a response is that was fitted to a recording.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Calibrated {
    /// Root mean square deviation of the recording from the response, in dB.
    pub fit_error_db: f64,
    /// Standard error of the resonance in Hz.
    pub resonance_error_hz: f64,
    /// Standard error of Q.
    pub q_error: f64,
    /// Standard error of the gain in (m/s²)/V.
    pub gain_error_mps2_per_v: f64,
    /// Volts that digital full scale was taken for.
    pub full_scale: Volts,
}

/// Why an actuator cannot do what was asked.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum ActuatorError {
    /// A number has no meaning.
    #[error("{what} is {value}, needs {needs}")]
    Number {
        /// What it is of, with its unit.
        what: &'static str,
        /// The number.
        value: f64,
        /// What would have a meaning.
        needs: &'static str,
    },
    /// There is no response.
    #[error("nobody has stated a response of {id}; calibrate it")]
    NoResponse {
        /// The actuator.
        id: String,
    },
    /// A response for another load does not follow from what is known.
    #[error("the response of {id} on another load needs {missing}; calibrate it on the load")]
    NoLoad {
        /// The actuator.
        id: String,
        /// What is not known of it.
        missing: &'static str,
    },
    /// The sampling rate is too low for the resonance or the lowest frequency.
    #[error("{what} of {hz} Hz is not below half of the rate of {rate_hz} Hz; use a higher rate")]
    Rate {
        /// What is too high.
        what: &'static str,
        /// Where it is.
        hz: f64,
        /// The rate.
        rate_hz: f64,
    },
    /// The figures of a data sheet contradict each other.
    #[error("the data sheet contradicts itself: {reason}; check its figures")]
    Contradiction {
        /// What does not fit, with the numbers.
        reason: String,
    },
}

/// What of an actuator's limits nothing keeps.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum LimitsWarning {
    /// A current is rated, and no voltage follows from it.
    #[error(
        "{id} bears {rated_amps_rms} A in the long run, and nobody has stated a resistance of its coil: nothing keeps that \
         limit; state its resistance in Ω"
    )]
    CurrentWithoutResistance {
        /// The actuator.
        id: String,
        /// Highest root mean square of the current in the long run, in A.
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
    /// The response that it has on the load that it was measured on.
    ///
    /// # Errors
    /// [`ActuatorError::NoResponse`].
    pub fn response(&self) -> Result<Response, ActuatorError> {
        let measured = self.measured.as_ref().map(|measured| measured.response);
        measured.ok_or_else(|| ActuatorError::NoResponse { id: self.id.clone() })
    }

    /// What it bears, in volts: the maker's rated voltage, and where none is rated the voltage `I R` of the rated current `I`
    /// through the resistance `R` of the coil. Its impedance is nowhere below that, so that `I R` never drives more than `I`;
    /// a rated voltage may, beside the resonance at which it was rated.
    pub fn limits_in_volts(&self) -> Limits {
        let of_current = || Some(Volts(self.limits.rated_amps_rms? * self.physical.resistance_ohm?));
        Limits { rated_volts_rms: self.limits.rated_volts_rms.or_else(of_current), ..self.limits }
    }

    /// What [`Actuator::limits_in_volts`] cannot say, for whoever drives it to be shown.
    pub fn limits_warning(&self) -> Option<LimitsWarning> {
        let rated_amps_rms = self.limits.rated_amps_rms?;
        let is_known = self.limits_in_volts().rated_volts_rms.is_some();
        (!is_known).then(|| LimitsWarning::CurrentWithoutResistance { id: self.id.clone(), rated_amps_rms })
    }

    /// The actuator on another load: with `m_t` the mass of case and load and `m_r = m_a m_t / (m_a + m_t)` that of case,
    /// load and moving mass `m_a` against each other, the gain goes as `1/m_t`, the square of the resonance and its width
    /// as `1/m_r`.
    ///
    /// # Errors
    /// [`ActuatorError`]; a load that it was measured on needs no masses.
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
            // The width ω₀/Q goes as 1/m_r, and ω₀ as its root.
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

/// Whether all numbers have a meaning.
///
/// # Errors
/// [`ActuatorError::Number`] for the first that has none.
pub fn validate(actuator: &Actuator) -> Result<(), ActuatorError> {
    let volts = |volts: Option<Volts>| volts.map(|volts| volts.0);
    let kilograms = |mass: Option<Kilograms>| mass.map(|mass| mass.0);
    let Actuator { limits, physical, calibrated, .. } = actuator;
    let numbers = [
        ("the lowest frequency in Hz", Some(actuator.lowest.0)),
        ("the load in kg", actuator.measured.and_then(|m| kilograms(m.load))),
        ("the rated voltage in V rms", volts(limits.rated_volts_rms)),
        ("the rated current in A rms", limits.rated_amps_rms),
        ("the peak voltage in V", volts(limits.peak_volts)),
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

/// Refuses what is not a finite number above zero.
pub(crate) fn check_positive(what: &'static str, value: f64) -> Result<(), ActuatorError> {
    if value.is_finite() && value > 0.0 {
        Ok(())
    } else {
        Err(ActuatorError::Number { what, value, needs: "a number above 0" })
    }
}

#[cfg(test)]
mod tests;
