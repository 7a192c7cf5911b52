//! Textures authored in the place of removed ones, as the paper mixes them: Figures 7 and 8 and Table II.

use shagreen_core::space::authoring::Blending;
use shagreen_core::space::fidelity::{COMPARED_RATE, Channels, Profile, error_db};
use shagreen_core::space::leave_one_out::{LeaveOneOut, Plan};
use shagreen_core::texture::blend::Mode;
use shagreen_core::texture::plane::Plane;
use shagreen_core::units::Hertz;
use shagreen_formats::evaluation_report::{MEASURED, evaluation_source, method_id};
use shagreen_formats::library::Library;
use shagreen_formats::reproduction_report::ReproducedItem;

use crate::authoring::{authoring, plane_at};
use crate::evaluation::evaluate_interpolation;
use crate::report::Reporter;
use crate::reproduce::charts::table;
use crate::reproduce::s0::dissimilarities::{Judged, judged};
use crate::reproduce::s0::{Authored, waveforms};
use crate::reproduce::work::Work;
use crate::texture_difference::texture_profile;

/// Number of authored textures that the paper compares.
const N_AUTHORED: usize = 6;
/// The textures of the built-in study of authored textures, in its order.
const OF_STUDY: [&str; N_AUTHORED] = ["coarse-canvas", "sanded-wood", "cork", "bumpy-rubber", "mdf", "denim"];
/// The modes that are evaluated: the mixing of the paper first.
const MODES: [Mode; 2] = [Mode::Paper, Mode::Field];

/// Computes the items; `placed` is the library with positions in the built space.
pub(super) fn items(work: &mut Work<'_>, placed: &Library) -> anyhow::Result<()> {
    work.step("authoring each texture from the others")?;
    let plan = Plan { blendings: MODES.map(Blending::from).to_vec(), signals: None };
    let measured = match evaluate_interpolation(placed, &plan, &mut |_, _| true) {
        Ok(measured) => Some(measured),
        Err(error) => {
            work.reporter.warn(&format!("no texture can be authored from the others: {error:#}"));
            None
        }
    };
    let mut all = Vec::new();
    for texture in chosen(placed, measured.as_ref()) {
        all.extend(authored(placed, texture, work.reporter)?);
    }
    work.step("rendering the waveforms of parents and sums")?;
    waveforms::item(work, placed, &all)?;
    work.step("asking simulated participants for dissimilarities")?;
    let judged = judged(placed, work.options.seed)?;
    let reach_db = measured.as_ref().map_or(0.0, |measured| measured.reach_db);
    let distances = relative_distances(placed, &all, reach_db, work.reporter)?;
    figure_8(work, placed, &all, &distances, &judged);
    table_2(work, placed, (&all, &distances), measured.as_ref(), &judged);
    Ok(())
}

/// Up to six textures that can be authored: those of the study first.
fn chosen(library: &Library, measured: Option<&LeaveOneOut>) -> Vec<usize> {
    let inside: Vec<usize> =
        measured.into_iter().flat_map(|of| &of.textures).map(|left_out| left_out.texture).collect();
    let of_study = OF_STUDY.iter().filter_map(|id| library.index_of(id));
    let mut chosen: Vec<usize> = of_study.filter(|texture| inside.contains(texture)).collect();
    let others: Vec<usize> = inside.into_iter().filter(|texture| !chosen.contains(texture)).collect();
    chosen.extend(others);
    chosen.truncate(N_AUTHORED);
    chosen
}

/// The texture authored by the mixing of the paper in the place of a removed one; `None` if it has no position.
fn authored(library: &Library, texture: usize, reporter: &dyn Reporter) -> anyhow::Result<Option<Authored>> {
    let Some(at) = library.textures[texture].at() else { return Ok(None) };
    let mut rest = library.clone();
    rest.textures[texture].place = None;
    let Some(authored) = authoring(&rest, Mode::Paper, reporter)?.author(at, &Blending::from(Mode::Paper))
    else {
        return Ok(None);
    };
    let rates_hz = authored.parents.iter().map(|(parent, _)| library.textures[*parent].model.rate().0);
    let rate = Hertz(rates_hz.fold(COMPARED_RATE.0, f64::max));
    let mut parents = Vec::with_capacity(authored.parents.len());
    for (parent, weight) in authored.parents {
        let entry = &library.textures[parent];
        parents.push((entry.name.clone(), plane_at(entry, rate, reporter)?, weight));
    }
    Ok(Some(Authored { name: library.textures[texture].name.clone(), texture, parents, rate }))
}

