//! `shagreen texture psd`: the spectrum that a texture's model has at one speed and force.

use anyhow::Context as _;
use serde_json::json;
use shagreen_core::ar::comparison_frequencies;
use shagreen_core::blend::mixture_psd;
use shagreen_core::fidelity::mixture_level_mps2;
use shagreen_core::plane::Plane;
use shagreen_core::units::{Contact, Hertz};
use shagreen_formats::thresholds::ThresholdKind;

use crate::cli::motion::quantity;
use crate::cli::near_names::unknown_texture;
use crate::cli::output;
use crate::cli::target::SoundArgs;
use crate::cli::words::words;

/// The one-sided power spectral density of a texture's model, in (m/s²)²/Hz, from 5 Hz to just below half its rate.
#[derive(clap::Args)]
pub(crate) struct Args {
    #[command(flatten)]
    sound: SoundArgs,
    /// Speed of the tip, in mm/s.
    #[arg(long, value_name = "V", value_parser = quantity)]
    speed: f64,
    /// Normal force of the tip, in N.
    #[arg(long, value_name = "F", value_parser = quantity)]
    force: f64,
    /// Number of frequencies.
    #[arg(long, value_name = "N", default_value_t = 256, value_parser = clap::value_parser!(u32).range(2..=65_536))]
    bins: u32,
    /// What the level is told in multiples of: the least that is felt by a hand that holds a tool, or by skin on a large
    /// contactor. Approximate curves.
    #[arg(long, value_name = "THRESHOLD", value_parser = words(ThresholdKind::ALL, ThresholdKind::id),
        default_value = ThresholdKind::default().id())]
    threshold: ThresholdKind,
    /// Leave this texture out of the library first: what is authored at its place without it?
    #[arg(long, value_name = "ID")]
    without: Option<String>,
    /// Print one JSON object.
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
            "this texture changes along a path of {n_keys} textures; the spectrum is that of its beginning"
        ));
    }
    let rate = chosen.rate(&library)?;
    let contact = Contact::from_mm_per_s_and_n(args.speed, args.force);
    let planes = chosen.planes(&library)?;
    let parents: Vec<(&Plane, f64)> = planes.iter().map(|(plane, weight)| (plane, *weight)).collect();
    let frequencies = comparison_frequencies(rate, args.bins as usize);
    let psd = mixture_psd(&parents, chosen.mixing, contact, &frequencies);
    let rms = mixture_level_mps2(&parents, chosen.mixing, contact);
    let pairs: Vec<(Hertz, f64)> = frequencies.iter().copied().zip(psd.iter().copied()).collect();
    let multiple = args.threshold.read()?.multiple(&pairs);
    if planes.iter().any(|(plane, _)| plane.relief().is_some()) {
        output::note("the texture has a relief, which depends on the place: this is the noise over it alone");
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
            "begins_path": chosen.path.is_some(),
        }),
        || {
            let lines = hz.iter().zip(&psd).map(|(hz, psd)| format!("{hz:.2}\t{psd:.6e}\n"));
            let parents = chosen.parents_text(&library);
            format!(
                "# {parents}: rms {rms:.4} m/s², {multiple:.1} times the threshold ({})\n# Hz\t(m/s²)²/Hz\n{}",
                args.threshold.id(),
                lines.collect::<String>().trim_end()
            )
        },
    );
    Ok(())
}
