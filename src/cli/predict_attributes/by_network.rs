//! Attributes of recordings, predicted by a trained network of strokes.

use std::path::Path;

use anyhow::Context as _;
use serde_json::json;
use shagreen_core::maths::gaussian_process::Estimate;
use shagreen_core::recording::fit::Stroke;
use shagreen_core::texture::patterns::{PAPER_FORCES_N, PAPER_RATE, PAPER_SPEEDS_MM_PER_S};
use shagreen_formats::bounded_file::FileKind;
use shagreen_formats::recording::ColumnMap;
use shagreen_learn::model_card::{ModelCard, TrainingExtent};
use shagreen_learn::model_file::sha256_of;
use shagreen_learn::stroke_model::StrokeModel;

use crate::cli::output;
use crate::cli::predict_attributes::{Args, Attribute, as_json, table_text};
use crate::cli::stroke_recordings::StrokeRecordings;
use shagreen_studio::attribute_prediction::UNIFORM_DEVIATION;
use shagreen_studio::file;

/// Predicts the attributes of the recordings with a network trained on strokes. The standard deviations are its
/// leave-one-texture-out RMSE.
pub(super) fn predict_by_network(args: &Args, path: &Path, map: &ColumnMap) -> anyhow::Result<()> {
    let bytes = file::read_file(path, FileKind::Network)?;
    let (network, card) = StrokeModel::from_bytes(&bytes).with_context(|| file::in_file(path))?;
    let recordings = StrokeRecordings::read(&args.recording, map, network.architecture().n_axes() != 1)?;
    let strokes = recordings.strokes().with_context(|| file::in_file(&args.recording[0]))?;
    let predicted = network.predict(&strokes)?.with_context(|| {
        let least = network.architecture().n_samples as f64 / PAPER_RATE.0;
        format!(
            "no stroke is as long as the {least} s that the network needs; leave --model out, or record longer strokes"
        )
    })?;
    warn_of_unknown(&card, &recordings, &strokes);
    let estimates = predicted.into_iter().zip(&card.left_out_rmse);
    let of_names = card.attributes.iter().zip(estimates);
    let attributes: Vec<Attribute<'_>> = of_names
        .map(|(name, (mean, deviation))| {
            Attribute::new(name, Estimate { mean, deviation: *deviation }, UNIFORM_DEVIATION)
        })
        .collect();
    let what = format!("the network {}, trained on {}", card.network, card.learned_from);
    let result = json!({
        "attributes": as_json(&attributes),
        "model": what,
        "model_sha256": sha256_of(&bytes),
        "label_source": card.label_sources,
        "strokes": strokes.len(),
        "beats_gaussian_process": card.gaussian_process.as_ref().map(|of| of.network_is_better),
        "cautions": cautions(&card),
    });
    output::print(args.json, &result, || {
        let mut lines = vec![table_text(&attributes, "recording"), format!("predicted by {what}")];
        lines.extend(cautions(&card));
        lines.join("\n")
    });
    Ok(())
}

/// Returns what a user of the predictions should know about the network: that the default predictor is better, and that
/// its training was cut short.
fn cautions(card: &ModelCard) -> Vec<String> {
    let worse = card.gaussian_process.as_ref().filter(|of| !of.network_is_better);
    let worse = worse.map(|of| {
        format!("{} To predict with it, give the library with --library instead of --model.", of.sentence())
    });
    worse.into_iter().chain(card.extent.as_ref().and_then(TrainingExtent::sentence)).collect()
}

/// Warns of strokes outside the training range of the network: the standard deviations do not show it.
fn warn_of_unknown(card: &ModelCard, recordings: &StrokeRecordings, strokes: &[Stroke]) {
    let ends = |values: [f64; 5]| [values[0], values[4]];
    // Networks of earlier versions were trained on the strokes of the paper.
    let (speed_mm_per_s, force_n) = match &card.extent {
        Some(extent) => (extent.speed_mm_per_s, extent.force_n),
        None => (ends(PAPER_SPEEDS_MM_PER_S), ends(PAPER_FORCES_N)),
    };
    // The training strokes are points in the speed-force plane. Values from half the lowest to 1.5 times the highest
    // count as near them.
    let known = |[low, high]: [f64; 2]| 0.5 * low..=1.5 * high;
    let (speeds_mm_per_s, forces_n) = (known(speed_mm_per_s), known(force_n));
    let rows = || strokes.iter().flat_map(|stroke| stroke.speed_mps.iter().zip(&stroke.force_n));
    let is_unknown = |(speed_mps, force_n): &(&f64, &f64)| {
        !speeds_mm_per_s.contains(&(1e3 * **speed_mps)) || !forces_n.contains(*force_n)
    };
    let n_unknown = rows().filter(is_unknown).count();
    let percent = 100.0 * n_unknown as f64 / rows().count().max(1) as f64;
    if percent >= 1.0 {
        let ([slowest, fastest], [weakest, strongest]) = (speed_mm_per_s, force_n);
        output::warn(&format!(
            "{percent:.0} % of the samples lie outside the range of speeds and forces on which the network was trained ({slowest:.0} to {fastest:.0} mm/s, {weakest:.1} to {strongest:.1} N); its standard deviations are not valid there"
        ));
    }
    if let Some((_, rate_hz)) = recordings.low_rates_hz().first() {
        output::warn(&format!(
            "the network was trained at {} Hz; a recording at {rate_hz:.0} Hz lacks the highest frequencies",
            PAPER_RATE.0
        ));
    }
}

#[cfg(test)]
mod tests {
    use super::cautions;
    use shagreen_learn::model_card::{GaussianProcessComparison, ModelCard};

    #[test]
    fn a_network_that_does_not_beat_the_gaussian_process_says_so() {
        let card = |gaussian_process| ModelCard {
            attributes: vec!["rough-smooth".to_owned()],
            left_out_rmse: vec![9.0],
            network: "serial".to_owned(),
            learned_from: "25 textures".to_owned(),
            label_sources: vec!["simulated".to_owned()],
            gaussian_process,
            extent: None,
        };
        let said = cautions(&card(Some(GaussianProcessComparison::new(vec![7.0], vec![4.0]))));
        assert_eq!(said.len(), 1);
        assert!(said[0].contains("does not beat the Gaussian process"), "{said:?}");
        assert!(said[0].contains("--library instead of --model"), "{said:?}");
        assert!(cautions(&card(Some(GaussianProcessComparison::new(vec![3.0], vec![4.0])))).is_empty());
        assert!(cautions(&card(None)).is_empty());
    }
}
