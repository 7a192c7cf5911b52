//! Synthetic textures shared by tests.

use std::f64::consts::PI;

use crate::dsp::ar::test_signals::from_resonances;
use crate::dsp::lsf::lsf_from_ar;
use crate::texture::{
    Grain, GrainNode, Interpolation, MIN_LSF_GAP, PublishedNode, TextureModel, TextureModelError,
};
use crate::units::{Hertz, MetersPerSecond, Newtons};

/// Two resonances that shift with speed and force; the level is 10 v F^0.3 m/s².
pub(crate) fn two_resonances(speeds: &[f64], forces: &[f64]) -> TextureModel {
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

/// A texture whose predictor is unstable in `f32`, which [`TextureModel::new`] would refuse: twenty line spectral
/// frequencies at the minimum distance.
pub(crate) fn unstable() -> TextureModel {
    let mut model = two_resonances(&[0.08], &[0.7]);
    let lsf = (1..=20).map(|i| 1.001 * MIN_LSF_GAP * f64::from(i)).collect();
    let node = GrainNode { speed: MetersPerSecond(0.08), force: Newtons(0.7), lsf, level_mps2: 1e6 };
    assert_eq!(
        TextureModel::new(Hertz(1000.0), vec![node.clone()], None),
        Err(TextureModelError::Unstable { index: 0 })
    );
    model.grain = Grain::Measured { nodes: vec![node], interpolation: Interpolation::Barycentric };
    model
}

/// Published texture with these orders at 1 kHz, up to 0.2 m/s and 3 N. Its irregular spectra shift with speed and
/// force; frequencies have six decimals, and the variance is zero on the axes.
pub(crate) fn arma(order: usize, ma_order: usize) -> TextureModel {
    let mut nodes = Vec::new();
    for v in [0.0, 0.06, 0.12, 0.2] {
        for f in [0.0, 0.5, 1.6, 3.0] {
            let lsf = |order: usize, phase: f64| -> Vec<f64> {
                let w = |i: usize| {
                    let wander = (1.7 * i as f64 + phase + 6.0 * v + 0.4 * f).sin();
                    let w = PI * (i as f64 + 0.8 + 0.38 * wander) / (order as f64 + 0.6);
                    (w * 1e6).round() / 1e6
                };
                (0..order).map(w).collect()
            };
            nodes.push(PublishedNode {
                speed: MetersPerSecond(v),
                force: Newtons(f),
                ar_lsf: lsf(order, 0.3),
                ma_lsf: lsf(ma_order, 2.0),
                variance: 0.05 * v * f,
                gain: 6.0 + 10.0 * v + f,
            });
        }
    }
    TextureModel::published(Hertz(1000.0), nodes, Some(0.4)).unwrap()
}
