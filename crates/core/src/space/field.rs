//! Field interpolation: vibration spectra, tap transient and friction as smooth functions over the whole space.
//!
//! Log spectra of textures lie near a low-dimensional surface. They are decomposed into principal components, and the
//! scores of each component become a smoothing spline over the space ([`crate::maths::smoother`]). All components share
//! one ridge parameter, chosen by generalized cross-validation. Every point is interpolated from all textures. Even at
//! the position of a texture, its neighbors contribute, so deviations that no neighbor confirms are smoothed away.

mod anisotropy;

use nalgebra::{DMatrix, SymmetricEigen};

use crate::maths::smoother::{Smoother, Surface, scattered};
use crate::maths::sums::add_columns;
use crate::space::field::anisotropy::Anisotropy;
use crate::space::mean_axes::MeanAxes;
use crate::space::sampled::{SampledGrain, Sampling};
use crate::space::space_point::{MOST_AXES, Unit};
use crate::texture::tap::Tap;
use crate::texture::{TextureModel, TextureModelError};
use crate::units::Hertz;

/// Maximum number of components, and the fraction of the variance that may remain unexplained.
const MOST_COMPONENTS: usize = 24;
const LEFT_OUT: f64 = 0.0005;
/// Maximum number of textures for the principal component analysis; a random sample is used if there are more.
const MOST_FOR_COMPONENTS: usize = 200;
/// Extrapolation limit: fraction of a component's range by which a value may exceed the range of all textures.
const BEYOND: f64 = 0.25;
/// The same for tap transients: a surface must not land harder than the hardest of the textures that it is made of.
const BEYOND_OF_TAPS: f64 = 0.0;
/// Lower limit of friction coefficients; smaller values are raised to it before the logarithm.
pub(crate) const LEAST_FRICTION: f64 = 1e-3;
/// Lower limits of the frequency in Hz, decay rate in 1/s and amplitude in m/s² of a tap transient. Smaller values are
/// raised to these limits, because logarithms of values near zero would dominate the average. A transient at these
/// limits cannot be felt.
const LEAST_TAP: [f64; 3] = [1.0, 1.0, 1e-3];
/// Noise gain `Σ w²` up to which extrapolation is unrestricted; at a gain of one, extrapolation stops.
const SURE: f64 = 0.8;
/// Number of steps from the hull to the limit of extrapolation.
const N_STEPS: u32 = 32;

/// Field over a space.
#[derive(Clone, Debug)]
pub(crate) struct Field {
    smoother: Smoother<MOST_AXES>,
    /// Mean ln density, contact by contact, bin by bin.
    mean: Vec<f32>,
    /// Components, concatenated; each has the length of `mean`.
    components: Vec<f32>,
    scores: Limited,
    /// Difference of the grain along the lay; `None` if all textures are isotropic.
    anisotropy: Option<Anisotropy>,
    friction: Option<Limited>,
    tap: Option<Limited>,
}

/// Smooth surfaces, clamped to the range of the measured values plus a margin.
#[derive(Clone, Debug)]
struct Limited {
    surface: Surface<MOST_AXES>,
    /// Lower and upper limit of each surface.
    limits: Vec<(f64, f64)>,
}

impl Limited {
    /// Surfaces through values with one row per position. `beyond` is the margin as a fraction of the range.
    fn new(smoother: &Smoother<MOST_AXES>, values: &DMatrix<f64>, beyond: f64) -> Self {
        let limits = values.column_iter().map(|values| {
            let (low, high) = (values.min(), values.max());
            let room = beyond * (high - low);
            (low - room, high + room)
        });
        Self { limits: limits.collect(), surface: smoother.surface(values) }
    }

    fn at(&self, at: Unit) -> Vec<f64> {
        let values = self.surface.at(at).into_iter().zip(&self.limits);
        values.map(|(value, (low, high))| value.clamp(*low, *high)).collect()
    }
}

