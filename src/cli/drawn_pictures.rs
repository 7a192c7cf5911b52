//! Pictures of drawn materials, looked at: as much to learn from as anybody wants.

use std::path::Path;

use anyhow::{Context as _, ensure};
use shagreen_core::drawn_material::draw;
use shagreen_core::picture_features::N_FEATURES;
use shagreen_core::shading::Picture;
use shagreen_core::starter::{LabelSpan, Labels, pictured};
use shagreen_formats::atomic;
use shagreen_learn::backbone::Backbone;
use shagreen_learn::looking::{LookingError, see};
use shagreen_learn::picture_set::{PictureSet, Seen};

use crate::cli::in_parallel::in_parallel;
use crate::cli::output::{self, Progress};

/// Counted up whenever drawn materials, their pictures or what is seen in them change.
const VERSION: u32 = 1;

/// Pictures after which what was seen is kept.
const N_AT_ONCE: usize = 40;

/// What was seen in each picture by statistics, and after that by the network where there is one; labels are places on the
/// axes of `span`, beyond 0..100 where a material lies beyond.
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
    // Where a network looked too, what statistics saw is a part of it.
    let mut kept = kept;
    if let Some(path) = kept.filter(|path| path.exists()) {
        let before =
            PictureSet::from_bytes(&output::read_file(path)?).with_context(|| output::in_file(path))?;
        let is_part = backbone.is_none() && before.made_by.starts_with(&seen_by);
        ensure!(
            before.made_by == set.made_by || is_part,
            "what was kept is of other materials or another network; name another folder by --state: {}",
            path.display()
        );
        let n_features = N_FEATURES + backbone.map_or(0, |b| b.kind().n_features());
        let fits = |seen: &Seen| seen.features.len() >= n_features && seen.labels.len() == 2;
        ensure!(before.pictures.iter().all(fits), "what was kept is damaged; delete it: {}", path.display());
        // What both of them saw is not replaced by what one of them sees.
        if before.made_by != set.made_by {
            kept = None;
        }
        set.pictures = before.pictures;
        if is_part {
            set.pictures.iter_mut().for_each(|seen| seen.features.truncate(N_FEATURES));
        }
    }
    let progress = Progress::new("pictures", n);
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

/// What statistics see in a picture, and after that what the network does where there is one.
pub(crate) fn see_all(backbone: Option<&Backbone>, picture: &Picture) -> Result<Vec<f32>, LookingError> {
    let mut features = see(None, picture)?;
    if backbone.is_some() {
        features.extend(see(backbone, picture)?);
    }
    Ok(features)
}

fn look_at(number: usize, seed: u64, backbone: Option<&Backbone>) -> anyhow::Result<Seen> {
    let (material, _) = draw(seed, number as u64);
    let (labels, picture) =
        pictured(&material, seed).with_context(|| format!("{} cannot be pictured", material.name))?;
    let features = see_all(backbone, &picture)?;
    // As they are kept, so that a training is the same again after it was stopped.
    let kept = |label: f64| f64::from(label as f32);
    Ok(Seen {
        features,
        labels: vec![kept(labels.roughness_log10_mps2), kept(labels.hardness_log10_n_per_m)],
    })
}
