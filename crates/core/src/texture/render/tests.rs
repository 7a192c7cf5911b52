use super::{Hand, RenderError, RenderPlan, render};
use crate::dsp::ar::test_signals::from_resonances;
use crate::dsp::lsf::lsf_from_ar;
use crate::dsp::spectrum::welch;
use crate::texture::blend::{Mode, mixture_psd};
use crate::texture::plane::{Plane, Prepared};
use crate::texture::profile::Profile;
use crate::texture::relief::Relief;
use crate::texture::test_textures::{arma, unstable};
use crate::texture::{GrainNode, TextureModel};
use crate::units::{Contact, Hertz, MetersPerSecond, Newtons};

fn plane(low_hz: f64, level: f64) -> Plane {
    let mut nodes = Vec::new();
    for v in [0.05, 0.1, 0.2] {
        for f in [0.5, 1.0] {
            let ar = from_resonances(Hertz(1000.0), &[(Hertz(low_hz), 0.9), (Hertz(300.0), 0.8)]);
            nodes.push(GrainNode {
                speed: MetersPerSecond(v),
                force: Newtons(f),
                lsf: lsf_from_ar(&ar).unwrap(),
                level_mps2: level * v * 10.0,
            });
        }
    }
    Plane::new(&TextureModel::new(Hertz(1000.0), nodes, None).unwrap())
}

fn steady(_: f64) -> Contact {
    Contact::from_mm_per_s_and_n(80.0, 0.7)
}

/// Checks that the rendered spectrum matches the closed-form spectrum in frequency bands.
fn check_spectrum(
    planes: &[(&Plane, f64)],
    mode: Mode,
    (rate, seconds): (f64, f64),
    contact: Contact,
    tolerance_db: f64,
) {
    let prepared: Vec<Prepared> = planes.iter().map(|(plane, _)| plane.prepare()).collect();
    let parents: Vec<(&Prepared, f64)> = prepared.iter().zip(planes).map(|(p, (_, w))| (p, *w)).collect();
    let plan = RenderPlan { parents: &parents, mode, rate: Hertz(rate), seconds, seed: 5 };
    let x = render(&plan, &mut |_: f64| contact).unwrap();
    let wide: Vec<f64> = x.iter().map(|v| f64::from(*v)).collect();
    let estimate = welch(&wide, Hertz(rate), (rate * 0.256) as usize);
    // Groups of bins: 30..60, 60..120, 120..240, 240..440 Hz.
    for (low, high) in [(30.0, 60.0), (60.0, 120.0), (120.0, 240.0), (240.0, 440.0)] {
        let bins: Vec<(Hertz, f64)> =
            estimate.iter().copied().filter(|(f, _)| f.0 >= low && f.0 < high).collect();
        let f: Vec<Hertz> = bins.iter().map(|b| b.0).collect();
        let model: f64 = mixture_psd(planes, mode, contact, &f).iter().sum();
        let error_db = 10.0 * (bins.iter().map(|b| b.1).sum::<f64>() / model).log10();
        assert!(
            error_db.abs() < tolerance_db,
            "{mode:?} at {rate}, {contact:?}: error {error_db} dB in {low}..{high} Hz"
        );
    }
}

/// Rendered spectra match the closed form in every mode and at every output rate.
#[test]
fn rendered_spectrum_is_the_models() {
    let planes = [plane(60.0, 0.5), plane(110.0, 1.0), plane(160.0, 2.0)];
    let parents: Vec<(&Plane, f64)> = planes.iter().zip([0.3, 0.4, 0.3]).collect();
    for mode in Mode::ALL {
        for rate in [1000.0, 8000.0] {
            // 120 s with at least 30 Hz bandwidth: a standard error of 0.07 dB; window leakage adds a little.
            check_spectrum(&parents, mode, (rate, 120.0), steady(0.0), 0.4);
        }
    }
}

