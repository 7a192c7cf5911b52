//! The paper on the quality of compressed signals: coded textures, judged and predicted discriminability.

mod selections;

use std::sync::Arc;

use anyhow::{Context as _, ensure};
use shagreen_core::people::study::analysis::discrimination::{Discrimination, discriminations};
use shagreen_core::people::study::plan::{Plan, Variant};
use shagreen_core::people::study::same_different::{Correction, d_prime};
use shagreen_core::signals::codec::CODEC_RATE;
use shagreen_core::signals::codec::bitrate::Bitrate;
use shagreen_core::signals::codec::books::Codebooks;
use shagreen_core::signals::codec::coded::Coded;
use shagreen_core::signals::codec::corpus::signal;
use shagreen_core::signals::quality::{
    Distances, Feature, PAPER_RATE, QualityMeter, QualityModel, RatedPair, SEGMENT_SECS, snr_db,
};
use shagreen_core::units::{Contact, MetersPerSecond, Newtons};
use shagreen_formats::built_in::BuiltIn;
use shagreen_formats::codec_tables::built_in_codebooks;
use shagreen_formats::figure::{Figure, Mark, Point, Scale, Tone};
use shagreen_formats::library::{Library, TextureEntry};
use shagreen_formats::quality_model::built_in_quality_model;
use shagreen_formats::thresholds::ThresholdKind;

use crate::reproduce::charts::{chart, line, series};
use crate::reproduce::simulated::{simulated_answers, simulated_participants};
use crate::reproduce::work::Work;

/// Number of participants of the paper.
const N_PARTICIPANTS: usize = 8;
/// The textures of the built-in study, which stand for steel, rubber, wood, leather and marble, in its order.
const OF_STUDY: [&str; 5] = ["polished-metal", "flat-rubber", "sanded-wood", "leather", "stone-tile"];
/// Stroke of all signals.
const CONTACT: Contact = Contact { speed: MetersPerSecond(0.1), force: Newtons(1.0) };
/// Bits of an uncoded sample.
const SAMPLE_BITS: f64 = 16.0;
/// Rates that Figure 2 shows, highest first.
const SHOWN_RATES: [Bitrate; 3] = [Bitrate::Kbps3_15, Bitrate::Kbps2_45, Bitrate::Kbps1_75];
/// Rest of a signal after its last segment, in s, so that resampling cannot make it too short.
const REST_SECS: f64 = 0.02;
/// Part of a signal that Figure 2 shows, in s.
const SHOWN_SECS: f64 = 0.06;

/// A texture, coded at all rates.
pub(super) struct CodedTexture {
    name: String,
    signal_mps2: Vec<f64>,
    /// At each rate of [`Bitrate::ALL`].
    versions: Vec<Version>,
}

/// A decoded signal beside its original.
struct Version {
    rate: Bitrate,
    decoded_mps2: Vec<f64>,
    distances: Distances,
    /// Discriminability by simulated participants; `None` without answers.
    d_prime: Option<f64>,
}

pub(super) fn run(work: &mut Work<'_>) -> anyhow::Result<()> {
    let library = match work.options.library {
        Some(library) => library.clone(),
        None => BuiltIn::Starter.read()?,
    };
    rates(work);
    work.step("asking simulated participants whether signals differ")?;
    let (plan, records) = simulated_answers("same-different", N_PARTICIPANTS, None, work.options.seed)?;
    let judged: Vec<Vec<Discrimination>> =
        plan.parts.iter().map(|part| discriminations(part, &records)).collect();
    trials(work, &judged);
    work.step("encoding the textures at five rates")?;
    let coded = coded_textures(work, &library, &plan, &judged)?;
    let source = format!("{} at 100 mm/s and 1 N, codec of Shagreen", work.named(&library));
    figure_2(work, &coded, &source);
    work.step("fitting the model of quality")?;
    let model = built_in_quality_model()?.model;
    let who = format!("{source}; d' judged by {}", simulated_participants(N_PARTICIPANTS));
    let pairs = pairs(&coded);
    figure_4(work, &coded, &model, (&pairs, &who))?;
    selections::item(work, &pairs, &who)
}

/// Pairs with the d′ of simulated participants.
fn pairs(coded: &[CodedTexture]) -> Vec<RatedPair> {
    let of_texture = |(texture, of): (usize, &CodedTexture)| {
        let pair = |version: &Version| {
            let d_prime = version.d_prime?;
            Some(RatedPair { texture, distances: version.distances, d_prime, weight: 1.0 })
        };
        of.versions.iter().filter_map(pair).collect::<Vec<RatedPair>>()
    };
    coded.iter().enumerate().flat_map(of_texture).collect()
}

