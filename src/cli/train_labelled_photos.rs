//! `shagreen train photo --photos`: trains a model of hardness, roughness and materials on labelled photos, and measures
//! its errors on classes and sources of photos that were left out.

use std::path::{Path, PathBuf};
use std::time::Instant;

use anyhow::{Context as _, ensure};
use serde_json::json;
use shagreen_core::maths::gaussian_process::Estimate;
use shagreen_core::words::counted;
use shagreen_formats::atomic;
use shagreen_formats::bounded_file::FileKind;
use shagreen_formats::photo_table::{LabelledPhoto, PhotoTable};
use shagreen_learn::attribute_model::AttributeModel;
use shagreen_learn::photo_card::{PhotoCard, PhotoSource, figure_lines};
use shagreen_learn::photo_config::{Calibration, HeadWeights, PhotoConfig};
use shagreen_learn::photo_folds::{Fold, LeftOut, folds};
use shagreen_learn::photo_model::{PhotoModel, drawn_roughness};
use shagreen_learn::photo_set::PhotoSet;
use shagreen_learn::photo_validation::{JudgedPhoto, judge};
use shagreen_learn::picture_model::{FeatureExtractor, PictureModel};

use crate::cli::class_figures::draw_classes;
use crate::cli::labelled_photos::{PhotoFiles, part_of};
use crate::cli::output;
use crate::cli::prediction_figures::FigureArgs;
use crate::cli::progress::Progress;
use shagreen_studio::file;
use shagreen_studio::parallel::in_parallel;

#[derive(clap::Args)]
pub(crate) struct LabelledArgs {
    /// Trains on labelled photos of materials too. PHOTOS.csv has the columns file (relative to the folder of the table),
    /// class, softness (0 hard to 100 soft) and softness_sd (the same for all photos of a class), source and license;
    /// author and note may be added. Standard deviations are scaled to the errors on photos whose whole class or source
    /// was left out of the training; the command prints these errors. The photos are not part of the model.
    #[arg(long, value_name = "PHOTOS.csv", conflicts_with_all = ["library", "pictures", "drawn_only", "unjudged"])]
    photos: Option<PathBuf>,
    /// Leaves out the photos whose note contains this text, in upper or lower case. Can be given several times.
    #[arg(long, value_name = "TEXT", requires = "photos")]
    without_note: Vec<String>,
    /// Number of random variations of each photo: crops, turns, blur, colors, light, noise and compression.
    #[arg(long, value_name = "N", default_value_t = 6, requires = "photos", value_parser = clap::value_parser!(u32).range(0..=100))]
    variations: u32,
    /// Model whose heads, trained on drawn materials, predict the roughness together with the photos. Without it, they are
    /// trained on --drawn materials.
    #[arg(long, value_name = "MODEL", requires = "photos", conflicts_with_all = ["drawn", "epochs", "patience", "heads"])]
    drawn_heads: Option<PathBuf>,
    /// Contributions of the heads to the hardness: ridge regression, class probabilities, small networks and kernel
    /// regression. Without the fourth number, there is no kernel regression.
    #[arg(long, value_name = "R,C,N,K", default_value = "1,1,1,0", requires = "photos", value_parser = parse_weights)]
    head_weights: HeadWeights,
    /// Contribution of the class probabilities to the roughness, 0 to 1. The rest is that of the heads trained on drawn
    /// materials. For photos of fewer than 224 pixels, the class probabilities count alone.
    #[arg(long, value_name = "SHARE", default_value_t = 0.5, requires = "photos")]
    roughness_of_classes: f64,
    /// Penalty of the ridge regression, for each row of features; above 0.
    #[arg(long, value_name = "P", default_value_t = 1.28, requires = "photos")]
    ridge_penalty: f64,
    /// Penalty of the class probabilities; above 0.
    #[arg(long, value_name = "P", default_value_t = 0.01, requires = "photos")]
    class_penalty: f64,
    /// Number of small networks.
    #[arg(long, value_name = "N", default_value_t = 3, requires = "photos", value_parser = clap::value_parser!(u32).range(1..=16))]
    networks: u32,
    /// Number of epochs of each small network.
    #[arg(long, value_name = "N", default_value_t = 20, requires = "photos", value_parser = clap::value_parser!(u32).range(1..=10_000))]
    network_epochs: u32,
    /// Number of parts into which the classes are divided; each part is left out once. A large number leaves each class out
    /// alone.
    #[arg(long, value_name = "N", default_value_t = 14, requires = "photos", value_parser = clap::value_parser!(u32).range(3..=1000))]
    class_folds: u32,
    /// Number of parts into which the sources are divided; each part is left out once.
    #[arg(long, value_name = "N", default_value_t = 8, requires = "photos", value_parser = clap::value_parser!(u32).range(2..=1000))]
    source_folds: u32,
    /// Photos on whose errors the standard deviations are scaled.
    #[arg(long, value_enum, default_value_t = CalibrateOn::Classes, requires = "photos")]
    calibrate_on: CalibrateOn,
}

