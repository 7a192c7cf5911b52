//! Calibration: identifies the response of an actuator from a recorded sweep.
//!
//! An exponential sine sweep ([`Sweep`]) is played and the acceleration recorded, with any recorder, sample rate and
//! start time. Division by the sweep gives an impulse response, in which the harmonic distortion precedes the linear
//! response (Farina 2000). Windows separate the two. The result is the gain over frequency ([`CurvePoint`]), the noise
//! from the silence around the sweep, and a fitted second-order high-pass ([`Fit`]).

mod clipping;
mod curve;
mod fit;
mod impulse;
mod locate;
mod sweep;

pub use crate::actuator::calibration::fit::{Fit, FitError};
pub use crate::actuator::calibration::sweep::{Sweep, SweepError};

use std::fmt;

use crate::actuator::calibration::clipping::clipped_peaks;
use crate::actuator::calibration::curve::{distortion, gains, silence};
use crate::actuator::calibration::fit::{MIN_SNR_DB, MOST_CLIPPED, fit_response};
use crate::actuator::calibration::impulse::{Impulse, prepare};
use crate::actuator::calibration::locate::locate;
use crate::actuator::{Actuator, Calibrated, Drive, Limits, Measured, Physical, USUAL_LOWEST};
use crate::units::{Hertz, Kilograms};

/// Minimum bandwidth with at least [`MIN_SNR_DB`], in octaves.
const LEAST_OCTAVES: f64 = 1.0;
/// Deviation of a fit above which a warning is given, in dB.
const POOR_FIT_DB: f64 = 2.0;
/// Distortion above which a warning is given, relative to the fundamental.
const DISTORTED: f64 = 0.1;

/// Result of a calibration.
#[derive(Clone, Debug, PartialEq)]
pub struct Calibration {
    /// Fitted response, or the reason why the measurement has none.
    pub fit: Result<Fit, FitError>,
    /// Gain over frequency, ascending, equidistant in the logarithm of frequency.
    pub curve: Vec<CurvePoint>,
    /// Distortion over frequency, as far as harmonics lie within the sweep.
    pub distortion: Vec<DistortionPoint>,
    /// Start time of the sweep in the recording in seconds; negative if the recording started later.
    pub begins_secs: f64,
    /// Warnings for the user.
    pub warnings: Vec<CalibrationWarning>,
}

/// Gain at one frequency.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct CurvePoint {
    /// Frequency.
    pub frequency: Hertz,
    /// Gain in (m/s²)/V.
    pub gain_mps2_per_v: f64,
    /// Gain equivalent of the noise around the sweep, in (m/s²)/V; `None` if there was no silence.
    pub noise_mps2_per_v: Option<f64>,
}

/// Distortion at one frequency.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct DistortionPoint {
    /// Frequency of the fundamental.
    pub frequency: Hertz,
    /// Total of the second to fifth harmonic, relative to the acceleration at the fundamental.
    pub share: f64,
}

/// Error of a calibration.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum CalibrationError {
    /// The sweep settings are invalid.
    #[error(transparent)]
    Sweep(#[from] SweepError),
    /// A sample is not finite.
    #[error("sample {index} of the recording is not finite; record again")]
    NotFinite {
        /// Index of the sample.
        index: usize,
    },
    /// The sample rate is too low for most of the sweep.
    #[error(
        "a recording at {rate_hz} Hz contains the sweep from {low_hz} Hz only up to {high_hz:.0} Hz; record at 1000 Hz or more"
    )]
    Rate {
        /// Sample rate of the recording, in Hz.
        rate_hz: f64,
        /// Lowest frequency of the sweep, in Hz.
        low_hz: f64,
        /// Highest frequency that the rate supports, in Hz.
        high_hz: f64,
    },
    /// The recording is constant.
    #[error("the recording is silent; check the sensor, its cable and the input that was recorded")]
    Silent,
    /// The recording is shorter than half of the sweep.
    #[error(
        "the recording lasts {seconds:.1} s, the sweep {sweep_secs:.1} s; start recording before the sweep and stop after it"
    )]
    Short {
        /// Duration of the recording in seconds.
        seconds: f64,
        /// Duration of the sweep in seconds.
        sweep_secs: f64,
    },
    /// The recording does not contain the sweep.
    #[error(
        "the recording does not contain the sweep of {sweep_secs} s from {low_hz} to {high_hz} Hz (found in {n_found} of {n_bands} octaves); check that this sweep was played, that the sensor is fixed to the actuator and that the level is high enough"
    )]
    NoSweep {
        /// Duration of the sweep in seconds.
        sweep_secs: f64,
        /// Lowest frequency of the sweep, in Hz.
        low_hz: f64,
        /// Highest frequency of the sweep, in Hz.
        high_hz: f64,
        /// Number of octaves that agree on the start time.
        n_found: usize,
        /// Number of octaves analyzed.
        n_bands: usize,
    },
    /// The noise masks the sweep.
    #[error(
        "the sweep exceeds the noise by {MIN_SNR_DB} dB in only {octaves:.1} octaves, needs {LEAST_OCTAVES}; play it louder, or remove the source of the noise"
    )]
    Noisy {
        /// Number of octaves with a sufficient signal-to-noise ratio.
        octaves: f64,
    },
}

