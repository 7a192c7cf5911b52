//! Voice coil parameters and response from data sheet values.

use std::f64::consts::TAU;

use crate::actuator::voice_coil::check_positive;
use crate::actuator::{ActuatorError, Response};
use crate::units::{Hertz, Kilograms, Volts};

/// Data sheet values of a voice coil actuator.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct DataSheet {
    /// Moving mass.
    pub moving_mass: Kilograms,
    /// Mass of the whole actuator.
    pub total_mass: Kilograms,
    /// Load mass of the measurement.
    pub load: Kilograms,
    /// Resistance of the coil in Ω.
    pub resistance_ohm: f64,
    /// Resonance frequency on that load.
    pub resonance: Hertz,
    /// Rated voltage, root mean square, assumed to apply at the resonance.
    pub rated_volts_rms: Volts,
    /// Rated current, root mean square in A, at that voltage.
    pub rated_amps_rms: f64,
    /// Peak voltage (half of peak to peak).
    pub peak_volts: Volts,
    /// Peak acceleration at the resonance for that voltage, in m/s².
    pub peak_mps2: f64,
}

/// Mechanical and electrical parameters of a voice coil.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Mechanics {
    /// Moving mass.
    pub moving_mass: Kilograms,
    /// Mass of the case, including all fixed parts.
    pub body_mass: Kilograms,
    /// Resistance of the coil in Ω.
    pub resistance_ohm: f64,
    /// Force factor Bl, in N/A.
    pub force_factor_n_per_a: f64,
    /// Stiffness of the spring in N/m.
    pub stiffness_n_per_m: f64,
    /// Damping of the suspension in N s/m, without the electromagnetic damping of the coil.
    pub damping_n_s_per_m: f64,
}

impl Mechanics {
    /// Identifies the parameters from data sheet values.
    ///
    /// At the resonance the motion adds `Z = Bl²/b` to the resistance, and the case acceleration is
    /// `a = (m_r/m_t) ω₀ Z I / Bl`. `Z` follows from the rated voltage and current, and `Bl` from the peak values.
    ///
    /// # Errors
    /// [`ActuatorError::Number`] if a value is not positive. [`ActuatorError::Contradiction`] if the moving mass
    /// exceeds the total mass, or if the rated current needs more than the rated voltage for the resistance alone.
    pub fn identified(sheet: &DataSheet) -> Result<Self, ActuatorError> {
        for (what, value) in [
            ("the moving mass in kg", sheet.moving_mass.0),
            ("the total mass in kg", sheet.total_mass.0),
            ("the load in kg", sheet.load.0),
            ("the resistance in Ω", sheet.resistance_ohm),
            ("the resonance in Hz", sheet.resonance.0),
            ("the rated voltage in V rms", sheet.rated_volts_rms.0),
            ("the rated current in A rms", sheet.rated_amps_rms),
            ("the peak voltage in V", sheet.peak_volts.0),
            ("the peak acceleration in m/s²", sheet.peak_mps2),
        ] {
            check_positive(what, value)?;
        }
        let body = sheet.total_mass.0 - sheet.moving_mass.0;
        if body <= 0.0 {
            let (moving, total) = (sheet.moving_mass.g(), sheet.total_mass.g());
            let reason = format!("the moving mass is {moving:.3} g, but the total mass is {total:.3} g");
            return Err(ActuatorError::Contradiction { reason });
        }
        let impedance = sheet.rated_volts_rms.0 / sheet.rated_amps_rms;
        let motional = impedance - sheet.resistance_ohm;
        if motional <= 0.0 {
            let resistance = sheet.resistance_ohm;
            let reason = format!(
                "the rated voltage divided by the rated current is {impedance:.3} Ω, but the coil resistance alone is {resistance:.3} Ω"
            );
            return Err(ActuatorError::Contradiction { reason });
        }
        let case = body + sheet.load.0;
        let reduced = sheet.moving_mass.0 * case / (sheet.moving_mass.0 + case);
        let omega = TAU * sheet.resonance.0;
        let peak_amps = sheet.peak_volts.0 / impedance;
        let force_factor = reduced / case * omega * motional * peak_amps / sheet.peak_mps2;
        Ok(Self {
            moving_mass: sheet.moving_mass,
            body_mass: Kilograms(body),
            resistance_ohm: sheet.resistance_ohm,
            force_factor_n_per_a: force_factor,
            stiffness_n_per_m: reduced * omega * omega,
            damping_n_s_per_m: force_factor * force_factor / motional,
        })
    }

    /// Response to a voltage on a load, without the coil inductance:
    /// `a/V = (Bl/(m_t R)) s² / (s² + ((b + Bl²/R)/m_r) s + k/m_r)`.
    ///
    /// # Errors
    /// [`ActuatorError::Number`] if the load is not positive or a parameter of the response is out of range.
    pub fn response_on(&self, load: Kilograms) -> Result<Response, ActuatorError> {
        check_positive("the load in kg", load.0)?;
        let case = self.body_mass.0 + load.0;
        let reduced = self.moving_mass.0 * case / (self.moving_mass.0 + case);
        let omega = (self.stiffness_n_per_m / reduced).sqrt();
        let by_coil = self.force_factor_n_per_a.powi(2) / self.resistance_ohm;
        let q = reduced * omega / (self.damping_n_s_per_m + by_coil);
        Response::new(Hertz(omega / TAU), q, self.force_factor_n_per_a / (case * self.resistance_ohm))
    }
}
