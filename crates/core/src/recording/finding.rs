//! Findings: problems in a recording that do not prevent its use.

use std::fmt;

use crate::units::Hertz;

/// Extent of a finding, and its first occurrence.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Where {
    /// Number of affected rows.
    pub n_rows: usize,
    /// Number of all rows.
    pub of_rows: usize,
    /// Time of the first affected row, in seconds from the start of the recording.
    pub first_secs: f64,
}

/// Problem in a recording that its user should know about. Nothing is repaired silently: the message states what was
/// done to the data.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub enum Finding {
    /// Rows repeat the timestamp of the row before; the first row of each timestamp is kept.
    RepeatedTimes(Where),
    /// Rows have an earlier timestamp than the row before; they are left out.
    BackwardTimes(Where),
    /// Rows are missing: intervals longer than 1.5 sampling intervals. The gaps are not filled.
    Gaps {
        /// Rows after gaps.
        at: Where,
        /// Longest gap, in seconds.
        longest_secs: f64,
    },
    /// The sampling intervals vary; the columns were resampled to a regular clock at the mean rate.
    Jitter {
        /// 95th percentile of the deviation from the usual sampling interval, relative to it.
        share: f64,
        /// Regular sample rate in Hz.
        rate_hz: f64,
    },
    /// The clock drifts: the sampling interval changes over the recording.
    Drift {
        /// Relative change of the sampling interval from the first to the last quarter.
        share: f64,
    },
    /// Values are missing or not finite; these rows are left out.
    NotANumber {
        /// Name of the column.
        column: String,
        /// Affected rows.
        at: Where,
    },
    /// Values exceed every possible measurement; these rows are left out.
    Impossible {
        /// Name of the column.
        column: String,
        /// Affected rows.
        at: Where,
        /// Largest valid magnitude, in `unit`.
        most: f64,
        /// SI unit of the column.
        unit: &'static str,
    },
    /// Spikes: a few rows far above their surroundings, without the ringing of a mechanical event. They are left out.
    Spikes {
        /// Name of the column.
        column: String,
        /// Number of spikes.
        n: usize,
        /// Affected rows.
        at: Where,
        /// Value of the highest spike, in m/s².
        value: f64,
        /// Height of this spike in robust standard deviations of the surrounding signal.
        times: f64,
    },
    /// A column of speed, position or force has values in some rows only, because its sensor is slower. The values
    /// between were interpolated linearly.
    SlowerTrack {
        /// Name of the column.
        column: String,
        /// Mean rate of the values, in Hz.
        rate_hz: f64,
    },
    /// A column is constant for suspiciously long: the sensor or its cable was stuck. These rows are left out.
    Stuck {
        /// Name of the column.
        column: String,
        /// Affected rows.
        at: Where,
    },
    /// An acceleration column repeats each value for several rows: the sensor was slower than the file.
    Held {
        /// Name of the column.
        column: String,
        /// Mean number of rows with the same value.
        n_rows: f64,
        /// Estimated sample rate of the sensor, in Hz.
        true_rate_hz: f64,
    },
    /// An axis of acceleration is constant; it is ignored.
    DeadAxis {
        /// Name of the column.
        column: String,
        /// Constant value, in m/s².
        value: f64,
    },
    /// The signal stays at its extreme value: the sensor or the converter was overdriven. These rows are left out.
    Clipped {
        /// Name of the column.
        column: String,
        /// Affected rows.
        at: Where,
        /// Extreme value, in the unit of the column.
        value: f64,
    },
    /// Several axes were combined into one by DFT321.
    AxesCombined {
        /// Number of axes.
        n_axes: usize,
    },
    /// Speeds are negative in some rows; their absolute value was used.
    SignedSpeed(Where),
    /// Forces are negative beyond sensor drift in some rows.
    SignedForce(Where),
    /// The tip speed is implausible for a stroke; its unit may be wrong.
    ImplausibleSpeed {
        /// Median speed while the tip moves, in m/s.
        median_mps: f64,
    },
    /// The force is implausible for a stylus; its unit may be wrong.
    ImplausibleForce {
        /// Highest force, in N.
        most_n: f64,
    },
    /// The vibration is implausibly strong or weak for a texture; the unit of acceleration may be wrong.
    ImplausibleAcceleration {
        /// Root mean square without the mean, in m/s².
        level_mps2: f64,
    },
    /// Narrow lines at the frequency of the mains or its harmonics, with the same level at every tip speed.
    MainsHum {
        /// Frequencies of the lines, ascending.
        lines: Vec<Hertz>,
        /// Smallest excess of the strongest line over the spectrum around it, in dB, over the tip speeds.
        above_db: f64,
        /// Whether the recording has several tip speeds. If not, the lines may come from the surface.
        has_speeds: bool,
    },
    /// Segments too short to contain low frequencies; they are left out.
    Fragments {
        /// Number of segments.
        n: usize,
        /// Total duration, in seconds.
        seconds: f64,
    },
    /// The speed was computed from positions.
    SpeedFromPositions,
    /// A quantity was given as a constant and not measured.
    Constant {
        /// Name of the quantity, with its unit.
        what: &'static str,
        /// Value of the quantity.
        value: f64,
    },
}