/// Photos on whose errors the standard deviations are scaled.
#[derive(Clone, Copy, Debug, PartialEq, Eq, clap::ValueEnum)]
enum CalibrateOn {
    /// Photos whose class was left out.
    Classes,
    /// Photos whose source was left out.
    Sources,
    /// Both.
    Both,
}

/// Parses three weights that are separated by commas.
fn parse_weights(text: &str) -> Result<HeadWeights, String> {
    let wrong = || "it must be three or four numbers of 0 or more, not all 0, such as 1,1,1,0".to_owned();
    let numbers = text.split(',').map(|number| number.trim().parse::<f64>());
    let numbers = numbers.collect::<Result<Vec<f64>, _>>().map_err(|_| wrong())?;
    let (ridge, classes, network, kernel) = match numbers[..] {
        [ridge, classes, network] => (ridge, classes, network, 0.0),
        [ridge, classes, network, kernel] => (ridge, classes, network, kernel),
        _ => return Err(wrong()),
    };
    Some(HeadWeights { ridge, classes, network, kernel }).filter(HeadWeights::is_sound).ok_or_else(wrong)
}

/// What the training on labelled photos needs of the other options.
pub(crate) struct Training<'a> {
    /// Feature extractor.
    pub(crate) eyes: FeatureExtractor,
    /// Features of the labelled photos are kept in this folder.
    pub(crate) state: Option<&'a Path>,
    /// File to write.
    pub(crate) out: Option<&'a Path>,
    /// Figures to write.
    pub(crate) figures: &'a FigureArgs,
    pub(crate) seed: u64,
    pub(crate) is_json: bool,
}

impl LabelledArgs {
    /// Returns the table of labelled photos.
    pub(crate) fn table(&self) -> Option<&Path> {
        self.photos.as_deref()
    }

    /// Returns the files that are read.
    pub(crate) fn inputs(&self) -> [Option<&Path>; 2] {
        [self.photos.as_deref(), self.drawn_heads.as_deref()]
    }

    fn config(&self, seed: u64) -> anyhow::Result<PhotoConfig> {
        let mut config = PhotoConfig {
            ridge_penalty: self.ridge_penalty,
            class_penalty: self.class_penalty,
            hardness: self.head_weights,
            roughness_of_classes: self.roughness_of_classes,
            calibration: match self.calibrate_on {
                CalibrateOn::Classes => Calibration::Classes,
                CalibrateOn::Sources => Calibration::Sources,
                CalibrateOn::Both => Calibration::Both,
            },
            ..PhotoConfig::usual(seed)
        };
        config.network.n_networks = self.networks as usize;
        config.network.n_epochs = self.network_epochs as usize;
        ensure!(
            config.is_sound(),
            "--ridge-penalty and --class-penalty must be above 0, --roughness-of-classes 0 to 1; correct them"
        );
        Ok(config)
    }

    fn is_kept(&self, photo: &LabelledPhoto) -> bool {
        let note = photo.note.to_lowercase();
        !self.without_note.iter().any(|text| note.contains(&text.to_lowercase()))
    }

