use super::is_accepted;
use crate::dsp::ar::psd;
use crate::dsp::lsf::{MIN_GAP, ar_from_lsf};
use crate::maths::rng::lcg_noise;
use crate::texture::plane::Plane;
use crate::texture::test_textures::two_resonances;
use crate::texture::{GrainNode, Interpolation, TextureModel};
use crate::units::{Contact, Hertz, MetersPerSecond, Newtons};
use proptest::prelude::{prop, prop_assert, proptest};
use shagreen_synth::contact::Contact as SynthContact;
use shagreen_synth::direction::Direction;
use std::f64::consts::PI;

fn radial(model: TextureModel) -> TextureModel {
    model.with_interpolation(Interpolation::RadialBasis).unwrap()
}

fn grid() -> TextureModel {
    radial(two_resonances(&[0.03, 0.07, 0.12, 0.18, 0.25], &[0.15, 0.4, 0.8, 1.5, 3.0]))
}

/// Random nodes of order 3 with levels over two decades, on a slightly perturbed grid of speeds and forces.
fn random(n: usize, seed: u64) -> TextureModel {
    let noise = lcg_noise(8 * n, seed);
    let nodes = noise.chunks(8).enumerate().map(|(i, x)| {
        let mut lsf = [1.5 + 0.2 * x[0], 1.5 + 0.2 * x[1], 1.5 + 0.2 * x[2]];
        lsf.sort_by(f64::total_cmp);
        lsf[1] += 0.01;
        lsf[2] += 0.02;
        let (column, row) = ((i % 5) as f64, (i / 5) as f64);
        GrainNode {
            speed: MetersPerSecond(0.04 * (column + 1.0 + 0.1 * x[3].sin())),
            force: Newtons(0.5 * (row + 1.0 + 0.1 * x[4].sin())),
            lsf: lsf.to_vec(),
            level_mps2: 10.0_f64.powf(x[5].sin()),
        }
    });
    radial(TextureModel::new(Hertz(1000.0), nodes.collect(), None).unwrap())
}

#[test]
fn nodes_are_met_and_the_axes_are_silent() {
    for model in [grid(), random(20, 3)] {
        let plane = Plane::new(&model);
        for node in model.nodes() {
            let grain = plane.at(Contact { speed: node.speed, force: node.force });
            // Error due to the ridge: 1e-6 times weights below a hundred.
            assert!((grain.level_mps2 / node.level_mps2 - 1.0).abs() < 1e-4);
            assert!(grain.lsf.iter().zip(&node.lsf).all(|(a, b)| (a - b).abs() < 1e-4));
        }
        for (mm_per_s, n) in [(0.0, 1.0), (100.0, 0.0), (0.0, 0.0), (-5.0, 1.0), (f64::NAN, 1.0)] {
            assert_eq!(plane.at(Contact::from_mm_per_s_and_n(mm_per_s, n)).level_mps2, 0.0);
        }
        // At half of the lowest force the level is half of the level at the lowest force.
        let (v, f) = (120.0, model.nodes().iter().map(|n| n.force.0).fold(f64::INFINITY, f64::min));
        let level = |force: f64| plane.at(Contact::from_mm_per_s_and_n(v, force)).level_mps2;
        assert!((level(0.5 * f) / level(f) - 0.5).abs() < 1e-9);
    }
}

#[test]
fn a_linear_field_is_reproduced() {
    let lsf = |v: f64, f: f64| vec![0.5 + v + 0.02 * f, 1.3 - v + 0.05 * f, 2.2 + 0.5 * v - 0.1 * f];
    let ln_level = |v: f64, f: f64| -1.0 + 4.0 * v + 0.3 * f;
    let mut nodes = Vec::new();
    for v in [0.05, 0.1, 0.25] {
        for f in [0.5, 1.2, 2.0] {
            let (speed, force) = (MetersPerSecond(v), Newtons(f));
            nodes.push(GrainNode { speed, force, lsf: lsf(v, f), level_mps2: ln_level(v, f).exp() });
        }
    }
    let plane = Plane::new(&radial(TextureModel::new(Hertz(1000.0), nodes, None).unwrap()));
    for (v, f) in [(0.06, 0.6), (0.111, 1.9), (0.2, 0.77), (0.25, 2.0)] {
        let grain = plane.at(Contact { speed: MetersPerSecond(v), force: Newtons(f) });
        assert!((grain.level_mps2.ln() - ln_level(v, f)).abs() < 1e-9);
        assert!(grain.lsf.iter().zip(lsf(v, f)).all(|(a, b)| (a - b).abs() < 1e-9));
    }
}

