//! `shagreen codec encode`: encodes a signal to a codec stream.

use std::path::PathBuf;
use std::sync::Arc;

use anyhow::Context as _;
use serde_json::json;
use shagreen_core::signals::codec::bitrate::Bitrate;
use shagreen_core::signals::codec::coded::Coded;
use shagreen_core::signals::codec::{CODEC_RATE, DELAY_SAMPLES};
use shagreen_core::signals::quality::snr_db;
use shagreen_core::words::counted;
use shagreen_formats::atomic;
use shagreen_formats::codec_stream::{is_stream, write_stream};
use shagreen_formats::codec_tables::built_in_codebooks;

use crate::cli::output;
use crate::cli::progress::Progress;
use crate::cli::signal_source::SignalArgs;
use shagreen_studio::file;
use shagreen_studio::replace::{refuse_foreign, refuse_inputs};

/// Encodes a texture signal at 1.75 to 3.15 kbit/s; 16-bit samples at 2000 Hz need 32 kbit/s.
///
/// The signal is a WAV file in m/s². Frequencies above 1000 Hz are removed; they lie above the range of vibrotactile
/// perception. The codec works in frames of 20 ms with an algorithmic delay of 35 ms. The file has a checksum every
/// 160 ms.
#[derive(clap::Args)]
pub(crate) struct Args {
    /// Signal to encode, as a WAV file.
    #[arg(value_name = "IN.wav")]
    signal: PathBuf,
    /// Codec stream to write.
    #[arg(short, long, value_name = "OUT.shgc")]
    out: PathBuf,
    /// Bit rate in kbit/s: 3.15, 2.75, 2.45, 2.15 or 1.75.
    #[arg(long, value_name = "KBPS", value_parser = kbps, default_value = "3.15")]
    kbps: Bitrate,
    #[command(flatten)]
    signals: SignalArgs,
    /// Print the result as one JSON object.
    #[arg(long)]
    json: bool,
}

/// Signal-to-noise ratio in dB below which a warning is printed.
const LEAST_SNR_DB: f64 = 2.0;

/// Parses one of the bit rates, in kbit/s.
pub(crate) fn kbps(text: &str) -> Result<Bitrate, String> {
    let found = text
        .trim()
        .parse::<f64>()
        .ok()
        .and_then(|kbps| Bitrate::ALL.into_iter().find(|rate| (rate.kbps() - kbps).abs() < 1e-9));
    found.ok_or_else(|| {
        let all = Bitrate::ALL.map(|rate| rate.kbps().to_string());
        format!("it must be one of {} kbit/s", all.join(", "))
    })
}

pub(crate) fn run(args: &Args) -> anyhow::Result<()> {
    refuse_inputs(&[&args.out], &[Some(&args.signal)])?;
    refuse_foreign(&args.out, "the stream", is_stream)?;
    let progress = Progress::endless("encoding the signal");
    let signal = args.signals.load_at(&args.signal, CODEC_RATE)?;
    let books = Arc::new(built_in_codebooks()?);
    let coded = Coded::encode(&signal, args.kbps, &books).with_context(|| file::in_file(&args.signal))?;
    let bytes = write_stream(&coded).with_context(|| file::in_file(&args.signal))?;
    let snr = snr_db(&signal, &coded.decode(&books));
    if snr < LEAST_SNR_DB {
        output::warn(&format!(
            "the signal-to-noise ratio is below {LEAST_SNR_DB} dB: the codec is designed for continuous vibration, not for single impacts"
        ));
    }
    atomic::write(&args.out, &bytes)?;
    progress.finish();
    let (kbps, frames, bits, seconds) =
        (args.kbps.kbps(), coded.frames.len(), coded.n_bits(), coded.seconds());
    let delay_ms = 1e3 * DELAY_SAMPLES as f64 / CODEC_RATE.0;
    output::print(
        args.json,
        &json!({
            "out": args.out.display().to_string(),
            "kbps": kbps,
            "frames": frames,
            "bits": bits,
            // Infinite for identical signals.
            "snr_db": snr.is_finite().then_some(snr),
            "bytes": bytes.len(),
            "seconds": seconds,
            "delay_ms": delay_ms,
        }),
        || {
            format!(
                "Encoded {seconds:.2} s in {} at {kbps} kbit/s, {bits} bits ({} bytes with header and checksums); signal-to-noise ratio {}: {}",
                counted(frames, "frame"),
                bytes.len(),
                if snr.is_finite() { format!("{snr:.1} dB") } else { "infinite".to_owned() },
                args.out.display()
            )
        },
    );
    Ok(())
}
