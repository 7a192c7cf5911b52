//! From a recorded sweep to the response of an actuator.
//!
//! A sine that rises exponentially ([`Sweep`]) is played and the acceleration recorded, by whatever, at whatever rate, begun
//! whenever. Divided by the sweep the recording becomes an impulse response, in which distortion lies ahead of the
//! response itself, by harmonics (Farina 2000); a window keeps the one or the other. What is left is the gain over
//! frequency ([`CurvePoint`]), with the noise of the silence around the sweep beside it, and a second-order high-pass that
//! is fitted to it ([`Fit`]).

mod clipping;
mod curve;
mod fit;
mod impulse;
mod locate;
mod sweep;

pub use crate::calibration::fit::{Fit, FitError};
pub use crate::calibration::sweep::{Sweep, SweepError};

use std::fmt;

use crate::actuator::{Actuator, Calibrated, Drive, Limits, Measured, Physical, USUAL_LOWEST};
use crate::calibration::clipping::clipped_peaks;
use crate::calibration::curve::{distortion, gains, silence};
use crate::calibration::fit::{MIN_SNR_DB, MOST_CLIPPED, fit_response};
use crate::calibration::impulse::{Impulse, prepare};
use crate::calibration::locate::locate;
use crate::units::{Hertz, Kilograms};

/// Least band above [`MIN_SNR_DB`] that tells anything, in octaves.
const LEAST_OCTAVES: f64 = 1.0;
/// Deviation of a fit that is worth a word, in dB.
const POOR_FIT_DB: f64 = 2.0;
/// Distortion that is worth a word.
const DISTORTED: f64 = 0.1;

/// What a recorded sweep says.
#[derive(Clone, Debug, PartialEq)]
pub struct Calibration {
    /// The response, or why there is none in what was measured.
    pub fit: Result<Fit, FitError>,
    /// Gain over frequency, ascending, evenly spaced in its logarithm.
    pub curve: Vec<CurvePoint>,
    /// Distortion over frequency, where its harmonics lie within the sweep.
    pub distortion: Vec<DistortionPoint>,
    /// When the sweep begins in the recording, in seconds; below zero where the recording began later.
    pub begins_secs: f64,
    /// What the owner should know.
    pub warnings: Vec<CalibrationWarning>,
}

/// The gain at a frequency.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct CurvePoint {
    /// The frequency.
    pub frequency: Hertz,
    /// Gain in (m/s²)/V.
    pub gain_mps2_per_v: f64,
    /// What the noise around the sweep would pass for, in (m/s²)/V; `None` where there was no silence to hear it in.
    pub noise_mps2_per_v: Option<f64>,
}

/// The distortion at a frequency.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct DistortionPoint {
    /// The frequency that was played.
    pub frequency: Hertz,
    /// Second to fifth harmonic together, as a share of the acceleration at the frequency itself.
    pub share: f64,
}

/// Why a recording says nothing of an actuator.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum CalibrationError {
    /// The sweep itself has no meaning.
    #[error(transparent)]
    Sweep(#[from] SweepError),
    /// A sample is no number.
    #[error("sample {index} of the recording is not a finite number; record again")]
    NotFinite {
        /// Its index.
        index: usize,
    },
    /// The rate leaves too little of the sweep.
    #[error(
        "a recording at {rate_hz} Hz holds the sweep from {low_hz} Hz only to {high_hz:.0} Hz; record at 1000 Hz or more"
    )]
    Rate {
        /// The rate of the recording.
        rate_hz: f64,
        /// The lowest frequency of the sweep.
        low_hz: f64,
        /// The highest that the rate can hold.
        high_hz: f64,
    },
    /// There is no signal.
    #[error("the recording is silent; check the sensor, its cable and the input that was recorded")]
    Silent,
    /// Much shorter than the sweep.
    #[error(
        "the recording has {seconds:.1} s, the sweep {sweep_secs:.1} s; record from before its beginning to after its end"
    )]
    Short {
        /// Length of the recording in seconds.
        seconds: f64,
        /// Length of the sweep in seconds.
        sweep_secs: f64,
    },
    /// The sweep is not in it.
    #[error(
        "the recording does not hold the sweep of {sweep_secs} s from {low_hz} to {high_hz} Hz (found in {n_found} of {n_bands} octaves); check that this sweep was played, that the sensor sits on the actuator and that it is loud enough"
    )]
    NoSweep {
        /// Length of the sweep in seconds.
        sweep_secs: f64,
        /// Its lowest frequency.
        low_hz: f64,
        /// Its highest frequency.
        high_hz: f64,
        /// Octaves in which something begins at one time.
        n_found: usize,
        /// Octaves that were looked at.
        n_bands: usize,
    },
    /// The sweep is buried in noise.
    #[error(
        "the sweep is {MIN_SNR_DB} dB above the noise in {octaves:.1} octaves only, needs {LEAST_OCTAVES}; play it louder, or find what hums"
    )]
    Noisy {
        /// Octaves that are clear of noise.
        octaves: f64,
    },
}