/// The rates, which need no data.
fn rates(work: &mut Work<'_>) {
    let mut item = work.item("rates", "codec of Shagreen");
    item.set("input", Some(1e-3 * CODEC_RATE.0 * SAMPLE_BITS), "");
    for rate in Bitrate::ALL {
        item.set(&format!("{:.2}", rate.kbps()), Some(rate.kbps()), "");
    }
    work.done(item);
}

/// Numbers of trials of the built-in study.
fn trials(work: &mut Work<'_>, judged: &[Vec<Discrimination>]) {
    let mut item = work.item("trials", simulated_participants(N_PARTICIPANTS));
    item.commands.push("shagreen study new same-different --out same-different.toml".to_owned());
    let first = judged.first().map_or(&[][..], Vec::as_slice);
    let n_trials: u64 = first.iter().map(|of| of.pooled.n_different + of.pooled.n_same).sum();
    item.set("versions", Some(judged.iter().map(Vec::len).sum::<usize>() as f64), "");
    item.set("pairs", Some(n_trials as f64 / N_PARTICIPANTS as f64), "");
    item.set("n", first.first().map(|of| of.pooled.n_different as f64), "");
    item.explain("the built-in study has other repeats");
    work.done(item);
}

/// The five textures of the study, or as many others if the library lacks one, each coded and compared at all rates.
fn coded_textures(
    work: &Work<'_>,
    library: &Library,
    plan: &Plan,
    judged: &[Vec<Discrimination>],
) -> anyhow::Result<Vec<CodedTexture>> {
    let books = Arc::new(built_in_codebooks()?);
    let meter = QualityMeter::new(PAPER_RATE, &ThresholdKind::default().read()?)?;
    let seconds = work.options.extent.n_segments as f64 * SEGMENT_SECS + REST_SECS;
    let textures = chosen(library)?;
    let mut all = Vec::with_capacity(textures.len());
    for (index, texture) in textures.into_iter().enumerate() {
        let seed = work.options.seed.wrapping_mul(1000).wrapping_add(index as u64);
        let of_study = judged.get(index).map_or(&[][..], Vec::as_slice);
        let coded = coded(texture, (&books, &meter), seconds, seed, |rate| d_prime_at(plan, of_study, rate));
        all.push(coded.with_context(|| format!("the texture \"{}\" cannot be coded", texture.id))?);
    }
    Ok(all)
}

fn chosen(library: &Library) -> anyhow::Result<Vec<&TextureEntry>> {
    let of_study = OF_STUDY.iter().map(|id| library.index_of(id));
    if let Some(all) = of_study.collect::<Option<Vec<usize>>>() {
        return Ok(all.into_iter().map(|index| &library.textures[index]).collect());
    }
    let n = library.textures.len();
    ensure!(
        n >= OF_STUDY.len(),
        "\"{}\" has {n} textures, but {} are needed; choose another library",
        library.name,
        OF_STUDY.len()
    );
    Ok((0..OF_STUDY.len()).map(|index| &library.textures[index * n / OF_STUDY.len()]).collect())
}

/// Discriminability of a texture and its version at a rate, from all answers to its pair.
fn d_prime_at(plan: &Plan, judged: &[Discrimination], rate: Bitrate) -> Option<f64> {
    let is_at = |of: &&Discrimination| {
        let variant = plan.stimulus(&of.pair.second).map(|stimulus| stimulus.variant);
        matches!(variant, Some(Variant::Coded { kbps }) if (kbps - rate.kbps()).abs() < 1e-9)
    };
    d_prime(judged.iter().find(is_at)?.pooled, Correction::LogLinear)
}

fn coded(
    texture: &TextureEntry,
    (books, meter): (&Arc<Codebooks>, &QualityMeter),
    seconds: f64,
    seed: u64,
    judged: impl Fn(Bitrate) -> Option<f64>,
) -> anyhow::Result<CodedTexture> {
    let signal_mps2 = signal(&texture.model, CONTACT, seconds, seed)?;
    let mut versions = Vec::with_capacity(Bitrate::ALL.len());
    for rate in Bitrate::ALL {
        let decoded_mps2 = Coded::encode(&signal_mps2, rate, books)?.decode(books);
        let distances = meter.distances(&signal_mps2, &decoded_mps2)?;
        versions.push(Version { rate, decoded_mps2, distances, d_prime: judged(rate) });
    }
    Ok(CodedTexture { name: texture.name.clone(), signal_mps2, versions })
}

