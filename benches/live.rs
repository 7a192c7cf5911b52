//! Benchmark of rendering and re-blending.
//!
//! Prints one JSON line per measurement with CPU time per call, in the format of the peer scripts; `benches/run` runs
//! all in alternation.
//!
//! `SHAGREEN_BENCH_INPUTS` names a folder with `model_ar20.txt` and `traj_60s_1kHz.f32`, the inputs of the peers;
//! otherwise a starter library texture and a generated stroke are used.
#![allow(
    clippy::print_stdout,
    clippy::expect_used,
    reason = "a benchmark prints results and panics on errors"
)]

#[path = "common/measure.rs"]
mod measure;

use std::hint::black_box;
use std::path::Path;
use std::sync::Arc;
use std::time::Instant;

use measure::{bench, bench_noted};
use shagreen_core::dsp::ar::power_gain;
use shagreen_core::dsp::lsf::ar_from_lsf;
use shagreen_core::space::authoring::{Authoring, Layers, Models};
use shagreen_core::space::{Space, SpacePoint};
use shagreen_core::texture::blend::Mode;
use shagreen_core::texture::height_map::{HeightMap, HeightMapOptions};
use shagreen_core::texture::plane::{Plane, Prepared};
use shagreen_core::texture::profile::Profile;
use shagreen_core::texture::relief::Relief;
use shagreen_core::texture::stick_slip::StickSlip;
use shagreen_core::texture::{GrainNode, TextureModel};
use shagreen_core::units::{Hertz, MetersPerSecond, Newtons};
use shagreen_device::controls::Input;
use shagreen_device::engine::{self, ChannelMask, Engine, EngineConfig, Handle};
use shagreen_device::hand::{Hand, Path as HandPath};
use shagreen_device::texture::OwnedTexture;
use shagreen_device::touch::Touch;
use shagreen_formats::library::Library;
use shagreen_formats::starter::starter_library;
use shagreen_synth::budget::Budget;
use shagreen_synth::contact::{Contact, ContactSource, Place};
use shagreen_synth::direction::Direction;
use shagreen_synth::drive::{DriveConfig, Inverse};
use shagreen_synth::equalizer::Resonance;
use shagreen_synth::noise::{Gaussian, Noise};
use shagreen_synth::renderer::{Blend, Mix, Parent, Renderer, TextureId, Textures};
use shagreen_synth::stream::Stream;
use shagreen_synth::texture::Texture;
use shagreen_synth::voice::{MAX_TICK, Voice};

struct Table(Vec<Prepared>);

impl Textures for Table {
    fn texture(&self, id: TextureId) -> Option<Texture<'_>> {
        self.0.get(usize::from(id)).map(Prepared::view)
    }
}

/// A stroke trajectory sampled at 1 kHz.
struct Trajectory(Vec<Contact>);

impl ContactSource for Trajectory {
    fn contact_at(&mut self, time_secs: f64) -> Contact {
        let last = self.0.len() - 1;
        self.0[((time_secs * 1e3) as usize).min(last)]
    }
}

fn trajectory(inputs: Option<&Path>) -> Trajectory {
    let made_up = |i: u32| {
        let t = f64::from(i) * 1e-3;
        Contact {
            speed_mps: (0.2 * (2.0 * t).sin().abs()) as f32,
            force_n: (1.5 + 1.2 * (0.7 * t).sin()) as f32,
        }
    };
    Trajectory(match inputs {
        None => (0..60_000).map(made_up).collect(),
        Some(folder) => {
            let bytes = std::fs::read(folder.join("traj_60s_1kHz.f32")).expect("no traj_60s_1kHz.f32");
            let float = |b: &[u8]| f32::from_le_bytes([b[0], b[1], b[2], b[3]]);
            let contact = |b: &[u8]| Contact { speed_mps: 1e-3 * float(&b[..4]), force_n: float(&b[4..]) };
            bytes.chunks_exact(8).map(contact).collect()
        }
    })
}

/// The peers' texture of order 20: their measured models, with our boundary models.
fn peers_texture(folder: &Path) -> Prepared {
    let text = std::fs::read_to_string(folder.join("model_ar20.txt")).expect("cannot read model_ar20.txt");
    let numbers =
        |line: &str| -> Vec<f64> { line.split_whitespace().map(|w| w.parse().expect("no number")).collect() };
    let mut lines = text.lines();
    let head = numbers(lines.next().expect("model_ar20.txt is empty"));
    let models = lines.skip(head[1] as usize).map(numbers).filter(|m| m[0] > 0.0 && m[1] > 0.0 && m[2] > 0.0);
    let node = |m: Vec<f64>| GrainNode {
        speed: MetersPerSecond::from_mm_per_s(m[0]),
        force: Newtons(m[1]),
        level_mps2: (m[2] * power_gain(&ar_from_lsf(&m[4..]))).sqrt(),
        lsf: m[4..].to_vec(),
    };
    Plane::new(&TextureModel::new(Hertz(1000.0), models.map(node).collect(), None).expect("no texture model"))
        .prepare()
}

