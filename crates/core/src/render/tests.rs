use super::{Hand, PathPlan, RenderError, RenderPlan, render, render_path};
use crate::ar::test_signals::from_resonances;
use crate::blend::{Mode, mixture_psd};
use crate::lsf::lsf_from_ar;
use crate::plane::{Plane, Prepared};
use crate::profile::Profile;
use crate::relief::Relief;
use crate::space::SpacePoint;
use crate::spectrum::welch;
use crate::texture::test_textures::arma;
use crate::texture::{GrainNode, MIN_LSF_GAP, TextureModel};
use crate::texture_path::{Along, AtEnd, Key, Stop, TexturePath};
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

/// Checks that a rendered signal has the spectrum that the formulas say, in bands.
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
    // Third-octave-like groups of bins: 30..60, 60..120, 120..240, 240..440 Hz.
    for (low, high) in [(30.0, 60.0), (60.0, 120.0), (120.0, 240.0), (240.0, 440.0)] {
        let bins: Vec<(Hertz, f64)> =
            estimate.iter().copied().filter(|(f, _)| f.0 >= low && f.0 < high).collect();
        let f: Vec<Hertz> = bins.iter().map(|b| b.0).collect();
        let model: f64 = mixture_psd(planes, mode, contact, &f).iter().sum();
        let error_db = 10.0 * (bins.iter().map(|b| b.1).sum::<f64>() / model).log10();
        assert!(
            error_db.abs() < tolerance_db,
            "{mode:?} at {rate}, {contact:?}: {low}..{high} Hz off by {error_db} dB"
        );
    }
}

/// Rendered signals have the spectra that the formulas say, in every mode and at any output rate.
#[test]
fn rendered_spectrum_is_the_models() {
    let planes = [plane(60.0, 0.5), plane(110.0, 1.0), plane(160.0, 2.0)];
    let parents: Vec<(&Plane, f64)> = planes.iter().zip([0.3, 0.4, 0.3]).collect();
    for mode in Mode::ALL {
        for rate in [1000.0, 8000.0] {
            // 120 s in at least 30 Hz: a standard error of 0.07 dB; the window leaks a little more.
            check_spectrum(&parents, mode, (rate, 120.0), steady(0.0), 0.4);
        }
    }
}

