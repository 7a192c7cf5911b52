//! Layers that depend on the tip's position or make it stick, without grain.

extern crate std;

use std::vec::Vec;

use super::{mix, rms, solo, straight, white};
use crate::contact::{Contact, Place};
use crate::height_map::HeightMap;
use crate::renderer::{Blend, Renderer, TextureId, Textures};
use crate::stick_slip::Friction;
use crate::texture::tests::parts;
use crate::texture::{Node, Parts, Texture, Triangle};

/// A friction that sticks at 30 mm/s. The numbers are such that their means are exact.
const STICKY: Friction = Friction { kinetic: 0.5, static_ratio: 2.0, stribeck_speed_mps: 0.05 };

/// Silent textures with these frictions.
struct Sliding {
    silent: ([Node; 4], [Triangle; 2]),
    frictions: [Option<Friction>; 2],
}

impl Textures for Sliding {
    fn texture(&self, id: TextureId) -> Option<Texture<'_>> {
        let friction = *self.frictions.get(usize::from(id))?;
        Texture::new(Parts { friction, ..parts(&self.silent.0, &self.silent.1) }).ok()
    }
}

/// One second of a slow stroke on textures with these frictions and weights.
fn slid(frictions: [Option<Friction>; 2], weights: &[f32]) -> Vec<f32> {
    let textures = Sliding { silent: white(0.0), frictions };
    let mut renderer = Renderer::new(1000.0, 5);
    assert!(renderer.set_mix(&mix(weights, Blend::Power)));
    renderer.finish_fades();
    let contact = Contact { speed_mps: 0.03, force_n: 1.0 };
    let mut out = std::vec![0.0; 1000];
    for tick in out.chunks_mut(renderer.tick_len()) {
        renderer.tick(&textures, contact, Place::default(), tick);
    }
    out
}

/// A tip has one state of sticking: textures with the same friction are as one, and one without friction takes its share
/// of the output.
#[test]
fn the_friction_of_a_mix_is_its_mean() {
    let alone = slid([Some(STICKY), None], &[1.0]);
    assert!(rms(&alone[500..]) > 0.1, "the tip does not stick: {}", rms(&alone[500..]));
    assert_eq!(slid([Some(STICKY); 2], &[0.5, 0.5]), alone);
    let half: Vec<f32> = alone.iter().map(|x| 0.5 * x).collect();
    assert_eq!(slid([Some(STICKY), None], &[0.5, 0.5]), half);
    assert!(slid([None; 2], &[0.5, 0.5]).iter().all(|x| *x == 0.0));
    let steady = Friction { static_ratio: 1.0, ..STICKY };
    assert!(slid([Some(steady), None], &[1.0]).iter().all(|x| *x == 0.0));
}

/// A texture that leaves takes its stick-slip vibration along within a fade, without a jump at its end.
#[test]
fn stick_slip_fades_with_its_texture() {
    let textures = Sliding { silent: white(0.0), frictions: [Some(STICKY), None] };
    let mut renderer = solo();
    let contact = Contact { speed_mps: 0.03, force_n: 1.0 };
    let highest = |renderer: &mut Renderer, n_ticks: usize| {
        let mut out = [0.0; 5];
        (0..n_ticks).fold(0.0_f32, |highest, _| {
            renderer.tick(&textures, contact, Place::default(), &mut out);
            out.iter().fold(highest, |highest, x| highest.max(x.abs()))
        })
    };
    let before = highest(&mut renderer, 200);
    assert!(renderer.set_mix(&mix(&[0.0, 1.0], Blend::Power)));
    let [first, second] = [highest(&mut renderer, 2), highest(&mut renderer, 2)];
    assert!(before > 0.1 && first <= 1.05 * before && second <= 0.6 * before, "{before}, {first}, {second}");
    highest(&mut renderer, 1);
    assert_eq!(highest(&mut renderer, 10), 0.0);
}

