//! Interpolation modes between textures, and the spectrum of a mixture of signals.

use crate::texture::plane::{Grain, Plane};
use crate::units::{Contact, Hertz, Radians};

/// Interpolation mode: how parent textures are combined into one.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Mode {
    /// As in the authoring paper ([`crate::space`]): inverse-distance weights of the corners of the Delaunay triangle,
    /// and a sum of independent signals. The result jumps where the point crosses a triangle edge, and its level drops
    /// between textures.
    Paper,
    /// Barycentric weights and independent signals; a gain restores the weighted mean of the levels.
    Power,
    /// Barycentric weights and signals with a shared excitation: no loss of level, and no gain correction.
    Shared,
    /// One texture with the weighted mean of line spectral frequencies and of the logarithm of the level.
    Parametric,
    /// One texture from a smooth field over all textures of the space: log spectrum, tap transient and friction.
    #[default]
    Field,
}

impl Mode {
    /// All modes, in the order of the user interface.
    pub const ALL: [Self; 5] = [Self::Field, Self::Parametric, Self::Shared, Self::Power, Self::Paper];

    /// Identifier in files and scripts.
    pub fn id(self) -> &'static str {
        match self {
            Self::Paper => "paper",
            Self::Power => "power",
            Self::Shared => "shared",
            Self::Parametric => "parametric",
            Self::Field => "field",
        }
    }

    /// Mode with this [`Mode::id`]; `None` if there is none.
    pub fn from_id(id: &str) -> Option<Self> {
        Self::ALL.into_iter().find(|m| m.id() == id)
    }

    /// Whether the mode computes a new texture model; otherwise it mixes signals.
    pub fn makes_a_model(self) -> bool {
        matches!(self, Self::Parametric | Self::Field)
    }
}

/// One-sided power spectral density in (m/s²)²/Hz of a mixture of planes at one contact, in closed form.
///
/// The parents have weights `w`, densities `S`, levels `σ` and filters `H` (including gains). `Paper`: `Σ w² S`.
/// `Power`: the same times `(Σ w σ)² / Σ w² σ²`. `Shared`, `Parametric` and `Field`: `|Σ w H|²`. All parents must have
/// the same rate.
pub fn mixture_psd(
    parents: &[(&Plane, f64)],
    mode: Mode,
    contact: Contact,
    frequencies: &[Hertz],
) -> Vec<f64> {
    let grains: Vec<(Grain, f64)> = parents.iter().map(|(plane, w)| (plane.at(contact), *w)).collect();
    psd_of_grains(&grains, mode, frequencies)
}

/// As [`mixture_psd`], which is for a stroke across the lay of each plane, for a stroke in a direction on the pad: an angle
/// from its x axis, counterclockwise.
pub fn mixture_psd_toward(
    parents: &[(&Plane, f64)],
    mode: Mode,
    contact: Contact,
    direction: Radians,
    frequencies: &[Hertz],
) -> Vec<f64> {
    let grain = |(plane, w): &(&Plane, f64)| (plane.toward(contact, direction), *w);
    let grains: Vec<(Grain, f64)> = parents.iter().map(grain).collect();
    psd_of_grains(&grains, mode, frequencies)
}

/// As [`mixture_psd`], of the grains of the parents.
pub(crate) fn psd_of_grains(grains: &[(Grain, f64)], mode: Mode, frequencies: &[Hertz]) -> Vec<f64> {
    match mode {
        Mode::Paper => independent_psd(grains, 1.0, frequencies),
        Mode::Power => {
            let parts = grains.iter().map(|(g, w)| w * g.level_mps2);
            let (sum, squares) = parts.fold((0.0, 0.0), |(s, q), p| (s + p, q + p * p));
            let makeup = if squares > 0.0 { sum * sum / squares } else { 1.0 };
            independent_psd(grains, makeup, frequencies)
        }
        Mode::Shared | Mode::Parametric | Mode::Field => {
            let mut sum = vec![(0.0, 0.0); frequencies.len()];
            for (grain, weight) in grains {
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
