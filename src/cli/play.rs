//! `shagreen play`: drives an actuator with a texture.

use std::time::{Duration, Instant};

use anyhow::{Context as _, bail};
use serde_json::json;
use shagreen_core::render::synth_blend;
use shagreen_device::controls::Input;
use shagreen_device::engine::{ChannelMask, FADE_SECS, Handle};
use shagreen_device::hand::{Hand, Path};
use shagreen_device::output::{NULL_ID, OpenOptions, UNCALIBRATED_FULL_SCALE_MPS2, USUAL_CEILING, open};
use shagreen_device::status::{LinkState, Status};
use shagreen_device::synth::renderer::{Mix, Parent};
use shagreen_device::texture::OwnedTexture;
use shagreen_formats::library::Library;

use crate::cli::library_source::{LibraryArgs, load};
use crate::cli::motion::{Motion, MotionArgs, motion, quantity};
use crate::cli::output::{self, Progress};
use crate::cli::target::{BlendArgs, Chosen, TargetArgs, choose};

/// Drives an actuator with a texture, in real time: a steady contact, or a recorded stroke.
#[derive(clap::Args)]
pub(crate) struct Args {
    #[command(flatten)]
    target: TargetArgs,
    #[command(flatten)]
    library: LibraryArgs,
    #[command(flatten)]
    blend: BlendArgs,
    /// Output to play on, by its id; `shagreen devices` lists them. Without it the silent one: no output is ever
    /// guessed, since actuator drive does not belong in someone's headphones.
    #[arg(long, value_name = "ID", default_value = NULL_ID)]
    output: String,
    /// Acceleration at which the output is at full scale, in m/s².
    #[arg(long, value_name = "A", value_parser = quantity, default_value_t = f64::from(UNCALIBRATED_FULL_SCALE_MPS2))]
    full_scale: f64,
    /// Frames a block to ask the output for: fewer are faster and harder to keep up with.
    #[arg(long, value_name = "N")]
    buffer: Option<u32>,
    /// Seed of the noise.
    #[arg(long, value_name = "N", default_value_t = 1)]
    seed: u64,
    /// Print one JSON object.
    #[arg(long)]
    json: bool,
    #[command(flatten)]
    motion: MotionArgs,
}

/// Speed in mm/s, force in N and length in seconds where none are given.
const DEFAULT_MOTION: (f64, f64, f64) = (100.0, 1.0, 3.0);
/// Width of the path of a steady contact: it says nothing about what is felt.
const EXTENT_M: f32 = 0.06;
/// How often the output is asked how it is doing.
const POLL: Duration = Duration::from_millis(20);
/// How much longer than the stroke playing may take.
const PATIENCE: Duration = Duration::from_secs(10);

pub(crate) fn run(args: &Args) -> anyhow::Result<()> {
    let motion = motion(&args.motion, Some(DEFAULT_MOTION))?;
    let library = load(&args.library)?;
    let chosen = choose(&library, &args.target, &args.blend)?;
    let options = OpenOptions {
        model_rate_hz: chosen.rate(&library)?.0 as f32,
        preferred_rate_hz: None,
        buffer_frames: args.buffer,
        seed: args.seed,
        full_scale_mps2: args.full_scale as f32,
        ceiling: USUAL_CEILING,
        channels: ChannelMask::FIRST_TWO,
    };
    let (mut handle, running) = open(&args.output, options).context("cannot play")?;
    load_textures(&mut handle, &library, &chosen)?;
    let seconds = motion.seconds();
    start(&mut handle, motion)?;
    let status = wait(&mut handle, seconds)?;
    output::print(
        args.json,
        &json!({
            "output": running.id(),
            "rate_hz": running.rate_hz(),
            "channels": running.channels(),
            "buffer_frames": running.buffer_frames(),
            "seconds": seconds,
            "underruns": status.underruns,
            "callback_load_max": status.load_max,
            "latency_ms": 1e3 * running.latency_secs(),
            "limited": status.limited_samples,
            "tripped": status.tripped,
            "parents": chosen.parents_json(&library),
            "at": chosen.at_json(),
            "clamped": chosen.clamped,
        }),
        || {
            format!(
                "Played {seconds:.3} s of {} on {} at {} Hz: latency {:.1} ms, {} underruns, load at most {:.0} %, {} samples limited",
                chosen.parents_text(&library),
                running.id(),
                running.rate_hz(),
                1e3 * running.latency_secs(),
                status.underruns,
                100.0 * status.load_max,
                status.limited_samples
            )
        },
    );
    Ok(())
}

fn load_textures(handle: &mut Handle, library: &Library, chosen: &Chosen) -> anyhow::Result<()> {
    let mut mix = Mix { blend: synth_blend(chosen.mode), ..Mix::default() };
    for (parent, (plane, weight)) in mix.parents.iter_mut().zip(chosen.planes(library)) {
        let p = plane.prepare();
        let texture = OwnedTexture::new(
            p.rate_hz,
            p.order,
            p.speed_max_mps,
            p.force_max_n,
            p.nodes.into(),
            p.triangles.into(),
        )?;
        let id = handle.load(texture).context("the output takes no texture; try again")?;
        *parent = Parent { id, weight: weight as f32 };
    }
    handle.set_mix(mix)?;
    Ok(())
}

fn start(handle: &mut Handle, motion: Motion) -> anyhow::Result<()> {
    match motion {
        Motion::Steady { contact, .. } => handle.set_input(Input::Hand(Hand {
            // Only a circle keeps its speed all the way.
            path: Path::Circle,
            speed_mps: contact.speed.0 as f32,
            force_n: contact.force.0 as f32,
            extent_m: EXTENT_M,
        })),
        Motion::Stroke { contacts, .. } => {
            if handle.play_track(contacts.into_track()?).is_err() {
                bail!("the output takes no stroke; try again");
            }
        }
    }
    Ok(())
}

/// Waits until so much has been played, then lifts the tip and lets it fade.
fn wait(handle: &mut Handle, seconds: f64) -> anyhow::Result<Status> {
    let progress = Progress::new("ms played", (1e3 * seconds) as usize);
    let started = Instant::now();
    let deadline = Duration::from_secs_f64(seconds) + PATIENCE;
    loop {
        std::thread::sleep(POLL);
        handle.collect();
        let status = handle.status();
        progress.set((1e3 * status.input_secs.min(seconds)) as usize);
        if status.state == LinkState::Lost {
            progress.finish();
            return Err(match handle.loss() {
                Some(loss) => anyhow::Error::new(loss.clone()).context("the output was lost"),
                None => anyhow::anyhow!("the output was lost; look for it with `shagreen devices`"),
            });
        }
        if status.input_secs >= seconds && status.frames_played > 0 {
            break;
        }
        if started.elapsed() > deadline {
            progress.finish();
            bail!("the output does not ask for samples; choose another with `shagreen devices`");
        }
    }
    handle.set_input(Input::Lifted);
    std::thread::sleep(Duration::from_secs_f64(3.0 * FADE_SECS));
    progress.finish();
    Ok(handle.status())
}
