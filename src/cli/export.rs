//! `shagreen export`: exports one or all textures for other programs.

use std::path::{Path, PathBuf};

use anyhow::{Context as _, bail};
use clap::builder::{PossibleValue, PossibleValuesParser, TypedValueParser};
use serde_json::{Value, json};
use shagreen_core::actuator::Actuator;
use shagreen_formats::library::TextureEntry;
use shagreen_studio::export::{
    self, Batch, ExportContext, ExportFormat, ExportOutcome, SignalFormat, all_lost, export_all, model_paths,
    refuse_existing, refuse_foreign_model,
};
use shagreen_studio::file::check_ending;
use shagreen_studio::replace::refuse_inputs;
use shagreen_studio::sound_entry::entry_of_sound;

use crate::cli::actuator_source::load_actuator;
use crate::cli::export_signals::{Request, export_signals, or_replace};
use crate::cli::out_name::refuse_dash;
use crate::cli::output::{self, Printed};
use crate::cli::signal_args::SignalArgs;
use crate::cli::target::{NamedSound, SoundArgs};

/// Exports one texture, or all of a library, in the format of another program, and reports what that format cannot store.
#[derive(clap::Args)]
pub(crate) struct Args {
    #[command(flatten)]
    sound: SoundArgs,
    /// Export every texture of the library into the folder --out, each to a file named after its id.
    #[arg(
        long,
        group = "TargetArgs",
        conflicts_with_all = ["blend", "natural", "extrapolate", "lock", "axes"]
    )]
    all: bool,
    /// Replace files of the same format. Without this option, only a WAV file with the sidecar of an export is replaced.
    #[arg(long)]
    replace: bool,
    /// File format. Formats of signals, such as wav and haptic, hold what one stroke over the texture gives: by default 2 s at
    /// 100 mm/s and 1 N. `shagreen render` writes the WAV file of any sound.
    #[arg(long, value_parser = parser())]
    format: Format,
    /// Actuator that the files are made for: a built-in one, by id, or a profile file. For formats that describe an actuator,
    /// such as hjif, and for envelopes such as haptic, which then have the band of the actuator.
    #[arg(long, value_name = "ID_OR_FILE")]
    actuator: Option<String>,
    /// File to write; with --all, the folder of the files.
    #[arg(short = 'o', long = "out", value_name = "OUT")]
    out: PathBuf,
    /// Print the result as one JSON object.
    #[arg(long)]
    json: bool,
    #[command(flatten)]
    signal: SignalArgs,
}

pub(crate) fn run(args: &Args) -> anyhow::Result<()> {
    refuse_dash(&args.out)?;
    match args.format {
        Format::Signal(format) => export_signal(args, format),
        Format::Model(format) => {
            args.signal.refuse(format.id())?;
            if args.all { export_every(args, format) } else { export_one(args, format) }
        }
    }
}

fn export_signal(args: &Args, format: &'static dyn SignalFormat) -> anyhow::Result<()> {
    let (library, selected) = args.sound.load_any()?;
    let textures = match selected {
        Some(selected) => vec![selected],
        None => NamedSound::all_of(&library, &args.sound.shape())?,
    };
    export_signals(&Request {
        format,
        textures,
        is_all: args.all,
        library,
        args: &args.signal,
        actuator: args.load_actuator()?,
        inputs: args.inputs().to_vec(),
        out: &args.out,
        replaces: args.replace,
        as_json: args.json,
    })
}

fn export_one(args: &Args, format: &'static dyn ExportFormat) -> anyhow::Result<()> {
    let paths = model_paths(format, &args.out);
    args.refuse_inputs(&paths)?;
    let actuator = args.load_actuator()?;
    let (library, selected) = args.sound.load_any()?;
    let NamedSound { name, sound } = selected.context("no texture is selected; give --texture ID")?;
    let texture = &entry_of_sound(&library, &sound, &name)?;
    refuse_foreign_model(format, &args.out)?;
    check_ending(format.name(), format.ending(), &args.out)?;
    refuse_existing(&paths, args.replace).map_err(|error| or_replace(error.into()))?;
    let context = ExportContext { created_by: output::CREATED_BY, actuator: actuator.as_ref() };
    let out = (args.out.as_path(), &context);
    let ExportOutcome { files, lost, license, warnings } =
        export::export(&library, texture, format, out, &Printed)?;
    let files: Vec<String> = files.iter().map(|file| file.display().to_string()).collect();
    output::print(
        args.json,
        &json!({"files": files, "lost": lost, "warnings": warnings, "licence": license}),
        || format!("Wrote \"{}\" as {}: {}", texture.name, format.id(), files.join(", ")),
    );
    Ok(())
}

