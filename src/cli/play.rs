//! `shagreen play`: drives an actuator with a texture.

use std::time::{Duration, Instant};

use anyhow::{Context as _, bail};
use serde_json::{Value, json};
use shagreen_core::space::texture_path::path_mix;
use shagreen_core::space::texture_path::{PrecomputedProgress, TexturePath};
use shagreen_core::texture::plane::Plane;
use shagreen_core::texture::render::synth_blend;
use shagreen_device::controls::Input;
use shagreen_device::engine::{FADE_SECS, Handle};
use shagreen_device::hand::{Hand, Path};
use shagreen_device::haptic_pen::sender::HapticReading;
use shagreen_device::haptic_pen::waveform::Waveform;
use shagreen_device::status::Status;
use shagreen_device::synth::renderer::{Mix, Parent};
use shagreen_device::synth::tap::Tap;
use shagreen_device::texture::OwnedTexture;
use shagreen_formats::library::Library;

use crate::cli::limiter_summary::LimiterSummary;
use crate::cli::motion::{Motion, MotionArgs, motion};
use crate::cli::output::{self, Printed};
use crate::cli::point::named_json;
use crate::cli::progress::{Progress, in_ms};
use crate::cli::rig::{Rig, RigArgs};
use crate::cli::target::SoundArgs;
use crate::cli::watch::Watch;
use shagreen_studio::sound::Sound;

/// Drives an actuator with a texture in real time, at constant speed and force or along a recorded stroke.
///
/// Defaults: speed 100 mm/s, force 1 N, duration 3 s.
#[derive(clap::Args)]
pub(crate) struct Args {
    #[command(flatten)]
    sound: SoundArgs,
    /// Random seed of the noise.
    #[arg(long, value_name = "N", default_value_t = 1)]
    seed: u64,
    /// Print the result as one JSON object.
    #[arg(long)]
    json: bool,
    #[command(flatten)]
    rig: RigArgs,
    #[command(flatten)]
    motion: MotionArgs,
}

/// Default speed in mm/s, force in N and duration in seconds.
const DEFAULT_MOTION: (f64, f64, f64) = (100.0, 1.0, 3.0);
/// Width of the circle of a steady contact, in m; it does not affect the texture.
const EXTENT_M: f32 = 0.06;
/// Interval at which the status of the output is read.
const POLL: Duration = Duration::from_millis(20);
/// The same interval until playback has begun.
const FIRST_POLL: Duration = Duration::from_millis(1);
/// Time that playback may take beyond the duration of the stroke.
const PATIENCE: Duration = Duration::from_secs(10);

pub(crate) fn run(args: &Args) -> anyhow::Result<()> {
    let motion = motion(&args.motion, Some(DEFAULT_MOTION))?;
    let (library, chosen) = args.sound.load()?;
    let Rig { mut handle, running, mut watch } =
        args.rig.open(chosen.rate(&library)?.0 as f32, args.seed).context("cannot play")?;
    chosen.note_limits(&library, &motion.trace(), &Printed);
    load_textures(&mut handle, &library, &chosen)?;
    let seconds = motion.seconds();
    let mut follow = chosen.path.as_ref().map(|path| Follow::new(path, &motion));
    handle.set_tap(chosen.tap.map_or(Tap::SILENT, Tap::from));
    let n_frames_before = handle.status().frames_played;
    start(&mut handle, motion)?;
    let status = wait(&mut handle, &mut watch, seconds, &mut |handle, secs| match &mut follow {
        Some(follow) => follow.go(handle, secs),
        None => Ok(()),
    })?;
    // A fade that does not end in time is cut off: the device has stopped.
    running.drain(PATIENCE);
    let limited = LimiterSummary::new(&status, n_frames_before, watch.heat_gain(), args.rig.has_actuator());
    limited.warnings().iter().for_each(|warning| output::warn(warning));
    let haptic = running.haptic_reading();
    if let Some(reading) = haptic {
        output::note(&approximation(reading));
    }
    output::print(
        args.json,
        &json!({
            "output": running.id(),
            "rate_hz": running.rate_hz(),
            "channels": running.channels(),
            "buffer_frames": running.buffer_frames(),
            "seconds": seconds,
            "underruns": status.underruns,
            "errors": status.backend_errors,
            "callback_load_max": status.load_max,
            "latency_ms": 1e3 * running.latency_secs(&status),
            "limited": limited.n_samples,
            "limited_share": limited.share,
            "heat_gain_min": limited.heat_gain,
            "heat_used": status.heat_used,
            "tripped": status.tripped,
            "parents": chosen.parents_json(&library),
            "at": chosen.at_json(),
            "at_named": named_json(&library, chosen.at),
            "clamped": chosen.clamped,
            "extrapolated": chosen.extrapolated,
            "shape": chosen.shape.text(),
            "haptic_pen": haptic.map(haptic_json),
        }),
        || {
            format!(
                "Played {seconds:.3} s of {} on {} at {} Hz: latency {:.1} ms, {} dropouts, processing load at most {:.0} %, samples limited: {}",
                chosen.parents_text(&library),
                running.id(),
                running.rate_hz(),
                1e3 * running.latency_secs(&status),
                status.underruns,
                100.0 * status.load_max,
                limited.in_words()
            )
        },
    );
    check(&status)
}

