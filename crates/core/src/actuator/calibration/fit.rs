//! Fit of a second-order high-pass to a measured gain.

use nalgebra::{Matrix3, Vector3};

use crate::actuator::Response;
use crate::actuator::calibration::CurvePoint;
use crate::units::Hertz;

/// Maximum fraction of clipped samples. For simulated coils with Q from 0.8 to 30, the resonance is then still accurate
/// to 1 % and the gain to 3 %; Q is too low, by a tenth at a Q of 6. At 5 % clipping, a damped coil has errors of 2 %
/// and 5 %.
pub(super) const MOST_CLIPPED: f64 = 0.02;
/// Highest frequency of the fit: rendering ends near it, and resonant modes of the case begin.
const FIT_HIGH: Hertz = Hertz(500.0);
/// Minimum signal-to-noise ratio of a point, in dB.
pub(super) const MIN_SNR_DB: f64 = 10.0;

/// Minimum number of points, and minimum number of octaves that they span.
const LEAST_POINTS: usize = 8;
const LEAST_OCTAVES: f64 = 1.5;
/// Error of a point without noise, in ln gain: 0.1 dB.
const FLOOR: f64 = 0.0115;
/// Scale of the Cauchy loss, in standard deviations. Larger residuals get less weight, so that hum or a mode of the
/// case hardly affects the fit.
const CAUCHY: f64 = 2.4;
/// Maximum standard errors of the logarithms of frequency and width of a valid resonance.
const MOST_RESONANCE_ERROR: f64 = 0.1;
const MOST_WIDTH_ERROR: f64 = 0.35;
/// Minimum improvement over a straight line on logarithmic frequency, as a ratio of root mean square errors.
const LEAST_GAIN_OVER_LINE: f64 = 2.0;
/// Deviation in dB above which the gain is not a second-order high-pass.
const MOST_ERROR_DB: f64 = 6.0;
/// Starting points of the search: resonances a quarter octave apart, each with these Q.
const START_Q: [f64; 6] = [0.5, 1.0, 2.5, 6.0, 15.0, 40.0];
const START_STEP: f64 = 1.19;
const N_STARTS: usize = 4;
const N_STEPS: usize = 80;
const DB: f64 = 20.0 * std::f64::consts::LOG10_E;

/// Fitted response with its standard errors.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Fit {
    /// Fitted response.
    pub response: Response,
    /// Root mean square deviation of the points from the response, in dB.
    pub error_db: f64,
    /// Standard error of the resonance frequency in Hz.
    pub resonance_error_hz: f64,
    /// Standard error of the quality factor Q.
    pub q_error: f64,
    /// Standard error of the gain in (m/s²)/V.
    pub gain_error_mps2_per_v: f64,
    /// Lowest and highest frequency of the points.
    pub band: (Hertz, Hertz),
    /// Number of points.
    pub n_points: usize,
}

/// Error of fitting a response to a gain.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum FitError {
    /// Too few points have a sufficient signal-to-noise ratio.
    #[error(
        "only {n_points} frequencies over {octaves:.1} octaves up to {} are clear of noise, needs {LEAST_POINTS} over {LEAST_OCTAVES}; play the sweep at a higher level",
        FIT_HIGH
    )]
    TooFew {
        /// Number of such points.
        n_points: usize,
        /// Octaves that they span.
        octaves: f64,
    },
    /// Too much of the recording is clipped for a correct fit.
    #[error(
        "{:.1} % of the sweep are clipped at {level_mps2:.1} m/s², more than the {:.1} % up to which the response can be identified; record again with less gain, or play the sweep at a lower level",
        100.0 * share,
        100.0 * MOST_CLIPPED
    )]
    Clipped {
        /// Fraction of the sweep's samples that are clipped.
        share: f64,
        /// Clipping level, in m/s².
        level_mps2: f64,
    },
    /// The gain has no resonance.
    #[error(
        "no resonance was found between {low_hz:.0} and {high_hz:.0} Hz: the gain is {low_gain:.3} (m/s²)/V at the lower and {high_gain:.3} (m/s²)/V at the upper end; check that the recording is from the sensor on the actuator, and not from a loopback cable"
    )]
    NoResonance {
        /// Lowest measured frequency, in Hz.
        low_hz: f64,
        /// Highest measured frequency, in Hz.
        high_hz: f64,
        /// Gain at the lowest frequency, in (m/s²)/V.
        low_gain: f64,
        /// Gain at the highest frequency, in (m/s²)/V.
        high_gain: f64,
    },
    /// The gain is not a second-order high-pass.
    #[error(
        "the measured gain is not a single resonance; the best fit deviates by {error_db:.1} dB (root mean square); fix the actuator and the sensor firmly to the load and measure again"
    )]
    OtherShape {
        /// Root mean square deviation in dB.
        error_db: f64,
    },
}

/// Whether a point has at least [`MIN_SNR_DB`] of signal-to-noise ratio.
pub(super) fn is_clear(point: &CurvePoint) -> bool {
    let noise = point.noise_mps2_per_v.unwrap_or(0.0);
    point.gain_mps2_per_v > noise * 10.0_f64.powf(MIN_SNR_DB / 20.0)
}

