//! Actuator configuration files (ACF) for players of `.haptic` clips. The output is JSON, which is also valid JSON5; files of
//! other programs are read as JSON5.
//!
//! Such a player uses no frequency response: it plays sines between two frequencies, and short bursts at the emphases
//! of a clip. The values written here neither overload the actuator nor use frequencies at which its gain is low:
//!
//! - The `continuous` band starts where the gain reaches half of the gain far above the resonance, but not below the
//!   lowest frequency of the profile. It ends at [`HIGHEST_HZ`], or at twice the resonance frequency if that is higher.
//! - Gains are fractions of the digital full scale of the drive, at most 1. `continuous` is the amplitude of a sine at
//!   the rated voltage, which the actuator bears indefinitely; `emphasis` is the peak voltage, which it bears briefly.
//! - `emphasis_ducking` is the gain of the continuous signal during an emphasis.
//! - An emphasis lasts two periods. At its lowest sharpness it is a sine at the lowest frequency. At its highest it is
//!   a square wave at the geometric mean of the resonance and the highest frequency. A voice coil rings down by itself,
//!   so the fade-out is zero.

use serde::{Deserialize, Serialize};
use shagreen_core::actuator::{Actuator, ActuatorError, Drive, Response};
use shagreen_core::units::Hertz;

use crate::json5::json_of_json5;
use crate::layout;
use crate::parser_words::plain;

/// Highest frequency of a clip, in Hz: skin is most sensitive near it, and clips are designed for it.
pub const HIGHEST_HZ: f64 = 300.0;
/// Gain of the continuous signal during an emphasis.
const DUCKING: f64 = 0.5;
/// Fraction of the gain far above the resonance that a frequency must reach to be used.
const LEAST_SHARE: f64 = 0.5;
/// Periods of an emphasis.
const PERIODS: f64 = 2.0;

/// An actuator configuration, as the file stores it.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct AcfV1 {
    /// Device, author and source; players ignore it.
    #[serde(default)]
    pub metadata: MetadataV1,
    /// Playback of continuous vibration.
    pub continuous: ContinuousV1,
    /// Playback of short events.
    pub emphasis: EmphasisV1,
}

/// Free-text metadata.
#[derive(Clone, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(default)]
pub struct MetadataV1 {
    /// Version of the configuration.
    pub version: String,
    /// Name of the actuator.
    pub device: String,
    /// The program that wrote it.
    pub author: String,
    /// Source of the actuator data.
    pub source: String,
}

/// Playback of continuous vibration.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct ContinuousV1 {
    /// Fraction of full scale at amplitude 1, 0 to 1.
    pub gain: f64,
    /// Gain of the continuous signal during an emphasis: 1 leaves it unchanged, 0 mutes it.
    pub emphasis_ducking: f64,
    /// Output frequency in Hz at clip frequency 0.
    pub frequency_min: f64,
    /// Output frequency in Hz at clip frequency 1.
    pub frequency_max: f64,
}

/// Playback of short events.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct EmphasisV1 {
    /// Fraction of full scale at amplitude 1, 0 to 1.
    pub gain: f64,
    /// Fade-out at the end, 0 to 100 %.
    pub fade_out_percent: f64,
    /// Burst at clip frequency 0.
    pub frequency_min: BurstV1,
    /// Burst at clip frequency 1.
    pub frequency_max: BurstV1,
}

/// A burst of a few periods.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct BurstV1 {
    /// Frequency in Hz.
    pub output_frequency: f64,
    /// Duration in ms.
    pub duration_ms: f64,
    /// `sine`, `square`, `saw` or `triangle`.
    pub shape: String,
}

/// Why bytes are no configuration.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error(
    "this is not an actuator configuration that can be read: {reason}; correct it, or export it again with `shagreen actuator acf`"
)]
pub struct AcfError {
    /// The parser's message with its line and column.
    pub reason: String,
}

/// Reads a configuration of any program, in JSON5. Its metadata may be incomplete.
///
/// # Errors
/// See [`AcfError`].
pub fn read_acf(bytes: &[u8]) -> Result<AcfV1, AcfError> {
    let json = json_of_json5(&String::from_utf8_lossy(bytes));
    serde_json::from_str(&json).map_err(|error| AcfError { reason: plain(&error.to_string()) })
}

/// Returns the configuration of an actuator behind a drive; `author` names the program.
///
/// # Errors
/// [`ActuatorError::NoResponse`] if the profile has no frequency response.
pub fn acf(actuator: &Actuator, drive: Drive, author: &str) -> Result<AcfV1, ActuatorError> {
    let response = actuator.response()?;
    let share = |volts: Option<f64>| volts.map_or(1.0, |volts| (volts / drive.full_scale.0).min(1.0));
    let peak = actuator.limits.peak_volts.map(|peak| peak.0);
    let rated = actuator.limits_in_volts().rated_volts_rms.map(|rated| rated.0 * std::f64::consts::SQRT_2);
    let resonance_hz = response.resonance().0;
    let low_hz = reaching(&response, LEAST_SHARE).0.max(actuator.lowest.0);
    let high_hz = HIGHEST_HZ.max(2.0 * resonance_hz).max(2.0 * low_hz);
    let burst = |hz: f64, shape: &str| {
        let hz = tenths(hz);
        BurstV1 { output_frequency: hz, duration_ms: tenths(1e3 * PERIODS / hz), shape: shape.to_owned() }
    };
    Ok(AcfV1 {
        metadata: MetadataV1 {
            version: "1.0.0".to_owned(),
            device: actuator.name.clone(),
            author: author.to_owned(),
            source: actuator.source.clone(),
        },
        continuous: ContinuousV1 {
            gain: share(rated).min(share(peak)),
            emphasis_ducking: DUCKING,
            frequency_min: tenths(low_hz),
            frequency_max: tenths(high_hz),
        },
        emphasis: EmphasisV1 {
            gain: share(peak),
            fade_out_percent: 0.0,
            frequency_min: burst(low_hz, "sine"),
            frequency_max: burst((resonance_hz.max(low_hz) * high_hz).sqrt(), "square"),
        },
    })
}