fn main() {
    let folder = std::env::var_os("SHAGREEN_BENCH_INPUTS").map(std::path::PathBuf::from);
    let library = starter_library().expect("no starter library");
    let planes: Vec<Plane> = library.textures.iter().map(|t| Plane::new(&t.model)).collect();
    let first = folder.as_deref().map_or_else(|| planes[0].prepare(), peers_texture);
    let mut strokes = trajectory(folder.as_deref());
    let n = strokes.0.len();

    let table = Table(vec![first]);
    let mut renderer = Renderer::new(1000.0, 7);
    let _ = renderer.set_mix(&Mix::solo(0));
    let mut tick = [0.0; MAX_TICK];
    bench("one texture, 1 kHz, coefficients every 5 ms", n as f64, "sample", || {
        for i in 0..n / renderer.tick_len() {
            renderer.tick(&table, strokes.0[i * 5], Place::default(), &mut tick);
            black_box(&tick);
        }
    });

    let mut stream = Stream::new(1000.0, 48_000.0, 7);
    stream.set_mix(Mix::solo(0));
    let mut block = [0.0; 256];
    bench("one texture, 48 kHz, blocks of 256", 48_000.0 * 20.0, "sample", || {
        for _ in 0..48_000 * 20 / 256 {
            stream.process(&table, &mut strokes, &mut block);
            black_box(&block);
        }
    });

    let prepared = Table(planes.iter().map(Plane::prepare).collect());
    let mut three = Mix::silent(Blend::Power);
    for (id, parent) in three.parents.iter_mut().enumerate() {
        *parent = Parent { id: id as TextureId, weight: 1.0 / 3.0 };
    }
    let mut mixed = Renderer::new(1000.0, 7);
    let _ = mixed.set_mix(&three);
    bench("three textures mixed, 1 kHz, coefficients every 5 ms", n as f64, "sample", || {
        for i in 0..n / mixed.tick_len() {
            mixed.tick(&prepared, strokes.0[i * 5], Place::default(), &mut tick);
            black_box(&tick);
        }
    });

    let gaussian = Gaussian::new();
    let mut many: Vec<(Voice, Noise, [u16; 2])> =
        (0..10_000).map(|seed| (Voice::new(), Noise::new(seed), [0; 2])).collect();
    let texture = table.0[0].view();
    bench(
        "10,000 voices for one second of 1 kHz, coefficients every 5 ms",
        10_000.0 * 1000.0,
        "sample",
        || {
            for i in 0..200 {
                for (voice, noise, hints) in &mut many {
                    let at = texture.evaluate(strokes.0[i * 5], Direction::UNKNOWN, hints);
                    voice.aim(texture.order(), &at);
                    let e: [f32; 5] = std::array::from_fn(|_| gaussian.draw(noise));
                    voice.add_tick(&e, (1.0, 1.0), &mut tick[..5]);
                }
            }
            black_box(&tick);
        },
    );

    by_order(&strokes);
    callback(&library);
    callback_with_layers(&library);
    reblending(&library, &planes);
}

/// Cost by predictor order, on the same stroke: the usual order at 1 kHz, the highest of earlier versions, and the orders
/// above it, whose loops are longer.
fn by_order(strokes: &Trajectory) {
    for order in [20_u32, 32, 48, 64] {
        let table = Table(vec![Plane::new(&resonant(order)).prepare()]);
        let mut renderer = Renderer::new(1000.0, 7);
        let _ = renderer.set_mix(&Mix::solo(0));
        let mut tick = [0.0; MAX_TICK];
        let n = strokes.0.len();
        bench(
            &format!("one texture of order {order}, 1 kHz, coefficients every 5 ms"),
            n as f64,
            "sample",
            || {
                for i in 0..n / renderer.tick_len() {
                    renderer.tick(&table, strokes.0[i * 5], Place::default(), &mut tick);
                    black_box(&tick);
                }
            },
        );
    }
}