/// Spectral distance of each authored texture (row) from each original (column), relative to that of the two textures farthest
/// apart on the first axis.
fn relative_distances(
    library: &Library,
    all: &[Authored],
    reach_db: f64,
    reporter: &dyn Reporter,
) -> anyhow::Result<Vec<Vec<f64>>> {
    let channels = Channels::of_models();
    let mut originals: Vec<Profile> = Vec::with_capacity(all.len());
    for of in all {
        originals.push(texture_profile(&library.textures[of.texture], &channels, reporter)?);
    }
    let row = |of: &Authored| -> Vec<f64> {
        let parents: Vec<(&Plane, f64)> =
            of.parents.iter().map(|(_, plane, weight)| (plane, *weight)).collect();
        let mixed = channels.profile(&parents, Mode::Paper);
        originals.iter().map(|original| error_db(&mixed, original) / reach_db).collect()
    };
    Ok(all.iter().map(row).collect())
}

/// What distances of signals come from.
fn source(work: &Work<'_>, placed: &Library) -> String {
    format!("{}, {}, mode {}", work.named(placed), evaluation_source(placed), Mode::Paper.id())
}

/// Figure 8: dissimilarities of simulated participants, and distances of signals.
fn figure_8(
    work: &mut Work<'_>,
    placed: &Library,
    all: &[Authored],
    distances: &[Vec<f64>],
    judged: &Judged,
) {
    let on_signals = source(work, placed);
    let mut item =
        work.item("figure-8", format!("dissimilarities: {}; most similar: {on_signals}", judged.who));
    item.set("pairs", judged.n_pairs.map(|n| n as f64), "of the built-in plan authored-dissimilarity");
    if let Some([different, first, second]) = judged.references {
        item.set("different", Some(different), "");
        item.set("same-1", Some(first), "");
        item.set("same-2", Some(second), "");
    }
    let is_nearest = |(index, row): &(usize, &Vec<f64>)| {
        row.iter().enumerate().all(|(other, distance)| other == *index || *distance > row[*index])
    };
    let n_nearest = distances.iter().enumerate().filter(is_nearest).count();
    let of = format!(
        "{n_nearest} of {} authored textures, {MEASURED}, unlike the rows above, which {} answered; in the paper, people compared other textures",
        all.len(),
        judged.who
    );
    item.set("nearest", (!all.is_empty()).then_some(n_nearest as f64), &of);
    item.figures.push(("simulated".to_owned(), judged.figure.clone()));
    let names: Vec<String> = all.iter().map(|of| of.name.clone()).collect();
    let row = |(of, row): (&Authored, &Vec<f64>)| {
        (format!("authored {}", of.name), row.iter().copied().map(Some).collect())
    };
    item.figures.push((
        "signals".to_owned(),
        table(
            "Spectral distance of authored textures (rows) from originals (columns); 1: the two textures farthest apart",
            names,
            all.iter().zip(distances).map(row).collect(),
            &on_signals,
        ),
    ));
    item.explain_all(&format!("{} answered; in the paper, ten people", judged.who));
    work.done(item);
}

/// Table II: the realism score with the spectral distance in the place of the dissimilarity.
fn table_2(
    work: &mut Work<'_>,
    placed: &Library,
    (all, distances): (&[Authored], &[Vec<f64>]),
    measured: Option<&LeaveOneOut>,
    judged: &Judged,
) {
    let on_signals = source(work, placed);
    let mut item = work.item("table-2", on_signals);
    item.commands.push("shagreen evaluate leave-one-out --blend all".to_owned());
    let scores: Vec<f64> = distances.iter().enumerate().map(|(index, row)| 1.0 - row[index]).collect();
    for (number, (of, score)) in (1..).zip(all.iter().zip(&scores)) {
        let reason = format!("here {}; {MEASURED}, not rated by people", of.name);
        item.set(&format!("pair-{number}"), Some(*score), &reason);
    }
    let mean = scores.iter().sum::<f64>() / scores.len() as f64;
    item.set("mean", (!scores.is_empty()).then_some(mean), &format!("{MEASURED}, not rated by people"));
    if let Some(measured) = measured {
        means_of_all(&mut item, measured);
    }
    let remark = above_one(judged.mean_score);
    item.add_remarked(format!("average of {}", judged.who), "", judged.mean_score, remark);
    item.explain("fewer than six textures lie inside the convex hull of the others");
    work.done(item);
}

/// Remark on a mean realism score; empty up to 1.
fn above_one(score: Option<f64>) -> &'static str {
    if score.is_some_and(|score| score > 1.0) {
        "above 1: on average, an authored texture and its original were judged less different than a texture and itself, which is the score of 1"
    } else {
        ""
    }
}

/// Mean scores over all textures inside the hull, by method.
fn means_of_all(item: &mut ReproducedItem, measured: &LeaveOneOut) {
    for summary in &measured.methods {
        let name = format!("average over {} textures, {}", summary.n, method_id(&summary.method));
        item.add(name, "", summary.nrs_mean);
    }
}
