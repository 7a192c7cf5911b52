//! A texture's speed-force plane: measured nodes, the boundary around them, and what lies between.

use std::collections::BTreeMap;

use shagreen_synth::texture as synth;

use crate::ar::{power_gain, psd};
use crate::lsf::ar_from_lsf;
use crate::texture::TextureModel;
use crate::triangulation::Triangulation;
use crate::units::{Contact, Hertz};

/// Spacing of silent models along the axis of zero force, in m/s (algorithms a.5).
const SPEED_STEP_MPS: f64 = 0.040;
/// Spacing of silent models along the axis of zero speed, in N, after the first at [`FIRST_FORCE_N`] (algorithms a.5).
const FORCE_STEP_N: f64 = 1.25;
/// First silent model on the axis of zero speed, in N.
const FIRST_FORCE_N: f64 = 0.5;

/// The grain of a texture at any contact: barycentric in the Delaunay triangles over speed and force, each divided by
/// its maximum, closed by silent models at zero speed or force and by copies along the edges of full speed and force.
#[derive(Clone, Debug)]
pub struct Plane {
    rate: Hertz,
    speed_max_mps: f64,
    force_max_n: f64,
    /// Line spectral frequencies and level of every vertex.
    vertices: Vec<(Vec<f64>, f64)>,
    triangulation: Triangulation,
}

/// The grain at one contact.
#[derive(Clone, Debug, PartialEq)]
pub struct Grain {
    /// Samples a second of the model.
    pub rate: Hertz,
    /// Line spectral frequencies in radians.
    pub lsf: Vec<f64>,
    /// Root mean square acceleration in m/s².
    pub level_mps2: f64,
}

impl Grain {
    /// Predictor coefficients `a_1 … a_p`.
    pub fn ar(&self) -> Vec<f64> {
        ar_from_lsf(&self.lsf)
    }

    /// Variance of the excitation that gives the level, in (m/s²)².
    pub fn excitation_variance(&self) -> f64 {
        self.level_mps2 * self.level_mps2 / power_gain(&self.ar())
    }

    /// One-sided power spectral density in (m/s²)²/Hz at each frequency.
    pub fn psd(&self, frequencies: &[Hertz]) -> Vec<f64> {
        psd(&self.ar(), self.excitation_variance(), self.rate, frequencies)
    }
}

impl Plane {
    /// The plane of a texture.
    pub fn new(texture: &TextureModel) -> Self {
        let (speed_max_mps, force_max_n) = (texture.speed_max().0, texture.force_max().0);
        let mut points: Vec<[f64; 2]> = Vec::new();
        let mut vertices = Vec::new();
        for node in texture.nodes() {
            points.push([node.speed.0 / speed_max_mps, node.force.0 / force_max_n]);
            vertices.push((node.lsf.clone(), node.level_mps2));
        }
        let n_measured = points.len();
        // A boundary model has the spectrum of the measured one nearest in mm/s and N (algorithms a.5).
        let nearest = |speed_mps: f64, force_n: f64| {
            let distance = |i: &usize| {
                let node = &texture.nodes()[*i];
                (1e3 * (node.speed.0 - speed_mps)).hypot(node.force.0 - force_n)
            };
            (0..n_measured).min_by(|a, b| distance(a).total_cmp(&distance(b))).unwrap_or(0)
        };
        let speeds = steps(speed_max_mps, SPEED_STEP_MPS, SPEED_STEP_MPS);
        let forces = steps(force_max_n, FIRST_FORCE_N, FORCE_STEP_N);
        let silent =
            speeds.iter().map(|v| [*v, 0.0]).chain(forces.iter().map(|f| [0.0, *f])).chain([[0.0, 0.0]]);
        for [v, f] in silent {
            points.push([v / speed_max_mps, f / force_max_n]);
            vertices.push((texture.nodes()[nearest(v, f)].lsf.clone(), 0.0));
        }
        // Copies along the far edges, but where something was measured on the edge close by.
        let far = forces.iter().map(|f| [speed_max_mps, *f]).chain(speeds.iter().map(|v| [*v, force_max_n]));
        for [v, f] in far {
            let at = [v / speed_max_mps, f / force_max_n];
            let reach = [SPEED_STEP_MPS / speed_max_mps, FORCE_STEP_N / force_max_n];
            let corner = at == [1.0, 1.0];
            let taken = points.iter().enumerate().any(|(i, p)| {
                let same_edge = (at[0] == 1.0 && p[0] == 1.0 && (p[1] - at[1]).abs() < reach[1])
                    || (at[1] == 1.0 && p[1] == 1.0 && (p[0] - at[0]).abs() < reach[0]);
                *p == at || (i < n_measured && same_edge && !corner)
            });
            if !taken {
                let node = &texture.nodes()[nearest(v, f)];
                points.push(at);
                vertices.push((node.lsf.clone(), node.level_mps2));
            }
        }
        // Coordinates are finite and of order one by the texture's own checks.
        let triangulation = Triangulation::new(&points).unwrap_or_default();
        Self { rate: texture.rate(), speed_max_mps, force_max_n, vertices, triangulation }
    }