/// A texture of this order with uneven frequencies, which change with speed and force.
fn resonant(order: u32) -> TextureModel {
    let node = |i: u32| {
        let (speed, force) = (f64::from(i % 4), f64::from(i / 4));
        let wave = |k: u32| 0.3 * (1.7 * f64::from(k) + 0.3 * speed + 0.2 * force).sin();
        let frequency = |k: u32| std::f64::consts::PI * (f64::from(k) + wave(k)) / f64::from(order + 1);
        GrainNode {
            speed: MetersPerSecond(0.05 * (1.0 + speed)),
            force: Newtons(0.5 * (1.0 + force)),
            lsf: (1..=order).map(frequency).collect(),
            level_mps2: 0.5 * (1.0 + speed),
        }
    };
    TextureModel::new(Hertz(1000.0), (0..16).map(node).collect(), None).expect("no texture model")
}

/// An engine with an actuator, its equalizer and its limits, that plays one texture.
fn playing(texture: &Prepared) -> (Handle, Engine) {
    let (mut handle, engine) = engine::new(EngineConfig {
        model_rate_hz: texture.parts().rate_hz,
        device_rate_hz: 48_000.0,
        seed: 1,
        drive: MARK_II,
        channels: ChannelMask::FIRST_TWO,
        friction: None,
    })
    .expect("no engine");
    let id = handle.load(OwnedTexture::new(texture.parts()).expect("invalid texture")).expect("no free slot");
    handle.set_mix(Mix::solo(id)).expect("texture not loaded");
    (handle, engine)
}

/// Cost of the audio callback: one field texture, an actuator with equalizer and thermal budget, and the limiter.
fn callback(library: &Library) {
    let space = Space::new(&library.positions()).expect("no starter space");
    let planes: Vec<Plane> = library.textures.iter().map(|t| Plane::new(&t.model)).collect();
    let layers: Vec<Option<Layers<'_>>> =
        library.textures.iter().zip(&planes).map(|(t, plane)| Some(Layers::of(&t.model, plane))).collect();
    let models = Models::new(&space, &layers).expect("textures differ in rate");
    let authoring = Authoring::new(space).with_models(Arc::new(models));
    let point = SpacePoint::plane(40.0, 60.0);
    let authored = authoring.author(point, &Mode::Field.into()).expect("no texture");
    let texture = Plane::new(&authored.model.expect("no model")).prepare();
    let (mut handle, mut engine) = playing(&texture);
    handle.set_input(Input::Hand(Hand {
        path: HandPath::Line,
        speed_mps: 0.1,
        force_n: 1.0,
        extent_m: 0.06,
    }));
    let mut block = [0.0; 2 * 128];
    let n_blocks = 48_000 * 20 / 128;
    bench(
        "callback: one authored texture, equalizer, budget, look-ahead, limiter; 48 kHz, 128 frames of two channels",
        f64::from(n_blocks) * 128.0,
        "frame",
        || {
            for _ in 0..n_blocks {
                engine.process(&mut block, 2);
                black_box(&block);
            }
        },
    );
    assert!(handle.status().level_mps2 > 0.0 && handle.status().peak > 0.0, "the output is silent");
}

/// A texture with every layer: grain across and along a rotated lay, relief, height map, friction that sticks, and a tap
/// transient.
fn layered(library: &Library) -> TextureModel {
    let model = library.textures[0].model.clone();
    let along =
        model.nodes().iter().map(|node| GrainNode { level_mps2: 0.5 * node.level_mps2, ..node.clone() });
    let along = along.collect();
    let n = 256_u32;
    let wave = |waves: u32, i: u32| (std::f64::consts::TAU * f64::from(waves * i) / f64::from(n)).sin();
    let heights_m = (0..n * n).map(|i| 5e-6 * wave(7, i % n) * wave(11, i / n) + 2e-6 * wave(40, i % n));
    let options = HeightMapOptions { speed_exponent: 1.5, ..HeightMapOptions::HARD_PLASTIC };
    let map = HeightMap::new(heights_m.collect(), 0.02, options).expect("no height map");
    let values = (0..4096).map(|i| 0.2 * wave(3, i)).collect();
    let relief =
        Relief::new(Profile::new(2e-5, values).expect("no profile"), Newtons(1.0)).expect("no relief");
    let stick_slip = StickSlip { static_ratio: 2.0, stribeck_speed: MetersPerSecond(0.05) };
    let model = model.with_along(Some(along)).expect("no grain along the lay");
    model
        .with_friction(Some(0.8))
        .expect("no friction")
        .with_stick_slip(Some(stick_slip))
        .with_height_map(Some(Arc::new(map)))
        .with_relief(Some(Arc::new(relief)))
        .with_turn_rad(0.3)
}