#[test]
fn few_nodes_and_nodes_on_a_line_are_enough() {
    let cases: [(&[f64], &[f64]); 4] =
        [(&[0.1], &[1.0]), (&[0.1, 0.2], &[1.0]), (&[0.05, 0.1, 0.2], &[1.0]), (&[0.1], &[0.4, 0.9, 3.0])];
    for (speeds, forces) in cases {
        let model = radial(two_resonances(speeds, forces));
        let plane = Plane::new(&model);
        assert!(is_accepted(&plane.prepare()));
        for node in model.nodes() {
            let grain = plane.at(Contact { speed: node.speed, force: node.force });
            assert!((grain.level_mps2 / node.level_mps2 - 1.0).abs() < 1e-4);
        }
        let last = model.nodes()[model.nodes().len() - 1].level_mps2;
        let beyond = plane.at(Contact::from_mm_per_s_and_n(900.0, 90.0)).level_mps2;
        assert!((beyond / last - 1.0).abs() < 1e-4);
    }
}

#[test]
fn nodes_that_are_silent_stay_silent_and_all_silent_is_silence() {
    let silenced = |which: &dyn Fn(usize) -> bool| {
        let mut nodes = grid().nodes().to_vec();
        for (i, node) in nodes.iter_mut().enumerate() {
            node.level_mps2 *= if which(i) { 0.0 } else { 1.0 };
        }
        Plane::new(&radial(TextureModel::new(Hertz(1000.0), nodes, None).unwrap()))
    };
    let model = grid();
    let node = &model.nodes()[12];
    let contact = Contact { speed: node.speed, force: node.force };
    // A millionth of the highest level represents silence.
    assert!(silenced(&|i| i == 12).at(contact).level_mps2 < 1e-5);
    let all = silenced(&|_| true);
    assert_eq!(all.at(contact).level_mps2, 0.0);
    assert!(is_accepted(&all.prepare()));
}

/// The renderer's triangles approximate the basis: level and spectrum within the tolerance of the refinement.
#[test]
fn triangles_stand_for_the_basis() {
    for model in [grid(), random(20, 9)] {
        let plane = Plane::new(&model);
        let prepared = plane.prepare();
        let f: Vec<Hertz> = (1..49).map(|i| Hertz(10.0 * f64::from(i))).collect();
        let mut worst = [0.0_f64; 2];
        for i in 0..500 {
            // A low-discrepancy pattern within the measured range.
            let [x, y] = [0.754_877, 0.569_840].map(|a| 0.25 + 0.75 * (f64::from(i) * a).fract());
            let contact = Contact {
                speed: MetersPerSecond(x * model.speed_max().0),
                force: Newtons(y * model.force_max().0),
            };
            let at = SynthContact { speed_mps: contact.speed.0 as f32, force_n: contact.force.0 as f32 };
            let (got, want) =
                (prepared.view().evaluate(at, Direction::UNKNOWN, &mut [0; 2]), plane.at(contact));
            let lsf: Vec<f64> = got.lsf[..model.order()].iter().map(|w| f64::from(*w)).collect();
            let level_db = 20.0 * (f64::from(got.level_mps2) / want.level_mps2).log10();
            let sigma = f64::from(got.sigma_mps2);
            let spectrum = psd(&ar_from_lsf(&lsf), sigma * sigma, Hertz(1000.0), &f);
            let squares = spectrum.iter().zip(want.psd(&f)).map(|(a, b)| (10.0 * (a / b).log10()).powi(2));
            let spectrum_db = (squares.sum::<f64>() / f.len() as f64).sqrt();
            worst = [worst[0].max(level_db.abs()), worst[1].max(spectrum_db)];
        }
        // The refinement tolerates 0.2 dB each at its test points; between them, levels over two decades give slightly
        // more.
        assert!(worst[0] < 0.5 && worst[1] < 0.5, "level {} dB, spectrum {} dB", worst[0], worst[1]);
    }
}

proptest! {
    #[test]
    fn order_is_kept_and_nothing_jumps(
        n in 1_usize..25,
        seed in 0_u64..1000,
        at in [0.0_f64..1.2, 0.0_f64..1.2],
        angle in 0.0_f64..std::f64::consts::TAU,
        speeds in prop::collection::vec(0.0_f64..0.3, 5),
    ) {
        let model = random(n, seed);
        let plane = Plane::new(&model);
        let contact = |x: f64, y: f64| Contact {
            speed: MetersPerSecond(x * model.speed_max().0),
            force: Newtons(y * model.force_max().0),
        };
        let here = plane.at(contact(at[0], at[1]));
        let there = plane.at(contact(at[0] + 1e-7 * angle.cos(), at[1] + 1e-7 * angle.sin()));
        // Levels up to 100 m/s², with slopes of at most a hundred times that over the width of the plane.
        prop_assert!((here.level_mps2 - there.level_mps2).abs() < 1e-2);
        prop_assert!(here.lsf.iter().zip(&there.lsf).all(|(a, b)| (a - b).abs() < 1e-4));
        for speed in speeds {
            let lsf = plane.at(Contact { speed: MetersPerSecond(speed), force: Newtons(at[1]) }).lsf;
            prop_assert!(lsf[0] >= MIN_GAP * 0.999 && lsf[lsf.len() - 1] <= PI - MIN_GAP * 0.999);
            prop_assert!(lsf.windows(2).all(|w| w[1] - w[0] >= MIN_GAP * 0.999), "{lsf:?}");
        }
    }

}
