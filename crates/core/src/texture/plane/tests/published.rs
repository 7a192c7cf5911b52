use super::{is_accepted, level_error_db};
use crate::dsp::lsf::ar_from_lsf;
use crate::texture::plane::Plane;
use crate::texture::test_textures::arma;
use crate::texture::{
    FORCES_N, GAINS, MIN_PUBLISHED_LSF_GAP, PublishedNode, SPEEDS_MPS, TextureModel, VARIANCES,
};
use crate::units::{Contact, Hertz, MetersPerSecond, Newtons};
use proptest::bool;
use proptest::collection::vec;
use proptest::prelude::{Strategy, prop_assert, proptest};
use shagreen_synth::contact::Contact as SynthContact;
use shagreen_synth::direction::Direction;
use shagreen_synth::texture::Texture;
use std::f64::consts::{PI, TAU};

/// Reference PSD of the published model, `2 gain² var |B|² / (rate |A|²)`, as sums of cosines and sines.
fn published_psd(ar_lsf: &[f64], ma_lsf: &[f64], variance: f64, gain: f64, f: Hertz) -> f64 {
    let square = |lsf: &[f64]| {
        let c = ar_from_lsf(lsf);
        let w = |k: usize| TAU * f.0 / 1000.0 * (k + 1) as f64;
        let re: f64 = 1.0 + c.iter().enumerate().map(|(k, c)| c * w(k).cos()).sum::<f64>();
        let im: f64 = c.iter().enumerate().map(|(k, c)| c * w(k).sin()).sum::<f64>();
        re * re + im * im
    };
    2.0 * gain * gain * variance * square(ma_lsf) / (1000.0 * square(ar_lsf))
}

#[test]
fn the_spectrum_is_the_published_one_at_nodes_and_between() {
    let model = arma(18, 16);
    let plane = Plane::new(&model);
    let f: Vec<Hertz> = (1..100).map(|i| Hertz(5.0 * f64::from(i))).collect();
    let check = |contact: Contact, parts: &[(usize, f64)]| {
        let nodes: Vec<(&PublishedNode, f64)> =
            parts.iter().map(|(i, w)| (&model.published_nodes()[*i], *w)).collect();
        let mix = |of: &dyn Fn(&PublishedNode) -> f64| nodes.iter().map(|(n, w)| w * of(n)).sum::<f64>();
        let ar_lsf: Vec<f64> = (0..18).map(|i| mix(&|n| n.ar_lsf[i])).collect();
        let ma_lsf: Vec<f64> = (0..16).map(|i| mix(&|n| n.ma_lsf[i])).collect();
        let (variance, gain) = (mix(&|n| n.variance), mix(&|n| n.gain));
        let grain = plane.at(contact);
        for (f, got) in f.iter().zip(grain.psd(&f)) {
            let want = published_psd(&ar_lsf, &ma_lsf, variance, gain, *f);
            // Ten digits below the guaranteed 0.1 dB: rounding errors of polynomials of order 18.
            assert!((got - want).abs() <= 1e-9 * want, "got {got}, expected {want} at {f} and {contact:?}");
        }
    };
    for (index, contact) in model.contacts().enumerate() {
        check(contact, &[(index, 1.0)]);
    }
    // On edges of the grid, which are edges of triangles.
    for (a, b) in [(5, 6), (9, 13), (1, 5), (14, 15)] {
        let at = |i: usize| &model.published_nodes()[i];
        for w in [0.25, 0.7] {
            let mean = |x: f64, y: f64| w * x + (1.0 - w) * y;
            let contact = Contact {
                speed: MetersPerSecond(mean(at(a).speed.0, at(b).speed.0)),
                force: Newtons(mean(at(a).force.0, at(b).force.0)),
            };
            check(contact, &[(a, w), (b, 1.0 - w)]);
        }
    }
    // Beyond the maximum speed and force.
    check(Contact::from_mm_per_s_and_n(900.0, 90.0), &[(15, 1.0)]);
}

#[test]
fn the_level_is_the_integral_of_the_spectrum() {
    for (order, ma_order) in [(18, 16), (20, 18), (15, 13), (3, 8), (6, 0)] {
        let plane = Plane::new(&arma(order, ma_order));
        let n = 8192;
        let f: Vec<Hertz> = (0..n).map(|i| Hertz((f64::from(i) + 0.5) * 500.0 / f64::from(n))).collect();
        for (mm_per_s, force) in [(60.0, 0.5), (37.0, 0.9), (150.0, 2.2)] {
            let grain = plane.at(Contact::from_mm_per_s_and_n(mm_per_s, force));
            let integral = (grain.psd(&f).iter().sum::<f64>() * 500.0 / f64::from(n)).sqrt();
            assert!(
                (grain.level_mps2 / integral - 1.0).abs() < 1e-9,
                "got {}, expected {integral}",
                grain.level_mps2
            );
        }
    }
}