/// With a moving-average part: alone at and between nodes, and in a mixture with a texture without such a part.
#[test]
fn rendered_spectrum_of_a_published_texture_is_the_published_one() {
    let (published, other) = (Plane::new(&arma(18, 16)), plane(110.0, 0.5));
    for (mm_per_s, force) in [(120.0, 1.6), (85.0, 0.9), (150.0, 2.4)] {
        // 60 s with at least 30 Hz bandwidth: a standard error of 0.1 dB, plus window leakage.
        let contact = Contact::from_mm_per_s_and_n(mm_per_s, force);
        check_spectrum(&[(&published, 1.0)], Mode::Shared, (1000.0, 60.0), contact, 0.5);
    }
    for mode in Mode::ALL {
        let parents = [(&published, 0.6), (&other, 0.4)];
        check_spectrum(&parents, mode, (1000.0, 60.0), steady(0.0), 0.5);
    }
}

#[test]
fn a_lifted_tip_is_silent_and_the_same_seed_repeats() {
    let prepared = plane(80.0, 1.0).prepare();
    let parents = [(&prepared, 1.0)];
    let plan =
        RenderPlan { parents: &parents, mode: Mode::Shared, rate: Hertz(1000.0), seconds: 1.0, seed: 1 };
    let mut lifts = |t: f64| if t < 0.5 { steady(t) } else { Contact::default() };
    let a = render(&plan, &mut lifts).unwrap();
    assert_eq!(a, render(&plan, &mut lifts).unwrap());
    let rms = |x: &[f32]| (x.iter().map(|v| v * v).sum::<f32>() / x.len() as f32).sqrt();
    assert!(rms(&a[..500]) > 0.1);
    assert!(
        a[600..].iter().all(|v| v.abs() < 1e-3),
        "the texture must be silent 0.1 s after the tip is lifted"
    );
}

#[test]
fn bad_plans_are_named() {
    let prepared = plane(80.0, 1.0).prepare();
    let parents = [(&prepared, 1.0)];
    let plan =
        RenderPlan { parents: &parents, mode: Mode::Power, rate: Hertz(1000.0), seconds: 1.0, seed: 1 };
    let error = |plan: RenderPlan<'_>| render(&plan, &mut steady).unwrap_err();
    assert_eq!(error(RenderPlan { parents: &[], ..plan }), RenderError::Parents { n: 0 });
    let low = RenderError::Rate { rate_hz: 500.0, lowest_hz: 1000.0 };
    assert_eq!(error(RenderPlan { rate: Hertz(500.0), ..plan }), low);
    assert_eq!(error(RenderPlan { seconds: -1.0, ..plan }), RenderError::Length { seconds: -1.0 });
    assert!(matches!(error(RenderPlan { seconds: f64::NAN, ..plan }), RenderError::Length { .. }));
}

#[test]
fn what_does_not_stay_finite_is_an_error_at_any_rate() {
    let prepared = Plane::new(&unstable()).prepare();
    let parents = [(&prepared, 1.0)];
    for rate in [1000.0, 8000.0] {
        let plan =
            RenderPlan { parents: &parents, mode: Mode::Shared, rate: Hertz(rate), seconds: 10.0, seed: 1 };
        let outcome = render(&plan, &mut steady);
        assert!(matches!(outcome, Err(RenderError::NotFinite { .. })), "{:?}", outcome.map(|x| x.len()));
    }
}

/// Stroke that moves forward at 100 mm/s for a time, and then back at the same speed.
struct BackAndForth(f64);

impl Hand for BackAndForth {
    fn contact_at(&mut self, _: f64) -> Contact {
        Contact::from_mm_per_s_and_n(100.0, 1.0)
    }

    fn place_m_at(&mut self, time_secs: f64) -> Option<[f64; 2]> {
        Some([0.005 + 0.1 * (self.0 - (time_secs - self.0).abs()), 0.0])
    }
}

#[test]
fn a_hand_that_says_where_it_is_feels_a_relief_backwards_on_its_way_back() {
    let prepared = wave(2.0).prepare();
    let plan = RenderPlan {
        parents: &[(&prepared, 1.0)],
        mode: Mode::Power,
        rate: Hertz(1000.0),
        seconds: 1.0,
        seed: 1,
    };
    let mirrored = |x: &[f32]| {
        // Sample i corresponds to the end of its interval.
        let forth: Vec<f64> = x[50..480].iter().map(|x| f64::from(*x)).collect();
        let back: Vec<f64> = x.iter().rev().skip(51).take(430).map(|x| f64::from(*x)).collect();
        crate::maths::statistics::correlation(&forth, &back).unwrap()
    };
    let x = render(&plan, &mut BackAndForth(0.5)).unwrap();
    assert!(mirrored(&x) > 0.85, "{}", mirrored(&x));
    // A stroke without positions continues forward; a reversal at another position gives another signal.
    let on = render(&plan, &mut |_: f64| Contact::from_mm_per_s_and_n(100.0, 1.0)).unwrap();
    assert_ne!(x[600..], on[600..]);
    let off = render(&plan, &mut BackAndForth(0.495)).unwrap();
    assert!(mirrored(&off) < 0.0, "{}", mirrored(&off));
}