    /// Trains a model on the photos of the table, and prints its errors. `train_drawn` trains heads on drawn materials.
    pub(crate) fn train(
        &self,
        photos: &PhotoFiles<'_>,
        of: &Training<'_>,
        train_drawn: impl FnOnce() -> anyhow::Result<PictureModel>,
    ) -> anyhow::Result<()> {
        let started = Instant::now();
        let config = self.config(of.seed)?;
        let table = photos.table.filtered(|photo| self.is_kept(photo));
        let (n_classes, n_sources) = (table.classes.len(), table.sources.len());
        ensure!(
            n_classes >= 3 && n_sources >= 2,
            "at least 3 classes and 2 sources of photos are needed, since each is left out of a training, but there are only {n_classes} and {n_sources}; add photos"
        );
        let kept = of.state.map(|folder| folder.join(format!("photos-{}.safetensors", of.seed)));
        let set = part_of(&photos.set(kept.as_deref())?, &table);
        let drawn = match &self.drawn_heads {
            Some(path) => heads_of(path, &of.eyes)?,
            None => train_drawn()?,
        };
        let rough = set
            .photos
            .iter()
            .map(|photo| drawn_roughness(&drawn, &photo.features))
            .collect::<Result<Vec<Option<Estimate>>, _>>()?;
        let judged = self.judged(&set, &rough, &config)?;
        let progress = Progress::endless("training on all photos");
        let drawn_materials = drawn.learned_from().to_owned();
        let card = self.card(photos, &table, drawn_materials, &config);
        let model = PhotoModel::learn(&set, drawn, &judged, &config, card)?;
        if let Some(out) = of.out {
            atomic::write(out, &model.to_bytes()?)?;
        }
        progress.finish();
        let drawing = draw_classes(of.figures, &set, &judged, &config);
        let out = of.out.map(|out| out.display().to_string());
        let figures = &model.card().figures;
        let result = json!({
            "photos": set.photos.len(),
            "classes": set.classes.len(),
            "sources": set.sources.len(),
            "left_out": figures,
            "out": out,
            "figures": of.figures.folder().map(|folder| folder.display().to_string()),
            "seconds": started.elapsed().as_secs_f64(),
        });
        output::print(of.is_json, &result, || {
            let table = figure_lines(figures).join("\n");
            let written = out.as_ref().map_or(String::new(), |out| format!("\nWrote the model: {out}"));
            format!(
                "Errors on photos whose whole class or source was left out of the training, in points (0 to 100); each class counts with the weight that it has in training.\n{table}\nr: correlation. MAE: mean absolute error. error/dev.: root mean square of error over predicted standard deviation, about 1 if the standard deviations hold.\nThe hardness of the photos is a physical label of their class, and their roughness an estimate from the lexicon; no person rated them.{written}"
            )
        });
        // After the result, which must not be lost with the figures.
        drawing
    }

    /// Predicts each photo with a model that was trained without its class, and with one without its source.
    fn judged(
        &self,
        set: &PhotoSet,
        rough: &[Option<Estimate>],
        config: &PhotoConfig,
    ) -> anyhow::Result<Vec<JudgedPhoto>> {
        let n_folds = |kind| match kind {
            LeftOut::Classes => self.class_folds as usize,
            LeftOut::Sources => self.source_folds as usize,
        };
        let all: Vec<(usize, Fold)> = LeftOut::ALL
            .into_iter()
            .flat_map(|kind| folds(set, kind, n_folds(kind)).into_iter().enumerate())
            .collect();
        let progress = Progress::new("training without classes and sources", all.len());
        let judged = in_parallel(all.len(), |index| {
            let (number, fold) = &all[index];
            let judged = judge(set, (*number, fold), rough, config)
                .with_context(|| format!("{} cannot be left out", left_out_names(set, fold)));
            progress.step();
            judged
        });
        progress.finish();
        Ok(judged.into_iter().collect::<anyhow::Result<Vec<_>>>()?.concat())
    }

    fn card(
        &self,
        photos: &PhotoFiles<'_>,
        table: &PhotoTable,
        drawn_materials: String,
        config: &PhotoConfig,
    ) -> PhotoCard {
        let n_left_out = photos.table.photos.len() - table.photos.len();
        let rule = |text: &String| format!("photos whose note contains \"{text}\"");
        let mut left_out: Vec<String> = self.without_note.iter().map(rule).collect();
        if !left_out.is_empty() {
            left_out.push(counted(n_left_out, "photo"));
        }
        PhotoCard {
            n_photos: table.photos.len(),
            n_classes: table.classes.len(),
            sources: sources(table),
            left_out,
            labels: LABELS.to_owned(),
            drawn_materials,
            n_variations: self.variations as usize,
            settings: config.clone(),
            figures: Vec::new(),
            limits: LIMITS.map(str::to_owned).to_vec(),
        }
    }

