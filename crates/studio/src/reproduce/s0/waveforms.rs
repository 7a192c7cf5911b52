//! Figure 7: waveforms of the parents of authored textures, over their weighted sum.

use shagreen_core::dsp::spectrum::rms;
use shagreen_core::maths::rng::derive_seed;
use shagreen_core::texture::blend::Mode;
use shagreen_core::units::{Contact, MetersPerSecond, Newtons};
use shagreen_formats::evaluation_report::evaluation_source;
use shagreen_formats::figure::{Figure, Scale};
use shagreen_formats::library::{Library, id_from_name};

use crate::render::{SampleFormat, render_mixture};
use crate::reproduce::charts::{chart, compared};
use crate::reproduce::s0::Authored;
use crate::reproduce::work::Work;

/// Tip speed and normal force, in the middle of those of the paper's patterns.
const CONTACT: Contact = Contact { speed: MetersPerSecond(0.15), force: Newtons(0.3) };
/// Length of the rendered signals, whose levels are compared, and of the part that is shown, in s.
const SIGNAL_SECS: f64 = 4.0;
const SHOWN_SECS: f64 = 0.2;
/// Distance of the waveforms in a figure, relative to the highest peak.
const SPACING: f64 = 2.2;

/// Rendered signals of an authored texture in m/s².
struct Signals {
    of_parents: Vec<Vec<f64>>,
    sum: Vec<f64>,
}

/// Computes the item: a chart of each authored texture, and the level that the sum loses.
pub(super) fn item(work: &mut Work<'_>, placed: &Library, all: &[Authored]) -> anyhow::Result<()> {
    let source = format!(
        "{} at 150 mm/s and 0.3 N, {}; each parent has noise of its own, so that their powers add, not their amplitudes",
        work.named(placed),
        evaluation_source(placed)
    );
    let mut item = work.item("figure-7", source);
    item.commands.push(
        "shagreen render --at RS,HS --speed 150 --force 0.3 --seconds 4 --blend paper -o sum.wav".to_owned(),
    );
    for of in all {
        let signals = rendered(of, work.options.seed)?;
        let levels = signals.of_parents.iter().zip(&of.parents).map(|(signal, (_, _, w))| w * rms(signal));
        let lost_db = 20.0 * (rms(&signals.sum) / levels.sum::<f64>()).log10();
        item.add(
            format!("{}: level of the sum relative to the weighted mean of its parents", of.name),
            "dB",
            Some(lost_db),
        );
        item.figures.push((id_from_name(&of.name), figure(of, &signals, &item.source)));
    }
    work.done(item);
    Ok(())
}

fn rendered(of: &Authored, seed: u64) -> anyhow::Result<Signals> {
    let mut of_parents = Vec::with_capacity(of.parents.len());
    for (number, (_, plane, _)) in of.parents.iter().enumerate() {
        let format = SampleFormat {
            rate: of.rate,
            seconds: SIGNAL_SECS,
            seed: derive_seed(seed, &format!("{} parent {number}", of.name)),
            loops: false,
        };
        let samples = render_mixture(&[(plane, 1.0)], Mode::Shared, format, &mut |_: f64| CONTACT)?;
        of_parents.push(samples.into_iter().map(f64::from).collect::<Vec<f64>>());
    }
    let n = of_parents.first().map_or(0, Vec::len);
    let at = |i: usize| -> f64 {
        of_parents.iter().zip(&of.parents).map(|(signal, (_, _, weight))| weight * signal[i]).sum()
    };
    let sum = (0..n).map(at).collect();
    Ok(Signals { of_parents, sum })
}

/// The parents above each other, and the sum below them.
fn figure(of: &Authored, signals: &Signals, source: &str) -> Figure {
    let n = ((SHOWN_SECS * of.rate.0) as usize).min(signals.sum.len());
    let of_parents = of.parents.iter().zip(&signals.of_parents);
    let named =
        of_parents.map(|((name, _, weight), signal)| (format!("{name}, {:.0} %", 100.0 * weight), signal));
    let all: Vec<(String, &Vec<f64>)> = named.chain([("weighted sum".to_owned(), &signals.sum)]).collect();
    let shown = all.iter().flat_map(|(_, signal)| &signal[..n]);
    let spacing_mps2 = SPACING * shown.fold(f64::MIN_POSITIVE, |peak, x| peak.max(x.abs()));
    let last = all.len() - 1;
    let lines = all.iter().enumerate().map(|(index, (name, signal))| {
        let offset = spacing_mps2 * (last - index) as f64;
        let points = signal[..n].iter().enumerate().map(|(i, x)| (1e3 * i as f64 / of.rate.0, x + offset));
        compared(name.clone(), index, points)
    });
    chart(
        format!("Parents of authored {} over their weighted sum", of.name),
        ["time in ms", &format!("acceleration in m/s², waveforms {spacing_mps2:.2} m/s² apart")],
        Scale::Linear,
        lines.collect(),
        source,
    )
}
