extern crate std;
use super::{Blend, MAX_VOICES, Mix, Parent, Renderer, TextureId, Textures};
use crate::contact::{Contact, Place};
use crate::texture::tests::{parts, square};
use crate::texture::{Along, Node, Parts, Texture, Triangle};
use std::vec::Vec;

/// Textures that differ only in the level at full speed and force.
pub(crate) struct Table(Vec<([Node; 4], [Triangle; 2])>);

impl Table {
    pub(crate) fn with_levels(levels: &[f32]) -> Self {
        Self(levels.iter().map(|&level| white(level)).collect())
    }
}

/// A white spectrum with this level at full speed and force.
fn white(level: f32) -> ([Node; 4], [Triangle; 2]) {
    let (mut nodes, mut triangles) = square();
    nodes[2].level_mps2 = level;
    // Evenly spaced LSFs give a predictor with zero coefficients and gain 1, so the spectrum is white.
    for node in &mut nodes {
        (node.lsf[0], node.lsf[1]) = (core::f32::consts::PI / 3.0, core::f32::consts::PI * 2.0 / 3.0);
    }
    for triangle in &mut triangles {
        triangle.ln_gain = [0.0; 6];
    }
    (nodes, triangles)
}

/// A texture that is rotated, with levels of 1 m/s² across and 3 m/s² along its lay.
struct Brushed {
    grains: [([Node; 4], [Triangle; 2]); 2],
    turn_rad: f32,
}

impl Brushed {
    fn turned(turn_rad: f32) -> Self {
        Self { grains: [white(1.0), white(3.0)], turn_rad }
    }
}

impl Textures for Brushed {
    fn texture(&self, _id: TextureId) -> Option<Texture<'_>> {
        let [(nodes, triangles), (along_nodes, along_triangles)] = &self.grains;
        let along = Some(Along { nodes: along_nodes, triangles: along_triangles });
        Texture::new(Parts { along, turn_rad: self.turn_rad, ..parts(nodes, triangles) }).ok()
    }
}

impl Textures for Table {
    fn texture(&self, id: TextureId) -> Option<Texture<'_>> {
        let (nodes, triangles) = self.0.get(usize::from(id))?;
        Texture::new(parts(nodes, triangles)).ok()
    }
}

pub(crate) const FULL: Contact = Contact { speed_mps: 1.0, force_n: 1.0 };

fn mix(weights: &[f32], blend: Blend) -> Mix {
    let mut mix = Mix::silent(blend);
    for (i, &weight) in weights.iter().enumerate() {
        mix.parents[i] = Parent { id: i as TextureId, weight };
    }
    mix
}

fn render(renderer: &mut Renderer, table: &dyn Textures, n: usize) -> Vec<f32> {
    let mut out = std::vec![0.0; n];
    for tick in out.chunks_mut(renderer.tick_len()) {
        renderer.tick(table, FULL, Place::default(), tick);
    }
    out
}

fn rms(x: &[f32]) -> f64 {
    (x.iter().map(|v| f64::from(*v).powi(2)).sum::<f64>() / x.len() as f64).sqrt()
}

#[test]
fn blends_have_the_levels_of_their_formulas() {
    let table = Table::with_levels(&[0.5, 1.0, 2.0]);
    let (w, s) = ([0.3_f64, 0.4, 0.3], [0.5, 1.0, 2.0]);
    let sum: f64 = w.iter().zip(&s).map(|(w, s)| w * s).sum();
    let independent = w.iter().zip(&s).map(|(w, s)| (w * s).powi(2)).sum::<f64>().sqrt();
    // The three textures have one spectrum, so signals with a shared excitation add fully in phase.
    for (blend, expected) in [(Blend::Paper, independent), (Blend::Power, sum), (Blend::Shared, sum)] {
        let mut renderer = Renderer::new(1000.0, 3);
        assert!(renderer.set_mix(&mix(&[0.3, 0.4, 0.3], blend)));
        renderer.finish_fades();
        let level = rms(&render(&mut renderer, &table, 200_000)[1000..]);
        // The tolerance is five standard errors of the level of 200,000 white samples.
        assert!(
            (level / expected - 1.0).abs() < 5.0 / (2.0 * 200_000_f64).sqrt(),
            "{blend:?}: {level} {expected}"
        );
    }
}

#[test]
fn a_change_never_jumps() {
    // A jump in white noise cannot be distinguished from the noise, so the test observes the weights. They move by at
    // most one tick's fraction of a fade.
    let table = Table::with_levels(&[1.0, 1.0, 1.0, 1.0]);
    let mut renderer = Renderer::new(1000.0, 3);
    assert!(renderer.set_mix(&Mix::solo(0)));
    let _ = render(&mut renderer, &table, 100);
    assert!(renderer.set_mix(&Mix::solo(1)));
    let mut last = 1.0;
    for _ in 0..6 {
        let _ = render(&mut renderer, &table, 5);
        let weight = renderer.slots.iter().find(|s| s.id == Some(0)).map_or(0.0, |s| s.weight);
        assert!(weight <= last && last - weight <= 0.2501, "{last} to {weight}");
        last = weight;
    }
    assert_eq!(last, 0.0);
    assert!(!renderer.is_sounding(0) && renderer.is_sounding(1));
}

#[test]
fn a_texture_that_stays_is_not_restarted() {
    let table = Table::with_levels(&[1.0, 1.0, 1.0]);
    let run = |change: bool| {
        let mut renderer = Renderer::new(1000.0, 9);
        assert!(renderer.set_mix(&mix(&[1.0], Blend::Paper)));
        renderer.finish_fades();
        let _ = render(&mut renderer, &table, 100);
        if change {
            assert!(renderer.set_mix(&mix(&[1.0, 0.0], Blend::Paper)));
        }
        render(&mut renderer, &table, 100)
    };
    assert_eq!(run(false), run(true));
}

