//! `shagreen latency`: measures the latency from a pen report to the recorded output signal.

use std::time::{Duration, Instant};

use anyhow::{Context as _, bail};
use serde_json::{Value, json};
use shagreen_core::texture::plane::Plane;
use shagreen_device::audio_input::Recorder;
use shagreen_device::controls::Input;
use shagreen_device::engine::Handle;
use shagreen_device::hid::live::{PenOptions, PenThread};
use shagreen_device::hid::replay::{PLAIN_PEN, REPLAY_ID, ReplayBus, ReplayedReport, plain_report};
use shagreen_device::hid::tracker::TrackerOptions;
use shagreen_device::kinematics::SpeedFilter;
use shagreen_device::pressure::PressureMap;
use shagreen_device::status::{LinkState, STROKE_BUDGET_SECS, TAP_BUDGET_SECS};
use shagreen_device::synth::renderer::Mix;
use shagreen_device::synth::tap::Tap;
use shagreen_device::texture::OwnedTexture;
use shagreen_formats::starter::starter_library;

use crate::cli::latency_onsets::{STROKE_SECS, quantile, stroke_onset, tap_onset};
use crate::cli::output;
use crate::cli::progress::{Progress, in_ms};
use crate::cli::rig::{Rig, RigArgs};

/// Measures the latency from a pen report to the output signal: replays simulated pen reports through the same
/// processing as a real pen, records the output, and compares the times.
///
/// The input must record the output: through a cable, an accelerometer on the actuator, or the monitor of the output,
/// which `shagreen devices` marks with "(monitor of ID)". A monitor does not contain the delay of the sound card. If
/// another input does not report its own latency, the results include it.
#[derive(clap::Args)]
pub(crate) struct Args {
    #[command(flatten)]
    rig: RigArgs,
    /// Input that records the output, by id; `shagreen devices` lists them.
    #[arg(long, value_name = "ID")]
    input: String,
    /// Channel of the input, counted from 1.
    #[arg(long, value_name = "N", default_value_t = 1, value_parser = clap::value_parser!(u16).range(1..=64))]
    input_channel: u16,
    /// Number of taps to measure, and number of strokes.
    #[arg(long, value_name = "N", default_value_t = 20, value_parser = clap::value_parser!(u16).range(1..=1000))]
    strokes: u16,
    /// Report rate of the replayed pen, in Hz.
    #[arg(long, value_name = "HZ", default_value_t = 133.0, value_parser = report_rate)]
    report_rate: f64,
    /// Print the result as one JSON object.
    #[arg(long)]
    json: bool,
}

/// Texture of the strokes; a rough one gives a strong signal.
const TEXTURE: &str = "sandpaper-p100";
/// Speed of the strokes in mm/s, and their pressure, 0..1.
const STROKE: (f64, f64) = (150.0, 0.6);
/// Time with the tip in the air after each stroke, in seconds.
const AIR_SECS: f64 = 0.4;
/// Smallest fraction of the taps, or of the strokes, that must be detected: fewer are not representative.
const LEAST_HEARD: f64 = 0.5;

fn report_rate(text: &str) -> Result<f64, String> {
    match text.parse::<f64>() {
        Ok(hz) if (20.0..=2000.0).contains(&hz) => Ok(hz),
        _ => Err("it must be a number from 20 to 2000".to_owned()),
    }
}

