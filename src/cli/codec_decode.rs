//! `shagreen codec decode`: a stream becomes a signal.

use std::path::PathBuf;
use std::sync::Arc;

use anyhow::{Context as _, anyhow};
use serde_json::json;
use shagreen_core::codec::CODEC_RATE;
use shagreen_core::spectrum::rms;
use shagreen_core::words::counted;
use shagreen_formats::codec_stream::read_stream;
use shagreen_formats::codec_tables::built_in_codebooks;
use shagreen_formats::wav::{SidecarV1, sidecar_path, write_wav};

use crate::cli::guard::{is_sidecar, refuse_foreign, refuse_inputs};
use crate::cli::output;

/// Decodes a stream of `codec encode` to a float WAV in m/s² at 2000 Hz, with a sidecar. How near it is to the signal that was
/// encoded, `quality` tells.
///
/// What is damaged or was lost is filled in, and said; nothing gets louder than the stream says that its signal was.
#[derive(clap::Args)]
pub(crate) struct Args {
    /// The stream.
    #[arg(value_name = "IN.shgc")]
    stream: PathBuf,
    /// Signal to write; its units go into OUT.json.
    #[arg(short, long, value_name = "OUT.wav")]
    out: PathBuf,
    /// Print one JSON object.
    #[arg(long)]
    json: bool,
}

pub(crate) fn run(args: &Args) -> anyhow::Result<()> {
    let beside = sidecar_path(&args.out);
    refuse_inputs(&[&args.out, &beside], &[Some(&args.stream)])?;
    refuse_foreign(&beside, "the sidecar", is_sidecar)?;
    let bytes = output::read_file(&args.stream)?;
    let read = read_stream(&bytes).with_context(|| output::in_file(&args.stream))?;
    for warning in &read.warnings {
        output::warn(&format!("{}: {warning}", output::file_name(&args.stream)));
    }
    let coded = read.value;
    if coded.n_samples == 0 {
        return Err(anyhow!("nothing of the signal is there; get the stream anew"))
            .with_context(|| output::in_file(&args.stream));
    }
    let samples: Vec<f32> =
        coded.decode(&Arc::new(built_in_codebooks()?)).into_iter().map(|x| x as f32).collect();
    let sidecar = SidecarV1::new(CODEC_RATE.0 as u32, coded.seconds(), 0, output::CREATED_BY);
    write_wav(&args.out, &samples, &sidecar)?;
    let n_lost = coded.frames.iter().filter(|frame| frame.is_none()).count();
    let (kbps, frames, seconds) = (coded.rate.kbps(), coded.frames.len(), coded.seconds());
    let felt: Vec<f64> = samples.iter().map(|x| f64::from(*x)).collect();
    let peak = felt.iter().fold(0.0_f64, |most, x| most.max(x.abs()));
    output::print(
        args.json,
        &json!({
            "out": args.out.display().to_string(),
            "kbps": kbps,
            "frames": frames,
            "bits": coded.n_bits(),
            "lost_frames": n_lost,
            "warnings": read.warnings,
            "seconds": seconds,
            "rate_hz": CODEC_RATE.0,
            "rms": rms(&felt),
            "peak": peak,
            "limit": coded.limit_mps2,
        }),
        || {
            format!(
                "{seconds:.2} s of {} at {kbps} kbit/s, {n_lost} of them filled in: {}",
                counted(frames, "frame"),
                args.out.display()
            )
        },
    );
    Ok(())
}
