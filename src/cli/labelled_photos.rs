//! Labelled photos as training data: reads their table, and computes their features only once.

use std::collections::HashMap;
use std::path::{Path, PathBuf};

use anyhow::{Context as _, ensure};
use shagreen_core::maths::rng::derive_seed;
use shagreen_core::surfaces::photo_variation::Variation;
use shagreen_core::surfaces::picture_doubts::Detail;
use shagreen_core::surfaces::prompt::interpret;
use shagreen_core::surfaces::starter::FRAMING;
use shagreen_formats::atomic;
use shagreen_formats::bounded_file::FileKind;
use shagreen_formats::lexicon_toml::built_in_lexicon;
use shagreen_formats::photo_table::{PhotoClass, PhotoTable, read_photo_table};
use shagreen_formats::picture::{Rgb, photo_pixels, recompressed};
use shagreen_learn::backbone::Backbone;
use shagreen_learn::model_file::sha256_of;
use shagreen_learn::photo_set::{MaterialClass, PhotoFeatures, PhotoSet, SeenPhoto};
use shagreen_learn::picture_predictor::{see_late, see_photo};

use crate::cli::output;
use crate::cli::progress::Progress;
use shagreen_studio::file;
use shagreen_studio::parallel::in_parallel;

/// Version of the features. Increase it when views, variations or the extracted features change.
const VERSION: u32 = 2;
/// Number of photos after which the extracted features are saved.
const N_AT_ONCE: usize = 100;

/// Labelled photos in a table, and where they lie.
pub(crate) struct PhotoFiles<'a> {
    /// All photos of the table.
    pub(crate) table: PhotoTable,
    /// Folder that the files are relative to.
    folder: PathBuf,
    backbone: Option<&'a Backbone>,
    seed: u64,
    n_variations: usize,
}

/// Features of one photo, with the SHA-256 of its file.
#[derive(Clone)]
struct Looked {
    sha256: String,
    features: PhotoFeatures,
}

impl<'a> PhotoFiles<'a> {
    /// Reads the table.
    pub(crate) fn read(
        path: &Path,
        backbone: Option<&'a Backbone>,
        seed: u64,
        n_variations: usize,
    ) -> anyhow::Result<Self> {
        let table = read_photo_table(&file::read_file(path, FileKind::Table)?)
            .with_context(|| file::in_file(path))?;
        Ok(Self { table, folder: file::folder_of(path), backbone, seed, n_variations })
    }

    /// Returns the features of all photos of the table. With a file `kept`, features that it contains are not computed
    /// again, and the others are added to it. The labels are always those of the table.
    pub(crate) fn set(&self, kept: Option<&Path>) -> anyhow::Result<PhotoSet> {
        let classes = self.table.classes.iter().map(material_class).collect::<anyhow::Result<Vec<_>>>()?;
        let before = kept.filter(|path| path.exists()).map(|path| self.earlier(path)).transpose()?;
        let n = self.table.photos.len();
        let hashes = in_parallel(n, |index| self.bytes(index).map(|bytes| sha256_of(&bytes)));
        let hashes: Vec<String> = hashes.into_iter().collect::<anyhow::Result<_>>()?;
        let mut known: HashMap<String, SeenPhoto> =
            before.into_iter().flat_map(|set| set.photos).map(|photo| (photo.file.clone(), photo)).collect();
        let mut looked: Vec<Option<Looked>> = self
            .table
            .photos
            .iter()
            .zip(hashes)
            .map(|(photo, sha256)| {
                let photo = known.remove(&photo.file).filter(|known| known.sha256 == sha256)?;
                Some(Looked { sha256, features: photo.features })
            })
            .collect();
        let missing: Vec<usize> = (0..n).filter(|index| looked[*index].is_none()).collect();
        let progress = Progress::new("computing the features of photos", n);
        progress.steps(n - missing.len());
        for some in missing.chunks(N_AT_ONCE) {
            let found = in_parallel(some.len(), |index| {
                let found = self.look(some[index]);
                progress.step();
                found
            });
            for (index, found) in some.iter().zip(found) {
                looked[*index] = Some(found?);
            }
            if let Some(path) = kept {
                atomic::write(path, &self.joined(&classes, &looked).to_bytes()?)?;
            }
        }
        progress.finish();
        let set = self.joined(&classes, &looked);
        // Labels that were changed since are kept too, for experiments with the file.
        if let Some(path) = kept.filter(|_| missing.is_empty()) {
            atomic::write(path, &set.to_bytes()?)?;
        }
        Ok(set)
    }

