//! `shagreen render`: renders a texture to a WAV file.

use std::path::PathBuf;

use anyhow::{Context as _, bail};
use serde_json::json;
use shagreen_core::space::LabelSource;
use shagreen_core::texture::render::Hand;
use shagreen_core::texture::tap::TAP_AMPLITUDES_MPS2;
use shagreen_core::units::{Contact, Hertz};
use shagreen_device::track::MAX_TRACK_SECS;
use shagreen_formats::library::Library;
use shagreen_formats::named_point::named_coordinates;
use shagreen_formats::wav::{self, ParentV1, SidecarV1, sidecar_path, write_wav_as};
use shagreen_formats::wav_encoding::{Level, SampleType, WavEncoding};
use shagreen_studio::export::{Rendered, lost_in_wav, lost_of_tap};
use shagreen_studio::levels::{Levels, WINDOW_SECS, contact_level, levels};
use shagreen_studio::render::{SEAM_SECS, SampleFormat, render_along, render_mixture};
use shagreen_studio::report::Reporter as _;

use crate::cli::motion::{Motion, MotionArgs, motion};
use crate::cli::output::{self, Printed};
use crate::cli::point::named_json;
use crate::cli::progress::{Progress, in_ms};
use crate::cli::target::SoundArgs;
use crate::cli::wav_name::check_wav_name;
use crate::cli::words::words;
use shagreen_studio::replace::{refuse_foreign_signal, refuse_signal_over_inputs};
use shagreen_studio::sound::Sound;
use shagreen_studio::tap_transients::{AddedTaps, add_tap_transients};

/// Renders the acceleration of a texture at the tip of a tool to a mono WAV file of 32-bit floats in m/s², with a
/// sidecar file (.json) that describes it.
///
/// Each landing in a recorded stroke adds a tap transient if the texture has one, as in playback.
#[derive(clap::Args)]
pub(crate) struct Args {
    #[command(flatten)]
    sound: SoundArgs,
    /// Sample rate of the output, in Hz. Default: the rate of the texture's model.
    #[arg(long, value_name = "HZ", value_parser = clap::value_parser!(u32).range(1..))]
    rate: Option<u32>,
    /// Random seed of the noise; the same seed gives the same samples.
    #[arg(long, value_name = "N", default_value_t = 1)]
    seed: u64,
    /// Type of the samples: 32-bit floats, or integers of 24 or 16 bits.
    #[arg(long, value_name = "BITS", default_value = "32", value_parser = words(SampleType::ALL, bits_word))]
    bits: SampleType,
    /// Scale the signal so that its peak is 1 dB below full scale, for players that clip; the sidecar states the
    /// acceleration at full scale. Integers are always scaled.
    #[arg(long)]
    normalize: bool,
    /// Make a loop: the end goes on into the beginning without a click.
    #[arg(long = "loop", conflicts_with = "stroke")]
    loops: bool,
    /// WAV file to write; its sidecar has the same name with .json.
    #[arg(short, long, value_name = "OUT.wav")]
    out: PathBuf,
    /// Print the result as one JSON object.
    #[arg(long)]
    json: bool,
    #[command(flatten)]
    motion: MotionArgs,
}

pub(crate) fn run(args: &Args) -> anyhow::Result<()> {
    check_wav_name(&args.out)?;
    let motion = motion(&args.motion, None)?;
    let (library, chosen) = args.sound.load()?;
    let rate_hz = match args.rate {
        Some(rate_hz) => rate_hz,
        None => whole(chosen.rate(&library)?)?,
    };
    let beside = sidecar_path(&args.out);
    refuse_signal_over_inputs(&args.out, &[motion.stroke_path(), args.sound.library_path()])?;
    refuse_foreign_signal(&args.out)?;
    wav::check_length((motion.seconds() * f64::from(rate_hz)).round() as u64)?;
    chosen.note_limits(&library, &motion.trace(), &Printed);
    let mut samples = samples(args, &library, &chosen, &motion, rate_hz)?;
    if samples.is_empty() {
        bail!("{} s at {rate_hz} Hz contain no sample; choose a longer duration", motion.seconds());
    }
    let sidecar = sidecar(args, &library, &chosen, &motion, rate_hz);
    let seconds = samples.len() as f64 / f64::from(rate_hz);
    let follows_stroke = motion.stroke_path().is_some();
    // Before the tap transients, which would hide the level of everything else.
    let contact_rms = contact_level(&samples, rate_hz, |secs| motion.contact_at(secs).force.0 > 0.0);
    let taps = add_taps(&mut samples, &library, &chosen, motion, rate_hz)?;
    let Levels { rms, peak } = levels(&samples);
    let level = if args.normalize { Level::Peak } else { Level::Kept };
    let encoding = WavEncoding { samples: args.bits, level };
    let full_scale = encoding.full_scale(&samples);
    write_wav_as(&args.out, &samples, &sidecar, encoding)?;
    if full_scale == 1.0 && peak > 1.0 {
        Printed.note("players clip what exceeds 1 m/s²; --normalize scales the signal for them");
    }
    let texture = chosen.texture.as_deref().and_then(|id| library.index_of(id));
    let rendered = Rendered {
        texture: texture.map(|index| &library.textures[index]),
        tap: chosen.tap,
        rate: Hertz(f64::from(rate_hz)),
        follows_stroke,
    };
    if let Some(lost) = lost_of_tap(rendered) {
        Printed.note(&format!("not stored in the file: {lost}"));
    }
    output::print(
        args.json,
        &json!({
            "out": args.out.display().to_string(),
            "sidecar": beside.display().to_string(),
            "rms": rms,
            "peak": peak,
            "peak_landing_s": taps.peak_landing_secs,
            "contact_rms_median": contact_rms,
            "full_scale": full_scale,
            "rate_hz": rate_hz,
            "seconds": seconds,
            "parents": chosen.parents_json(&library),
            "at": chosen.at_json(),
            "at_named": named_json(&library, chosen.at),
            "clamped": chosen.clamped,
            "extrapolated": chosen.extrapolated,
            "blend": chosen.mode.id(),
            "shape": chosen.shape.text(),
            "seed": args.seed,
            "lost": lost_in_wav(rendered),
        }),
        || {
            format!(
                "Rendered {seconds:.3} s at {rate_hz} Hz of {}: rms {rms:.4} m/s², peak {peak:.4} m/s²{}{}\n{}\n{}",
                chosen.parents_text(&library),
                taps.peak_landing_secs.map_or(String::new(), |secs| format!(" at a landing at {secs:.2} s")),
                contact_text(contact_rms.filter(|_| follows_stroke)),
                args.out.display(),
                beside.display()
            )
        },
    );
    Ok(())
}