/// Fits a response to a gain over frequency.
///
/// Least squares of ln gain over ln K, ln ω and ln ζ, weighted by the noise, with a Cauchy loss that reduces the weight
/// of outliers. Uses the points clear of noise up to [`FIT_HIGH`].
///
/// # Errors
/// [`FitError`]; without a clear resonance in the points, no response is returned.
pub(super) fn fit_response(curve: &[CurvePoint]) -> Result<Fit, FitError> {
    let points: Vec<Point> =
        curve.iter().filter(|p| p.frequency.0 <= FIT_HIGH.0 && is_clear(p)).map(Point::new).collect();
    let n_points = points.len();
    let ends = points.first().zip(points.last());
    let octaves = ends.map_or(0.0, |(first, last)| (last.ln_hz - first.ln_hz) / std::f64::consts::LN_2);
    let Some((first, last)) = ends.filter(|_| n_points >= LEAST_POINTS && octaves >= LEAST_OCTAVES) else {
        return Err(FitError::TooFew { n_points, octaves });
    };
    let mut starts: Vec<(f64, Vector3<f64>)> = Vec::new();
    let mut ln_hz = first.ln_hz;
    while ln_hz <= last.ln_hz {
        for q in START_Q {
            let at = Vector3::new(0.0, ln_hz, -(2.0 * q).ln());
            let offsets: Vec<f64> = points.iter().map(|p| p.ln_gain - ln_model(&at, p.ln_hz)).collect();
            let at = Vector3::new(crate::dsp::spectrum::median(offsets), at[1], at[2]);
            starts.push((points.iter().map(|p| p.residual(&at).abs()).sum(), at));
        }
        ln_hz += START_STEP.ln();
    }
    starts.sort_by(|a, b| a.0.total_cmp(&b.0));
    let found = starts.iter().take(N_STARTS).map(|(_, start)| descend(&points, *start));
    let best = found.min_by(|a, b| a.cost.total_cmp(&b.cost));
    let error_db = |residual: &dyn Fn(&Point) -> f64| {
        DB * (points.iter().map(|p| residual(p).powi(2)).sum::<f64>() / n_points as f64).sqrt()
    };
    let no_resonance = FitError::NoResonance {
        low_hz: first.ln_hz.exp(),
        high_hz: last.ln_hz.exp(),
        low_gain: first.ln_gain.exp(),
        high_gain: last.ln_gain.exp(),
    };
    let Some(Found { at, errors, .. }) = best else { return Err(no_resonance) };
    let fit_db = error_db(&|p| p.ln_gain - ln_model(&at, p.ln_hz));
    let line = line_through(&points);
    let line_db = error_db(&|p| p.ln_gain - line[0] - line[1] * p.ln_hz);
    let is_within = (first.ln_hz..=last.ln_hz).contains(&at[1]);
    let is_known = errors[1] <= MOST_RESONANCE_ERROR && errors[2] <= MOST_WIDTH_ERROR;
    // Unknown standard errors are NaN and fail this test, too.
    if !is_within || !is_known || fit_db * LEAST_GAIN_OVER_LINE > line_db {
        let is_other = fit_db > MOST_ERROR_DB && line_db > MOST_ERROR_DB;
        return Err(if is_other { FitError::OtherShape { error_db: fit_db } } else { no_resonance });
    }
    if fit_db > MOST_ERROR_DB {
        return Err(FitError::OtherShape { error_db: fit_db });
    }
    let (gain, hz, q) = (at[0].exp(), at[1].exp(), 0.5 * (-at[2]).exp());
    let response = Response::new(Hertz(hz), q, gain).map_err(|_| no_resonance)?;
    Ok(Fit {
        response,
        error_db: fit_db,
        resonance_error_hz: hz * errors[1],
        q_error: q * errors[2],
        gain_error_mps2_per_v: gain * errors[0],
        band: (Hertz(first.ln_hz.exp()), Hertz(last.ln_hz.exp())),
        n_points,
    })
}

/// Data point of the fit.
struct Point {
    ln_hz: f64,
    ln_gain: f64,
    /// Standard deviation of `ln_gain`.
    deviation: f64,
}

impl Point {
    fn new(point: &CurvePoint) -> Self {
        let share = point.noise_mps2_per_v.unwrap_or(0.0) / point.gain_mps2_per_v;
        Self {
            ln_hz: point.frequency.0.ln(),
            ln_gain: point.gain_mps2_per_v.ln(),
            // Half of the noise power is in phase with the signal.
            deviation: (0.5 * share * share + FLOOR * FLOOR).sqrt(),
        }
    }

    /// Residual in standard deviations.
    fn residual(&self, at: &Vector3<f64>) -> f64 {
        (self.ln_gain - ln_model(at, self.ln_hz)) / self.deviation
    }
}

/// Result of one search.
struct Found {
    at: Vector3<f64>,
    /// Sum of absolute residuals. The robust costs of different searches have different scales and cannot be compared.
    cost: f64,
    /// Standard errors; NaN if unknown.
    errors: Vector3<f64>,
}

