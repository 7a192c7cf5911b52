use super::{
    ACROSS, ALONG, Contact, Material, MetersPerSecond, Newtons, PEN, PROFILE_STEP_M, Radians, Springs,
    StrokeError, Surface, contact_stiffness_n_per_m, effective_modulus_pa, hardness, hertz_stiffness_n_per_m,
    patch_radius_m, prepare, press, rms, simulate,
};
use crate::surfaces::height_field::{Tile, synthesize};
use crate::surfaces::material::tests::plain;
use rustfft::num_complex::Complex;
use std::f64::consts::TAU;

const TILE: Tile = Tile { n_cells: 128, spacing_m: 40e-6 };

fn at(speed_mps: f64, force_n: f64) -> Contact {
    Contact { speed: MetersPerSecond(speed_mps), force: Newtons(force_n) }
}

fn surface(material: &Material) -> Surface {
    prepare(material, &synthesize(material, TILE, 1), &PEN, 0.18, ACROSS, 1)
}

#[test]
fn hertz_relations_hold_together() {
    let material = plain();
    for force_n in [0.1, 1.0, 3.0] {
        let modulus = effective_modulus_pa(&material, &PEN);
        let patch = patch_radius_m(&material, &PEN, Newtons(force_n));
        // Two closed forms of one contact: k = 2 E* a, and the load of a patch, F = 4/3 E* a³ / R.
        let stiffness = hertz_stiffness_n_per_m(&material, &PEN, Newtons(force_n));
        assert!((stiffness / (2.0 * modulus * patch) - 1.0).abs() < 1e-12);
        let load = 4.0 / 3.0 * modulus * patch.powi(3) / PEN.tip_radius_m;
        assert!((load / force_n - 1.0).abs() < 1e-12);
        assert!(contact_stiffness_n_per_m(&material, &PEN, Newtons(force_n)) < stiffness);
    }
}

#[test]
fn hardness_keeps_its_numbers() {
    // log10 of k = 3/2 (4/3 E* √R)^⅔ at 1 N, computed independently: polished metal, cork, cardboard.
    for (modulus, expected) in
        [(1e11, 5.654_356_582_051_952), (2e7, 4.183_684_737_704_996), (6e7, 4.498_298_111_727_566)]
    {
        let material = Material { youngs_modulus_pa: modulus, ..plain() };
        assert!((hardness(&material, &PEN) - expected).abs() < 1e-12);
    }
}

#[test]
fn a_flat_surface_is_silent_and_a_rougher_one_louder() {
    let check = |height_rms_m: f64| {
        let material = Material { height_rms_m, friction_heterogeneity: 0.0, ..plain() };
        rms(&simulate(&surface(&material), at(0.1, 1.0), 0.5, 3).expect("valid stroke"))
    };
    assert_eq!(check(0.0), 0.0);
    let [one, two] = [1e-8, 2e-8].map(check);
    // At such low heights the response is linear except for ball dilation and the asperity compliance.
    assert!((two / one - 2.0).abs() < 0.05, "{one} and {two}");
    assert!(check(2e-6) > 20.0 * two);
}

/// In the linear regime, RMS matches `S_a(f) = |H_c(f)|² (2πf)⁴ S_h(f/v) / v` plus its lateral counterpart, computed
/// from the same profile.
#[test]
fn power_of_a_stroke_is_the_linear_prediction() {
    let speed_mps = 0.2;
    let material = Material { height_rms_m: 2e-8, friction_heterogeneity: 0.0, hurst: 0.6, ..plain() };
    let surface = surface(&material);
    let signal = simulate(&surface, at(speed_mps, 1.0), 0.5, 3).expect("valid stroke");

    let pressed = press(&surface, Newtons(1.0)).expect("valid force");
    let mut heights = pressed.path.heights_m.clone();
    let Springs { contact_n_per_m: stiffness, damping_n_s_per_m: damping, .. } = pressed.springs;
    let n = heights.len();
    let mut planner = realfft::RealFftPlanner::<f64>::new();
    let forward = planner.plan_fft_forward(n);
    let mut spectrum = forward.make_output_vec();
    forward.process(&mut heights, &mut spectrum).expect("own plan");
    let mut predicted = 0.0;
    for (i, value) in spectrum.iter().enumerate() {
        let f_hz = speed_mps * i as f64 / (n as f64 * PROFILE_STEP_M);
        if (10.0..475.0).contains(&f_hz) {
            let w = TAU * f_hz;
            let contact = Complex::new(stiffness, w * damping);
            let hand = Complex::new(
                PEN.hand_stiffness_n_per_m - PEN.mass_kg * w * w,
                w * PEN.hand_damping_n_s_per_m,
            );
            let ride = contact / (contact + hand);
            let pull =
                material.friction_coefficient * contact * (1.0 - ride) + Complex::new(0.0, w / speed_mps);
            let w_l = TAU * PEN.lateral_resonance_hz;
            let mode = Complex::new(w_l * w_l - w * w, 2.0 * PEN.lateral_damping_ratio * w_l * w);
            let lateral = pull / PEN.mass_kg / mode;
            let height = value.norm() / n as f64;
            predicted += 2.0 * (height * w * w).powi(2) * (ride.norm_sqr() + lateral.norm_sqr());
        }
    }
    // The stroke covers most of the path; spectral leakage and sampling error amount to some percent.
    let ratio = rms(&signal) / predicted.sqrt();
    assert!((ratio - 1.0).abs() < 0.1, "{ratio}");
}

#[test]
fn same_seed_same_stroke() {
    let surface = surface(&plain());
    let once = simulate(&surface, at(0.05, 0.5), 0.5, 3);
    assert_eq!(once, simulate(&surface, at(0.05, 0.5), 0.5, 3));
    assert_ne!(once, simulate(&surface, at(0.05, 0.5), 0.5, 4));
    assert_eq!(once.map(|signal| signal.len()), Ok(500));
}

#[test]
fn what_cannot_be_stroked_is_refused() {
    let surface = surface(&plain());
    let fails = |contact, secs| simulate(&surface, contact, secs, 1).expect_err("not a stroke");
    let weightless = StrokeError::NotPositive { quantity: "force in N", value: 0.0 };
    assert_eq!(fails(at(0.1, 0.0), 1.0), weightless);
    assert!(matches!(fails(at(f64::NAN, 1.0), 1.0), StrokeError::NotPositive { .. }));
    assert!(matches!(fails(at(0.1, 1.0), f64::INFINITY), StrokeError::NotPositive { .. }));
    assert!(matches!(fails(at(0.1, 1.0), 3.0), StrokeError::PathTooShort { .. }));
}

#[test]
fn a_brushed_surface_is_quiet_along_its_lay_and_an_isotropic_one_is_not() {
    let level = |material: &Material, angle: Radians| {
        let field = synthesize(material, TILE, 1);
        let surface = prepare(material, &field, &PEN, 0.18, angle, 1);
        rms(&simulate(&surface, at(0.1, 1.0), 1.0, 3).expect("valid stroke"))
    };
    let decibels = |material: &Material| 20.0 * (level(material, ALONG) / level(material, ACROSS)).log10();
    let brushed = Material { stretch: 30.0, ..plain() };
    // Above the roll-off, power falls as the elongation to the power of -2H, for heights and friction: by 18 to 21 dB.
    assert!(decibels(&brushed) < -10.0, "{} dB", decibels(&brushed));
    // Two strokes of a second over a random surface.
    assert!(decibels(&plain()).abs() < 3.0, "{} dB", decibels(&plain()));
}
