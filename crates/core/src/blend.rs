//! The ways in which textures become one, and the spectrum of a mixture of signals.

use crate::plane::{Grain, Plane};
use crate::space::{Location, Space};
use crate::units::{Contact, Hertz};

/// How parents become one texture.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Mode {
    /// As printed: weights by inverse distance to the corners of the Delaunay triangle, independent signals summed.
    /// Jumps where the point crosses an edge, and sinks in level between textures.
    Paper,
    /// Barycentric weights, independent signals, level made up to the weighted mean of the levels.
    Power,
    /// Barycentric weights, signals that share one excitation: no loss of level, no makeup.
    Shared,
    /// One texture with the mean of the line spectral frequencies and of the logarithm of the level.
    Parametric,
    /// One texture from a smooth field over all textures of the space: log spectrum, landing and friction.
    #[default]
    Field,
}

impl Mode {
    /// All modes, in the order in which they are offered.
    pub const ALL: [Self; 5] = [Self::Field, Self::Parametric, Self::Shared, Self::Power, Self::Paper];

    /// The word for files and scripts.
    pub fn id(self) -> &'static str {
        match self {
            Self::Paper => "paper",
            Self::Power => "power",
            Self::Shared => "shared",
            Self::Parametric => "parametric",
            Self::Field => "field",
        }
    }

    /// The mode that has this [`Mode::id`].
    pub fn from_id(id: &str) -> Option<Self> {
        Self::ALL.into_iter().find(|m| m.id() == id)
    }

    /// Whether a point becomes a texture of its own; else it is a mixture of signals.
    pub fn makes_a_model(self) -> bool {
        matches!(self, Self::Parametric | Self::Field)
    }
}

/// Distance below which a point is at a texture, in points of the axes.
const AT_A_TEXTURE: f64 = 1e-7;

/// Weights `d_i^-1 / Σ d_j^-1` over the corners of the triangle; a texture's own point is that texture.
pub(crate) fn inverse_distance(space: &Space, location: &Location) -> Vec<(usize, f64)> {
    let distance =
        |texture: usize| space.position(texture).map_or(f64::INFINITY, |p| p.distance(location.at));
    if let Some((texture, _)) = location.corners.iter().find(|(t, _)| distance(*t) < AT_A_TEXTURE) {
        return vec![(*texture, 1.0)];
    }
    let sum: f64 = location.corners.iter().map(|(t, _)| 1.0 / distance(*t)).sum();
    location.corners.iter().map(|(t, _)| (*t, 1.0 / distance(*t) / sum)).collect()
}

/// One-sided power spectral density in (m/s²)²/Hz of a mixture of planes at one contact, in closed form.
///
/// `paper`: `Σ w² S`; `power`: the same times `(Σ w σ)² / Σ w² σ²`; `shared`: `|Σ w H|²` of the parents' filters with
/// their gains, and so where something was made for the point. All parents have one rate.
pub fn mixture_psd(
    parents: &[(&Plane, f64)],
    mode: Mode,
    contact: Contact,
    frequencies: &[Hertz],
) -> Vec<f64> {
    let grains: Vec<(Grain, f64)> = parents.iter().map(|(plane, w)| (plane.at(contact), *w)).collect();
    match mode {
        Mode::Paper => independent_psd(&grains, 1.0, frequencies),
        Mode::Power => {
            let parts = grains.iter().map(|(g, w)| w * g.level_mps2);
            let (sum, squares) = parts.fold((0.0, 0.0), |(s, q), p| (s + p, q + p * p));
            let makeup = if squares > 0.0 { sum * sum / squares } else { 1.0 };
            independent_psd(&grains, makeup, frequencies)
        }
        Mode::Shared | Mode::Parametric | Mode::Field => {
            let mut sum = vec![(0.0, 0.0); frequencies.len()];
            for (grain, weight) in &grains {
                for (s, (re, im)) in sum.iter_mut().zip(grain.response(frequencies)) {
                    s.0 += weight * re;
                    s.1 += weight * im;
                }
            }
            sum.into_iter().map(|(re, im)| re * re + im * im).collect()
        }
    }
}

fn independent_psd(grains: &[(Grain, f64)], scale: f64, frequencies: &[Hertz]) -> Vec<f64> {
    let mut sum = vec![0.0; frequencies.len()];
    for (grain, weight) in grains {
        for (s, p) in sum.iter_mut().zip(grain.psd(frequencies)) {
            *s += scale * weight * weight * p;
        }
    }
    sum
}

#[cfg(test)]
mod tests {
    use super::Mode;

    #[test]
    fn modes_round_trip() {
        for mode in Mode::ALL {
            assert_eq!(Mode::from_id(mode.id()), Some(mode));
        }
        assert_eq!(Mode::from_id("loud"), None);
    }
}