    /// Reads the features of an earlier run by the same method.
    fn earlier(&self, path: &Path) -> anyhow::Result<PhotoSet> {
        let set = PhotoSet::from_bytes(&file::read_file(path, FileKind::Network)?)
            .with_context(|| file::in_file(path))?;
        ensure!(
            set.made_by == self.made_by(),
            "the saved features were made by another network, seed or number of variations; choose another folder with --state: {}",
            path.display()
        );
        Ok(set)
    }

    fn made_by(&self) -> String {
        let eyes = self.backbone.map_or("statistics", Backbone::sha256);
        format!("{} variations of seed {}, seen by {eyes} (version {VERSION})", self.n_variations, self.seed)
    }

    /// Returns the set of the photos whose features are known.
    fn joined(&self, classes: &[MaterialClass], looked: &[Option<Looked>]) -> PhotoSet {
        let known = self.table.photos.iter().zip(looked);
        let photos = known
            .filter_map(|(photo, looked)| {
                let Looked { sha256, features } = looked.clone()?;
                let (class, source) = (photo.class, photo.source);
                Some(SeenPhoto { file: photo.file.clone(), sha256, class, source, features })
            })
            .collect();
        let sources = self.table.sources.clone();
        PhotoSet { made_by: self.made_by(), classes: classes.to_vec(), sources, photos }
    }

    fn path(&self, index: usize) -> PathBuf {
        self.folder.join(&self.table.photos[index].file)
    }

    fn bytes(&self, index: usize) -> anyhow::Result<Vec<u8>> {
        file::read_file(&self.path(index), FileKind::Picture)
    }

    fn look(&self, index: usize) -> anyhow::Result<Looked> {
        let bytes = self.bytes(index)?;
        let features = self.features(&self.table.photos[index].file, &bytes);
        let features = features.with_context(|| file::in_file(&self.path(index)))?;
        Ok(Looked { sha256: sha256_of(&bytes), features })
    }

    /// Returns the features of the views of a photo, then of its variations.
    fn features(&self, name: &str, bytes: &[u8]) -> anyhow::Result<PhotoFeatures> {
        // The size of the surface in a photo is unknown; no feature depends on it.
        let photo = photo_pixels(bytes)?.into_surface(FRAMING.millimeters);
        let mut features = see_photo(self.backbone, &photo)?;
        for number in 0..self.n_variations {
            let seed = derive_seed(self.seed, &format!("{name} {number}"));
            let variation = Variation::draw(seed, photo.width.min(photo.height));
            let varied = variation.apply(&photo)?;
            let compressed = recompressed(&Rgb::from(&varied), variation.jpeg_quality)?;
            features.late.push(see_late(self.backbone, &compressed.into_surface(varied.millimeters))?);
        }
        // Rounded as in the file, so that a resumed training gives the same result.
        let kept = |x: f64| f64::from(x as f32);
        let Detail { rms, sharpness_db } = features.detail;
        features.detail = Detail { rms: kept(rms), sharpness_db: kept(sharpness_db) };
        Ok(features)
    }
}

/// Returns the part of a set whose photos are in a filtered table of the same photos, with the classes and sources of the
/// latter.
pub(crate) fn part_of(set: &PhotoSet, table: &PhotoTable) -> PhotoSet {
    let by_file: HashMap<&str, &SeenPhoto> =
        set.photos.iter().map(|photo| (photo.file.as_str(), photo)).collect();
    let by_name: HashMap<&str, &MaterialClass> =
        set.classes.iter().map(|class| (class.name.as_str(), class)).collect();
    let photos = table.photos.iter().filter_map(|photo| {
        let known = by_file.get(photo.file.as_str())?;
        Some(SeenPhoto { class: photo.class, source: photo.source, ..(*known).clone() })
    });
    let classes = table.classes.iter().filter_map(|class| by_name.get(class.name.as_str()));
    PhotoSet {
        made_by: set.made_by.clone(),
        classes: classes.map(|class| (*class).clone()).collect(),
        sources: table.sources.clone(),
        photos: photos.collect(),
    }
}

/// Returns a class with its roughness: that of its entry in the lexicon, or else that of the words of its name.
fn material_class(class: &PhotoClass) -> anyhow::Result<MaterialClass> {
    let lexicon = built_in_lexicon()?;
    let of_entry = lexicon.material(&class.name).and_then(|(_, [rough_smooth, ..])| *rough_smooth);
    let rough_smooth = of_entry.unwrap_or_else(|| {
        let understood = interpret(&class.name, lexicon);
        if !understood.is_about_touch() {
            output::warn(&format!(
                "the lexicon does not contain \"{}\", so the roughness of this class is unknown",
                class.name
            ));
        }
        let [rough_smooth, ..] = understood.attributes;
        rough_smooth
    });
    Ok(MaterialClass {
        name: class.name.clone(),
        hard_soft: class.softness,
        hard_soft_sd: class.softness_sd,
        rough_smooth: rough_smooth.mean,
        rough_smooth_sd: rough_smooth.deviation,
    })
}