/// A moving average too: alone at a node and between, and in a mixture with what has none.
#[test]
fn rendered_spectrum_of_a_published_texture_is_the_published_one() {
    let (published, other) = (Plane::new(&arma(18, 16)), plane(110.0, 0.5));
    for (mm_per_s, force) in [(120.0, 1.6), (85.0, 0.9), (150.0, 2.4)] {
        // 60 s in at least 30 Hz: a standard error of 0.1 dB, and again what the window leaks.
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
    assert!(a[600..].iter().all(|v| v.abs() < 1e-3), "rings for more than 0.1 s");
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
    // Twenty frequencies as near to each other as a model may have them: in `f32` the predictor is unstable.
    let lsf = (1..=20).map(|i| 1.001 * MIN_LSF_GAP * f64::from(i)).collect();
    let node = GrainNode { speed: MetersPerSecond(0.08), force: Newtons(0.7), lsf, level_mps2: 1e6 };
    let prepared = Plane::new(&TextureModel::new(Hertz(1000.0), vec![node], None).unwrap()).prepare();
    let parents = [(&prepared, 1.0)];
    for rate in [1000.0, 8000.0] {
        let plan =
            RenderPlan { parents: &parents, mode: Mode::Shared, rate: Hertz(rate), seconds: 10.0, seed: 1 };
        let outcome = render(&plan, &mut steady);
        assert!(matches!(outcome, Err(RenderError::NotFinite { .. })), "{:?}", outcome.map(|x| x.len()));
    }
}

/// A path between two textures whose levels are 1 and 4 times as high: the level follows the way that the tip has traveled
/// since it landed.
#[test]
fn a_path_is_heard_as_it_is_traveled() {
    let model = |level: f64| {
        let nodes = [0.05, 0.2].into_iter().flat_map(|v| {
            [0.5, 1.0].map(|f| GrainNode {
                speed: MetersPerSecond(v),
                force: Newtons(f),
                lsf: lsf_from_ar(&from_resonances(Hertz(1000.0), &[(Hertz(120.0), 0.8)])).unwrap(),
                level_mps2: level,
            })
        });
        TextureModel::new(Hertz(1000.0), nodes.collect(), None).unwrap()
    };
    let key = |level: f64, along: f64| Key {
        stop: Stop { at: SpacePoint { rough_smooth: 0.0, hard_soft: 0.0 }, along },
        is_stop: true,
        model: model(level),
    };
    let path = TexturePath::new(Along::Distance, AtEnd::Hold, vec![key(1.0, 0.0), key(4.0, 0.4)]).unwrap();
    let prepared: Vec<Prepared> = path.keys().iter().map(|key| Plane::new(&key.model).prepare()).collect();
    for rate in [1000.0, 8000.0] {
        // 0.1 m/s for two seconds, two in the air, five more.
        let plan = PathPlan { path: &path, prepared: &prepared, rate: Hertz(rate), seconds: 9.0, seed: 3 };
        let mut contact_at = |t: f64| {
            let is_lifted = (2.0..4.0).contains(&t);
            Contact::from_mm_per_s_and_n(100.0, if is_lifted { 0.0 } else { 0.7 })
        };
        let x = render_path(&plan, &mut contact_at).unwrap();
        let level = |from: f64, to: f64| {
            let part = &x[(from * rate) as usize..(to * rate) as usize];
            (part.iter().map(|v| f64::from(*v).powi(2)).sum::<f64>() / part.len() as f64).sqrt()
        };
        // Under one excitation levels of one spectrum add up: linear along the way.
        for (from, to, want) in
            [(0.9, 1.1, 1.75), (1.9, 2.0, 2.46), (4.1, 4.3, 1.15), (5.9, 6.1, 2.5), (8.1, 8.9, 4.0)]
        {
            let got = level(from, to);
            assert!((got / want - 1.0).abs() < 0.25, "{rate}: {got} for {want} from {from}");
        }
        assert!(level(2.5, 3.9) < 1e-3);
    }
    let few = PathPlan { path: &path, prepared: &prepared[..1], rate: Hertz(1000.0), seconds: 1.0, seed: 3 };
    assert_eq!(render_path(&few, &mut steady), Err(RenderError::Keys { n: 1, keys: 2 }));
}

/// A hand that goes forth for a time at 100 mm/s, and the same way back.
struct BackAndForth(f64);

impl Hand for BackAndForth {
    fn contact_at(&mut self, _: f64) -> Contact {
        Contact::from_mm_per_s_and_n(100.0, 1.0)
    }

    fn place_m_at(&mut self, time_secs: f64) -> Option<f64> {
        Some(0.005 + 0.1 * (self.0 - (time_secs - self.0).abs()))
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
        // Sample i is felt at the end of its interval.
        let forth: Vec<f64> = x[50..480].iter().map(|x| f64::from(*x)).collect();
        let back: Vec<f64> = x.iter().rev().skip(51).take(430).map(|x| f64::from(*x)).collect();
        crate::statistics::correlation(&forth, &back).unwrap()
    };
    let x = render(&plan, &mut BackAndForth(0.5)).unwrap();
    assert!(mirrored(&x) > 0.85, "{}", mirrored(&x));
    // Whoever says nothing of it goes on; a turn elsewhere is another one.
    let on = render(&plan, &mut |_: f64| Contact::from_mm_per_s_and_n(100.0, 1.0)).unwrap();
    assert_ne!(x[600..], on[600..]);
    let off = render(&plan, &mut BackAndForth(0.495)).unwrap();
    assert!(mirrored(&off) < 0.0, "{}", mirrored(&off));
}

/// A texture that is silent but for its relief: a wave of so many mm.
fn wave(millimeters: f64) -> Plane {
    let values = (0..1000).map(|i| (std::f64::consts::TAU * 0.02 * f64::from(i) / millimeters).cos());
    silent_but_for(Profile::new(2e-5, values.collect()).unwrap())
}

fn silent_but_for(profile: Profile) -> Plane {
    let relief = Relief::new(profile, Newtons(1.0)).unwrap();
    Plane::new(&TextureModel::of_relief(relief.into(), Hertz(1000.0)).unwrap())
}

/// A relief sounds at the speed over its length, by weight, whatever the mode mixes signals by.
#[test]
fn reliefs_sound_by_place_and_by_weight() {
    let (long, short) = (wave(2.0).prepare(), wave(0.5).prepare());
    for mode in [Mode::Paper, Mode::Power, Mode::Shared] {
        for rate in [1000.0, 8000.0] {
            let parents = [(&long, 0.75), (&short, 0.25)];
            let plan = RenderPlan { parents: &parents, mode, rate: Hertz(rate), seconds: 1.0, seed: 1 };
            // At half its force.
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
            // What stands still for the high-pass at 10 Hz is a little less at 50.
            assert!((part(50.0) / 0.375 - 0.98).abs() < 0.03, "{mode:?}: {} at 50 Hz", part(50.0));
            assert!((part(200.0) / 0.125 - 1.0).abs() < 0.05, "{mode:?}: {} at 200 Hz", part(200.0));
            assert!(part(120.0) < 1e-3);
        }
    }
}

/// A recording as a relief, under the speed at which it was recorded, is the recording again.
#[test]
fn at_its_own_speed_a_recording_comes_back() {
    let noise = crate::rng::lcg_noise(4000, 3);
    // Without what a tip that stands must not feel, and what lies at the end of the band.
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
    // A sample stands where the tip is at its end.
    let snr = |lag: usize| crate::quality::snr_db(&recorded[100 + lag..2900], &heard[100..2900 - lag]);
    let best = (0..4).map(snr).fold(f64::MIN, f64::max);
    assert!(best > 15.0, "{best} dB");
}