#[test]
fn it_is_silent_in_the_air_and_fades_in_as_published() {
    let plane = Plane::new(&arma(14, 12));
    for (mm_per_s, force) in [(0.0, 1.0), (100.0, 0.0), (-3.0, 1.0), (f64::NAN, 1.0)] {
        let grain = plane.at(Contact::from_mm_per_s_and_n(mm_per_s, force));
        assert_eq!((grain.level_mps2, grain.sigma_mps2), (0.0, 0.0));
    }
    // The variance is linear, so the level is proportional to the square root of speed.
    let level = |mm_per_s| plane.at(Contact::from_mm_per_s_and_n(mm_per_s, 0.5)).level_mps2;
    let ratio = level(1e-2) / level(1e-4);
    assert!((ratio - 10.0).abs() < 0.01, "{ratio}");
}

/// Models that span the ranges that [`TextureModel::published`] accepts: the corners, and nodes between.
fn any_published() -> impl Strategy<Value = Option<TextureModel>> {
    let any_of = |low: f64, high: f64| {
        (low.max(1e-9).ln()..=high.ln()).prop_map(move |x: f64| x.exp().clamp(low, high))
    };
    let node = move |order: usize, ma_order: usize| {
        let lsf = |order: usize| (vec(1e-3..1.0_f64, order + 1), bool::ANY);
        let variance = any_of(*VARIANCES.start(), *VARIANCES.end());
        (
            lsf(order),
            lsf(ma_order),
            variance,
            any_of(*GAINS.start(), *GAINS.end()),
            [0.0..=1.0_f64, 0.0..=1.0_f64],
        )
    };
    let (speed, force) =
        (any_of(*SPEEDS_MPS.start(), *SPEEDS_MPS.end()), any_of(*FORCES_N.start(), *FORCES_N.end()));
    (1_usize..=32, 0_usize..=32, speed, force).prop_flat_map(move |(order, ma_order, speed, force)| {
        vec(node(order, ma_order), 4..12).prop_map(move |nodes| {
            let lsf = |(gaps, is_packed): (Vec<f64>, bool)| -> Vec<f64> {
                let (n, total) = (gaps.len() - 1, gaps.iter().sum::<f64>());
                let sum = |i: usize| PI * gaps[..=i].iter().sum::<f64>() / total;
                let from_top = |i: usize| PI - 1.01 * MIN_PUBLISHED_LSF_GAP * (n - i) as f64;
                (0..n).map(|i| if is_packed { from_top(i) } else { sum(i) }).collect()
            };
            let corners = [[0.0, 0.0], [1.0, 0.0], [0.0, 1.0], [1.0, 1.0]];
            let node = |(i, (ar, ma, variance, gain, at)): (usize, (_, _, f64, f64, [f64; 2]))| {
                let at = corners.get(i).copied().unwrap_or(at);
                let (speed, force) = (MetersPerSecond(at[0] * speed), Newtons(at[1] * force));
                PublishedNode { speed, force, ar_lsf: lsf(ar), ma_lsf: lsf(ma), variance, gain }
            };
            TextureModel::published(Hertz(1000.0), nodes.into_iter().enumerate().map(node).collect(), None)
                .ok()
        })
    })
}

proptest! {
    #[test]
    fn every_accepted_published_model_is_an_accepted_texture(
        model in any_published(),
        at in [0.0_f64..1.1, 0.0_f64..1.1],
    ) {
        if let Some(model) = model {
            let plane = Plane::new(&model);
            let prepared = plane.prepare();
            let accepted = Texture::new(prepared.parts());
            prop_assert!(accepted.is_ok(), "{:?}", accepted.err());
            let speed = MetersPerSecond(at[0] * model.speed_max().0);
            let contact = Contact { speed, force: Newtons(at[1] * model.force_max().0) };
            let (speed_mps, force_n) = (contact.speed.0 as f32, contact.force.0 as f32);
            let got = prepared.view().evaluate(SynthContact { speed_mps, force_n }, Direction::UNKNOWN, &mut [0; 2]);
            prop_assert!(got.sigma_mps2.is_finite() && plane.at(contact).level_mps2.is_finite());
        }
    }

    /// The renderer's evaluation agrees with the model: excitation and level within 0.1 dB.
    #[test]
    fn a_prepared_published_texture_is_the_model(mm_per_s in 1.0_f64..210.0, force in 0.02_f64..3.2) {
        let plane = Plane::new(&arma(18, 16));
        let prepared = plane.prepare();
        prop_assert!(is_accepted(&prepared));
        let contact = Contact::from_mm_per_s_and_n(mm_per_s, force);
        let at = SynthContact { speed_mps: (mm_per_s * 1e-3) as f32, force_n: force as f32 };
        let (got, want) = (prepared.view().evaluate(at, Direction::UNKNOWN, &mut [0; 2]), plane.at(contact));
        // Between three silent corners the texture is silent; near silence, rounding errors of the weights are
        // relatively large.
        if want.level_mps2 > 1e-3 {
            prop_assert!(level_error_db(&plane, &prepared, contact).abs() < 0.01);
            let level_db = 20.0 * (f64::from(got.level_mps2) / want.level_mps2).log10();
            prop_assert!(level_db.abs() < 0.1, "level error {level_db} dB");
        } else {
            prop_assert!(got.level_mps2 < 2e-3);
        }
        for (a, b) in got.ma_lsf.iter().zip(&want.ma_lsf).chain(got.lsf.iter().zip(&want.lsf)) {
            // Weights in f32.
            prop_assert!((f64::from(*a) - b).abs() < 1e-4);
        }
    }
}
