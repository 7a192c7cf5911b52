//! Actuator and texture for the tests of the audio callback.

use shagreen_device::synth::budget::Budget;
use shagreen_device::synth::drive::{DriveConfig, Inverse};
use shagreen_device::synth::equalizer::Resonance;
use shagreen_device::synth::relief::Relief;
use shagreen_device::synth::texture::{MAX_ORDER, NO_NEIGHBOR, Node, Parts, Triangle};
use shagreen_device::texture::OwnedTexture;

/// An actuator that uses every stage of the output.
pub(crate) const DRIVE: DriveConfig = DriveConfig {
    inverse: Some(Inverse {
        resonance: Resonance { frequency_hz: 65.0, q: 4.0, gain_mps2_per_volt: 2.0 },
        lowest_hz: 20.0,
    }),
    full_scale: 4.0,
    ceiling: 0.9,
    look_ahead_secs: 0.002,
    budget: Some(Budget { rms: 0.3, time_secs: 5.0 }),
};

/// White noise whose level grows with speed, with a relief of waves of 0.64 mm along x.
pub(crate) fn texture(level_mps2: f32) -> OwnedTexture {
    let mut lsf = [0.0; MAX_ORDER];
    (lsf[0], lsf[1]) = (1.0, 2.0);
    let node = |level_mps2| Node { level_mps2, lsf };
    let triangle = Triangle {
        nodes: [0, 1, 2],
        neighbors: [NO_NEIGHBOR; 3],
        weights: [-1.0, 0.0, 1.0, 1.0, -1.0, 0.0],
        ln_gain: [0.0; 6],
    };
    let nodes = [node(0.0), node(level_mps2), node(level_mps2)];
    let mut octaves = Vec::new();
    for n in (2..=10).rev().map(|octave| 1_usize << octave) {
        let value = |i: usize| (std::f32::consts::TAU * 16.0 * i as f32 / n as f32).sin();
        octaves.extend((0..n).map(|i| if n >= 64 { 0.3 * level_mps2 * value(i) } else { 0.0 }));
    }
    let (nodes, triangles) = (&nodes, &[triangle]);
    OwnedTexture::new(Parts {
        rate_hz: 1000.0,
        order: 2,
        ma_order: 0,
        speed_max_mps: 1.0,
        force_max_n: 1.0,
        nodes,
        excitations: &[],
        triangles,
        relief: Some(Relief::new(1e-5, 1.0, 1024, &octaves).unwrap()),
    })
    .unwrap()
}
