//! Silence after lift-off, and bounds on the output, for any texture, tap transient and actuator.

use proptest::prelude::{ProptestConfig, prop, prop_assert, proptest};
use shagreen_synth::drive::{DriveConfig, Inverse};
use shagreen_synth::equalizer::Resonance;
use shagreen_synth::renderer::Mix;
use shagreen_synth::tap::Tap;

use super::{CONFIG, play};
use crate::controls::Input;
use crate::engine::{EngineConfig, new};
use crate::texture::tests::with_lsf;
use crate::track::{PenSample, Track};

/// Longest time from lift-off to silence that users are promised, in seconds.
const PROMISED_SECS: f64 = 0.3;
const LIFT_SECS: f64 = 0.4;

/// Stroke that touches from 0.1 s to [`LIFT_SECS`].
fn stroke() -> Track {
    let sample = |i: u32| {
        let time_secs = f64::from(i) * 0.01;
        let touching = i >= 10 && time_secs < LIFT_SECS;
        PenSample {
            time_secs,
            x_m: 0.3 * time_secs,
            y_m: 0.0,
            force_n: if touching { 1.0 } else { 0.0 },
            touching,
        }
    };
    Track::new(&(0..150).map(sample).collect::<Vec<_>>()).unwrap()
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 48, ..ProptestConfig::default() })]

    #[test]
    fn everything_is_silent_soon_after_lift_off(
        mut gaps in prop::collection::vec(1e-4_f32..1.0, 4..=33),
        model_rate_hz in 200.0_f32..4000.0,
        level in 0.0_f32..1e6,
        tap in (0.0_f32..3000.0, -10.0_f32..1e3, -1e30_f32..1e30),
        coil in (30.0_f64..300.0, 0.5_f64..3000.0, 0.01_f64..30.0),
    ) {
        let sum: f32 = gaps.iter().sum();
        for gap in &mut gaps {
            *gap *= std::f32::consts::PI / sum;
        }
        let lsf: Vec<f32> = gaps[..gaps.len() - 1]
            .iter()
            .scan(0.0, |at, gap| { *at += gap; Some(*at) })
            .collect();
        let (frequency_hz, q, lowest_hz) = coil;
        let inverse = Inverse { resonance: Resonance { frequency_hz, q, gain_mps2_per_volt: 1.0 }, lowest_hz };
        let drive = DriveConfig { inverse: Some(inverse), look_ahead_secs: 0.002, ..DriveConfig::proportional(5.0, 0.9) };
        let (mut handle, mut engine) = new(EngineConfig { model_rate_hz, drive, ..CONFIG }).unwrap();
        let Ok(texture) = with_lsf(model_rate_hz, level, &lsf) else { return Ok(()) };
        let id = handle.load(texture).unwrap();
        handle.set_mix(Mix::solo(id)).unwrap();
        handle.set_tap(Tap { frequency_hz: tap.0, decay_per_sec: tap.1, amplitude_mps2: tap.2 });
        handle.play_track(stroke()).unwrap();
        let out = play(&mut engine, 72_000, 256);
        prop_assert!(out.iter().all(|x| x.abs() <= 0.9), "above the ceiling, or not finite");
        let begun = out.iter().position(|x| *x != 0.0);
        let silent = ((LIFT_SECS + PROMISED_SECS) * 48_000.0) as usize;
        prop_assert!(out[silent..].iter().all(|x| *x == 0.0));
        prop_assert!(begun.is_none_or(|frame| frame > 3000), "before contact");
    }
}

/// Negative control: while the tip touches, the same texture sounds on.
#[test]
fn a_texture_sounds_on_while_the_tip_touches() {
    let (mut handle, mut engine) = new(CONFIG).unwrap();
    let id = handle.load(with_lsf(1000.0, 1.0, &[0.5, 0.51, 2.0]).unwrap()).unwrap();
    handle.set_mix(Mix::solo(id)).unwrap();
    handle.set_input(Input::Hand(super::HAND));
    let out = play(&mut engine, 96_000, 256);
    assert!(out[90_000..].iter().any(|x| x.abs() > 0.01));
}
