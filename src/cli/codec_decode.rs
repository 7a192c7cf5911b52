//! `shagreen codec decode`: decodes a codec stream to a signal.

use std::path::PathBuf;
use std::sync::Arc;

use anyhow::{Context as _, anyhow};
use serde_json::json;
use shagreen_core::dsp::spectrum::rms;
use shagreen_core::signals::codec::CODEC_RATE;
use shagreen_core::words::counted;
use shagreen_formats::bounded_file::FileKind;
use shagreen_formats::codec_stream::read_stream;
use shagreen_formats::codec_tables::built_in_codebooks;
use shagreen_formats::wav::{SidecarV1, write_wav};

use crate::cli::output;
use crate::cli::progress::Progress;
use crate::cli::wav_name::check_wav_name;
use shagreen_studio::file;
use shagreen_studio::replace::{refuse_foreign_signal, refuse_signal_over_inputs};

/// Decodes a stream of `codec encode` to a WAV file of 32-bit floats in m/s² at 2000 Hz, with a sidecar file (.json).
/// `quality` compares it with the original signal.
///
/// Damaged and missing frames are concealed and reported. The output never exceeds the peak of the original signal,
/// which the stream contains.
#[derive(clap::Args)]
pub(crate) struct Args {
    /// Codec stream to decode.
    #[arg(value_name = "IN.shgc")]
    stream: PathBuf,
    /// WAV file to write; the sidecar OUT.json states its units.
    #[arg(short, long, value_name = "OUT.wav")]
    out: PathBuf,
    /// Print the result as one JSON object.
    #[arg(long)]
    json: bool,
}

pub(crate) fn run(args: &Args) -> anyhow::Result<()> {
    check_wav_name(&args.out)?;
    refuse_signal_over_inputs(&args.out, &[Some(&args.stream)])?;
    refuse_foreign_signal(&args.out)?;
    let progress = Progress::endless("decoding the stream");
    let bytes = file::read_file(&args.stream, FileKind::Recording)?;
    let read = read_stream(&bytes).with_context(|| file::in_file(&args.stream))?;
    for warning in &read.warnings {
        output::warn(&format!("{}: {warning}", file::file_name(&args.stream)));
    }
    let coded = read.value;
    if coded.n_samples == 0 {
        return Err(anyhow!("the stream contains no samples; encode the signal again"))
            .with_context(|| file::in_file(&args.stream));
    }
    let samples: Vec<f32> =
        coded.decode(&Arc::new(built_in_codebooks()?)).into_iter().map(|x| x as f32).collect();
    let sidecar = SidecarV1::new(CODEC_RATE.0 as u32, coded.seconds(), 0, output::CREATED_BY);
    write_wav(&args.out, &samples, &sidecar)?;
    progress.finish();
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
                "Decoded {seconds:.2} s from {} at {kbps} kbit/s, {n_lost} of them concealed: {}",
                counted(frames, "frame"),
                args.out.display()
            )
        },
    );
    Ok(())
}
