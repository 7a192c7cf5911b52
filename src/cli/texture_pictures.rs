//! Pictures of the textures of a library as training data: those in the library, and more of them in a table.

use std::path::{Path, PathBuf};

use anyhow::{Context as _, anyhow, ensure};
use shagreen_core::space::LabelSource;
use shagreen_core::surfaces::shading::Picture as Surface;
use shagreen_core::surfaces::starter::FRAMING;
use shagreen_core::words::counted;
use shagreen_formats::bounded_file::FileKind;
use shagreen_formats::library::{Library, TextureEntry};
use shagreen_formats::picture::{Picture, decode, photo_pixels};
use shagreen_formats::texture_files::{TextureFileKind, read_texture_files};
use shagreen_learn::picture_set::Seen;

use crate::cli::output;
use shagreen_studio::file;
use shagreen_studio::near_names::unknown_texture;
use shagreen_studio::parallel::in_parallel;

/// Fewest textures for a leave-one-out evaluation.
const LEAST_TEXTURES: usize = 3;

#[derive(clap::Args)]
pub(crate) struct PictureArgs {
    /// Table of further pictures of the textures: a CSV file with the columns texture (its id) and picture (a file,
    /// relative to the folder of the table). All pictures of a texture are left out of training together, and their
    /// predictions are averaged.
    #[arg(long, value_name = "TABLE.csv")]
    pictures: Option<PathBuf>,
}

/// Texture with a known position and at least one picture.
pub(crate) struct PicturedTexture {
    /// Name of the texture.
    pub(crate) name: String,
    /// Features and labels of each picture; the labels are the same.
    pub(crate) pictures: Vec<Seen>,
}

/// A picture that is not yet decoded.
enum Source<'a> {
    /// Of a texture of the library, with its id.
    Library(&'a str, &'a Picture),
    /// A file of the table.
    File(PathBuf),
}

impl Source<'_> {
    /// Returns the features of the picture, computed by `see`.
    fn features(&self, see: impl FnOnce(&Surface) -> anyhow::Result<Vec<f32>>) -> anyhow::Result<Vec<f32>> {
        match self {
            Self::Library(id, picture) => decode(picture)
                .map_err(anyhow::Error::from)
                .and_then(|pixels| see(&pixels.into_surface(picture.millimeters)))
                .with_context(|| format!("the picture of \"{id}\"")),
            Self::File(path) => photo_pixels(&file::read_file(path, FileKind::Picture)?)
                .map_err(anyhow::Error::from)
                // The size of the surface in a photo is unknown; no feature depends on it.
                .and_then(|pixels| see(&pixels.into_surface(FRAMING.millimeters)))
                .with_context(|| file::in_file(path)),
        }
    }
}

impl PictureArgs {
    /// Returns the table that was named.
    pub(crate) fn path(&self) -> Option<&Path> {
        self.pictures.as_deref()
    }

    /// Returns the features, computed by `see`, of all pictures of the textures that have a position and a picture. An
    /// estimated position does not count: it is a prediction itself.
    pub(crate) fn textures(
        &self,
        library: &Library,
        see: impl Fn(&Surface) -> anyhow::Result<Vec<f32>> + Sync,
    ) -> anyhow::Result<Vec<PicturedTexture>> {
        let mut sources: Vec<Vec<Source<'_>>> = library
            .textures
            .iter()
            .map(|texture| {
                let own = texture.picture.as_ref().filter(|_| labels_of(texture).is_some());
                own.map(|picture| Source::Library(&texture.id, picture)).into_iter().collect()
            })
            .collect();
        for (texture_idx, path) in self.files(library)? {
            sources[texture_idx].push(Source::File(path));
        }
        let flat: Vec<&Source<'_>> = sources.iter().flatten().collect();
        let features = in_parallel(flat.len(), |index| flat[index].features(&see));
        let mut features = features.into_iter();
        let mut textures = Vec::new();
        for (texture, sources) in library.textures.iter().zip(&sources) {
            let of_texture = features.by_ref().take(sources.len()).collect::<anyhow::Result<Vec<_>>>()?;
            let Some(labels) = labels_of(texture).filter(|_| !of_texture.is_empty()) else { continue };
            let seen = |features| Seen { features, labels: labels.clone() };
            let pictures = of_texture.into_iter().map(seen).collect();
            textures.push(PicturedTexture { name: texture.name.clone(), pictures });
        }
        ensure!(
            textures.len() >= LEAST_TEXTURES,
            "\"{}\" has only {} with a picture and a position that is not an estimate, but at least three are needed; add pictures to the library in the window, or name them with --pictures",
            library.name,
            counted(textures.len(), "texture")
        );
        Ok(textures)
    }