/// Logarithmic gain of the model with parameters `(ln K, ln f₀, ln ζ)`.
fn ln_model(at: &Vector3<f64>, ln_hz: f64) -> f64 {
    let ln_x = ln_hz - at[1];
    let square = (2.0 * ln_x).exp();
    let width = (2.0 * (at[2] + std::f64::consts::LN_2)).exp();
    at[0] + 2.0 * ln_x - 0.5 * ((1.0 - square).powi(2) + width * square).ln()
}

/// Gradient of [`ln_model`].
fn slope(at: &Vector3<f64>, ln_hz: f64) -> Vector3<f64> {
    let square = (2.0 * (ln_hz - at[1])).exp();
    let width = (2.0 * (at[2] + std::f64::consts::LN_2)).exp();
    let below = (1.0 - square).powi(2) + width * square;
    let by_width = width * square / below;
    Vector3::new(1.0, -2.0 - 2.0 * square * (1.0 - square) / below + by_width, -by_width)
}

/// Levenberg-Marquardt minimization of the robust cost.
fn descend(points: &[Point], start: Vector3<f64>) -> Found {
    let mut at = start;
    let mut damping = 1e-3;
    let mut scale = scale_of(points, &at);
    let mut cost = cost_of(points, &at, scale);
    for _ in 0..N_STEPS {
        let (normal, pull) = normal_equations(points, &at, scale);
        let damped = normal + Matrix3::from_diagonal(&(normal.diagonal() * damping));
        let Some(step) = damped.lu().solve(&pull) else { break };
        let next = at + step;
        let next_cost = cost_of(points, &next, scale);
        if next_cost < cost {
            at = next;
            damping = (damping * 0.3).max(1e-12);
            // Updates the scale of the loss to the current fit.
            scale = scale_of(points, &at);
            cost = cost_of(points, &at, scale);
            if step.amax() < 1e-12 {
                break;
            }
        } else {
            damping *= 5.0;
            if damping > 1e12 {
                break;
            }
        }
    }
    Found { at, cost: points.iter().map(|p| p.residual(&at).abs()).sum(), errors: errors(points, &at, scale) }
}

/// Standard errors of a robust fit (Huber): `s² n/(n-3) mean(ψ²) / mean(ψ')²` times the inverse normal matrix.
fn errors(points: &[Point], at: &Vector3<f64>, scale: f64) -> Vector3<f64> {
    let n = points.len() as f64;
    let (mut normal, mut pull, mut stiffness) = (Matrix3::zeros(), 0.0, 0.0);
    for point in points {
        let slope = slope(at, point.ln_hz) / point.deviation;
        normal += slope * slope.transpose();
        let away = point.residual(at) / scale;
        let square = (away / CAUCHY).powi(2);
        pull += (away * weight(away)).powi(2) / n;
        stiffness += (1.0 - square) / (1.0 + square).powi(2) / n;
    }
    let spread = scale * scale * n / (n - 3.0).max(1.0) * pull / stiffness.max(0.1).powi(2);
    let unknown = Vector3::repeat(f64::NAN);
    normal.try_inverse().map_or(unknown, |inverse| inverse.diagonal().map(|v| (v * spread).sqrt()))
}

/// Robust scale of the residuals, in standard deviations; at least one.
fn scale_of(points: &[Point], at: &Vector3<f64>) -> f64 {
    let away = points.iter().map(|p| p.residual(at).abs()).collect();
    (1.4826 * crate::dsp::spectrum::median(away)).max(1.0)
}

fn cost_of(points: &[Point], at: &Vector3<f64>, scale: f64) -> f64 {
    points.iter().map(|p| (p.residual(at) / scale / CAUCHY).powi(2).ln_1p()).sum()
}

fn weight(away: f64) -> f64 {
    1.0 / (1.0 + (away / CAUCHY).powi(2))
}

fn normal_equations(points: &[Point], at: &Vector3<f64>, scale: f64) -> (Matrix3<f64>, Vector3<f64>) {
    let (mut normal, mut pull) = (Matrix3::zeros(), Vector3::zeros());
    for point in points {
        let residual = point.residual(at);
        let slope = slope(at, point.ln_hz) / point.deviation;
        let weight = weight(residual / scale);
        normal += weight * slope * slope.transpose();
        pull += weight * residual * slope;
    }
    (normal, pull)
}

/// Offset and slope of the regression line of ln gain on ln frequency.
fn line_through(points: &[Point]) -> [f64; 2] {
    let n = points.len() as f64;
    let (x, y) = points.iter().fold((0.0, 0.0), |(x, y), p| (x + p.ln_hz / n, y + p.ln_gain / n));
    let (xy, xx) = points
        .iter()
        .fold((0.0, 0.0), |(xy, xx), p| (xy + (p.ln_hz - x) * (p.ln_gain - y), xx + (p.ln_hz - x).powi(2)));
    let slope = xy / xx;
    [y - slope * x, slope]
}
