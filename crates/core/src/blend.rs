//! An authored texture: the weights of its parents, and the spectrum of their mixture.

use crate::plane::{Grain, Plane};
use crate::space::{Location, Space, SpacePoint};
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
    #[default]
    Shared,
}

impl Mode {
    /// All modes, in the order in which they are offered.
    pub const ALL: [Self; 3] = [Self::Paper, Self::Power, Self::Shared];

    /// The word for files and scripts.
    pub fn id(self) -> &'static str {
        match self {
            Self::Paper => "paper",
            Self::Power => "power",
            Self::Shared => "shared",
        }
    }

    /// The mode that has this [`Mode::id`].
    pub fn from_id(id: &str) -> Option<Self> {
        Self::ALL.into_iter().find(|m| m.id() == id)
    }
}

/// Distance below which a point is at a texture, in points of the axes.
const AT_A_TEXTURE: f64 = 1e-7;

/// What is authored at a point.
#[derive(Clone, Debug, PartialEq)]
pub struct Authored {
    /// Where the point lies, with barycentric weights.
    pub location: Location,
    /// Library indices of the parents and the weights of the mode, largest first; zero weights are left out.
    pub parents: Vec<(usize, f64)>,
    /// How they are mixed.
    pub mode: Mode,
}

/// The texture at `point`, as parents and weights; `None` in a space without textures.
pub fn author(space: &Space, point: SpacePoint, mode: Mode) -> Option<Authored> {
    let location = space.locate(point)?;
    let mut parents = match mode {
        Mode::Paper => inverse_distance(space, &location),
        Mode::Power | Mode::Shared => location.corners.clone(),
    };
    parents.retain(|(_, w)| *w > 0.0);
    parents.sort_by(|a, b| b.1.total_cmp(&a.1));
    Some(Authored { location, parents, mode })
}

/// Weights `d_i^-1 / Σ d_j^-1` over the corners of the triangle; a texture's own point is that texture.
fn inverse_distance(space: &Space, location: &Location) -> Vec<(usize, f64)> {
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
/// their gains. All parents have one rate.
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
        Mode::Shared => {
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
    use super::{Mode, author};
    use crate::space::{Space, SpacePoint};
    use proptest::prelude::{prop, prop_assert, proptest};

    fn point(rs: f64, hs: f64) -> SpacePoint {
        SpacePoint::new(rs, hs).unwrap()
    }

    #[test]
    fn golden_inverse_distance_weights() {
        let v: serde_json::Value =
            serde_json::from_str(include_str!("../../../vectors/g_interp/weights_vectors.json")).unwrap();
        let space =
            Space::new(&[Some(point(0.0, 0.0)), Some(point(100.0, 0.0)), Some(point(20.0, 90.0))]).unwrap();
        for case in v["weights"].as_array().unwrap() {
            let at = point(100.0 * case["q"][0].as_f64().unwrap(), 100.0 * case["q"][1].as_f64().unwrap());
            let authored = author(&space, at, Mode::Paper).unwrap();
            for index in 0..3 {
                let weight = authored.parents.iter().find(|(i, _)| *i == index).map_or(0.0, |(_, w)| *w);
                assert!((weight - case["idw1"][index].as_f64().unwrap()).abs() < 1e-12, "{case}: {weight}");
            }
        }
    }

    proptest! {
        /// At its own point a texture is itself, and weights are a partition of one, in every mode.
        #[test]
        fn weights_partition_one(
            points in prop::collection::vec((0.0_f64..100.0, 0.0_f64..100.0), 1..30),
            at in (0.0_f64..100.0, 0.0_f64..100.0),
        ) {
            let sites: Vec<_> = points.iter().map(|(a, b)| Some(point(*a, *b))).collect();
            let space = Space::new(&sites).unwrap();
            for mode in Mode::ALL {
                let authored = author(&space, point(at.0, at.1), mode).unwrap();
                let sum: f64 = authored.parents.iter().map(|p| p.1).sum();
                prop_assert!((sum - 1.0).abs() < 1e-9 && authored.parents.len() <= 3);
                prop_assert!(authored.parents.windows(2).all(|w| w[0].1 >= w[1].1));
                let own = author(&space, sites[0].unwrap(), mode).unwrap();
                prop_assert!((own.parents[0].1 - 1.0).abs() < 1e-6);
            }
        }

        /// Barycentric weights change little when the point moves little, across edges and the hull too.
        #[test]
        fn barycentric_weights_are_continuous(
            points in prop::collection::vec((0.0_f64..100.0, 0.0_f64..100.0), 3..20),
            at in (0.0_f64..100.0, 0.0_f64..100.0),
            angle in 0.0_f64..std::f64::consts::TAU,
        ) {
            // Textures at least two points apart: a sliver's weights may change as fast as it is thin.
            let mut apart: Vec<SpacePoint> = Vec::new();
            for (a, b) in points {
                let p = point(a, b);
                if apart.iter().all(|q| q.distance(p) > 2.0) { apart.push(p); }
            }
            let space = Space::new(&apart.iter().map(|p| Some(*p)).collect::<Vec<_>>()).unwrap();
            let step = 1e-6;
            let to = point((at.0 + step * angle.cos()).clamp(0.0, 100.0), (at.1 + step * angle.sin()).clamp(0.0, 100.0));
            let weights = |p: SpacePoint| {
                let mut w = vec![0.0; apart.len()];
                for (i, v) in author(&space, p, Mode::Power).unwrap().parents { w[i] = v; }
                w
            };
            let moved: f64 = weights(point(at.0, at.1)).iter().zip(weights(to)).map(|(a, b)| (a - b).abs()).sum();
            // The slope is one over the height of a triangle; heights above 1e-3 leave this bound.
            prop_assert!(moved < 1e-2, "{moved}");
        }
    }

    #[test]
    fn modes_round_trip() {
        for mode in Mode::ALL {
            assert_eq!(Mode::from_id(mode.id()), Some(mode));
        }
        assert_eq!(Mode::from_id("loud"), None);
    }
}