/// Adds the tap transients of a recorded stroke, and notes those that are limited.
fn add_taps(
    samples: &mut [f32],
    library: &Library,
    chosen: &Sound,
    motion: Motion,
    rate_hz: u32,
) -> anyhow::Result<AddedTaps> {
    let (Motion::Stroke { contacts, .. }, Some(tap)) = (motion, chosen.tap) else {
        return Ok(AddedTaps::default());
    };
    let model_rate_hz = chosen.rate(library)?.0;
    let taps = add_tap_transients(samples, rate_hz, model_rate_hz, contacts.into_track()?, tap.into())?;
    if taps.n_limited > 0 {
        Printed.note(&format!(
            "{} so fast that the tap transient would exceed {} m/s²; it is limited to this value",
            counted_landings(taps.n_limited),
            TAP_AMPLITUDES_MPS2.end()
        ));
    }
    Ok(taps)
}

fn counted_landings(n: usize) -> String {
    if n == 1 { "1 landing is".to_owned() } else { format!("{n} landings are") }
}

/// Returns the level of the texture without its tap transients, as text.
fn contact_text(contact_rms: Option<f64>) -> String {
    contact_rms.map_or(String::new(), |rms| {
        format!("; median rms of {WINDOW_SECS} s in contact, without taps: {rms:.4} m/s²")
    })
}

fn bits_word(of: SampleType) -> &'static str {
    match of {
        SampleType::Float32 => "32",
        SampleType::Pcm24 => "24",
        SampleType::Pcm16 => "16",
    }
}

/// Returns a rate as a whole number, as WAV files need it.
fn whole(rate: Hertz) -> anyhow::Result<u32> {
    if rate.0.fract() == 0.0 {
        Ok(rate.0 as u32)
    } else {
        bail!("the model's rate of {rate} is not a whole number; choose a rate with --rate")
    }
}

/// Motion that shows its progress.
struct Watched<'a> {
    motion: &'a Motion,
    progress: Progress,
}

impl Hand for Watched<'_> {
    fn contact_at(&mut self, time_secs: f64) -> Contact {
        self.progress.set_secs(time_secs);
        self.motion.contact_at(time_secs)
    }

    fn place_m_at(&mut self, time_secs: f64) -> Option<[f64; 2]> {
        self.motion.place_m_at(time_secs)
    }
}

fn samples(
    args: &Args,
    library: &Library,
    chosen: &Sound,
    motion: &Motion,
    rate_hz: u32,
) -> anyhow::Result<Vec<f32>> {
    let mut hand = Watched { motion, progress: Progress::new("rendering", in_ms(motion.seconds())) };
    if args.loops && motion.seconds() > MAX_TRACK_SECS - SEAM_SECS {
        bail!("a loop lasts at most {} s; choose a shorter duration", MAX_TRACK_SECS - SEAM_SECS);
    }
    let format = SampleFormat {
        rate: Hertz(f64::from(rate_hz)),
        seconds: motion.seconds(),
        seed: args.seed,
        loops: args.loops,
    };
    if let Some(path) = &chosen.path {
        return render_along(path, format, &mut hand)
            .context("the path cannot be rendered with these options");
    }
    let voices = chosen.planes(library, &Printed)?;
    render_mixture(&voices, chosen.mixing, format, &mut hand)
        .context("the texture cannot be rendered with these options")
}

fn sidecar(args: &Args, library: &Library, chosen: &Sound, motion: &Motion, rate_hz: u32) -> SidecarV1 {
    let parent = |(index, weight): &(usize, f64)| ParentV1::new(library, *index, *weight);
    SidecarV1 {
        texture: chosen.texture.clone(),
        at: chosen.at_json(),
        at_named: chosen.at.map(|at| named_coordinates(library.axis_names(), at)),
        clamped: chosen.clamped,
        extrapolated: chosen.extrapolated,
        blend: chosen.mode.id().to_owned(),
        shape: chosen.shape.text(),
        parents: chosen.parents.iter().map(parent).collect(),
        library: library.name.clone(),
        label_source: library.label_source().map(|source| LabelSource::id(source).to_owned()),
        // The file name only: a redistributed file must not reveal the names of folders.
        stroke: motion
            .stroke_path()
            .and_then(|path| path.file_name())
            .map(|name| name.to_string_lossy().into_owned()),
        trace: motion.trace(),
        ..SidecarV1::new(rate_hz, motion.seconds(), args.seed, output::CREATED_BY)
    }
}
