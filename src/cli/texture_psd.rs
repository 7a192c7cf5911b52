//! `shagreen texture psd`: computes the power spectral density (PSD) of a texture's model at one speed and force.

use anyhow::Context as _;
use serde_json::json;
use shagreen_core::dsp::ar::comparison_frequencies;
use shagreen_core::space::fidelity::mixture_level_mps2;
use shagreen_core::texture::blend::mixture_psd;
use shagreen_core::texture::plane::Plane;
use shagreen_core::units::{Contact, Hertz};
use shagreen_formats::thresholds::ThresholdKind;

use crate::cli::output::{self, Printed};
use crate::cli::quantity::{force, speed};
use crate::cli::target::SoundArgs;
use crate::cli::words::words;
use shagreen_studio::near_names::unknown_texture;

/// Computes the one-sided power spectral density (PSD) of a texture's model, in (m/s²)²/Hz, from 5 Hz to just below
/// half the model rate.
#[derive(clap::Args)]
pub(crate) struct Args {
    #[command(flatten)]
    sound: SoundArgs,
    /// Tip speed, in mm/s.
    #[arg(long, value_name = "V", value_parser = speed)]
    speed: f64,
    /// Normal force, in N.
    #[arg(long, value_name = "F", value_parser = force)]
    force: f64,
    /// Number of frequencies.
    #[arg(long, value_name = "N", default_value_t = 256, value_parser = clap::value_parser!(u32).range(2..=65_536))]
    bins: u32,
    /// Detection threshold that the level is compared with: held-tool for vibration felt through a held tool, pacinian
    /// or composite for bare skin on a large contactor. The curves are approximate.
    #[arg(long, value_name = "THRESHOLD", value_parser = words(ThresholdKind::ALL, ThresholdKind::id),
        default_value = ThresholdKind::default().id())]
    threshold: ThresholdKind,
    /// Remove this texture from the library first, for example to see which texture is interpolated at its position
    /// without it.
    #[arg(long, value_name = "ID")]
    without: Option<String>,
    /// Print the result as one JSON object.
    #[arg(long)]
    json: bool,
}

pub(crate) fn run(args: &Args) -> anyhow::Result<()> {
    let mut textures = args.sound.load_textures()?;
    if let Some(id) = &args.without {
        let library = &mut textures.library;
        let index = library.index_of(id).with_context(|| unknown_texture(library, id))?;
        library.textures.remove(index);
    }
    let chosen = args.sound.choose(&textures)?;
    let library = textures.library;
    if let Some(path) = &chosen.path {
        let n_keys = path.keys().len();
        output::note(&format!(
            "this texture changes along a path of {n_keys} textures; the PSD is that of its start"
        ));
    }
    let rate = chosen.rate(&library)?;
    let contact = Contact::from_mm_per_s_and_n(args.speed, args.force);
    let planes = chosen.planes(&library, &Printed)?;
    let parents: Vec<(&Plane, f64)> = planes.iter().map(|(plane, weight)| (plane, *weight)).collect();
    let frequencies = comparison_frequencies(rate, args.bins as usize);
    let psd = mixture_psd(&parents, chosen.mixing, contact, &frequencies);
    let rms = mixture_level_mps2(&parents, chosen.mixing, contact);
    let pairs: Vec<(Hertz, f64)> = frequencies.iter().copied().zip(psd.iter().copied()).collect();
    let multiple = args.threshold.read()?.multiple(&pairs);
    if planes.iter().any(|(plane, _)| plane.relief().is_some()) {
        output::note(
            "the texture has a relief, which depends on position; the PSD is that of its noise alone",
        );
    }
    let hz: Vec<f64> = frequencies.iter().map(|frequency| frequency.0).collect();
    output::print(
        args.json,
        &json!({
            "hz": hz,
            "psd": psd,
            "rms": rms,
            "times_threshold": multiple,
            "threshold": args.threshold.id(),
            "rate_hz": rate.0,
            "parents": chosen.parents_json(&library),
            "at": chosen.at_json(),
            "clamped": chosen.clamped,
            "extrapolated": chosen.extrapolated,
            "blend": chosen.mode.id(),
            "shape": chosen.shape_text(),
            "begins_path": chosen.path.is_some(),
        }),
        || {
            let lines = hz.iter().zip(&psd).map(|(hz, psd)| format!("{hz:.2}\t{psd:.6e}\n"));
            let parents = chosen.parents_text(&library);
            format!(
                "# {parents}: rms {rms:.4} m/s², {multiple:.1} times the detection threshold ({})\n# Hz\t(m/s²)²/Hz\n{}",
                args.threshold.id(),
                lines.collect::<String>().trim_end()
            )
        },
    );
    Ok(())
}
