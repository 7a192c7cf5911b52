//! Radial basis interpolation of the grain, and the triangles that approximate it in the renderer.

use crate::dsp::ar::{power_gain, psd};
use crate::dsp::lsf::{MIN_GAP, ar_from_lsf, repair_to};
use crate::maths::radial_basis::RadialBasis;
use crate::maths::triangulation::Xy;
use crate::texture::plane::values::Values;
use crate::texture::{GrainNode, MIN_NODE_DISTANCE};
use crate::units::Hertz;

/// Ridge of the radial basis: large enough for a solvable system, too small to change the result noticeably.
const RIDGE: f64 = 1e-6;
/// Level that represents silence among audible levels, relative to the highest; the logarithm needs a positive number.
const SILENCE: f64 = 1e-6;
/// Factor by which an extrapolated level may exceed the measured levels.
const BEYOND: f64 = 10.0;
/// Distance between the initial triangle corners on the lines of lowest measured speed and force.
const SPACING: f64 = 0.1;
/// Tolerated root mean square error of the triangles' spectrum over [`FREQUENCIES`] frequencies, in dB.
const SPECTRUM_TOLERANCE_DB: f64 = 0.2;
/// Tolerated error of the triangles' level, relative to the level at the nearest contact in the measured range: 0.2 dB.
const LEVEL_TOLERANCE: f64 = 0.023;
/// Number of frequencies at which spectra are compared.
const FREQUENCIES: usize = 24;

/// Grain over the plane by radial basis functions. Coordinates are relative to the highest speed and force.
#[derive(Clone, Debug)]
pub(super) struct RadialGrain {
    /// Line spectral frequencies, followed by the natural logarithm of the level.
    basis: RadialBasis,
    /// Lowest measured speed and lowest measured force.
    lowest: Xy,
    /// Limits of the interpolated logarithmic level; `None` if all nodes are silent.
    ln_levels: Option<(f64, f64)>,
    /// Minimum distance of line spectral frequencies, in radians.
    gap: f64,
    nodes: Vec<Xy>,
}

impl RadialGrain {
    /// Fits the radial basis to nodes at these positions; `None` if the equations have no solution in floating point.
    pub(super) fn new(nodes: &[GrainNode], places: &[Xy]) -> Option<Self> {
        let highest = nodes.iter().map(|n| n.level_mps2).fold(0.0, f64::max);
        let is_heard = highest > 0.0;
        let ln_level = |n: &GrainNode| {
            if is_heard { n.level_mps2.max(SILENCE * highest).max(f64::MIN_POSITIVE).ln() } else { 0.0 }
        };
        let row = |n: &GrainNode| n.lsf.iter().copied().chain([ln_level(n)]).collect();
        let lowest_ln = nodes.iter().map(ln_level).fold(f64::INFINITY, f64::min);
        let gaps = nodes.iter().flat_map(|n| n.lsf.windows(2).map(|w| w[1] - w[0]));
        let ends = nodes.iter().flat_map(|n| [n.lsf[0], std::f64::consts::PI - n.lsf[n.lsf.len() - 1]]);
        Some(Self {
            basis: RadialBasis::new(places, &nodes.iter().map(row).collect::<Vec<_>>(), RIDGE)?,
            lowest: [0, 1].map(|axis| places.iter().map(|p| p[axis]).fold(1.0, f64::min)),
            ln_levels: is_heard.then(|| (lowest_ln - BEYOND.ln(), highest.ln() + BEYOND.ln())),
            // Frequencies that were measured closer together than [`MIN_GAP`] may stay that close.
            gap: gaps.chain(ends).fold(MIN_GAP, f64::min),
            nodes: places.to_vec(),
        })
    }

    /// Grain at a position.
    pub(super) fn at(&self, at: Xy) -> Values {
        let level_mps2 = self.share(at) * self.inside_level(at);
        Values::measured(self.lsf(at), level_mps2)
    }