/// Figure 2: the first texture over its decoded versions.
fn figure_2(work: &mut Work<'_>, coded: &[CodedTexture], source: &str) {
    let mut item = work.item("figure-2", source);
    item.commands.push("shagreen codec encode IN.wav --kbps 3.15 -o OUT".to_owned());
    let Some(CodedTexture { name, signal_mps2, versions }) = coded.first() else {
        work.done(item);
        return;
    };
    let shown = |signal: &[f64]| -> Vec<(f64, f64)> {
        let n = ((SHOWN_SECS * CODEC_RATE.0) as usize).min(signal.len());
        signal[..n].iter().enumerate().map(|(i, x)| (1e3 * i as f64 / CODEC_RATE.0, *x)).collect()
    };
    for rate in SHOWN_RATES {
        let Some(version) = versions.iter().find(|version| version.rate == rate) else { continue };
        let decoded = &version.decoded_mps2;
        item.add(
            format!("{name}: signal-to-noise ratio at {} kbit/s", rate.kbps()),
            "dB",
            Some(snr_db(signal_mps2, decoded)),
        );
        item.figures.push((
            format!("{}", rate.bits_per_sec()),
            chart(
                format!("{name} and its decoded version at {} kbit/s", rate.kbps()),
                ["time in ms", "acceleration in m/s²"],
                Scale::Linear,
                vec![
                    line("original", Tone::Main, shown(signal_mps2)),
                    line("decoded", Tone::Second, shown(decoded)),
                ],
                source,
            ),
        ));
    }
    work.done(item);
}

/// Figure 4: judged and predicted d′ of each texture by the bit rate, and the fits of all features and of one.
fn figure_4(
    work: &mut Work<'_>,
    coded: &[CodedTexture],
    model: &QualityModel,
    (pairs, who): (&[RatedPair], &str),
) -> anyhow::Result<()> {
    let mut item = work.item("figure-4", format!("{who}; predictions with the published weights"));
    item.commands.push("shagreen evaluate codec --seconds 2.4".to_owned());
    for (number, CodedTexture { name, versions, .. }) in (1..).zip(coded) {
        let judged = versions.iter().filter_map(|of| Some(Point::new(of.rate.kbps(), of.d_prime?)));
        let predicted = versions.iter().map(|of| Point::new(of.rate.kbps(), model.d_prime(&of.distances)));
        item.figures.push((
            format!("{number}"),
            chart(
                format!("Discriminability d' of {name} and its coded versions"),
                ["bit rate in kbit/s", "d'"],
                Scale::Linear,
                vec![
                    series("SIMULATED participants", Mark::Dots, Tone::Second, judged.collect()),
                    series("predicted from signals", Mark::Dots, Tone::Main, predicted.collect()),
                ],
                who,
            ),
        ));
    }
    item.figures.push(("fits".to_owned(), fits(pairs, who)?));
    work.done(item);
    Ok(())
}

/// The last panel of Figure 4: d′ by all features and by the Okamoto model alone, both fitted to the judgments.
fn fits(pairs: &[RatedPair], who: &str) -> anyhow::Result<Figure> {
    let fitted = |features: &[Feature]| -> anyhow::Result<Vec<Point>> {
        let model = QualityModel::fitted(features, pairs)?;
        let point = |pair: &RatedPair| Point::new(pair.d_prime, model.d_prime(&pair.distances));
        Ok(pairs.iter().map(point).collect())
    };
    let (of_all, of_one) = (fitted(&Feature::ALL)?, fitted(&[Feature::SpectralAmplitude])?);
    let high = of_all.iter().chain(&of_one).flat_map(|point| [point.x, point.y]).fold(1.0_f64, f64::max);
    Ok(chart(
        "Predicted and judged d' of all textures and rates",
        ["judged d'", "predicted d'"],
        Scale::Linear,
        vec![
            line("predicted as judged", Tone::Limit, [(0.0, 0.0), (high, high)]),
            series("all features", Mark::Dots, Tone::Main, of_all),
            series("Okamoto model alone", Mark::Dots, Tone::Second, of_one),
        ],
        who,
    ))
}