/// What is not as it should be in a calibration that is usable nevertheless.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub enum CalibrationWarning {
    /// The recording was driven over its range.
    Clipped {
        /// Peaks that are cut off.
        n_peaks: usize,
        /// Samples of these peaks as a share of those of the sweep, 0..1.
        share: f64,
        /// Where they are cut off, in m/s².
        level_mps2: f64,
    },
    /// There is no silence around the sweep, so that the noise is not known.
    NoSilence,
    /// A part of the sweep is missing.
    Partial {
        /// The lowest frequency that is there.
        low_hz: f64,
        /// The highest frequency that is there.
        high_hz: f64,
    },
    /// Frequencies are buried in noise and were left out.
    Buried {
        /// The share of the curve.
        share: f64,
    },
    /// The response is not quite a second-order high-pass.
    PoorFit {
        /// Root mean square deviation in dB.
        error_db: f64,
    },
    /// The actuator or the sensor distorts.
    Distorted {
        /// The highest share of harmonics.
        share: f64,
        /// Where.
        at_hz: f64,
    },
}

impl fmt::Display for CalibrationWarning {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Clipped { n_peaks, share, level_mps2 } => write!(
                f,
                "{n_peaks} peaks of the recording ({:.2} % of the sweep) are cut off at {level_mps2:.3} m/s²: the actuator is stronger there, and its Q greater, than it seems; record with less gain, or play the sweep more quietly",
                100.0 * share
            ),
            Self::NoSilence => write!(
                f,
                "there is no silence around the sweep, so the noise is not known; record from a second before it to a second after it"
            ),
            Self::Partial { low_hz, high_hz } => write!(
                f,
                "the recording begins or ends within the sweep; {low_hz:.0} to {high_hz:.0} Hz of it were used"
            ),
            Self::Buried { share } => {
                write!(f, "{:.0} % of the frequencies are buried in noise and were left out", 100.0 * share)
            }
            Self::PoorFit { error_db } => write!(
                f,
                "one resonance describes what was measured only within {error_db:.1} dB (root mean square); look at the plot"
            ),
            Self::Distorted { share, at_hz } => write!(
                f,
                "harmonics reach {:.0} % at {at_hz:.0} Hz: the actuator or the sensor is driven over its range; play the sweep more quietly",
                100.0 * share
            ),
        }
    }
}

/// The actuator of `base`, or one of which nothing else is known, with the response that was fitted to what it did on `load`
/// through `drive`. Physical figures that followed from another response are left out.
pub fn fitted_actuator(base: Option<Actuator>, fit: &Fit, load: Option<Kilograms>, drive: Drive) -> Actuator {
    let known = base.unwrap_or(Actuator {
        id: String::new(),
        name: String::new(),
        maker: String::new(),
        source: String::new(),
        license: String::new(),
        measured: None,
        limits: Limits::default(),
        physical: Physical::default(),
        lowest: USUAL_LOWEST,
        calibrated: None,
    });
    let physical = Physical {
        force_factor_n_per_a: None,
        stiffness_n_per_m: None,
        damping_n_s_per_m: None,
        ..known.physical
    };
    Actuator {
        measured: Some(Measured { response: fit.response, load }),
        physical,
        calibrated: Some(Calibrated {
            fit_error_db: fit.error_db,
            resonance_error_hz: fit.resonance_error_hz,
            q_error: fit.q_error,
            gain_error_mps2_per_v: fit.gain_error_mps2_per_v,
            full_scale: drive.full_scale,
        }),
        ..known
    }
}