#[cfg(test)]
mod tests {
    use super::{PhotoClass, PhotoFiles, built_in_lexicon, material_class, part_of};
    use shagreen_formats::picture::{Rgb, encode_png};
    use std::path::Path;

    fn write(folder: &Path, name: &str, level: u8) {
        let pixels = (0..40 * 40 * 3).map(|i: u32| level.wrapping_add((i * 37 % 50) as u8)).collect();
        let rgb = Rgb { width: 40, height: 40, pixels };
        std::fs::write(folder.join(name), encode_png(&rgb).unwrap()).unwrap();
    }

    const HEADER: &str = "file,class,softness,softness_sd,source,license\n";

    #[test]
    fn features_are_computed_once_and_again_for_a_photo_that_changed() {
        let folder = tempfile::tempdir().unwrap();
        write(folder.path(), "a.png", 20);
        write(folder.path(), "b.png", 120);
        let table = folder.path().join("photos.csv");
        let lines = "a.png,brick,9,7,s,CC0\nb.png,carpet,85,8,t,CC0\n";
        std::fs::write(&table, format!("{HEADER}{lines}")).unwrap();
        let kept = folder.path().join("photos.safetensors");
        let set = |n| PhotoFiles::read(&table, None, 3, n).unwrap().set(Some(kept.as_path()));
        let first = set(1).unwrap();
        assert_eq!((first.photos.len(), first.photos[0].features.late.len()), (2, 6));
        assert_eq!(set(1).unwrap(), first);
        // Labels come from the table, and so does the order.
        let turned = "b.png,carpet,80,8,t,CC0\na.png,brick,9,7,s,CC0\n";
        std::fs::write(&table, format!("{HEADER}{turned}")).unwrap();
        let second = set(1).unwrap();
        assert_eq!(second.photos[1].features, first.photos[0].features);
        assert_eq!(second.classes[second.photos[0].class].hard_soft, 80.0);
        write(folder.path(), "a.png", 77);
        let third = set(1).unwrap();
        assert_ne!(third.photos[1].features, second.photos[1].features);
        assert_eq!(third.photos[0], second.photos[0]);
        let error = set(2).unwrap_err().to_string();
        assert!(error.contains("--state"), "{error}");
        std::fs::write(folder.path().join("b.png"), b"no picture").unwrap();
        let error = format!("{:#}", set(1).unwrap_err());
        assert!(error.contains("b.png"), "{error}");
    }

    #[test]
    fn a_part_has_its_own_classes_and_sources() {
        let folder = tempfile::tempdir().unwrap();
        write(folder.path(), "a.png", 20);
        write(folder.path(), "b.png", 120);
        let table = folder.path().join("photos.csv");
        std::fs::write(&table, format!("{HEADER}a.png,brick,9,7,s,CC0\nb.png,carpet,85,8,t,MIT\n")).unwrap();
        let files = PhotoFiles::read(&table, None, 3, 0).unwrap();
        let set = files.set(None).unwrap();
        let part = part_of(&set, &files.table.filtered(|photo| photo.license == "MIT"));
        assert_eq!((part.photos.len(), part.photos[0].class, part.photos[0].source), (1, 0, 0));
        assert_eq!((part.classes[0].name.as_str(), part.sources[0].as_str()), ("carpet", "t"));
        assert_eq!(part.photos[0].features, set.photos[1].features);
    }

    #[test]
    fn the_roughness_of_a_class_is_that_of_its_name_in_the_lexicon() {
        let class = |name: &str| {
            let class = PhotoClass { name: name.to_owned(), softness: 9.0, softness_sd: 7.0 };
            material_class(&class).unwrap()
        };
        let brick = class("brick");
        assert!(brick.rough_smooth < 20.0 && brick.rough_smooth_sd < 15.0, "{brick:?}");
        assert_eq!((brick.hard_soft, brick.hard_soft_sd), (9.0, 7.0));
        // The entry that stands for the class, not the word in its name.
        let lexicon = built_in_lexicon().unwrap();
        let plush = lexicon.material("plush").unwrap().1[0].unwrap();
        assert_eq!(
            (class("plush").rough_smooth, class("plush").rough_smooth_sd),
            (plush.mean, plush.deviation)
        );
        // An unknown name says nothing.
        let unknown = class("zzyzx");
        assert_eq!((unknown.rough_smooth, unknown.rough_smooth_sd), (50.0, 28.9));
    }
}
