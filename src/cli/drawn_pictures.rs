//! Training features from pictures of drawn materials: simulated surfaces with random parameters, in any number.

use std::path::Path;

use anyhow::{Context as _, ensure};
use shagreen_core::surfaces::picture_features::N_FEATURES;
use shagreen_core::surfaces::random_material::draw;
use shagreen_core::surfaces::shading::Picture;
use shagreen_core::surfaces::starter::{LabelSpan, Labels, pictured};
use shagreen_formats::atomic;
use shagreen_formats::bounded_file::FileKind;
use shagreen_learn::backbone::Backbone;
use shagreen_learn::picture_model::FeatureExtractor;
use shagreen_learn::picture_predictor::{LookingError, see};
use shagreen_learn::picture_set::{PictureSet, Seen};

use crate::cli::progress::Progress;
use shagreen_studio::file;
use shagreen_studio::parallel::in_parallel;

/// Version of the features. Increase it when drawn materials, their pictures or the extracted features change.
const VERSION: u32 = 1;

/// Number of pictures after which the extracted features are saved.
const N_AT_ONCE: usize = 40;

/// Returns the features of each picture: texture statistics, followed by backbone features if there is a backbone.
/// Labels are positions on the axes of `span`; they can lie outside 0..100.
pub(crate) fn drawn_pictures(
    n: usize,
    seed: u64,
    backbone: Option<&Backbone>,
    span: &LabelSpan,
    kept: Option<&Path>,
) -> anyhow::Result<Vec<Seen>> {
    let seen_by = format!("materials of seed {seed}, seen by {N_FEATURES} statistics (version {VERSION})");
    let made_by = backbone.map_or_else(|| seen_by.clone(), |b| format!("{seen_by} and {}", b.sha256()));
    let mut set = PictureSet { made_by, pictures: Vec::new() };
    // A file with backbone features also contains the statistics.
    let mut kept = kept;
    if let Some(path) = kept.filter(|path| path.exists()) {
        let before = PictureSet::from_bytes(&file::read_file(path, FileKind::Network)?)
            .with_context(|| file::in_file(path))?;
        let is_part = backbone.is_none() && before.made_by.starts_with(&seen_by);
        ensure!(
            before.made_by == set.made_by || is_part,
            "the saved features belong to other materials or another network; choose another folder with --state: {}",
            path.display()
        );
        let n_features = N_FEATURES + backbone.map_or(0, |b| b.kind().n_features());
        let fits = |seen: &Seen| seen.features.len() >= n_features && seen.labels.len() == 2;
        ensure!(
            before.pictures.iter().all(fits),
            "the file of saved features is damaged; delete it: {}",
            path.display()
        );
        // A file with both kinds of features is not replaced by one with statistics only.
        if before.made_by != set.made_by {
            kept = None;
        }
        set.pictures = before.pictures;
        if is_part {
            set.pictures.iter_mut().for_each(|seen| seen.features.truncate(N_FEATURES));
        }
    }
    let progress = Progress::new("computing the features of pictures", n);
    for _ in 0..set.pictures.len().min(n) {
        progress.step();
    }
    while set.pictures.len() < n {
        let end = (set.pictures.len() + N_AT_ONCE).min(n);
        let begin = set.pictures.len();
        let seen = in_parallel(end - begin, |index| {
            let seen = look_at(begin + index, seed, backbone);
            progress.step();
            seen
        });
        set.pictures.extend(seen.into_iter().collect::<anyhow::Result<Vec<Seen>>>()?);
        if let Some(path) = kept {
            atomic::write(path, &set.to_bytes()?)?;
        }
    }
    progress.finish();
    let on_axes = |seen: &Seen| {
        let labels = Labels { roughness_log10_mps2: seen.labels[0], hardness_log10_n_per_m: seen.labels[1] };
        Seen { labels: span.axes(&labels).to_vec(), features: seen.features.clone() }
    };
    Ok(set.pictures.iter().take(n).map(on_axes).collect())
}

/// Returns the texture statistics of a picture, followed by backbone features if there is a backbone.
pub(crate) fn see_all(backbone: Option<&Backbone>, picture: &Picture) -> Result<Vec<f32>, LookingError> {
    let mut features = see(None, picture)?;
    if backbone.is_some() {
        features.extend(see(backbone, picture)?);
    }
    Ok(features)
}

/// Returns the part of features from [`see_all`] that this extractor gives.
pub(crate) fn seen_by(eyes: &FeatureExtractor, seen: &Seen) -> Seen {
    let (statistics, network) = seen.features.split_at(N_FEATURES);
    let features = if *eyes == FeatureExtractor::Statistics { statistics } else { network };
    Seen { features: features.to_vec(), labels: seen.labels.clone() }
}

fn look_at(number: usize, seed: u64, backbone: Option<&Backbone>) -> anyhow::Result<Seen> {
    let (material, _) = draw(seed, number as u64);
    let (labels, picture) = pictured(&material, seed)
        .with_context(|| format!("no picture of {} can be rendered", material.name))?;
    let features = see_all(backbone, &picture)?;
    // Rounded as in the file, so that a resumed training gives the same result.
    let kept = |label: f64| f64::from(label as f32);
    Ok(Seen {
        features,
        labels: vec![kept(labels.roughness_log10_mps2), kept(labels.hardness_log10_n_per_m)],
    })
}