pub(crate) fn run(args: &Args) -> anyhow::Result<()> {
    // Taps and strokes are measured separately, so that neither masks the other.
    let taps = measure(args, true)?;
    let strokes = measure(args, false)?;
    let told = |measured: &Measured, budget_secs: f32| {
        let secs = &measured.latency_secs;
        json!({
            "n": secs.len(),
            "median_ms": 1e3 * quantile(secs, 0.5),
            "p95_ms": 1e3 * quantile(secs, 0.95),
            "max_ms": 1e3 * quantile(secs, 1.0),
            "budget_ms": (1e3 * f64::from(budget_secs)).round(),
            "told_ms": 1e3 * measured.told_secs,
            "missed": measured.n_missed,
        })
    };
    let (taps, strokes) = (told(&taps, TAP_BUDGET_SECS), told(&strokes, STROKE_BUDGET_SECS));
    let number = |of: &Value, field: &str| of[field].as_f64().unwrap_or(f64::NAN);
    for (what, of) in [("strokes", &strokes), ("taps", &taps)] {
        let (median, budget) = (number(of, "median_ms"), number(of, "budget_ms"));
        if median > budget {
            output::warn(&format!(
                "{what} have a median latency of {median:.1} ms, above the limit of {budget:.0} ms; use a smaller --buffer or another output"
            ));
        }
    }
    output::print(
        args.json,
        &json!({"strokes": strokes, "taps": taps, "report_rate_hz": args.report_rate}),
        || {
            let line = |what: &str, of: &Value| {
                format!(
                    "{what}: median {:.1} ms (n = {}, {} missed), 95th percentile {:.1} ms; estimated by the program: {:.1} ms",
                    number(of, "median_ms"),
                    of["n"],
                    of["missed"],
                    number(of, "p95_ms"),
                    number(of, "told_ms")
                )
            };
            format!(
                "Latency from the pen report to the recorded output signal\n{}\n{}",
                line("Strokes, to half the final level", &strokes),
                line("Tap transients, to the first sample", &taps)
            )
        },
    );
    Ok(())
}

/// Result of a measurement.
struct Measured {
    latency_secs: Vec<f64>,
    n_missed: usize,
    /// Latency that the engine reports for the same contacts, in seconds.
    told_secs: f64,
}

fn measure(args: &Args, with_taps: bool) -> anyhow::Result<Measured> {
    let library = starter_library()?;
    let index =
        library.index_of(TEXTURE).context("the starter library has no sandpaper; reinstall Shagreen")?;
    let model = &library.textures[index].model;
    let Rig { mut handle, running: _running, mut watch } =
        args.rig.open(model.rate().0 as f32, 1).context("cannot measure")?;
    let rate_hz = handle.config().device_rate_hz;
    let mut recorder = Recorder::open(&args.input, usize::from(args.input_channel) - 1, rate_hz as u32)
        .context("cannot measure")?;
    if with_taps {
        let amplitude_mps2 = 0.5 * handle.config().drive.full_scale_mps2();
        handle.set_tap(Tap { frequency_hz: 250.0, decay_per_sec: 100.0, amplitude_mps2 });
    } else {
        let id = handle.load(OwnedTexture::new(Plane::new(model).prepare().parts())?)?;
        handle.set_mix(Mix::solo(id))?;
    }
    handle.set_input(Input::Live);
    let mut heard = Vec::new();
    begin(&mut handle, &mut recorder, &mut heard)?;

    let (reports, landings) = strokes(args, with_taps);
    let seconds = reports.last().map_or(0.0, |report| report.secs) + AIR_SECS;
    let (bus, came) = ReplayBus::new(PLAIN_PEN.to_vec(), reports);
    let tracking = TrackerOptions { speed_filter: SpeedFilter::KALMAN, pressure_map: PressureMap::USUAL };
    let options = PenOptions { id: REPLAY_ID.to_owned(), tracking, size_m: None };
    let pen = PenThread::start(bus, options, handle.take_live_input())?;
    let progress = Progress::new("measuring the latency", in_ms(seconds));
    let begun = Instant::now();
    while begun.elapsed().as_secs_f64() < seconds {
        std::thread::sleep(Duration::from_millis(10));
        recorder.read(&mut heard);
        recorder.check()?;
        handle.collect();
        watch.look(&mut handle)?;
        progress.set_secs(begun.elapsed().as_secs_f64());
    }
    progress.finish();
    drop(pen);
    let latency = handle.status().latency;
    let rate = f64::from(recorder.rate_hz());
    let mut latency_secs = Vec::new();
    for (_, at) in came.try_iter().filter(|(i, _)| landings.contains(i)) {
        let index = recorder.sample_index_at(at).context("the input has delivered no samples")?.max(0.0);
        let begin = index as usize;
        let found =
            if with_taps { tap_onset(&heard, begin, rate) } else { stroke_onset(&heard, begin, rate) };
        latency_secs.extend(found.map(|samples| (samples as f64 - index.fract()) / rate));
    }
    let what = if with_taps { "taps" } else { "strokes" };
    let n = usize::from(args.strokes);
    refuse_few(latency_secs.len(), n, what, &args.input)?;
    latency_secs.sort_by(f64::total_cmp);
    let told = if with_taps { latency.tap_secs } else { latency.stroke_secs };
    let n_missed = n - latency_secs.len();
    Ok(Measured { latency_secs, n_missed, told_secs: f64::from(told) })
}