/// Texture with a relief only: a cosine with this wavelength in mm.
fn wave(millimeters: f64) -> Plane {
    let values = (0..1000).map(|i| (std::f64::consts::TAU * 0.02 * f64::from(i) / millimeters).cos());
    silent_but_for(Profile::new(2e-5, values.collect()).unwrap())
}

fn silent_but_for(profile: Profile) -> Plane {
    let relief = Relief::new(profile, Newtons(1.0)).unwrap();
    Plane::new(&TextureModel::of_relief(relief.into(), Hertz(1000.0)).unwrap())
}

/// A relief sounds at the frequency speed / wavelength, scaled by its weight, in every interpolation mode.
#[test]
fn reliefs_sound_by_place_and_by_weight() {
    let (long, short) = (wave(2.0).prepare(), wave(0.5).prepare());
    for mode in [Mode::Paper, Mode::Power, Mode::Shared] {
        for rate in [1000.0, 8000.0] {
            let parents = [(&long, 0.75), (&short, 0.25)];
            let plan = RenderPlan { parents: &parents, mode, rate: Hertz(rate), seconds: 1.0, seed: 1 };
            // At half of the relief's force.
            let x = render(&plan, &mut |_: f64| Contact::from_mm_per_s_and_n(100.0, 0.5)).unwrap();
            let part = |hz: f64| {
                let late = x.iter().enumerate().skip(x.len() / 2);
                let angle = |i: usize| std::f64::consts::TAU * hz * i as f64 / rate;
                let (mut re, mut im) = (0.0, 0.0);
                for (i, x) in late {
                    (re, im) = (re + angle(i).cos() * f64::from(*x), im + angle(i).sin() * f64::from(*x));
                }
                2.0 * f64::hypot(re, im) / (0.5 * x.len() as f64)
            };
            // The 10 Hz high-pass filter attenuates 50 Hz slightly.
            assert!((part(50.0) / 0.375 - 0.98).abs() < 0.03, "{mode:?}: {} at 50 Hz", part(50.0));
            assert!((part(200.0) / 0.125 - 1.0).abs() < 0.05, "{mode:?}: {} at 200 Hz", part(200.0));
            assert!(part(120.0) < 1e-3);
        }
    }
}

/// A recording used as a relief is reproduced at the speed of the recording.
#[test]
fn at_its_own_speed_a_recording_comes_back() {
    let noise = crate::maths::rng::lcg_noise(4000, 3);
    // Without the components at zero frequency and at the band edge.
    let recorded: Vec<f64> = noise.windows(4).map(|w| 0.25 * (w[0] + w[1] - w[2] - w[3])).collect();
    let prepared = silent_but_for(Profile::new(1e-4, recorded.clone()).unwrap()).prepare();
    let plan = RenderPlan {
        parents: &[(&prepared, 1.0)],
        mode: Mode::Power,
        rate: Hertz(1000.0),
        seconds: 3.0,
        seed: 1,
    };
    let x = render(&plan, &mut |_: f64| Contact::from_mm_per_s_and_n(100.0, 1.0)).unwrap();
    let heard: Vec<f64> = x.iter().map(|x| f64::from(*x)).collect();
    // A sample corresponds to the tip position at its end.
    let snr = |lag: usize| {
        let pairs = || recorded[100 + lag..2900].iter().zip(&heard[100..2900 - lag]);
        let power: f64 = pairs().map(|(x, _)| x * x).sum();
        let noise: f64 = pairs().map(|(x, y)| (x - y).powi(2)).sum();
        10.0 * (power / noise).log10()
    };
    let best = (0..4).map(snr).fold(f64::MIN, f64::max);
    assert!(best > 15.0, "{best} dB");
}

mod direction;