/// What `recording`, in m/s² at `rate`, says about the actuator that `sweep` was played on through `drive`.
///
/// When the sweep begins is found out; a clock that runs fast or slow by a hundred millionths, hum, gravity and slow drift
/// of the sensor do no harm.
///
/// # Errors
/// [`CalibrationError`]; that no resonance was found is no error but [`Calibration::fit`].
pub fn calibrate(
    recording: &[f64],
    rate: Hertz,
    sweep: &Sweep,
    drive: Drive,
) -> Result<Calibration, CalibrationError> {
    let within = check(recording, rate, sweep)?;
    let mut warnings = Vec::new();
    let clipped = clipped_peaks(recording, within.seconds * rate.0);
    let too_clipped = match clipped {
        Some(CalibrationWarning::Clipped { share, level_mps2, .. }) if share > MOST_CLIPPED => {
            Some(FitError::Clipped { share, level_mps2 })
        }
        _ => None,
    };
    warnings.extend(clipped);
    let (signal, rate) = prepare(recording, rate, sweep);
    let impulse = Impulse::new(&signal, rate, &within, drive);
    let begins_secs = locate(&impulse, &within, signal.len())?;
    let silence = silence(&signal, rate, begins_secs, sweep.seconds);
    if silence.is_empty() {
        warnings.push(CalibrationWarning::NoSilence);
    }
    let curve = gains(&impulse, &within, begins_secs, &silence);
    let recorded_secs = signal.len() as f64 / rate.0;
    let n_whole = curve.len();
    let is_there = |point: &CurvePoint| {
        let at_secs = begins_secs + sweep.time_of(point.frequency);
        at_secs >= 0.0 && at_secs + curve::RING_SECS <= recorded_secs
    };
    let curve: Vec<CurvePoint> = curve.into_iter().filter(is_there).collect();
    if let (Some(first), Some(last), true) = (curve.first(), curve.last(), curve.len() < n_whole) {
        let (low_hz, high_hz) = (first.frequency.0, last.frequency.0);
        warnings.push(CalibrationWarning::Partial { low_hz, high_hz });
    }
    let n_clear = curve.iter().filter(|point| fit::is_clear(point)).count();
    let octaves = n_clear as f64 / curve::POINTS_PER_OCTAVE;
    if octaves < LEAST_OCTAVES {
        return Err(CalibrationError::Noisy { octaves });
    }
    if n_clear < curve.len() {
        warnings.push(CalibrationWarning::Buried { share: 1.0 - n_clear as f64 / curve.len() as f64 });
    }
    let distortion = distortion(&impulse, &within, begins_secs, &curve);
    let fit = too_clipped.map_or_else(|| fit_response(&curve), Err);
    if let Ok(fit) = &fit
        && fit.error_db > POOR_FIT_DB
    {
        warnings.push(CalibrationWarning::PoorFit { error_db: fit.error_db });
    }
    let mut calibration = Calibration { fit, curve, distortion, begins_secs, warnings };
    if let Some(DistortionPoint { frequency, share }) =
        calibration.worst_distortion().filter(|worst| worst.share > DISTORTED)
    {
        calibration.warnings.push(CalibrationWarning::Distorted { share, at_hz: frequency.0 });
    }
    Ok(calibration)
}

impl Calibration {
    /// The highest distortion from half an octave below the resonance on: further down, harmonics lie nearer to the
    /// resonance than what is played, and any amplifier makes them stand out.
    pub fn worst_distortion(&self) -> Option<DistortionPoint> {
        let resonance_hz = self.fit.as_ref().map_or(0.0, |fit| fit.response.resonance().0);
        let counts = self
            .distortion
            .iter()
            .filter(|p| p.frequency.0 >= std::f64::consts::FRAC_1_SQRT_2 * resonance_hz);
        counts.max_by(|a, b| a.share.total_cmp(&b.share)).copied()
    }
}

/// The part of the sweep that a recording of this rate can hold.
fn check(recording: &[f64], rate: Hertz, sweep: &Sweep) -> Result<Sweep, CalibrationError> {
    sweep.check()?;
    let high_hz = sweep.high.0.min(sweep::NYQUIST_SHARE * 0.5 * rate.0);
    if !rate.0.is_finite() || high_hz.is_nan() || high_hz < sweep::LEAST_RATIO * sweep.low.0 {
        let (rate_hz, low_hz) = (rate.0, sweep.low.0);
        return Err(CalibrationError::Rate { rate_hz, low_hz, high_hz });
    }
    if let Some(index) = recording.iter().position(|sample| !sample.is_finite()) {
        return Err(CalibrationError::NotFinite { index });
    }
    let seconds = recording.len() as f64 / rate.0;
    if seconds < 0.5 * sweep.seconds {
        return Err(CalibrationError::Short { seconds, sweep_secs: sweep.seconds });
    }
    if recording.iter().all(|sample| *sample == recording[0]) {
        return Err(CalibrationError::Silent);
    }
    Ok(sweep.up_to(Hertz(high_hz)))
}

#[cfg(test)]
mod tests;