impl Finding {
    /// Whether this is an ordinary step of the conversion, not an imperfection of the recording.
    pub fn is_ordinary(&self) -> bool {
        matches!(self, Self::AxesCombined { .. } | Self::SpeedFromPositions | Self::Constant { .. })
    }

    /// Short name, stable for scripts.
    pub fn name(&self) -> &'static str {
        match self {
            Self::RepeatedTimes(_) => "repeated timestamps",
            Self::BackwardTimes(_) => "backward timestamps",
            Self::Gaps { .. } => "gaps",
            Self::Jitter { .. } => "irregular timestamps",
            Self::Drift { .. } => "clock drift",
            Self::NotANumber { .. } => "not a number",
            Self::Impossible { .. } => "impossible values",
            Self::Spikes { .. } => "spikes",
            Self::SlowerTrack { .. } => "slower track",
            Self::Stuck { .. } => "stuck sensor",
            Self::Held { .. } => "repeated values",
            Self::DeadAxis { .. } => "dead axis",
            Self::Clipped { .. } => "clipping",
            Self::AxesCombined { .. } => "axes combined",
            Self::SignedSpeed(_) => "signed speed",
            Self::SignedForce(_) => "signed force",
            Self::ImplausibleSpeed { .. } => "implausible speed",
            Self::ImplausibleForce { .. } => "implausible force",
            Self::ImplausibleAcceleration { .. } => "implausible acceleration",
            Self::MainsHum { .. } => "mains hum",
            Self::Fragments { .. } => "fragments",
            Self::SpeedFromPositions => "speed from positions",
            Self::Constant { .. } => "constant",
        }
    }
}

impl fmt::Display for Where {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{} of {} rows, first at {:.3} s", self.n_rows, self.of_rows, self.first_secs)
    }
}