/// Says what a haptic pen has played instead of the texture.
fn approximation(reading: HapticReading) -> String {
    let played = reading.strongest.and_then(|play| Some((play.waveform?.name(), play.intensity_percent)));
    let played = played.map_or("nothing, because the texture is too weak".to_owned(), |(name, percent)| {
        format!("at its strongest \"{name}\" at {percent} %")
    });
    format!("a haptic pen plays an approximation by waveforms of its own: {played}")
}

fn haptic_json(reading: HapticReading) -> Value {
    json!({
        "waveform": reading.strongest.and_then(|play| play.waveform).map(Waveform::name),
        "intensity_percent": reading.strongest.map(|play| play.intensity_percent),
        "reports": reading.n_reports,
        "approximation": true,
    })
}

/// Returns an error if the limiter tripped: the rest of the output was then silent.
fn check(status: &Status) -> anyhow::Result<()> {
    if status.tripped {
        bail!(
            "a sample was not a finite number, so the output was silenced and playback is incomplete; \
             try another --full-scale or texture, and report this error"
        );
    }
    Ok(())
}

fn load_textures(handle: &mut Handle, library: &Library, chosen: &Sound) -> anyhow::Result<()> {
    if let Some(path) = &chosen.path {
        // Slots are assigned in order, so the number of a key is that of its texture.
        for key in path.keys() {
            let texture = OwnedTexture::new(Plane::new(&key.model).prepare().parts())?;
            handle.load(texture).context("the output accepts no texture; try again")?;
        }
        handle.set_mix(path_mix(path, 0.0))?;
        return Ok(());
    }
    let mut mix = Mix::silent(synth_blend(chosen.mixing));
    for (parent, (plane, weight)) in mix.parents.iter_mut().zip(chosen.planes(library, &Printed)?) {
        let texture = OwnedTexture::new(plane.prepare().parts())?;
        let id = handle.load(texture).context("the output accepts no texture; try again")?;
        *parent = Parent { id, weight: weight as f32 };
    }
    handle.set_mix(mix)?;
    Ok(())
}

fn start(handle: &mut Handle, motion: Motion) -> anyhow::Result<()> {
    match motion {
        Motion::Steady { contact, .. } => handle.set_input(Input::Hand(Hand {
            // Only a circle has constant speed.
            path: Path::Circle,
            speed_mps: contact.speed.0 as f32,
            force_n: contact.force.0 as f32,
            extent_m: EXTENT_M,
        })),
        Motion::Stroke { contacts, .. } => {
            if handle.play_track(contacts.into_track()?).is_err() {
                bail!("the output accepts no stroke; try again");
            }
        }
    }
    Ok(())
}

/// Follows a texture path during playback.
struct Follow<'a> {
    path: &'a TexturePath,
    ahead: PrecomputedProgress,
}

/// Integration step of the traveled distance, in seconds.
const FOLLOW_STEP_SECS: f64 = 0.005;

impl<'a> Follow<'a> {
    fn new(path: &'a TexturePath, motion: &Motion) -> Self {
        let mut contact_at = |secs| motion.contact_at(secs);
        let ahead =
            PrecomputedProgress::new(path.along(), motion.seconds(), FOLLOW_STEP_SECS, &mut contact_at);
        Self { path, ahead }
    }

    /// Sets the mix for the position reached `secs` after the start.
    fn go(&mut self, handle: &mut Handle, secs: f64) -> anyhow::Result<()> {
        Ok(handle.set_mix(path_mix(self.path, self.ahead.at(secs)))?)
    }
}

