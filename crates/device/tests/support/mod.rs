//! Actuator and texture for the tests of the audio callback.

use shagreen_device::engine::{FrictionConfig, FrictionWave};
use shagreen_device::synth::budget::Budget;
use shagreen_device::synth::drive::{DriveConfig, Inverse};
use shagreen_device::synth::equalizer::Resonance;
use shagreen_device::synth::height_map::{self, HeightMap};
use shagreen_device::synth::relief::Relief;
use shagreen_device::synth::stick_slip::Friction;
use shagreen_device::synth::texture::{Along, MAX_ORDER, NO_NEIGHBOR, Node, Parts, Triangle};
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

/// A display that renders friction, on the second channel.
pub(crate) const FRICTION: FrictionConfig =
    FrictionConfig { channel_idx: 1, wave: FrictionWave::Carrier { frequency_hz: 120.0 } };

/// A rotated texture with every layer: noise whose level grows with speed and is three times as high along the lay, a
/// relief of waves of 0.64 mm, a height map, and friction that sticks.
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
    let heights_m: Vec<f32> = (0..height_map::PATCH_FORCES.len() * height_map::length(16))
        .map(|i| 1e-6 * level_mps2 * (1.7 * i as f32).sin())
        .collect();
    let level_along_mps2 = (3.0 * level_mps2).min(f32::MAX);
    let along_nodes = [node(0.0), node(level_along_mps2), node(level_along_mps2)];
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
        along: Some(Along { nodes: &along_nodes, triangles }),
        turn_rad: 0.3,
        relief: Some(Relief::new(1e-5, 1.0, 1024, &octaves).unwrap()),
        height_map: Some(HeightMap::new(0.01, 1.0, 2.0, 16, &heights_m).unwrap()),
        friction: Some(Friction { kinetic: 0.5, static_ratio: 2.0, stribeck_speed_mps: 0.05 }),
    })
    .unwrap()
}
