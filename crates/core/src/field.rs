//! Grain, landing and friction as smooth functions of the point: what all textures of a space say about every place.
//!
//! Spectra of textures lie near a surface of few dimensions. Their logarithms are taken apart into principal components,
//! and each component's score becomes a smooth surface over the space ([`crate::smoother`]), with one ridge for all,
//! chosen by generalized cross-validation. What no neighbor confirms is smoothed away: a place between textures is told by
//! all of them, and a texture's own place is told by its neighbors as well as by itself.

use nalgebra::{DMatrix, SymmetricEigen};
use pulp::{Arch, Simd, WithSimd};

use crate::sampled::{SampledGrain, Sampling};
use crate::smoother::{Smoother, Surface, scattered};
use crate::tap::Tap;
use crate::texture::{TextureModel, TextureModelError};
use crate::triangulation::Xy;
use crate::units::Hertz;

/// Most components, and the share of the variance that they need not hold.
const MOST_COMPONENTS: usize = 24;
const LEFT_OUT: f64 = 0.0005;
/// Textures from which components are found, chosen by chance where there are more.
const MOST_FOR_COMPONENTS: usize = 200;
/// Share of a component's range that a place may lie beyond all textures.
const BEYOND: f64 = 0.25;
/// Friction coefficients below this are told apart from nothing.
pub(crate) const LEAST_FRICTION: f64 = 1e-3;
/// Frequency in Hz, decay in 1/s and amplitude in m/s² of a landing below which nothing is felt: what is less counts as
/// this, since logarithms of next to nothing would outweigh everything.
const LEAST_TAP: [f64; 3] = [1.0, 1.0, 1e-3];
/// Noise `Σ w²` up to which extrapolation goes all the way; at one it stands still.
const SURE: f64 = 0.8;
/// Steps of the way to the limit of extrapolation.
const N_STEPS: u32 = 32;

/// The field over a space.
#[derive(Clone, Debug)]
pub(crate) struct Field {
    smoother: Smoother,
    /// Mean ln density, bin by bin, contact by contact.
    mean: Vec<f32>,
    /// Components, each as long as the mean, one after the other.
    components: Vec<f32>,
    scores: Limited,
    friction: Option<Limited>,
    tap: Option<Limited>,
}

/// Smooth surfaces that keep within what was measured, and a little beyond.
#[derive(Clone, Debug)]
struct Limited {
    surface: Surface,
    /// Lowest and highest value of each.
    limits: Vec<(f64, f64)>,
}

impl Limited {
    /// The surfaces over values, a row for each place.
    fn new(smoother: &Smoother, values: &DMatrix<f64>) -> Self {
        let limits = values.column_iter().map(|values| {
            let (low, high) = (values.min(), values.max());
            let room = BEYOND * (high - low);
            (low - room, high + room)
        });
        Self { limits: limits.collect(), surface: smoother.surface(values) }
    }

    fn at(&self, at: Xy) -> Vec<f64> {
        let values = self.surface.at(at).into_iter().zip(&self.limits);
        values.map(|(value, (low, high))| value.clamp(*low, *high)).collect()
    }
}

/// What a field is made of: a texture at its place.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Site<'a> {
    pub(crate) at: Xy,
    pub(crate) grain: &'a SampledGrain,
    pub(crate) friction: Option<f64>,
    pub(crate) tap: Option<Tap>,
}

