//! Strokes that networks are trained on: rendered from texture models, or recorded.

use std::path::{Path, PathBuf};

use anyhow::{Context as _, bail, ensure};
use shagreen_core::recording::fit::Stroke;
use shagreen_core::texture::patterns::PAPER_RATE;
use shagreen_core::words::counted;
use shagreen_formats::attribute_table::AttributeTable;
use shagreen_formats::bounded_file::FileKind;
use shagreen_formats::library::Library;
use shagreen_formats::recording::{Ask, ColumnMap};
use shagreen_formats::texture_files::{TextureFile, TextureFileKind, read_texture_files};
use shagreen_learn::stroke_set::StrokedTexture;

use crate::cli::output::{self, Printed};
use crate::cli::recording_answers::{map_of, parse_answer};
use crate::cli::stroke_recordings::StrokeRecordings;
use crate::cli::train_networks::network_kind::Axes;
use shagreen_studio::file;
use shagreen_studio::near_names::unknown_texture;
use shagreen_studio::training_strokes::{of_textures, rendered_strokes};

#[derive(clap::Args)]
pub(super) struct RecordingTableArgs {
    /// Table of recordings on which networks are trained, instead of on strokes rendered from the texture models: a CSV
    /// file with the columns texture (its id in the library) and recording (a file, relative to the table). Every texture
    /// with attributes needs a recording.
    #[arg(long, value_name = "TABLE.csv", conflicts_with = "share")]
    recordings: Option<PathBuf>,
    /// Column map of the recordings: a TOML file that states their columns and units.
    #[arg(long, value_name = "MAP.toml", requires = "recordings")]
    map: Option<PathBuf>,
    /// State a property that the recordings do not contain, for example acceleration_unit=g; overrides the column map.
    /// Can be given several times.
    #[arg(long = "set", value_name = "KEY=VALUE", value_parser = parse_answer, requires = "recordings")]
    answers: Vec<(Ask, String)>,
}

impl RecordingTableArgs {
    /// Returns the table of recordings that was named.
    pub(super) fn path(&self) -> Option<&Path> {
        self.recordings.as_deref()
    }
}

/// Returns the 25 strokes of the paper on each texture ([`rendered_strokes`]), and prints its warnings.
pub(super) fn rendered(
    library: &Library,
    table: &AttributeTable,
    share: f64,
    seed: u64,
) -> anyhow::Result<Vec<StrokedTexture>> {
    rendered_strokes(library, table, share, seed, &Printed)
}

/// Returns the strokes in the recordings of each texture, at the sample rate of the networks. `path` is the table of
/// recordings, and `n_samples` the length of a segment.
pub(super) fn recorded(
    args: &RecordingTableArgs,
    path: &Path,
    (library, table): (&Library, &AttributeTable),
    axes: Axes,
    n_samples: usize,
) -> anyhow::Result<Vec<StrokedTexture>> {
    let map = map_of(args.map.as_deref(), &args.answers)?;
    let listed = read_texture_files(&file::read_file(path, FileKind::Table)?, TextureFileKind::Recording)
        .with_context(|| file::in_file(path))?;
    check_textures(&listed, library, table).with_context(|| file::in_file(path))?;
    let folder = path.parent().unwrap_or(Path::new(""));
    of_textures(library, table, |texture_id, _| {
        let of_texture = listed.iter().filter(|listed| listed.texture == texture_id);
        let files: Vec<PathBuf> = of_texture.map(|listed| folder.join(&listed.file)).collect();
        let strokes = read_strokes(&files, &map, axes)?;
        ensure!(
            strokes.iter().any(|stroke| stroke.speed_mps.len() >= n_samples),
            "no stroke in the recordings is as long as the {} s that the networks need; record longer strokes",
            n_samples as f64 / PAPER_RATE.0
        );
        Ok(strokes)
    })
}

/// Checks that the table names textures of the library, and a recording for each texture with attributes.
fn check_textures(listed: &[TextureFile], library: &Library, table: &AttributeTable) -> anyhow::Result<()> {
    let is_unknown = |listed: &&TextureFile| library.index_of(&listed.texture).is_none();
    if let Some(TextureFile { texture, line, .. }) = listed.iter().find(is_unknown) {
        bail!("line {line}: {}", unknown_texture(library, texture));
    }
    let ids = table.textures.iter().map(|index| library.textures[*index].id.as_str());
    let missing: Vec<&str> = ids.filter(|id| listed.iter().all(|listed| listed.texture != *id)).collect();
    ensure!(
        missing.is_empty(),
        "the table names no recording of {} ({}); add their recordings, or choose a library without them",
        counted(missing.len(), "texture"),
        missing.join(", ")
    );
    Ok(())
}

/// Reads the strokes in recordings, and warns of recordings at a lower rate than that of the networks.
fn read_strokes(files: &[PathBuf], map: &ColumnMap, axes: Axes) -> anyhow::Result<Vec<Stroke>> {
    let recordings = StrokeRecordings::read(files, map, axes == Axes::Three)?;
    for (index, rate_hz) in recordings.low_rates_hz() {
        output::warn(&format!(
            "the networks are trained at {} Hz; a recording at {rate_hz:.0} Hz lacks the highest frequencies: {}",
            PAPER_RATE.0,
            files[index].display()
        ));
    }
    Ok(recordings.strokes()?)
}

/// Returns the lowest and highest tip speed, in mm/s, and normal force, in N, of all strokes.
pub(super) fn ranges(textures: &[StrokedTexture]) -> ([f64; 2], [f64; 2]) {
    let strokes = || textures.iter().flat_map(|texture| &texture.strokes);
    let speeds_mm_per_s = strokes().flat_map(|stroke| &stroke.speed_mps).map(|speed| 1e3 * speed);
    let forces_n = strokes().flat_map(|stroke| &stroke.force_n).copied();
    (range_of(speeds_mm_per_s), range_of(forces_n))
}

/// Lowest and highest value, neither below 0; a sensor may drift below it.
fn range_of(values: impl Iterator<Item = f64>) -> [f64; 2] {
    let (low, high) =
        values.fold((f64::INFINITY, 0.0_f64), |(low, high), value| (low.min(value), high.max(value)));
    [low.clamp(0.0, high), high]
}

#[cfg(test)]
mod tests {
    use super::{check_textures, range_of};
    use shagreen_formats::attribute_table::attribute_table;
    use shagreen_formats::starter::starter_library;
    use shagreen_formats::texture_files::TextureFile;

    #[test]
    fn each_texture_needs_a_recording_and_each_recording_a_texture() {
        let library = starter_library().unwrap();
        let table = attribute_table(&library).unwrap();
        let listed = |texture: &str| TextureFile {
            texture: texture.to_owned(),
            file: format!("{texture}.csv"),
            line: 7,
        };
        let all: Vec<TextureFile> = library.textures.iter().map(|texture| listed(&texture.id)).collect();
        assert!(check_textures(&all, &library, &table).is_ok());
        let error = check_textures(&all[1..], &library, &table).unwrap_err().to_string();
        assert!(error.contains("1 texture") && error.contains(&library.textures[0].id), "{error}");
        let error = check_textures(&[listed("crok")], &library, &table).unwrap_err().to_string();
        assert!(error.contains("line 7") && error.contains("cork"), "{error}");
    }

    #[test]
    fn a_range_has_no_negative_end() {
        assert_eq!(range_of([0.2, 0.1, 0.4].into_iter()), [0.1, 0.4]);
        assert_eq!(range_of([0.2, -0.01].into_iter()), [0.0, 0.2]);
        assert_eq!(range_of([].into_iter()), [0.0, 0.0]);
    }
}
