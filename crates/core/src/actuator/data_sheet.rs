//! From the figures of a data sheet to a response.

use std::f64::consts::TAU;

use crate::actuator::{ActuatorError, Response, check_positive};
use crate::units::{Hertz, Kilograms, Volts};

/// What the data sheet of a voice coil says.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct DataSheet {
    /// Mass of what moves within the case.
    pub moving_mass: Kilograms,
    /// Mass of the whole actuator.
    pub total_mass: Kilograms,
    /// Mass that it was measured on.
    pub load: Kilograms,
    /// Resistance of the coil in Ω.
    pub resistance_ohm: f64,
    /// Resonance on that load.
    pub resonance: Hertz,
    /// Rated voltage, root mean square, taken to be at the resonance.
    pub rated_volts_rms: Volts,
    /// Rated current, root mean square in A, at that voltage.
    pub rated_amps_rms: f64,
    /// Peak of a voltage (half of peak to peak).
    pub peak_volts: Volts,
    /// Peak of the acceleration at the resonance for that voltage, in m/s².
    pub peak_mps2: f64,
}

/// The masses, spring and motor of a voice coil.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Mechanics {
    /// Mass of what moves within the case.
    pub moving_mass: Kilograms,
    /// Mass of the case with all that does not move in it.
    pub body_mass: Kilograms,
    /// Resistance of the coil in Ω.
    pub resistance_ohm: f64,
    /// Force for a current, Bl, in N/A.
    pub force_factor_n_per_a: f64,
    /// Stiffness of the spring in N/m.
    pub stiffness_n_per_m: f64,
    /// Damping of the suspension in N s/m, without that of the coil.
    pub damping_n_s_per_m: f64,
}

impl Mechanics {
    /// The masses, spring and motor that a data sheet implies.
    ///
    /// At the resonance the motion adds `Z = Bl²/b` to the resistance, and the case accelerates by
    /// `a = (m_r/m_t) ω₀ Z I / Bl`: the first follows from rated voltage and current, the second from the peaks.
    ///
    /// # Errors
    /// [`ActuatorError`] where a number has no meaning, or the rated current would take more than the rated voltage through
    /// the resistance alone.
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
            let reason = format!("{moving:.3} g move within {total:.3} g");
            return Err(ActuatorError::Contradiction { reason });
        }
        let impedance = sheet.rated_volts_rms.0 / sheet.rated_amps_rms;
        let motional = impedance - sheet.resistance_ohm;
        if motional <= 0.0 {
            let resistance = sheet.resistance_ohm;
            let reason =
                format!("rated voltage over current is {impedance:.3} Ω, the coil alone {resistance:.3} Ω");
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

    /// The response to a voltage on a load, without the coil's inductance:
    /// `a/V = (Bl/(m_t R)) s² / (s² + ((b + Bl²/R)/m_r) s + k/m_r)`.
    ///
    /// # Errors
    /// [`ActuatorError::Number`].
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