    /// Returns the files of the table, each with the index of its texture. Those of textures without a known position are
    /// left out, with a warning.
    fn files(&self, library: &Library) -> anyhow::Result<Vec<(usize, PathBuf)>> {
        let Some(table) = &self.pictures else { return Ok(Vec::new()) };
        let read = read_texture_files(&file::read_file(table, FileKind::Table)?, TextureFileKind::Picture);
        let folder = file::folder_of(table);
        let mut files = Vec::new();
        let mut n_without_place = vec![0; library.textures.len()];
        for row in read.with_context(|| file::in_file(table))? {
            let texture_idx = library
                .index_of(&row.texture)
                .ok_or_else(|| anyhow!("line {}: {}", row.line, unknown_texture(library, &row.texture)))
                .with_context(|| file::in_file(table))?;
            if labels_of(&library.textures[texture_idx]).is_some() {
                files.push((texture_idx, folder.join(row.file)));
            } else {
                n_without_place[texture_idx] += 1;
            }
        }
        for (texture, n) in library.textures.iter().zip(n_without_place).filter(|(_, n)| *n > 0) {
            output::warn(&format!(
                "\"{}\" has no position that is not an estimate, so {} of the table cannot be used: {}",
                texture.id,
                counted(n, "picture"),
                table.display()
            ));
        }
        Ok(files)
    }
}

/// Returns the position of a texture on both axes, unless it is an estimate.
fn labels_of(texture: &TextureEntry) -> Option<Vec<f64>> {
    let place = texture.place.filter(|place| place.source != LabelSource::Estimated)?;
    Some(vec![place.at.x(), place.at.y()])
}

#[cfg(test)]
mod tests {
    use super::PictureArgs;
    use shagreen_core::space::LabelSource;
    use shagreen_formats::picture::encode_png;
    use shagreen_formats::starter::starter_library;
    use std::path::Path;

    /// Writes a gray picture.
    fn write(folder: &Path, name: &str, level: u8) {
        let rgb = shagreen_formats::picture::Rgb { width: 20, height: 20, pixels: vec![level; 1200] };
        std::fs::write(folder.join(name), encode_png(&rgb).unwrap()).unwrap();
    }

    #[test]
    fn pictures_of_the_table_join_those_of_the_library() {
        let folder = tempfile::tempdir().unwrap();
        std::fs::create_dir(folder.path().join("more")).unwrap();
        write(folder.path(), "a.png", 10);
        write(folder.path(), "more/b.png", 90);
        write(folder.path(), "c.png", 200);
        let table = folder.path().join("pictures.csv");
        std::fs::write(&table, "texture,picture\ncork,a.png\ncork,more/b.png\nglass,c.png\n").unwrap();
        let mut library = starter_library().unwrap();
        let args = PictureArgs { pictures: Some(table.clone()) };
        let read = |library: &_| {
            args.textures(library, |surface| Ok(vec![f32::from(surface.rgb[0]), surface.width as f32]))
        };
        let textures = read(&library).unwrap();
        assert_eq!(textures.len(), 25);
        let cork = textures.iter().find(|texture| texture.name == "Cork").unwrap();
        let features: Vec<&[f32]> = cork.pictures.iter().map(|seen| &seen.features[..]).collect();
        assert_eq!(features[1..], [[10.0, 20.0], [90.0, 20.0]]);
        assert!(cork.pictures.iter().all(|seen| seen.labels == cork.pictures[0].labels));
        let n_pictures: usize = textures.iter().map(|texture| texture.pictures.len()).sum();
        assert_eq!(n_pictures, 28);

        // A texture needs no picture in the library, but a position that is not an estimate.
        let [cork, glass] = ["cork", "glass"].map(|id| library.index_of(id).unwrap());
        library.textures[cork].picture = None;
        library.textures[glass].place.as_mut().unwrap().source = LabelSource::Estimated;
        let textures = read(&library).unwrap();
        assert_eq!(textures.len(), 24);
        assert_eq!(textures.iter().find(|texture| texture.name == "Cork").unwrap().pictures.len(), 2);

        let fails = |text: &str, words: &[&str]| {
            std::fs::write(&table, text).unwrap();
            let error = format!("{:#}", read(&starter_library().unwrap()).err().expect("an error"));
            assert!(words.iter().all(|word| error.contains(word)), "{error}");
        };
        fails("texture,picture\ncrok,a.png\n", &["line 2", "did you mean cork?", "pictures.csv"]);
        fails("texture,picture\ncork,none.png\n", &["no such file", "none.png"]);
        fails("texture,picture\ncork,pictures.csv\n", &["not a picture", "pictures.csv"]);
        fails("texture,picture\ncork,a.png\nglass,a.png\n", &["in line 2 and again in line 3"]);
    }
}
