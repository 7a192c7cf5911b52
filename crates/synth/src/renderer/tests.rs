extern crate std;
use super::{Blend, MAX_VOICES, Mix, Parent, Renderer, TextureId, Textures};
use crate::contact::{Contact, Place};
use crate::texture::tests::{parts, square};
use crate::texture::{Node, Texture, Triangle};
use std::vec::Vec;

/// Textures that differ only in the level at full speed and force.
pub(crate) struct Table(Vec<([Node; 4], [Triangle; 2])>);

impl Table {
    pub(crate) fn with_levels(levels: &[f32]) -> Self {
        Self(
            levels
                .iter()
                .map(|&level| {
                    let (mut nodes, mut triangles) = square();
                    nodes[2].level_mps2 = level;
                    // Evenly spaced LSFs give a predictor with zero coefficients and gain 1, so the spectrum is white.
                    for node in &mut nodes {
                        (node.lsf[0], node.lsf[1]) =
                            (core::f32::consts::PI / 3.0, core::f32::consts::PI * 2.0 / 3.0);
                    }
                    for triangle in &mut triangles {
                        triangle.ln_gain = [0.0; 6];
                    }
                    (nodes, triangles)
                })
                .collect(),
        )
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

fn render(renderer: &mut Renderer, table: &Table, n: usize) -> Vec<f32> {
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