fn export_every(args: &Args, format: &'static dyn ExportFormat) -> anyhow::Result<()> {
    let actuator = args.load_actuator()?;
    let (library, _) = args.sound.load_any()?;
    let (folder, shape) = (args.out.as_path(), args.sound.shape());
    let shaped = |texture: &TextureEntry| {
        export::shaped(texture, &shape).with_context(|| format!("\"{}\" cannot have this shape", texture.id))
    };
    let entries = library.textures.iter().map(shaped).collect::<anyhow::Result<Vec<_>>>()?;
    let paths = export::paths_in(folder, entries.iter().map(|entry| &entry.id), format.ending());
    let paths: Vec<PathBuf> = paths.iter().flat_map(|path| model_paths(format, path)).collect();
    args.refuse_inputs(&paths)?;
    let context = ExportContext { created_by: output::CREATED_BY, actuator: actuator.as_ref() };
    let batch = Batch { folder, replaces: args.replace, context };
    let outcomes = export_all(&library, &entries, format, &batch, &Printed).map_err(or_replace)?;
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
        "lost": all_lost(outcomes.iter().map(|outcome| &*outcome.lost)),
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
    /// Returns an error if one of these files is an input.
    fn refuse_inputs(&self, files: &[PathBuf]) -> anyhow::Result<()> {
        let files: Vec<&Path> = files.iter().map(PathBuf::as_path).collect();
        refuse_inputs(&files, &self.inputs())
    }

    /// Returns the files that are read, without the stroke.
    fn inputs(&self) -> [Option<&Path>; 2] {
        [self.sound.library_path(), self.actuator.as_deref().map(Path::new)]
    }

    /// Loads the actuator that was named.
    fn load_actuator(&self) -> anyhow::Result<Option<Actuator>> {
        let Some(name) = &self.actuator else { return Ok(None) };
        let describes = |format: Format| match format {
            Format::Model(format) => format.describes_actuator(),
            Format::Signal(format) => format.uses_actuator(),
        };
        if !describes(self.format) {
            let ids: Vec<&str> =
                Format::all().into_iter().filter(|format| describes(*format)).map(Format::id).collect();
            bail!(output::Usage(format!(
                "files of the format {} do not describe an actuator; leave out --actuator, or use --format {}",
                self.format.id(),
                ids.join(" or ")
            )));
        }
        load_actuator(name, None).map(Some)
    }
}

/// Selected format.
#[derive(Clone, Copy)]
enum Format {
    /// Of texture models.
    Model(&'static dyn ExportFormat),
    /// Of signals of one stroke.
    Signal(&'static dyn SignalFormat),
}

impl Format {
    /// Returns all formats, in the order of [`export::listed`].
    fn all() -> Vec<Self> {
        let signals = export::SIGNAL_FORMATS.into_iter().map(Self::Signal);
        signals.chain(export::FORMATS.into_iter().map(Self::Model)).collect()
    }

    fn id(self) -> &'static str {
        match self {
            Self::Model(format) => format.id(),
            Self::Signal(format) => format.id(),
        }
    }
}

/// Parses the id of a format; the help lists all of them.
fn parser() -> impl TypedValueParser<Value = Format> {
    let ids = export::listed().map(|format| PossibleValue::new(format.id).help(format.help));
    PossibleValuesParser::new(ids).try_map(|id| {
        let found = Format::all().into_iter().find(|format| format.id() == id);
        found.ok_or_else(|| format!("{id} is not a format"))
    })
}