/// Waits until `seconds` have been played, then lifts the tip and waits for the fade. `at` is called with the elapsed
/// time of the motion.
fn wait(
    handle: &mut Handle,
    watch: &mut Watch,
    seconds: f64,
    at: &mut dyn FnMut(&mut Handle, f64) -> anyhow::Result<()>,
) -> anyhow::Result<Status> {
    let progress = Progress::new("playing", in_ms(seconds));
    let mut beginning = Beginning { frames_played: handle.status().frames_played, n_changes: 0 };
    let started = Instant::now();
    let deadline = Duration::from_secs_f64(seconds) + PATIENCE;
    loop {
        std::thread::sleep(if beginning.is_over() { POLL } else { FIRST_POLL });
        handle.collect();
        let status = watch.look(handle)?;
        beginning.note(status.frames_played);
        // Before the motion has begun, the input's clock is that of the tip in the air.
        if beginning.is_over() {
            progress.set_secs(status.input_secs.min(seconds));
            at(handle, status.input_secs)?;
            if status.input_secs >= seconds {
                break;
            }
        }
        if started.elapsed() > deadline {
            bail!("{} does not request samples; choose another output with `shagreen devices`", watch.what());
        }
    }
    handle.set_input(Input::Lifted);
    std::thread::sleep(Duration::from_secs_f64(3.0 * FADE_SECS));
    progress.finish();
    watch.look(handle)
}

/// Detects that the output has begun to play the input that was set before this was created.
///
/// The block being rendered at that time may still use the previous input; the next one does not.
struct Beginning {
    frames_played: u64,
    n_changes: u32,
}

impl Beginning {
    /// Records the number of frames that the output has played.
    fn note(&mut self, frames_played: u64) {
        if frames_played != self.frames_played {
            self.frames_played = frames_played;
            self.n_changes += 1;
        }
    }

    fn is_over(&self) -> bool {
        self.n_changes >= 2
    }
}

#[cfg(test)]
mod tests {
    use super::{Beginning, EXTENT_M, Hand, Input, Path, Status, Watch, check, wait};
    use shagreen_device::engine::{self, ChannelMask, EngineConfig};
    use shagreen_device::synth::drive::DriveConfig;
    use std::time::Duration;

    #[test]
    fn it_has_begun_when_a_second_block_has_been_played() {
        let mut beginning = Beginning { frames_played: 512, n_changes: 0 };
        for (frames_played, is_over) in
            [(512, false), (768, false), (768, false), (1024, true), (1024, true), (1280, true)]
        {
            beginning.note(frames_played);
            assert_eq!(beginning.is_over(), is_over, "{frames_played} frames");
        }
    }

    /// A device that has played one second with the tip in the air and requests its next block late.
    #[test]
    fn the_time_before_the_input_does_not_count() {
        let (mut handle, mut engine) = engine::new(EngineConfig {
            model_rate_hz: 1000.0,
            device_rate_hz: 48_000.0,
            seed: 1,
            drive: DriveConfig::proportional(20.0, 0.9),
            channels: ChannelMask::FIRST_TWO,
            friction: None,
        })
        .unwrap();
        engine.process(&mut vec![0.0; 48_000], 1);
        assert!(handle.status().input_secs > 0.5);
        handle.set_input(Input::Hand(Hand {
            path: Path::Circle,
            speed_mps: 0.1,
            force_n: 1.0,
            extent_m: EXTENT_M,
        }));
        let device = std::thread::spawn(move || {
            for _ in 0..4 {
                std::thread::sleep(Duration::from_millis(200));
                engine.process(&mut vec![0.0; 4800], 1);
            }
        });
        let status = wait(&mut handle, &mut Watch::new("x", None), 0.15, &mut |_, _| Ok(())).unwrap();
        // At least two blocks of 0.1 s.
        assert!(status.frames_played >= 48_000 + 2 * 4800, "{status:?}");
        drop(handle);
        device.join().unwrap();
    }

    #[test]
    fn a_tripped_limiter_is_a_failure() {
        assert!(check(&Status { limited_samples: 9, ..Status::default() }).is_ok());
        let error = check(&Status { tripped: true, ..Status::default() }).unwrap_err().to_string();
        assert!(error.contains("silenced") && !error.contains('\n'), "{error}");
    }
}