/// Serializes a configuration as JSON.
pub fn write_acf(acf: &AcfV1) -> Vec<u8> {
    layout::to_bytes(acf, 3)
}

/// Returns the lowest frequency at which the gain is `share` times the gain far above the resonance. It solves `x² =
/// share² ((1 - x)² + x/Q²)` with `x = (f/f₀)²`.
fn reaching(response: &Response, share: f64) -> Hertz {
    let square = share * share;
    let half = 0.5 * (response.q().powi(-2) - 2.0) * square;
    let x = (half + (half * half + (1.0 - square) * square).sqrt()) / (1.0 - square);
    Hertz(response.resonance().0 * x.sqrt())
}

fn tenths(value: f64) -> f64 {
    (10.0 * value).round() / 10.0
}

#[cfg(test)]
mod tests {
    use super::{AcfV1, acf, reaching, read_acf, write_acf};
    use crate::actuator_toml::built_in_actuators;
    use shagreen_core::actuator::{Drive, Response};
    use shagreen_core::units::{Hertz, Volts};

    #[test]
    fn a_configuration_is_json_and_comes_back() {
        let actuator = built_in_actuators().unwrap().remove(0);
        let made = acf(&actuator, Drive::new(Volts(5.0)).unwrap(), "shagreen").unwrap();
        let bytes = write_acf(&made);
        assert_eq!(serde_json::from_slice::<AcfV1>(&bytes).unwrap(), made);
        assert_eq!(read_acf(&bytes).unwrap(), made);
        let value: serde_json::Value = serde_json::from_slice(&bytes).unwrap();
        // 1.41 V rms is a sine of 1.994 V amplitude; 4.5 V is nine tenths of 5 V.
        assert!((value["continuous"]["gain"].as_f64().unwrap() - 0.3988).abs() < 1e-4);
        assert!((value["emphasis"]["gain"].as_f64().unwrap() - 0.9).abs() < 1e-12);
        assert_eq!(value["continuous"]["frequency_max"], 300.0);
        assert_eq!(value["emphasis"]["frequency_max"]["shape"], "square");
        // Two periods at the geometric mean of 65 and 300 Hz.
        assert_eq!(value["emphasis"]["frequency_max"]["output_frequency"], 139.6);
        assert_eq!(value["emphasis"]["frequency_max"]["duration_ms"], 14.3);
    }

    /// Other programs write comments, names without quotes, and metadata of their own.
    #[test]
    fn a_configuration_of_another_program_is_read() {
        let burst = "{output_frequency: 70, duration_ms: 30.5, shape: 'sine',}";
        let text = format!(
            "{{\n  metadata: {{device: 'pad', date: '2026-01-31'}}, // by hand\n  continuous: {{gain: 1., emphasis_ducking: .5, frequency_min: 70, frequency_max: 210,}},\n  emphasis: {{gain: 1, fade_out_percent: 0, frequency_min: {burst}, frequency_max: {burst}}},\n}}\n"
        );
        let read = read_acf(text.as_bytes()).unwrap();
        assert_eq!((&*read.metadata.device, read.continuous.frequency_max), ("pad", 210.0));
        assert_eq!(read.emphasis.frequency_min.duration_ms, 30.5);
        let error =
            read_acf(text.replace("frequency_max: 210", "frequency_max: 'high'").as_bytes()).unwrap_err();
        assert!(error.to_string().contains("where a number is needed (line 3"), "{error}");
        assert!(read_acf(b"my notes").is_err());
    }

    #[test]
    fn no_gain_goes_beyond_full_scale() {
        let actuator = built_in_actuators().unwrap().remove(0);
        let made = acf(&actuator, Drive::ASSUMED, "").unwrap();
        assert_eq!((made.continuous.gain, made.emphasis.gain), (1.0, 1.0));
    }

    #[test]
    fn the_band_begins_where_the_gain_does() {
        for (q, share) in [(0.5, 0.5), (4.0, 0.5), (30.0, 0.9), (0.2, 0.1)] {
            let response = Response::new(Hertz(65.0), q, 2.0).unwrap();
            let gain = response.magnitude_at(reaching(&response, share));
            // The root has a closed form, so only f64 rounding remains.
            assert!((gain / (2.0 * share) - 1.0).abs() < 1e-12, "{gain} for Q {q}");
        }
    }

    #[test]
    fn without_a_response_there_is_none() {
        let unknown =
            built_in_actuators().unwrap().into_iter().find(|actuator| actuator.id == "mm1c").unwrap();
        let message = acf(&unknown, Drive::ASSUMED, "").unwrap_err().to_string();
        assert!(message.contains("mm1c is unknown; calibrate it"), "{message}");
    }
}
