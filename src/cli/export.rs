//! `shagreen export`: exports one or all textures for other programs.

use std::path::{Path, PathBuf};

use anyhow::{Context as _, bail};
use clap::builder::{PossibleValue, PossibleValuesParser, TypedValueParser};
use serde_json::{Value, json};
use shagreen_core::texture::shape::Shape;
use shagreen_formats::library::{Library, TextureEntry};
use shagreen_studio::export::{
    self, Batch, ExistingFiles, ExportFormat, ExportOutcome, all_lost, export_all,
};
use shagreen_studio::near_names::unknown_texture;
use shagreen_studio::project::{load_project, textures_by_id};
use shagreen_studio::replace::refuse_inputs;

use crate::cli::library_args::LibraryArgs;
use crate::cli::output::{self, Printed};
use crate::cli::own_folder::permitted_libraries;
use crate::cli::shape_args::ShapeArgs;

/// Exports one texture, or all of a library, in the format of another program, and reports what that format cannot store.
#[derive(clap::Args)]
pub(crate) struct Args {
    /// Texture of the library, by id.
    #[arg(long, value_name = "ID", required_unless_present = "all")]
    texture: Option<String>,
    /// Export every texture into the folder --out, each to a file named after its id.
    #[arg(long, conflicts_with = "texture")]
    all: bool,
    /// Replace files of the same format that exist in the folder.
    #[arg(long, requires = "all")]
    replace: bool,
    #[command(flatten)]
    library: LibraryArgs,
    /// Project file. The textures are then those of the project: its library and the textures added to it.
    #[arg(long, value_name = "PROJECT", conflicts_with = "library")]
    project: Option<PathBuf>,
    #[command(flatten)]
    shape: ShapeArgs,
    /// File format. `shagreen render` writes the WAV file of a stroke.
    #[arg(long, value_parser = parser())]
    format: Format,
    /// File to write; with --all, the folder of the files.
    #[arg(short = 'o', long = "out", value_name = "OUT")]
    out: PathBuf,
    /// Print the result as one JSON object.
    #[arg(long)]
    json: bool,
}

pub(crate) fn run(args: &Args) -> anyhow::Result<()> {
    match &args.texture {
        Some(id) => export_one(args, id),
        None => export_every(args),
    }
}

fn export_one(args: &Args, id: &str) -> anyhow::Result<()> {
    refuse_inputs(&[&args.out], &[args.source()])?;
    let library = args.load()?;
    let Some(index) = library.index_of(id) else { bail!(unknown_texture(&library, id)) };
    let texture = &export::shaped(&library.textures[index], &args.shape.or(Shape::default()))?;
    let out = (args.out.as_path(), output::CREATED_BY);
    let ExportOutcome { files, lost, license, warnings } =
        export::export(&library, texture, args.format.0, out, &Printed)?;
    let files: Vec<String> = files.iter().map(|file| file.display().to_string()).collect();
    output::print(
        args.json,
        &json!({"files": files, "lost": lost, "warnings": warnings, "licence": license}),
        || format!("Wrote \"{}\" as {}: {}", texture.name, args.format.0.id(), files.join(", ")),
    );
    Ok(())
}

fn export_every(args: &Args) -> anyhow::Result<()> {
    let (library, format, folder) = (args.load()?, args.format.0, args.out.as_path());
    let shape = args.shape.or(Shape::default());
    let shaped = |texture: &TextureEntry| {
        export::shaped(texture, &shape).with_context(|| format!("\"{}\" cannot have this shape", texture.id))
    };
    let entries = library.textures.iter().map(shaped).collect::<anyhow::Result<Vec<_>>>()?;
    let paths = export::paths_in(folder, entries.iter().map(|entry| &entry.id), format.ending());
    refuse_inputs(&paths.iter().map(PathBuf::as_path).collect::<Vec<_>>(), &[args.source()])?;
    let batch = Batch { folder, replaces: args.replace, created_by: output::CREATED_BY };
    let outcomes = export_all(&library, &entries, format, &batch, &Printed).map_err(|error| {
        let can_replace = error.is::<ExistingFiles>();
        if can_replace { error.context("nothing was written; --replace replaces the files") } else { error }
    })?;
    let shown = |outcome: &ExportOutcome| {
        outcome.files.iter().map(|file| file.display().to_string()).collect::<Vec<_>>()
    };
    let each: Vec<Value> = entries
        .iter()
        .zip(&outcomes)
        .map(|(entry, outcome)| {
            json!({"id": entry.id, "files": shown(outcome), "lost": outcome.lost, "licence": outcome.license})
        })
        .collect();
    let files: Vec<String> = outcomes.iter().flat_map(shown).collect();
    let warnings: Vec<&String> = outcomes.iter().flat_map(|outcome| &outcome.warnings).collect();
    let result = json!({
        "files": files,
        "lost": all_lost(&outcomes),
        "warnings": warnings,
        "exported": each,
        "folder": folder.display().to_string(),
    });
    output::print(args.json, &result, || {
        let line = |(entry, outcome): (&TextureEntry, &ExportOutcome)| {
            format!("{}: {}\n", entry.id, shown(outcome).join(", "))
        };
        let lines: String = entries.iter().zip(&outcomes).map(line).collect();
        format!("{lines}Exported {} textures as {} into {}", entries.len(), format.id(), folder.display())
    });
    Ok(())
}

impl Args {
    /// Returns the library or project that was named.
    fn source(&self) -> Option<&Path> {
        self.project.as_deref().or(self.library.path())
    }

    /// Loads the textures to choose from.
    fn load(&self) -> anyhow::Result<Library> {
        match &self.project {
            Some(path) => textures_by_id(&load_project(path, &permitted_libraries(), &Printed)?, &Printed),
            None => self.library.load(),
        }
    }
}

/// Format selected from [`export::FORMATS`].
#[derive(Clone, Copy)]
struct Format(&'static dyn ExportFormat);

/// Parses the id of a format; the help lists all of them.
fn parser() -> impl TypedValueParser<Value = Format> {
    let ids = export::FORMATS.map(|format| PossibleValue::new(format.id()).help(format.help()));
    PossibleValuesParser::new(ids)
        .try_map(|id| export::format(&id).map(Format).ok_or_else(|| format!("{id} is not a format")))
}
