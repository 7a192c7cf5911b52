//! Grain between measured nodes by a radial basis, and the triangles that stand for it in the renderer.

use crate::ar::{power_gain, psd};
use crate::lsf::{MIN_GAP, ar_from_lsf, repair_to};
use crate::plane::values::Values;
use crate::radial_basis::RadialBasis;
use crate::texture::{GrainNode, MIN_NODE_DISTANCE};
use crate::triangulation::Xy;
use crate::units::Hertz;

/// Smoothing of the basis: enough for a system that can be solved, too little to be seen.
const RIDGE: f64 = 1e-6;
/// Level that stands for silence among levels that are heard, as a share of the highest: logarithms need one.
const SILENCE: f64 = 1e-6;
/// How far beyond the measured levels an extrapolated one may go, as a factor.
const BEYOND: f64 = 10.0;
/// How far apart the triangles' first corners lie on the lines below which nothing was measured.
const SPACING: f64 = 0.1;
/// Error of the spectrum in triangles, root mean square over [`FREQUENCIES`].
const SPECTRUM_TOLERANCE_DB: f64 = 0.2;
/// Error of the level in triangles, as a share of the level at the nearest contact within what was measured: 0.2 dB.
const LEVEL_TOLERANCE: f64 = 0.023;
/// At how many frequencies spectra are compared.
const FREQUENCIES: usize = 24;

/// Grain over the plane by a radial basis. Places are in shares of the highest speed and force.
#[derive(Clone, Debug)]
pub(super) struct RadialGrain {
    /// Line spectral frequencies, then ln of the level.
    basis: RadialBasis,
    /// The lowest speed and the lowest force measured.
    lowest: Xy,
    /// What an interpolated level is held between, as ln; `None` where all nodes are silent.
    ln_levels: Option<(f64, f64)>,
    /// Smallest distance of frequencies.
    gap: f64,
    nodes: Vec<Xy>,
}

impl RadialGrain {
    /// The grain through nodes at their places; `None` where the equations have no solution in floating point.
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
            // Frequencies that were measured nearer to each other stay as near.
            gap: gaps.chain(ends).fold(MIN_GAP, f64::min),
            nodes: places.to_vec(),
        })
    }

    /// The grain at a place.
    pub(super) fn at(&self, at: Xy) -> Values {
        let level_mps2 = self.share(at) * self.inside_level(at);
        Values::measured(self.lsf(at), level_mps2)
    }

    fn lsf(&self, at: Xy) -> Vec<f64> {
        let mut lsf = self.basis.at(self.inside(at));
        lsf.pop();
        repair_to(lsf, self.gap)
    }

    /// The nearest contact within what was measured.
    fn inside(&self, at: Xy) -> Xy {
        [0, 1].map(|axis| at[axis].clamp(self.lowest[axis], 1.0))
    }

    /// Level there.
    fn inside_level(&self, at: Xy) -> f64 {
        let ln_level = self.basis.at(self.inside(at)).pop();
        match (ln_level, self.ln_levels) {
            (Some(ln_level), Some((low, high))) => ln_level.clamp(low, high).exp(),
            _ => 0.0,
        }
    }

    /// The share of that level which is left at a place: below the lowest speed or force it falls in a straight line to
    /// zero on the axes.
    fn share(&self, at: Xy) -> f64 {
        (at[0] / self.lowest[0]).min(at[1] / self.lowest[1]).clamp(0.0, 1.0)
    }

    /// The first corners of triangles: nodes, corners of the plane, and lines along which the grain has a kink.
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
        // A node near such a line must not be the tip of a long flat triangle on it.
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

    /// How far `linear`, interpolated in a triangle, is from the grain at a place, in units of what is tolerated.
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

/// Root mean square difference of two spectra of the same power, in dB.
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
    // Of predictors that rounding makes unstable there is nothing to compare.
    if mean.is_finite() { mean.sqrt() } else { 0.0 }
}
