//! Haptic pens as outputs: the reports for authored textures are those that the rule prescribes.

use shagreen_core::space::SpacePoint;
use shagreen_core::space::authoring::Blending;
use shagreen_core::texture::render::synth_blend;
use shagreen_core::texture::shape::Shape;
use shagreen_device::controls::Input;
use shagreen_device::engine::{self, ChannelMask, EngineConfig};
use shagreen_device::hand::{Hand, Path};
use shagreen_device::haptic_pen::pen::HapticPen;
use shagreen_device::haptic_pen::simulated::{Got, SimulatedPen};
use shagreen_device::haptic_pen::translator::Translator;
use shagreen_device::synth::drive::DriveConfig;
use shagreen_device::synth::renderer::{Mix, Parent};
use shagreen_device::texture::OwnedTexture;
use shagreen_formats::library::Library;
use shagreen_formats::starter::starter_library;
use shagreen_studio::report::Warnings;
use shagreen_studio::sound::Sound;

use crate::support::Bench;

const RATE_HZ: u32 = 8000;
/// Frames of a window of 50 ms.
const WINDOW: usize = 400;
/// Ten authored textures, by their points.
const POINTS: [[f64; 2]; 10] = [
    [20.0, 20.0],
    [50.0, 20.0],
    [80.0, 20.0],
    [15.0, 50.0],
    [35.0, 45.0],
    [60.0, 50.0],
    [85.0, 50.0],
    [30.0, 70.0],
    [50.0, 80.0],
    [70.0, 75.0],
];
/// The continuous waveforms of the simulated pen by the ordinals in its reports, with the frequencies that the guide
/// states, in Hz.
const OFFERED: [(u8, f64); 4] = [(7, 80.0), (6, 146.0), (4, 266.0), (5, 359.0)];
/// Octaves of the hysteresis, and the tolerance for rounding errors between two waveforms that are equally near.
const HYSTERESIS: f64 = 0.25;
const TOLERANCE_OCTAVES: f64 = 1e-3;

/// Renders 0.8 s of an authored texture at 100 mm/s and 1 N as a share of 20 m/s².
fn drive(library: &Library, point: [f64; 2]) -> Vec<f32> {
    let point = SpacePoint::of(&point).unwrap();
    let reporter = Warnings::default();
    let sound =
        Sound::of_point(library, point, (&Blending::default(), &Shape::default()), &reporter).unwrap();
    let (mut handle, mut engine) = engine::new(EngineConfig {
        model_rate_hz: sound.rate(library).unwrap().0 as f32,
        device_rate_hz: RATE_HZ as f32,
        seed: 1,
        drive: DriveConfig::proportional(20.0, 0.9),
        channels: ChannelMask::FIRST_TWO,
        friction: None,
    })
    .unwrap();
    let mut mix = Mix::silent(synth_blend(sound.mixing));
    for (parent, (plane, weight)) in mix.parents.iter_mut().zip(sound.planes(library, &reporter).unwrap()) {
        let id = handle.load(OwnedTexture::new(plane.prepare().parts()).unwrap()).unwrap();
        *parent = Parent { id, weight: weight as f32 };
    }
    handle.set_mix(mix).unwrap();
    handle.set_input(Input::Hand(Hand { path: Path::Circle, speed_mps: 0.1, force_n: 1.0, extent_m: 0.06 }));
    let mut signal = vec![0.0; 16 * WINDOW];
    for block in signal.chunks_mut(64) {
        engine.process(block, 1);
    }
    signal
}

/// Intensity in percent and frequency in Hz of a window as the guide defines them; `before` is the sample before it.
fn measured(window: &[f32], before: f32) -> (f64, f64) {
    let samples: Vec<f64> = std::iter::once(&before).chain(window).map(|x| f64::from(*x)).collect();
    let energy = |values: &[f64]| values.iter().map(|x| x * x).sum::<f64>();
    let steps: Vec<f64> = samples.windows(2).map(|pair| pair[1] - pair[0]).collect();
    let (squares, squared_steps) = (energy(&samples[1..]), energy(&steps));
    let rms = (squares / window.len() as f64).sqrt();
    let ratio = if squares > 0.0 { (squared_steps / squares).sqrt() } else { 0.0 };
    let frequency_hz = f64::from(RATE_HZ) / std::f64::consts::PI * (0.5 * ratio).min(1.0).asin();
    (100.0 * (rms / 0.25).min(1.0), frequency_hz)
}