    /// Returns the number of variations of each photo.
    pub(crate) fn n_variations(&self) -> usize {
        self.variations as usize
    }
}

/// Origin of the labels, for the model card.
const LABELS: &str = "hardness: a physical label of the class of each photo, from the table of photos; roughness: an estimate from the lexicon by the name of the class. No person touched or rated the surfaces";

/// Known limits, for the model card.
const LIMITS: [&str; 4] = [
    "all photos of a class have the same labels: differences within a class are not predicted",
    "meshes, cork and plain smooth surfaces are often predicted wrongly",
    "a photo does not show the size of a surface, nor what lies beneath it",
    "the error of the roughness is known only against estimates of the classes",
];

/// Reads heads that were trained on drawn materials with the same features.
fn heads_of(path: &Path, eyes: &FeatureExtractor) -> anyhow::Result<PictureModel> {
    let bytes = file::read_file(path, FileKind::Network)?;
    let model = AttributeModel::from_bytes(&bytes).with_context(|| file::in_file(path))?;
    ensure!(
        model.eyes() == eyes,
        "these heads were trained on features of another network ({}); choose other heads, or the same network with --backbone: {}",
        model.eyes().name(),
        path.display()
    );
    Ok(model.drawn().clone())
}

/// Returns the names of the classes or sources that a fold leaves out.
fn left_out_names(set: &PhotoSet, fold: &Fold) -> String {
    let name = |index: &usize| match fold.kind {
        LeftOut::Classes => set.classes[set.photos[*index].class].name.as_str(),
        LeftOut::Sources => set.sources[set.photos[*index].source].as_str(),
    };
    let mut names: Vec<&str> = fold.photos.iter().map(name).collect();
    names.sort_unstable();
    names.dedup();
    format!("the {} {}", fold.kind.noun(), names.join(", "))
}

/// Returns the sources of a table with their licenses and authors, the largest first.
fn sources(table: &PhotoTable) -> Vec<PhotoSource> {
    let of_source = |(index, name): (usize, &String)| {
        let photos = || table.photos.iter().filter(|photo| photo.source == index);
        let distinct = |value: fn(&LabelledPhoto) -> &String| {
            let mut values: Vec<String> =
                photos().map(value).filter(|text| !text.is_empty()).cloned().collect();
            values.sort_unstable();
            values.dedup();
            values
        };
        PhotoSource {
            name: name.clone(),
            n_photos: photos().count(),
            licenses: distinct(|photo| &photo.license),
            authors: distinct(|photo| &photo.author),
        }
    };
    let mut sources: Vec<PhotoSource> = table.sources.iter().enumerate().map(of_source).collect();
    sources.sort_by_key(|source| std::cmp::Reverse(source.n_photos));
    sources
}

#[cfg(test)]
mod tests {
    use super::{parse_weights, sources};
    use shagreen_formats::photo_table::read_photo_table;

    #[test]
    fn weights_are_three_or_four_numbers() {
        let weights = parse_weights("2, 1,0.5").unwrap();
        assert_eq!([weights.ridge, weights.classes, weights.network], [2.0, 1.0, 0.5]);
        assert_eq!(weights.kernel, 0.0);
        assert_eq!(parse_weights("0,0,0,2").unwrap().kernel, 2.0);
        for wrong in ["1,1", "1,1,1,1,1", "1,x,1,1", "a", "", "0,0,0", "1,-1,1", "1,inf,1"] {
            assert!(parse_weights(wrong).is_err(), "{wrong}");
        }
    }

    #[test]
    fn the_card_names_each_source_with_its_licenses_and_authors() {
        let table = "file,class,softness,softness_sd,source,license,author\n\
            a.jpg,brick,9,7,mine,CC0,Ann\n\
            b.jpg,brick,9,7,theirs,MIT,Ben\n\
            c.jpg,brick,9,7,theirs,CC-BY 3.0,\n";
        let sources = sources(&read_photo_table(table.as_bytes()).unwrap());
        assert_eq!((sources[0].name.as_str(), sources[0].n_photos), ("theirs", 2));
        assert_eq!(sources[0].licenses, ["CC-BY 3.0", "MIT"]);
        assert_eq!(sources[0].authors, ["Ben"]);
        assert_eq!(sources[1].authors, ["Ann"]);
    }
}