/// A texture and its position, as input of the field.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Site<'a> {
    pub(crate) at: Unit,
    /// Grain across the lay.
    pub(crate) grain: &'a SampledGrain,
    /// Grain along the lay; `None` for an isotropic texture.
    pub(crate) along: Option<&'a SampledGrain>,
    /// Angle of the texture's x axis on the pad, counterclockwise, in rad.
    pub(crate) turn_rad: f64,
    pub(crate) friction: Option<f64>,
    pub(crate) tap: Option<Tap>,
}

impl Field {
    /// Field over sites in the unit cube; `None` without sites, or if the sites are too close to each other.
    pub(crate) fn new(sites: &[Site<'_>]) -> Option<Self> {
        let n = sites.len();
        let width = sites.first()?.grain.ln_psd.len();
        let mut mean = vec![0.0; width];
        for site in sites {
            for (m, x) in mean.iter_mut().zip(&site.grain.ln_psd) {
                *m += f64::from(*x) / n as f64;
            }
        }
        // One column per texture.
        let centered = DMatrix::from_fn(width, n, |j, i| f64::from(sites[i].grain.ln_psd[j]) - mean[j]);
        let components = components(&centered);
        let scores = centered.transpose() * &components;
        let places: Vec<Unit> = sites.iter().map(|site| site.at).collect();
        let smoother = Smoother::fitted(&places, &scores)?;
        Some(Self {
            scores: Limited::new(&smoother, &scores, BEYOND),
            components: components.iter().map(|x| *x as f32).collect(),
            mean: mean.into_iter().map(|x| x as f32).collect(),
            smoother,
            anisotropy: Anisotropy::new(sites),
            friction: over_known(sites, BEYOND, |site| {
                site.friction.map(|f| vec![f.max(LEAST_FRICTION).ln()])
            }),
            tap: over_known(sites, BEYOND_OF_TAPS, |site| site.tap.map(|tap| ln_tap(tap).to_vec())),
        })
    }

    /// Texture at a point of the unit cube, optionally moved by a weight of 0..1 towards the texture of a site. Its grains
    /// are those across and along the lay of `axes`. `weights` are those of the sites at this point ([`Field::weights`]).
    ///
    /// # Errors
    /// [`TextureModelError`] if the result is not a valid texture, which is possible far from all textures.
    pub(crate) fn texture(
        &self,
        sampling: &Sampling,
        (at, weights): (Unit, &[f64]),
        axes: &MeanAxes,
        towards: Option<(Site<'_>, f64)>,
    ) -> Result<TextureModel, TextureModelError> {
        let scores: Vec<f32> = self.scores.at(at).into_iter().map(|score| score as f32).collect();
        let mut ln_psd = self.mean.clone();
        add_columns(&self.components, &scores, self.mean.len(), &mut ln_psd);
        let mut ln_friction = self.friction.as_ref().map(|surface| surface.at(at)[0]);
        let mut tap = self.tap.as_ref().map(|surface| surface.at(at));
        let differences = self.anisotropy.as_ref().map(|of| of.at(weights, axes, towards));
        if let Some((own, share)) = towards {
            let mix = |field: f64, own: f64| field + share * (own - field);
            for (field, own) in ln_psd.iter_mut().zip(&own.grain.ln_psd) {
                *field += share as f32 * (own - *field);
            }
            if let (Some(field), Some(own)) = (&mut ln_friction, own.friction) {
                *field = mix(*field, own.max(LEAST_FRICTION).ln());
            }
            if let (Some(field), Some(own)) = (&mut tap, own.tap) {
                for (field, own) in field.iter_mut().zip(ln_tap(own)) {
                    *field = mix(*field, own);
                }
            }
        }
        let nodes = |difference: &[f32]| {
            let ln_psd: Vec<f32> = ln_psd.iter().zip(difference).map(|(field, more)| field + more).collect();
            sampling.nodes_of_spectra(&ln_psd)
        };
        let (across, along) = match &differences {
            Some([across, along]) => (nodes(across), Some(nodes(along))),
            None => (sampling.nodes_of_spectra(&ln_psd), None),
        };
        sampling.texture(across, along, ln_friction.map(f64::exp), tap.map(|tap| tap_from_ln(&tap)))
    }

    /// Weight of each texture at a point, in the order of the sites. Weights sum to one and may be negative.
    pub(crate) fn weights(&self, at: Unit) -> Vec<f64> {
        self.smoother.weights(at)
    }

    /// Farthest point to which the field extrapolates on the straight line from `inside` to `to`. The noise gain `Σ w²`
    /// must not exceed one anywhere on this line, so the texture is at least as reliable as a copy of one measured
    /// texture. Where the highest noise gain so far exceeds [`SURE`], every step is shortened in proportion to the
    /// excess. A hard limit at a gain of one would be discontinuous: a local maximum of the noise gain that just
    /// reaches or just misses one would make the end point jump.
    pub(crate) fn supported(&self, inside: Unit, to: Unit) -> Unit {
        let along =
            |t: f64| -> Unit { std::array::from_fn(|axis| inside[axis] + t * (to[axis] - inside[axis])) };
        let noise = |at: Unit| self.weights(at).iter().map(|w| w * w).sum::<f64>();
        let pace = |worst: f64| ((1.0 - worst) / (1.0 - SURE)).clamp(0.0, 1.0);
        let mut worst = noise(inside);
        let mut reached = 0.0;
        for step in 1..=N_STEPS {
            let before = pace(worst);
            if before == 0.0 {
                break;
            }
            worst = worst.max(noise(along(f64::from(step) / f64::from(N_STEPS))));
            reached += 0.5 * (before + pace(worst)) / f64::from(N_STEPS);
        }
        along(reached)
    }
}

/// Principal components of the log spectra (one input column per texture), as columns of unit length.
fn components(centered: &DMatrix<f64>) -> DMatrix<f64> {
    let kept = scattered(centered.ncols(), MOST_FOR_COMPONENTS);
    let sample = centered.select_columns(&kept);
    let eigen = SymmetricEigen::new(sample.transpose() * &sample);
    let mut order: Vec<usize> = (0..kept.len()).collect();
    order.sort_by(|a, b| eigen.eigenvalues[*b].total_cmp(&eigen.eigenvalues[*a]));
    let variance: f64 = eigen.eigenvalues.iter().map(|v| v.max(0.0)).sum();
    let mut left = variance;
    order.retain(|i| {
        let is_needed = left > LEFT_OUT * variance;
        left -= eigen.eigenvalues[*i].max(0.0);
        is_needed
    });
    order.truncate(MOST_COMPONENTS);
    let mut components = sample * eigen.eigenvectors.select_columns(&order);
    for mut column in components.column_iter_mut() {
        column.normalize_mut();
    }
    components
}

/// Surface over the sites with a known value, with the margin of [`Limited::new`]; `None` if there are none.
fn over_known(
    sites: &[Site<'_>],
    beyond: f64,
    known: impl Fn(&Site<'_>) -> Option<Vec<f64>>,
) -> Option<Limited> {
    let rows: Vec<(Unit, Vec<f64>)> =
        sites.iter().filter_map(|site| known(site).map(|row| (site.at, row))).collect();
    let width = rows.first()?.1.len();
    let places: Vec<Unit> = rows.iter().map(|(at, _)| *at).collect();
    let values = DMatrix::from_fn(rows.len(), width, |i, j| rows[i].1[j]);
    Some(Limited::new(&Smoother::fitted(&places, &values)?, &values, beyond))
}

/// A tap transient as logarithms for averaging, because stiffness and damping span decades.
pub(crate) fn ln_tap(tap: Tap) -> [f64; 3] {
    let [frequency_hz, decay_per_sec, amplitude_mps2] = LEAST_TAP;
    [
        tap.frequency.0.max(frequency_hz).ln(),
        tap.decay_per_sec.max(decay_per_sec).ln(),
        tap.amplitude_mps2.max(amplitude_mps2).ln(),
    ]
}

/// Tap transient from its logarithms.
pub(crate) fn tap_from_ln(ln: &[f64]) -> Tap {
    Tap { frequency: Hertz(ln[0].exp()), decay_per_sec: ln[1].exp(), amplitude_mps2: ln[2].exp() }
}