#[test]
fn ten_authored_textures_have_the_reports_that_the_rule_prescribes() {
    let library = starter_library().unwrap();
    let mut ordinals = Vec::new();
    for point in POINTS {
        let signal = drive(&library, point);
        let simulated = SimulatedPen::listing();
        let mut pen = HapticPen::open(Box::new(simulated.clone()), "test").unwrap();
        let waveforms: Vec<_> = pen.waveforms().collect();
        let mut translator = Translator::new(RATE_HZ, waveforms.iter().copied());
        let mut present: Option<u8> = None;
        let mut n_playing = 0;
        let mut before = 0.0;
        for (index, window) in signal.chunks(WINDOW).enumerate() {
            let n_before = simulated.got().len();
            pen.play(translator.process(window, 1).unwrap()).unwrap();
            let got = simulated.got().split_off(n_before);
            let (percent, frequency_hz) =
                measured(window, std::mem::replace(&mut before, window[WINDOW - 1]));
            let place = format!("{point:?}, window {index}: {got:?}, {percent} %, {frequency_hz} Hz");
            match got.as_slice() {
                // The automatic trigger plays the waveform while the tip touches.
                [Got::Feature(report)] => {
                    let [7, intensity, 0, ordinal] = report[..] else { panic!("{place}") };
                    assert!((f64::from(intensity) - percent).abs() <= 0.6, "{place}");
                    let octaves = |(_, hz): &(u8, f64)| (frequency_hz / hz).log2().abs();
                    let nearest = OFFERED.iter().map(octaves).fold(f64::INFINITY, f64::min);
                    let chosen = octaves(OFFERED.iter().find(|(offered, _)| *offered == ordinal).unwrap());
                    let allowed = if present == Some(ordinal) { HYSTERESIS } else { 0.0 };
                    assert!(chosen <= nearest + allowed + TOLERANCE_OCTAVES, "{place}");
                    present = Some(ordinal);
                    n_playing += 1;
                    ordinals.push(ordinal);
                }
                [Got::Output(report)] => {
                    // The tap at the beginning.
                    assert!(matches!(report[..], [7, _, 0, 3]) && present.is_none(), "{place}");
                }
                // Silence: no waveform for a touching tip, and a stop.
                [Got::Feature(none), Got::Output(stop)] => {
                    assert_eq!((&none[..], &stop[..]), (&[7, 0, 0, 1][..], &[7, 0, 0, 2][..]), "{place}");
                    assert!(percent <= 0.6, "{place}");
                    present = None;
                }
                _ => panic!("{place}"),
            }
        }
        assert!(n_playing >= 10, "{point:?} plays in {n_playing} windows only");
    }
    ordinals.sort_unstable();
    ordinals.dedup();
    assert!(ordinals.len() > 1, "all textures have the same waveform: {ordinals:?}");
}

#[test]
fn the_simulated_pen_is_an_output_that_says_that_it_approximates() {
    let bench = Bench::new();
    let said = bench.run("play --at 30,70 --seconds 0.4 --output haptic:simulated --json");
    assert_eq!(said.code, 0, "{}", said.stderr);
    assert!(said.stderr.contains("approximation"), "{}", said.stderr);
    let played: serde_json::Value = serde_json::from_str(&said.stdout).unwrap();
    let pen = &played["haptic_pen"];
    assert!(pen["reports"].as_u64().unwrap() > 3, "{played}");
    assert!(pen["waveform"].as_str().is_some() && pen["intensity_percent"].as_u64().unwrap() > 0, "{played}");
    assert_eq!(pen["approximation"], true);
    let silent = bench.json("play --at 30,70 --seconds 0.1 --output null");
    assert!(silent["haptic_pen"].is_null());
    for actuator in ["haptuator-mark-ii", "dualsense"] {
        bench.fails(
            &format!("play --at 30,70 --seconds 0.1 --output haptic:simulated --actuator {actuator}"),
            1,
            &["plays waveforms of its own", "leave --actuator out"],
        );
    }
    assert!(bench.run("devices").stdout.contains("haptic:simulated  Simulated haptic pen"));
    bench.fails("play --at 30,70 --output haptic:none", 1, &["there is no output"]);
}