    /// The grain at `contact`; outside the measured range that of its nearest edge, in the air silent.
    pub fn at(&self, contact: Contact) -> Grain {
        let share = |x: f64, max: f64| if x > 0.0 { (x / max).min(1.0) } else { 0.0 };
        let at = [share(contact.speed.0, self.speed_max_mps), share(contact.force.0, self.force_max_n)];
        let order = self.vertices[0].0.len();
        let (corners, weights) = match self.triangulation.locate(at, 0) {
            Some((triangle, weights)) => (self.triangulation.triangles()[triangle], weights),
            // The triangles cover the whole rectangle; a rounding error outside is the first vertex, unheard.
            None => ([0; 3], [1.0, 0.0, 0.0]),
        };
        let mix = |value: &dyn Fn(usize) -> f64| {
            corners.iter().zip(weights).map(|(c, w)| w * value(*c)).sum::<f64>()
        };
        Grain {
            rate: self.rate,
            lsf: (0..order).map(|i| mix(&|c| self.vertices[c].0[i])).collect(),
            level_mps2: mix(&|c| self.vertices[c].1),
        }
    }

    /// What the renderer needs: nodes and triangles in `f32`, with the gain of the predictor at corners and at the
    /// middles of edges.
    pub fn prepare(&self) -> Prepared {
        let node = |(lsf, level): &(Vec<f64>, f64)| {
            let mut out = synth::Node { level_mps2: *level as f32, lsf: [0.0; synth::MAX_ORDER] };
            for (o, w) in out.lsf.iter_mut().zip(lsf) {
                *o = *w as f32;
            }
            out
        };
        let ln_gain = |lsf: &[f64]| power_gain(&ar_from_lsf(lsf)).ln().min(60.0);
        let at_vertex: Vec<f64> = self.vertices.iter().map(|(lsf, _)| ln_gain(lsf)).collect();
        // Two triangles share an edge: its middle is worked out once.
        let mut at_middle = BTreeMap::new();
        for corners in self.triangulation.triangles() {
            for i in 0..3 {
                let (a, b) = edge(corners[i], corners[(i + 1) % 3]);
                at_middle.entry((a, b)).or_insert_with(|| {
                    let pairs = self.vertices[a].0.iter().zip(&self.vertices[b].0);
                    ln_gain(&pairs.map(|(x, y)| 0.5 * (x + y)).collect::<Vec<_>>())
                });
            }
        }
        let middle = |a: usize, b: usize| at_middle[&edge(a, b)];
        let triangle = |(index, corners): (usize, &[usize; 3])| {
            let t = &self.triangulation;
            let [a, b, c] = *corners;
            // The weights are affine: their values at three points give the map.
            let origin = t.weights_in(index, [0.0, 0.0]);
            let (x, y) = (t.weights_in(index, [1.0, 0.0]), t.weights_in(index, [0.0, 1.0]));
            let map = |i: usize| [x[i] - origin[i], y[i] - origin[i], origin[i]];
            let ([u0, u1, u2], [v0, v1, v2]) = (map(0), map(1));
            synth::Triangle {
                nodes: [a as u16, b as u16, c as u16],
                neighbors: t.neighbors()[index].map(|n| n.map_or(synth::NO_NEIGHBOR, |n| n as u16)),
                weights: [u0, u1, u2, v0, v1, v2].map(|w| w as f32),
                ln_gain: [at_vertex[a], at_vertex[b], at_vertex[c], middle(b, c), middle(c, a), middle(a, b)]
                    .map(|g| g as f32),
            }
        };
        Prepared {
            rate_hz: self.rate.0 as f32,
            order: self.vertices[0].0.len(),
            speed_max_mps: self.speed_max_mps as f32,
            force_max_n: self.force_max_n as f32,
            nodes: self.vertices.iter().map(node).collect(),
            triangles: self.triangulation.triangles().iter().enumerate().map(triangle).collect(),
        }
    }
}

/// An edge by its ends, whichever comes first.
fn edge(a: usize, b: usize) -> (usize, usize) {
    (a.min(b), a.max(b))
}

/// A texture as the renderer takes it.
#[derive(Clone, Debug, PartialEq)]
pub struct Prepared {
    /// Samples a second, in Hz.
    pub rate_hz: f32,
    /// Order of the predictor.
    pub order: usize,
    /// Speed at which the texture saturates, in m/s.
    pub speed_max_mps: f32,
    /// Force at which the texture saturates, in N.
    pub force_max_n: f32,
    /// Nodes of the plane.
    pub nodes: Vec<synth::Node>,
    /// Triangles over the nodes.
    pub triangles: Vec<synth::Triangle>,
}