/// Cost of the audio callback with one texture that has every layer, under a hand that strokes in all directions and taps
/// every 40 ms. The note is the share of the time that a device allots to it.
fn callback_with_layers(library: &Library) {
    let model = layered(library);
    let (mut handle, mut engine) = playing(&Plane::new(&model).prepare());
    handle.set_tap(model.tap().expect("no tap transient").into());
    handle.set_input(Input::Live);
    let mut live = handle.take_live_input().expect("no live input");
    let mut block = [0.0; 2 * 128];
    let n_blocks = 48_000_u32 * 20 / 128;
    let n_frames = f64::from(n_blocks) * 128.0;
    bench_noted(
        "callback: one texture with grain across and along, relief, height map, stick-slip and taps; 48 kHz, 128 frames of two channels",
        n_frames,
        "frame",
        || {
            let begun = Instant::now();
            for i in 0..n_blocks {
                // On a circle of 20 mm at 50 mm/s, in the air for every 15th block.
                let (sin, cos) = (0.0133 * i as f32).sin_cos();
                let is_down = i % 15 != 14;
                let contact = Contact { speed_mps: 0.05, force_n: if is_down { 1.0 } else { 0.0 } };
                let touch = Touch { x_m: 0.01 * cos, y_m: 0.01 * sin, contact };
                live.land(touch, Instant::now(), Some(0.1)).expect("the queue of touches is full");
                engine.process(&mut block, 2);
                black_box(&block);
            }
            let share = begun.elapsed().as_secs_f64() / (n_frames / 48_000.0);
            format!("{:.2} % of the time allotted", 100.0 * share)
        },
    );
    assert!(handle.status().level_mps2 > 0.0 && handle.status().peak > 0.0, "the output is silent");
}

/// Haptuator Mark II on a 100 g load, with a 5 V amplifier.
const MARK_II: DriveConfig = DriveConfig {
    inverse: Some(Inverse {
        resonance: Resonance { frequency_hz: 65.0, q: 4.086, gain_mps2_per_volt: 2.134 },
        lowest_hz: 20.0,
    }),
    full_scale: 5.0,
    ceiling: 0.9,
    look_ahead_secs: 0.002,
    budget: Some(Budget { rms: 0.282, time_secs: 10.0 }),
};

/// Cost of a drag step on the window's thread.
fn reblending(library: &Library, planes: &[Plane]) {
    let authoring = Authoring::new(Space::new(&library.positions()).expect("no starter space"));
    let n_drags = 10_000;
    bench("re-blend after a drag: parents, weights, mix", f64::from(n_drags), "drag", || {
        for i in 0..n_drags {
            let t = f64::from(i) * 1e-3;
            let point = SpacePoint::plane(50.0 + 45.0 * (1.9 * t).sin(), 50.0 + 45.0 * (3.0 * t).cos());
            let authored = authoring.author(point, &Mode::Shared.into()).expect("no texture");
            let mut mix = Mix::silent(Blend::Power);
            for ((texture, weight), parent) in authored.parents.iter().zip(&mut mix.parents) {
                *parent = Parent { id: *texture as TextureId, weight: *weight as f32 };
            }
            black_box(mix);
        }
    });
    // Worst case: a drag into a triangle of three textures that no output has loaded yet.
    let prepared: Vec<Prepared> = planes.iter().map(Plane::prepare).collect();
    let n_textures = planes.len();
    bench(
        "re-blend into three new textures, prepared in advance as in the window",
        n_textures as f64 / 3.0,
        "drag",
        || {
            let (mut handle, _engine) = engine::new(EngineConfig {
                model_rate_hz: 1000.0,
                device_rate_hz: 48_000.0,
                seed: 1,
                drive: DriveConfig::proportional(20.0, 0.9),
                channels: ChannelMask::FIRST_TWO,
                friction: None,
            })
            .expect("no engine");
            for three in prepared.chunks(3) {
                let mut mix = Mix::solo(0);
                for (texture, parent) in three.iter().zip(&mut mix.parents) {
                    let id =
                        handle.load(OwnedTexture::new(texture.parts()).expect("no texture")).expect("full");
                    *parent = Parent { id, weight: 1.0 / 3.0 };
                }
                handle.set_mix(mix).expect("textures not loaded");
            }
        },
    );
    bench("preparing a new texture", planes.len() as f64, "texture", || {
        for plane in planes {
            black_box(plane.prepare());
        }
    });
}