    fn lsf(&self, at: Xy) -> Vec<f64> {
        let mut lsf = self.basis.at(self.inside(at));
        lsf.pop();
        repair_to(lsf, self.gap)
    }

    /// Nearest contact in the measured range.
    fn inside(&self, at: Xy) -> Xy {
        [0, 1].map(|axis| at[axis].clamp(self.lowest[axis], 1.0))
    }

    /// Level at the nearest contact in the measured range.
    fn inside_level(&self, at: Xy) -> f64 {
        let ln_level = self.basis.at(self.inside(at)).pop();
        match (ln_level, self.ln_levels) {
            (Some(ln_level), Some((low, high))) => ln_level.clamp(low, high).exp(),
            _ => 0.0,
        }
    }

    /// Factor on [`Self::inside_level`] at a position: below the lowest measured speed or force, it decreases linearly
    /// to zero on the axes.
    fn share(&self, at: Xy) -> f64 {
        (at[0] / self.lowest[0]).min(at[1] / self.lowest[1]).clamp(0.0, 1.0)
    }

    /// Initial triangle corners: nodes, corners of the plane, and points on the lines where the grain has a kink.
    pub(super) fn corners(&self) -> Vec<Xy> {
        let mut out = self.nodes.clone();
        let mut add = |at: Xy| {
            let is_far = |p: &Xy| (p[0] - at[0]).abs().max((p[1] - at[1]).abs()) >= 0.99 * MIN_NODE_DISTANCE;
            if out.iter().all(is_far) {
                out.push(at);
            }
        };
        let [x, y] = self.lowest;
        for at in [[0.0, 0.0], [1.0, 0.0], [0.0, 1.0], [1.0, 1.0], [x, y], [0.5 * x, 0.5 * y]] {
            add(at);
        }
        let steps = |low: f64| {
            let n = ((1.0 - low) / SPACING).ceil().max(1.0);
            (0..=n as usize).map(move |i| low + (1.0 - low) * i as f64 / n)
        };
        for s in steps(x) {
            for line in [0.0, y, 1.0] {
                add([s, line]);
            }
        }
        for s in steps(y) {
            for line in [0.0, x, 1.0] {
                add([line, s]);
            }
        }
        // Avoids a long flat triangle between one of these lines and a node near it.
        for node in &self.nodes {
            for line in [y, 1.0] {
                if (node[1] - line).abs() < SPACING {
                    add([node[0], line]);
                }
            }
            for line in [x, 1.0] {
                if (node[0] - line).abs() < SPACING {
                    add([line, node[1]]);
                }
            }
        }
        out
    }

    /// Error of `linear`, interpolated in a triangle, at a position; relative to the tolerance.
    pub(super) fn error(&self, at: Xy, linear: &Values) -> f64 {
        let inside = self.inside_level(at);
        let wanted = self.at(at);
        if inside == 0.0 {
            return 0.0;
        }
        let level_error = (linear.level_mps2() - wanted.level_mps2()).abs() / inside / LEVEL_TOLERANCE;
        level_error.max(spectral_distance_db(&linear.lsf, &wanted.lsf) / SPECTRUM_TOLERANCE_DB)
    }
}

/// Root mean square difference of two spectra with the same power, in dB.
fn spectral_distance_db(a: &[f64], b: &[f64]) -> f64 {
    let rate = Hertz(1.0);
    let frequencies: Vec<Hertz> =
        (0..FREQUENCIES).map(|i| Hertz(0.5 * (i as f64 + 0.5) / FREQUENCIES as f64)).collect();
    let spectrum = |lsf: &[f64]| {
        let predictor = ar_from_lsf(lsf);
        psd(&predictor, 1.0 / power_gain(&predictor), rate, &frequencies)
    };
    let squares = spectrum(a).into_iter().zip(spectrum(b)).map(|(a, b)| (10.0 * (a / b).log10()).powi(2));
    let mean = squares.sum::<f64>() / FREQUENCIES as f64;
    // Predictors that are unstable due to rounding cannot be compared.
    if mean.is_finite() { mean.sqrt() } else { 0.0 }
}