impl Prepared {
    /// The texture lent to a renderer.
    pub fn view(&self) -> synth::Texture<'_> {
        // A model that was checked makes slices that would be accepted; a test holds it.
        synth::Texture::checked_before(
            self.rate_hz,
            self.order,
            self.speed_max_mps,
            self.force_max_n,
            &self.nodes,
            &self.triangles,
        )
    }
}

/// `first, first + step, …` below `max`, and `max` itself.
fn steps(max: f64, first: f64, step: f64) -> Vec<f64> {
    let mut out: Vec<f64> = (0..1000).map(|i| first + step * f64::from(i)).take_while(|x| *x < max).collect();
    out.push(max);
    out
}

#[cfg(test)]
mod tests {
    use super::{Plane, Prepared, synth};
    use crate::ar::from_resonances;
    use crate::lsf::lsf_from_ar;
    use crate::texture::{GrainNode, TextureModel};
    use crate::units::{Contact, Hertz, MetersPerSecond, Newtons};
    use proptest::prelude::{prop_assert, proptest};
    use shagreen_synth::contact::Contact as SynthContact;

    /// Two resonances that wander with speed and force, level as v F^0.3.
    fn texture(speeds: &[f64], forces: &[f64]) -> TextureModel {
        let mut nodes = Vec::new();
        for &v in speeds {
            for &f in forces {
                let ar = from_resonances(
                    Hertz(1000.0),
                    &[(Hertz(60.0 + 400.0 * v), 0.9), (Hertz(200.0 + 30.0 * f), 0.85), (Hertz(400.0), 0.6)],
                );
                nodes.push(GrainNode {
                    speed: MetersPerSecond(v),
                    force: Newtons(f),
                    lsf: lsf_from_ar(&ar).unwrap(),
                    level_mps2: 10.0 * v * f.powf(0.3),
                });
            }
        }
        TextureModel::new(Hertz(1000.0), nodes, Some(0.3)).unwrap()
    }

    fn is_accepted(p: &Prepared) -> bool {
        let range = (p.speed_max_mps, p.force_max_n);
        synth::Texture::new(p.rate_hz, p.order, range.0, range.1, &p.nodes, &p.triangles).is_ok()
    }

    fn grid() -> TextureModel {
        texture(&[0.03, 0.07, 0.12, 0.18, 0.25], &[0.15, 0.4, 0.8, 1.5, 3.0])
    }

    #[test]
    fn measured_nodes_are_met_exactly_and_silence_on_the_axes() {
        let texture = grid();
        let plane = Plane::new(&texture);
        for node in texture.nodes() {
            let grain = plane.at(Contact { speed: node.speed, force: node.force });
            assert!((grain.level_mps2 - node.level_mps2).abs() < 1e-9);
            assert!(grain.lsf.iter().zip(&node.lsf).all(|(a, b)| (a - b).abs() < 1e-9));
        }
        for (mm_per_s, n) in [(0.0, 1.0), (100.0, 0.0), (0.0, 0.0), (-5.0, 1.0), (f64::NAN, 1.0)] {
            assert_eq!(plane.at(Contact::from_mm_per_s_and_n(mm_per_s, n)).level_mps2, 0.0);
        }
    }

    #[test]
    fn one_node_alone_still_covers_the_plane() {
        let plane = Plane::new(&texture(&[0.1], &[1.0]));
        assert!(is_accepted(&plane.prepare()));
        assert!((plane.at(Contact::from_mm_per_s_and_n(500.0, 9.0)).level_mps2 - 1.0).abs() < 1e-9);
        // The copy at 40 mm/s is the slowest on the edge of full force; from there the level sinks to silence.
        let half = plane.at(Contact::from_mm_per_s_and_n(20.0, 1.0)).level_mps2;
        assert!((half - 0.5).abs() < 1e-9, "{half}");
    }

    proptest! {
        /// What the callback evaluates is what the model says: level within 0.1 dB, spectrum by its frequencies.
        #[test]
        fn prepared_texture_is_the_model(mm_per_s in 1.0_f64..260.0, force in 0.02_f64..3.2) {
            let plane = Plane::new(&grid());
            let prepared = plane.prepare();
            prop_assert!(is_accepted(&prepared));
            let view = prepared.view();
            let mut hint = 0;
            let got = view.evaluate(SynthContact { speed_mps: (mm_per_s * 1e-3) as f32, force_n: force as f32 }, &mut hint);
            let grain = plane.at(Contact::from_mm_per_s_and_n(mm_per_s, force));
            prop_assert!((f64::from(got.level_mps2) - grain.level_mps2).abs() < 1e-4 * (1.0 + grain.level_mps2));
            for (a, b) in got.lsf.iter().zip(&grain.lsf) {
                prop_assert!((f64::from(*a) - b).abs() < 1e-4);
            }
            let sigma = grain.excitation_variance().sqrt();
            let error_db = 20.0 * (f64::from(got.sigma_mps2) / sigma).log10();
            prop_assert!(error_db.abs() < 0.1, "level off by {error_db} dB");
        }
    }
}