#[test]
fn more_changes_than_voices_are_held_back_and_then_taken() {
    let table = Table::with_levels(&[1.0; 20]);
    let mut renderer = Renderer::new(1000.0, 1);
    let mut refused = 0;
    for id in 0..20 {
        while !renderer.set_mix(&Mix::solo(id)) {
            refused += 1;
            let _ = render(&mut renderer, &table, 5);
            assert!(refused < 100, "the mix is never accepted");
        }
    }
    assert!(refused > 0, "no mix was refused: 20 textures fit into {MAX_VOICES} voices at once");
    assert!(renderer.is_sounding(19));
}

#[test]
fn silence_where_there_is_no_contact_or_no_texture() {
    let table = Table::with_levels(&[1.0]);
    let mut renderer = Renderer::new(1000.0, 1);
    assert!(renderer.set_mix(&Mix::solo(7)));
    assert!(render(&mut renderer, &table, 50).iter().all(|&x| x == 0.0));
    assert!(renderer.set_mix(&Mix::solo(0)));
    let mut out = [1.0; 5];
    for _ in 0..10 {
        renderer.tick(&table, Contact::LIFTED, Place::default(), &mut out);
        assert_eq!(out, [0.0; 5]);
    }
}

/// Renderer of one texture at full weight.
fn solo() -> Renderer {
    let mut renderer = Renderer::new(1000.0, 5);
    assert!(renderer.set_mix(&Mix::solo(0)));
    renderer.finish_fades();
    renderer
}

/// Output and level in m/s² after each tick, for a tip at these positions.
fn stroked(brushed: &Brushed, places_m: impl Iterator<Item = [f64; 2]>) -> Vec<(Vec<f32>, f32)> {
    let mut renderer = solo();
    let mut tick = std::vec![0.0; renderer.tick_len()];
    let next = |[x_m, y_m]: [f64; 2]| {
        renderer.tick(brushed, FULL, Place { x_m, y_m, n_jumps: 0 }, &mut tick);
        (tick.clone(), renderer.slots[0].level)
    };
    places_m.map(next).collect()
}

/// Positions along a straight stroke, one a tick.
fn straight(angle_deg: f32, n_ticks: u32) -> impl Iterator<Item = [f64; 2]> {
    let (sin, cos) = f64::from(angle_deg).to_radians().sin_cos();
    (0..n_ticks).map(move |i| [5e-4 * f64::from(i) * cos, 5e-4 * f64::from(i) * sin])
}

#[test]
fn the_power_turns_with_the_stroke() {
    for (turn_deg, angle_deg, power) in [
        (0.0, 0.0, 1.0),
        (0.0, 90.0, 9.0),
        (0.0, 45.0, 5.0),
        (0.0, -45.0, 5.0),
        (30.0, 30.0, 1.0),
        (30.0, 75.0, 5.0),
        (90.0, 0.0, 9.0),
        (0.0, 30.0, 3.0),
    ] {
        let ticks = stroked(&Brushed::turned(f32::to_radians(turn_deg)), straight(angle_deg, 20_000));
        let samples: Vec<f32> = ticks[10..].iter().flat_map(|(tick, _)| tick.iter().copied()).collect();
        let ratio = rms(&samples).powi(2) / power;
        // Five standard errors of the power of 100,000 white samples.
        let tolerance = 5.0 * (2.0 / 100_000_f64).sqrt();
        assert!((ratio - 1.0).abs() < tolerance, "{ratio} at {angle_deg}° on a texture at {turn_deg}°");
    }
}

/// A full turn in 2 s changes the power from 1 to 9 (m/s²)² and back, by less than a twentieth of that in a tick.
#[test]
fn a_turning_stroke_has_no_jump() {
    let circle = (0..800).map(|i| {
        let (sin, cos) = (core::f64::consts::PI * 0.005 * f64::from(i)).sin_cos();
        [0.03 * cos, 0.03 * sin]
    });
    let powers: Vec<f32> =
        stroked(&Brushed::turned(0.3), circle).iter().map(|(_, level)| level * level).collect();
    let steepest = powers[10..].windows(2).map(|pair| (pair[1] - pair[0]).abs()).fold(0.0, f32::max);
    assert!(steepest < 8.0 / 20.0, "a step of {steepest}");
    let (low, high) = powers[10..]
        .iter()
        .fold((9.0_f32, 0.0_f32), |(low, high), power| (low.min(*power), high.max(*power)));
    assert!(low < 1.05 && high > 8.95, "{low} to {high}");
}

#[test]
fn a_reversed_stroke_feels_the_same() {
    let there: Vec<[f64; 2]> = straight(30.0, 200).collect();
    let back = there.iter().rev().copied();
    let ticks = stroked(&Brushed::turned(0.0), there.iter().copied().chain(back));
    assert!(ticks[1..].iter().all(|(_, level)| (level - 3.0_f32.sqrt()).abs() < 1e-4));
}

/// A tip without positions strokes across the lay, and so does one before its first motion.
#[test]
fn without_motion_the_stroke_is_across_the_lay() {
    let samples = render(&mut solo(), &Brushed::turned(0.7), 100_000);
    assert!((rms(&samples[10..]) - 1.0).abs() < 0.02, "{}", rms(&samples));
}

mod layers;
