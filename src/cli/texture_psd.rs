//! `shagreen texture psd`: computes the power spectral density (PSD) of a texture's model at one speed and force.

use serde_json::json;
use shagreen_core::dsp::ar::comparison_frequencies;
use shagreen_core::dsp::threshold::Threshold;
use shagreen_core::space::fidelity::mixture_level_toward_mps2;
use shagreen_core::texture::blend::mixture_psd_toward;
use shagreen_core::texture::plane::Plane;
use shagreen_core::texture::steady_stick_slip::{SteadyStickSlip, steady_stick_slip};
use shagreen_core::units::{Contact, Hertz, Radians};
use shagreen_core::words::two_digits;
use shagreen_formats::library::Library;
use shagreen_formats::thresholds::ThresholdKind;

use crate::cli::output::{self, Printed};
use crate::cli::point::named_json;
use crate::cli::quantity::{force, speed};
use crate::cli::target::SoundArgs;
use crate::cli::words::words;
use shagreen_studio::sound::Sound;
use shagreen_studio::trace::steady_trace;

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
    /// Direction of the stroke on the pad, in degrees counterclockwise from the right; it matters for a texture that
    /// differs over direction. Default: to the right, as `render` moves with --speed.
    #[arg(long, value_name = "DEGREES", value_parser = degrees, default_value_t = 0.0, allow_hyphen_values = true,
        hide_default_value = true)]
    direction: f64,
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
    let (library, chosen) = args.sound.load_without(args.without.as_deref())?;
    if let Some(path) = &chosen.path {
        let n_keys = path.keys().len();
        output::note(&format!(
            "this texture changes along a path of {n_keys} textures; the PSD is that of its start"
        ));
    }
    let rate = chosen.rate(&library)?;
    let contact = Contact::from_mm_per_s_and_n(args.speed, args.force);
    chosen.note_limits(&library, &steady_trace(contact, 0.0), &Printed);
    let planes = chosen.planes(&library, &Printed)?;
    let parents: Vec<(&Plane, f64)> = planes.iter().map(|(plane, weight)| (plane, *weight)).collect();
    let frequencies = comparison_frequencies(rate, args.bins as usize);
    let direction = Radians::from_degrees(args.direction);
    let density = |at: &[Hertz]| mixture_psd_toward(&parents, chosen.mixing, contact, direction, at);
    let psd = density(&frequencies);
    let rms = mixture_level_toward_mps2(&parents, chosen.mixing, contact, direction);
    let is_directional = planes.iter().any(|(plane, _)| plane.along().is_some());
    let stick_slip = steady_stick_slip(&parents, contact);
    let threshold = args.threshold.read()?;
    let multiple = if let Some(stick_slip) = &stick_slip {
        multiple_with(&threshold, stick_slip, density)
    } else {
        let pairs: Vec<(Hertz, f64)> = frequencies.iter().copied().zip(psd.iter().copied()).collect();
        threshold.multiple(&pairs)
    };
    let has = |layer: fn(&Plane) -> bool| planes.iter().any(|(plane, _)| layer(plane));
    for (name, is_there) in [
        ("relief", has(|plane| plane.relief().is_some())),
        ("height map", has(|plane| plane.height_map().is_some())),
    ] {
        if is_there {
            output::note(&format!(
                "the texture has a {name}, which depends on position; the PSD is that of its noise alone"
            ));
        }
    }
    if let Some(SteadyStickSlip { frequency, rms_mps2, .. }) = &stick_slip {
        output::note(&format!(
            "at this speed and force the tip sticks and slips at {:.0} Hz, with {rms_mps2:.3} m/s² rms; the PSD is that of the \
             noise alone, the multiple of the threshold that of both",
            frequency.0
        ));
    }
    if is_directional {
        output::note(&format!(
            "the texture differs over direction; the PSD is that of a stroke at {}°, counterclockwise from the right \
             (--direction)",
            args.direction
        ));
    }
    let figures = Figures { frequencies, psd, rms, multiple, stick_slip, is_directional };
    print_figures(args, &chosen, &library, &figures)
}

/// Spectrum and figures of a texture at one contact.
struct Figures {
    frequencies: Vec<Hertz>,
    /// Density and level of the noise.
    psd: Vec<f64>,
    rms: f64,
    /// Multiple of the detection threshold, with stick-slip.
    multiple: f64,
    stick_slip: Option<SteadyStickSlip>,
    is_directional: bool,
}

/// Returns the multiple of a threshold that the noise and the independent stick-slip vibration have together.
fn multiple_with(
    threshold: &Threshold,
    stick_slip: &SteadyStickSlip,
    density: impl Fn(&[Hertz]) -> Vec<f64>,
) -> f64 {
    let frequencies: Vec<Hertz> = stick_slip.density.iter().map(|(frequency, _)| *frequency).collect();
    let noise = density(&frequencies);
    let sum =
        stick_slip.density.iter().zip(noise).map(|((frequency, of_tip), noise)| (*frequency, of_tip + noise));
    threshold.multiple(&sum.collect::<Vec<_>>())
}

fn print_figures(args: &Args, chosen: &Sound, library: &Library, figures: &Figures) -> anyhow::Result<()> {
    let Figures { frequencies, psd, rms, multiple, stick_slip, is_directional } = figures;
    let hz: Vec<f64> = frequencies.iter().map(|frequency| frequency.0).collect();
    let of_tip = stick_slip.as_ref().map(|of| json!({"hz": of.frequency.0, "rms": of.rms_mps2}));
    output::print(
        args.json,
        &json!({
            "hz": hz,
            "psd": psd,
            "rms": rms,
            "stick_slip": of_tip,
            "rms_with_stick_slip": stick_slip.as_ref().map_or(*rms, |of| rms.hypot(of.rms_mps2)),
            "times_threshold": multiple,
            "threshold": args.threshold.id(),
            "direction_degrees": is_directional.then_some(args.direction),
            "rate_hz": chosen.rate(library)?.0,
            "parents": chosen.parents_json(library),
            "at": chosen.at_json(),
            "at_named": named_json(library, chosen.at),
            "clamped": chosen.clamped,
            "extrapolated": chosen.extrapolated,
            "blend": chosen.mode.id(),
            "shape": chosen.shape.text(),
            "begins_path": chosen.path.is_some(),
        }),
        || {
            let lines = hz.iter().zip(psd).map(|(hz, psd)| format!("{hz:.2}\t{psd:.6e}\n"));
            let parents = chosen.parents_text(library);
            let tip = stick_slip.as_ref().map_or(String::new(), |of| {
                format!(", stick-slip {:.4} m/s² at {:.0} Hz", of.rms_mps2, of.frequency.0)
            });
            let toward = if *is_directional { format!(" at {}°", args.direction) } else { String::new() };
            format!(
                "# {parents}{toward}: rms {rms:.4} m/s²{tip}, about {} times the detection threshold ({})\n# Hz\t(m/s²)²/Hz\n{}",
                two_digits(*multiple),
                args.threshold.id(),
                lines.collect::<String>().trim_end()
            )
        },
    );
    Ok(())
}

/// Parses an angle in degrees.
fn degrees(text: &str) -> Result<f64, String> {
    match text.parse::<f64>() {
        Ok(value) if value.abs() <= 360.0 => Ok(value),
        _ => Err("it must be a number of degrees from -360 to 360".to_owned()),
    }
}