impl fmt::Display for Finding {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}: ", self.name())?;
        match self {
            Self::RepeatedTimes(at) => write!(f, "{at}; the first row of each timestamp was kept"),
            Self::BackwardTimes(at) => write!(f, "{at}; these rows were left out"),
            Self::Gaps { at, longest_secs } => {
                write!(f, "{at}, the longest {longest_secs:.3} s; they were not filled")
            }
            Self::Jitter { share, rate_hz } => write!(
                f,
                "sampling intervals deviate by {:.0} % (95th percentile); the columns were resampled to {rate_hz:.1} Hz",
                100.0 * share
            ),
            Self::Drift { share } => {
                write!(
                    f,
                    "the sampling interval changes by {:.2} % from the first to the last quarter",
                    100.0 * share
                )
            }
            Self::Held { column, n_rows, true_rate_hz } => write!(
                f,
                "{column} repeats each value for {n_rows:.1} rows on average; its true sample rate seems to be {true_rate_hz:.0} Hz"
            ),
            Self::DeadAxis { column, value } => {
                // Added, so that nothing reads "-0".
                write!(f, "{column} is {} in every row; this axis was ignored", value + 0.0)
            }
            Self::NotANumber { column, at } => write!(f, "{column}, {at}; these rows were left out"),
            Self::Impossible { column, at, most, unit } => write!(
                f,
                "{column} exceeds {most} {unit}, {at}; these rows were left out; if there are many, check the unit"
            ),
            Self::Spikes { column, n, at, value, times } => {
                let glitches =
                    if *n == 1 { "1 electrical glitch" } else { &format!("{n} electrical glitches") };
                write!(
                    f,
                    "{glitches} in {column}, up to {value:.1} m/s², {times:.0} standard deviations of the surrounding signal, {at}; left out"
                )
            }
            Self::SlowerTrack { column, rate_hz } => {
                write!(
                    f,
                    "{column} has values at {rate_hz:.1} Hz only; the rows between were interpolated linearly"
                )
            }
            Self::Stuck { column, at } => write!(f, "{column} does not change, {at}; left out"),
            Self::Clipped { column, at, value } => {
                write!(f, "{column} stays at {value:.4}, {at}; left out")
            }
            Self::AxesCombined { n_axes } => write!(f, "{n_axes} axes were combined by DFT321"),
            Self::SignedSpeed(at) => write!(f, "negative in {at}; the absolute value was used"),
            Self::SignedForce(at) => write!(
                f,
                "negative in {at}; the tip counts as lifted there; check the zero and the sign of the sensor"
            ),
            Self::ImplausibleSpeed { median_mps } => write!(
                f,
                "the median speed of the moving tip is {:.3} mm/s; strokes usually have 10 to 1000 mm/s, check the unit",
                1e3 * median_mps
            ),
            Self::ImplausibleForce { most_n } => {
                write!(
                    f,
                    "the force reaches {most_n:.0} N; a stylus is pressed with up to 10 N, check the unit"
                )
            }
            Self::ImplausibleAcceleration { level_mps2 } => {
                let digits: usize = if *level_mps2 < 1.0 { 6 } else { 0 };
                write!(
                    f,
                    "the vibration has {level_mps2:.digits$} m/s² rms; textures have about 0.05 to 20 m/s², check the unit of acceleration (1 g is 9.81 m/s²) and the full scale"
                )
            }
            Self::MainsHum { lines, above_db, has_speeds } => {
                let lines: Vec<String> = lines.iter().map(|line| format!("{:.0}", line.0)).collect();
                let noun = if lines.len() == 1 { "line" } else { "lines" };
                write!(f, "{noun} at {} Hz, {above_db:.0} dB above the spectrum around ", lines.join(", "))?;
                if *has_speeds {
                    write!(f, "at every tip speed: probably mains hum; it becomes part of the texture")
                } else {
                    write!(
                        f,
                        "at the only tip speed: mains hum, or a period of the surface; a recording at another speed tells them apart"
                    )
                }
            }
            Self::Fragments { n, seconds } => {
                write!(f, "{n} segments between rows left out, {seconds:.3} s in total, are too short to use")
            }
            Self::SpeedFromPositions => {
                write!(f, "the file has no speed; it was computed from the positions")
            }
            Self::Constant { what, value } => {
                write!(f, "{what} was set to {} for the whole recording", micro(*value))
            }
        }
    }
}

/// Rounds to millionths, which removes rounding errors of unit conversions.
pub(super) fn micro(value: f64) -> f64 {
    // Added, so that nothing reads "-0".
    (1e6 * value).round() * 1e-6 + 0.0
}

#[cfg(test)]
mod tests {
    use super::{Finding, micro};

    #[test]
    fn zero_has_no_sign() {
        let text = Finding::DeadAxis { column: "ax".to_owned(), value: -0.0 }.to_string();
        assert!(text.contains("ax is 0 in every row"), "{text}");
        assert_eq!(micro(-1e-9).to_string(), "0");
    }
}