impl Field {
    /// The field through sites, in the unit square; `None` without any, and where they are too near each other to be told
    /// apart.
    pub(crate) fn new(sites: &[Site<'_>]) -> Option<Self> {
        let n = sites.len();
        let width = sites.first()?.grain.ln_psd.len();
        let mut mean = vec![0.0; width];
        for site in sites {
            for (m, x) in mean.iter_mut().zip(&site.grain.ln_psd) {
                *m += f64::from(*x) / n as f64;
            }
        }
        // A column for each texture.
        let centered = DMatrix::from_fn(width, n, |j, i| f64::from(sites[i].grain.ln_psd[j]) - mean[j]);
        let components = components(&centered);
        let scores = centered.transpose() * &components;
        let places: Vec<Xy> = sites.iter().map(|site| site.at).collect();
        let smoother = Smoother::fitted(&places, &scores)?;
        Some(Self {
            scores: Limited::new(&smoother, &scores),
            components: components.iter().map(|x| *x as f32).collect(),
            mean: mean.into_iter().map(|x| x as f32).collect(),
            smoother,
            friction: over_known(sites, |site| site.friction.map(|f| vec![f.max(LEAST_FRICTION).ln()])),
            tap: over_known(sites, |site| site.tap.map(|tap| ln_tap(tap).to_vec())),
        })
    }

    /// The texture at a place of the unit square, or so far on the way to a texture of its own.
    ///
    /// # Errors
    /// See [`TextureModelError`]: what lies far from all textures may be no texture.
    pub(crate) fn texture(
        &self,
        sampling: &Sampling,
        at: Xy,
        towards: Option<(Site<'_>, f64)>,
    ) -> Result<TextureModel, TextureModelError> {
        let scores: Vec<f32> = self.scores.at(at).into_iter().map(|score| score as f32).collect();
        let mut ln_psd = self.mean.clone();
        Arch::new().dispatch(AddAll { scores: &scores, components: &self.components, to: &mut ln_psd });
        let mut ln_friction = self.friction.as_ref().map(|surface| surface.at(at)[0]);
        let mut tap = self.tap.as_ref().map(|surface| surface.at(at));
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
        sampling.texture_of_spectra(&ln_psd, ln_friction.map(f64::exp), tap.map(|tap| tap_from_ln(&tap)))
    }

    /// What each texture says about a place, in the order of the sites: they sum to one, and some may be below zero.
    pub(crate) fn weights(&self, at: Xy) -> Vec<f64> {
        self.smoother.weights(at)
    }

    /// How far from `inside` towards `to` the field supports a texture: the noise of the measurements, `Σ w²`, nowhere on
    /// the way weighs more than in a copy of one texture. The way is made shorter from [`SURE`] on, in proportion to the
    /// highest noise met so far: were it simply cut where the noise is one, a bump of the noise that is met or missed
    /// by a hair would let the end jump from one side of it to the other.
    pub(crate) fn supported(&self, inside: Xy, to: Xy) -> Xy {
        let along = |t: f64| [0, 1].map(|axis| inside[axis] + t * (to[axis] - inside[axis]));
        let noise = |at: Xy| self.weights(at).iter().map(|w| w * w).sum::<f64>();
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

/// Adds components times their scores.
struct AddAll<'a> {
    scores: &'a [f32],
    components: &'a [f32],
    to: &'a mut [f32],
}

impl WithSimd for AddAll<'_> {
    type Output = ();

    #[inline(always)]
    #[allow(clippy::inline_always, reason = "what is not inlined is compiled for any machine")]
    fn with_simd<S: Simd>(self, _: S) {
        let Self { scores, components, to } = self;
        for (score, component) in scores.iter().zip(components.chunks_exact(to.len())) {
            for (sum, c) in to.iter_mut().zip(component) {
                *sum += score * c;
            }
        }
    }
}

/// The principal components of spectra, a column for each texture; a column of unit length for each.
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

/// A surface over the sites where something is known.
fn over_known(sites: &[Site<'_>], known: impl Fn(&Site<'_>) -> Option<Vec<f64>>) -> Option<Limited> {
    let rows: Vec<(Xy, Vec<f64>)> =
        sites.iter().filter_map(|site| known(site).map(|row| (site.at, row))).collect();
    let width = rows.first()?.1.len();
    let places: Vec<Xy> = rows.iter().map(|(at, _)| *at).collect();
    let values = DMatrix::from_fn(rows.len(), width, |i, j| rows[i].1[j]);
    Some(Limited::new(&Smoother::fitted(&places, &values)?, &values))
}

/// A landing as numbers that are averaged: logarithms, since stiffness and damping run over decades.
pub(crate) fn ln_tap(tap: Tap) -> [f64; 3] {
    let [frequency_hz, decay_per_sec, amplitude_mps2] = LEAST_TAP;
    [
        tap.frequency.0.max(frequency_hz).ln(),
        tap.decay_per_sec.max(decay_per_sec).ln(),
        tap.amplitude_mps2.max(amplitude_mps2).ln(),
    ]
}

/// The landing of averaged numbers.
pub(crate) fn tap_from_ln(ln: &[f64]) -> Tap {
    Tap { frequency: Hertz(ln[0].exp()), decay_per_sec: ln[1].exp(), amplitude_mps2: ln[2].exp() }
}