/// A texture that cannot stick takes over without a step, wherever the oscillation is.
#[test]
fn stick_slip_ends_without_a_click() {
    let textures = Sliding {
        silent: white(0.0),
        frictions: [Some(STICKY), Some(Friction { static_ratio: 1.0, ..STICKY })],
    };
    let contact = Contact { speed_mps: 0.03, force_n: 1.0 };
    let mut out = [0.0; 5];
    for n_before in 200..240 {
        let mut renderer = solo();
        let mut signal = Vec::new();
        for tick in 0..n_before + 20 {
            if tick == n_before {
                assert!(renderer.set_mix(&mix(&[0.0, 1.0], Blend::Power)));
            }
            renderer.tick(&textures, contact, Place::default(), &mut out);
            signal.extend(out);
        }
        let step = |part: &[f32]| part.windows(2).fold(0.0_f32, |step, w| step.max((w[1] - w[0]).abs()));
        let (before, after) = signal.split_at(5 * n_before);
        assert!(step(after) <= 1.1 * step(&before[500..]), "{} for {}", step(after), step(&before[500..]));
        assert!(after[50..].iter().all(|x| *x == 0.0));
    }
}

/// A rotated texture with waves of 10 mm along its x axis.
struct Wavy {
    silent: ([Node; 4], [Triangle; 2]),
    coefficients_m: Vec<f32>,
    turn_rad: f32,
}

impl Wavy {
    fn turned(turn_rad: f32) -> Self {
        let mut coefficients_m = Vec::new();
        for _patch in 0..3 {
            for n in [16_u16, 8, 4] {
                for sample in 0..n * n {
                    let turns = f32::from(sample % n) / f32::from(n);
                    coefficients_m.push(1e-5 * (core::f32::consts::TAU * turns).sin());
                }
            }
        }
        Self { silent: white(0.0), coefficients_m, turn_rad }
    }
}

impl Textures for Wavy {
    fn texture(&self, _id: TextureId) -> Option<Texture<'_>> {
        let height_map = HeightMap::new(0.01, 1.0, 2.0, 16, &self.coefficients_m).ok();
        let parts = parts(&self.silent.0, &self.silent.1);
        Texture::new(Parts { height_map, turn_rad: self.turn_rad, ..parts }).ok()
    }
}

/// Half a second of a stroke over waves that are rotated by `turn_deg`.
fn waved(turn_deg: f32, stroke_deg: f32) -> Vec<f32> {
    let (textures, mut renderer) = (Wavy::turned(turn_deg.to_radians()), solo());
    let contact = Contact { speed_mps: 0.1, force_n: 1.0 };
    let mut out = Vec::new();
    for [x_m, y_m] in straight(stroke_deg, 100) {
        let mut tick = [0.0; 5];
        renderer.tick(&textures, contact, Place { x_m, y_m, n_jumps: 0 }, &mut tick);
        out.extend(tick);
    }
    out
}

#[test]
fn a_height_map_is_stroked_in_the_axes_of_its_texture() {
    let across = waved(0.0, 0.0);
    // A curvature of (2π / 10 mm)² · 10 µm at 0.1 m/s.
    assert!((0.01..0.04).contains(&rms(&across)), "{}", rms(&across));
    for angle in [30.0, -120.0, 90.0] {
        let turned = waved(angle, angle);
        let most = turned.iter().zip(&across).map(|(a, b)| (a - b).abs()).fold(0.0, f32::max);
        assert!(most < 1e-4, "{most} at {angle}°");
        assert!(
            rms(&waved(angle, angle + 90.0)) < 1e-4,
            "the stroke along the waves of {angle}° is not silent"
        );
    }
}

#[test]
fn weights_scale_a_height_map() {
    let mut renderer = Renderer::new(1000.0, 5);
    assert!(renderer.set_mix(&mix(&[0.25], Blend::Paper)));
    renderer.finish_fades();
    let textures = Wavy::turned(0.0);
    let full = waved(0.0, 0.0);
    for ([x_m, y_m], full) in straight(0.0, 100).zip(full.chunks(5)) {
        let mut tick = [0.0; 5];
        let contact = Contact { speed_mps: 0.1, force_n: 1.0 };
        renderer.tick(&textures, contact, Place { x_m, y_m, n_jumps: 0 }, &mut tick);
        assert!(tick.iter().zip(full).all(|(quarter, full)| (4.0 * *quarter - *full).abs() < 1e-6));
    }
}