/// Problem of a calibration that is still usable.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub enum CalibrationWarning {
    /// The recording is clipped.
    Clipped {
        /// Number of clipped peaks.
        n_peaks: usize,
        /// Number of clipped samples relative to the samples of the sweep, 0 to 1.
        share: f64,
        /// Clipping level, in m/s².
        level_mps2: f64,
    },
    /// There is no silence around the sweep, so the noise is unknown.
    NoSilence,
    /// The recording contains only a part of the sweep.
    Partial {
        /// Lowest recorded frequency, in Hz.
        low_hz: f64,
        /// Highest recorded frequency, in Hz.
        high_hz: f64,
    },
    /// Frequencies with too much noise were left out.
    Buried {
        /// Share of the curve, 0 to 1.
        share: f64,
    },
    /// The response deviates from a second-order high-pass.
    PoorFit {
        /// Root mean square deviation in dB.
        error_db: f64,
    },
    /// The actuator or the sensor distorts.
    Distorted {
        /// Largest harmonic distortion, relative to the fundamental.
        share: f64,
        /// Frequency of the fundamental, in Hz.
        at_hz: f64,
    },
}

impl fmt::Display for CalibrationWarning {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Clipped { n_peaks, share, level_mps2 } => write!(
                f,
                "{n_peaks} peaks of the recording ({:.2} % of the sweep) are clipped at {level_mps2:.3} m/s²; the true gain and Q at these frequencies are higher than measured; record with less gain, or play the sweep at a lower level",
                100.0 * share
            ),
            Self::NoSilence => write!(
                f,
                "there is no silence around the sweep, so the noise is unknown; record from one second before it to one second after it"
            ),
            Self::Partial { low_hz, high_hz } => write!(
                f,
                "the recording starts or ends within the sweep; only {low_hz:.0} to {high_hz:.0} Hz were used"
            ),
            Self::Buried { share } => {
                write!(f, "{:.0} % of the frequencies are masked by noise and were left out", 100.0 * share)
            }
            Self::PoorFit { error_db } => write!(
                f,
                "the fitted resonance deviates from the measurement by {error_db:.1} dB (root mean square); check the plot"
            ),
            Self::Distorted { share, at_hz } => write!(
                f,
                "harmonic distortion reaches {:.0} % at {at_hz:.0} Hz; the actuator or the sensor is overdriven; play the sweep at a lower level",
                100.0 * share
            ),
        }
    }
}

/// Returns `base`, or an otherwise unknown actuator, with the response fitted on `load` through `drive`. Physical
/// parameters that depend on a previous response are removed.
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
        friction: None,
        channels: Vec::new(),
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

/// Identifies the response of the actuator from `recording`, in m/s² at `rate`, of `sweep` played through `drive`.
///
/// The start of the sweep is found automatically. Clock differences of up to 100 ppm, hum, gravity and slow sensor
/// drift do not affect the result.
///
/// # Errors
/// [`CalibrationError`]. A missing resonance is not an error of this function; see [`Calibration::fit`].
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
    /// Largest distortion at frequencies from half an octave below the resonance. Further below, the harmonics are
    /// closer to the resonance than the fundamental, and the resonance amplifies the distortion of any amplifier.
    pub fn worst_distortion(&self) -> Option<DistortionPoint> {
        let resonance_hz = self.fit.as_ref().map_or(0.0, |fit| fit.response.resonance().0);
        let counts = self
            .distortion
            .iter()
            .filter(|p| p.frequency.0 >= std::f64::consts::FRAC_1_SQRT_2 * resonance_hz);
        counts.max_by(|a, b| a.share.total_cmp(&b.share)).copied()
    }
}

/// Part of the sweep that a recording at this rate can contain.
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