/// Returns an error if too few onsets were detected for a representative result.
fn refuse_few(n_heard: usize, n: usize, what: &str, input: &str) -> anyhow::Result<()> {
    let advice = "connect the input to the output, raise the input level, or choose another input or channel";
    if n_heard == 0 {
        bail!("the input `{input}` records nothing of the output: {advice}");
    }
    if (n_heard as f64) < LEAST_HEARD * n as f64 {
        bail!("the input `{input}` records only {n_heard} of {n} {what}, too few for a result: {advice}");
    }
    Ok(())
}

/// Waits until output and input run, then records a moment of silence.
fn begin(handle: &mut Handle, recorder: &mut Recorder, heard: &mut Vec<f32>) -> anyhow::Result<()> {
    let begun = Instant::now();
    while handle.status().state != LinkState::Running || heard.is_empty() {
        if begun.elapsed() > Duration::from_secs(10) {
            bail!("the output or the input does not start; check them with `shagreen devices`");
        }
        std::thread::sleep(Duration::from_millis(10));
        recorder.read(heard);
    }
    std::thread::sleep(Duration::from_millis(300));
    Ok(())
}

/// Returns the reports of all strokes, and the indices of those that begin a contact. The intervals between strokes
/// vary, so that contacts fall anywhere in a block.
fn strokes(args: &Args, with_taps: bool) -> (Vec<ReplayedReport>, Vec<usize>) {
    let (speed_mm_per_s, pressure) = STROKE;
    let (mut reports, mut landings) = (Vec::new(), Vec::new());
    let mut begin_secs = 0.3;
    for i in 0..args.strokes {
        let n = (STROKE_SECS * args.report_rate) as u32;
        landings.push(reports.len());
        for k in 0..n {
            let secs = f64::from(k) / args.report_rate;
            let x_mm = 10.0 + if with_taps { 0.0 } else { speed_mm_per_s * secs };
            reports.push(ReplayedReport {
                secs: begin_secs + secs,
                bytes: plain_report(x_mm, 50.0, pressure, true),
            });
        }
        reports.push(ReplayedReport {
            secs: begin_secs + STROKE_SECS,
            bytes: plain_report(10.0, 50.0, 0.0, false),
        });
        begin_secs += STROKE_SECS + AIR_SECS + 0.0013 * f64::from(i % 7);
    }
    (reports, landings)
}

#[cfg(test)]
mod tests {
    use super::refuse_few;

    #[test]
    fn too_few_onsets_are_errors() {
        for (n_heard, n, words) in [
            (20, 20, None),
            (10, 20, None),
            (1, 1, None),
            (9, 20, Some("9 of 20 taps")),
            (0, 1, Some("nothing")),
        ] {
            match (refuse_few(n_heard, n, "taps", "x"), words) {
                (Ok(()), None) => {}
                (Err(error), Some(words)) => assert!(error.to_string().contains(words), "{error}"),
                other => panic!("{n_heard} of {n}: {other:?}"),
            }
        }
    }
}
