//! `shagreen import directional`: fits texture models to strokes in several directions.

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};

use serde_json::{Value, json};
use shagreen_formats::recording::directional::{NamedDirections, TextureStrokes, unused_others};
use shagreen_studio::import::directional::{
    DirectionalError, DirectionalOptions, DirectionalTexture, directions_of, find, import_texture,
};
use shagreen_studio::parallel::{in_parallel_by, n_processors};

use crate::cli::fit_args::{FitArgs, tap_json, tap_text};
use crate::cli::import::{Destination, Outcome};
use crate::cli::progress::Progress;

/// Number of textures that are fitted at once; each may hold minutes of recordings in memory.
const MAX_AT_ONCE: usize = 4;

/// Fits texture models to strokes in several directions: a folder of tables, one for each stroke and quantity.
///
/// The name of each file is TEXTURE_DIRECTION_SPEED_FORCE_REPEAT, with mm/s and mN, as in cork_45_20_200_1.csv. The
/// folder or the name contains the quantity: acceleration (time,X,Y,Z in s and g), force (time,force in s and N) or
/// position (time,X,Y in s and mm). A texture that differs over direction gets grain across and along its lay.
#[derive(clap::Args)]
pub(crate) struct Args {
    /// Folders of strokes. Each texture that the file names contain becomes a texture.
    #[arg(required = true, value_name = "FOLDER")]
    folders: Vec<PathBuf>,
    #[command(flatten)]
    destination: Destination,
    /// State the angle of a direction of the file names, in degrees counterclockwise from the x axis, for example
    /// along=90. Can be given several times. Default: the angle in the name, or that of the positions.
    #[arg(long = "direction", value_name = "NAME=DEGREES", value_parser = parse_direction)]
    directions: Vec<(String, f64)>,
    #[command(flatten)]
    fit: FitArgs,
    /// License of the textures, for example an SPDX expression.
    #[arg(long, default_value = "", hide_default_value = true)]
    licence: String,
}

/// Texture to fit.
struct Job<'a> {
    folder: &'a Path,
    texture: TextureStrokes,
    named: NamedDirections,
}

pub(crate) fn run(args: &Args) -> anyhow::Result<()> {
    let (mut jobs, mut warnings) = (Vec::new(), Vec::new());
    for folder in args.folders.iter().map(PathBuf::as_path) {
        let found = find(folder)?;
        let named = directions_of(&found.textures);
        warnings.extend(unused_others(&found.others).into_iter().chain(found.warnings));
        let job = |texture| Job { folder, texture, named: named.clone() };
        jobs.extend(found.textures.into_iter().map(job));
    }
    let files: Vec<PathBuf> =
        jobs.iter().flat_map(|job| &job.texture.strokes).flat_map(|stroke| stroke.paths().cloned()).collect();
    let mut outcome = Outcome::new(&args.destination, &files)?;
    let is_known = |name: &str| jobs.iter().any(|job| job.named.angles_rad.contains_key(name));
    for (name, degrees) in args.directions.iter().filter(|(name, _)| !is_known(name)) {
        warnings.push(format!("--direction {name}={degrees} has no effect: no file name has this direction"));
    }
    for warning in warnings {
        outcome.warn_of_all(warning);
    }
    let options = DirectionalOptions {
        fit: args.fit.options(),
        stated_deg: args.directions.iter().cloned().collect::<BTreeMap<String, f64>>(),
        license: args.licence.clone(),
    };
    let progress = Progress::new("fitting the strokes", jobs.len());
    let done = in_parallel_by(n_processors().min(MAX_AT_ONCE), jobs.len(), |index| {
        let done = import_texture(&jobs[index].texture, &jobs[index].named, &options);
        progress.step();
        done
    });
    progress.finish();
    for (job, done) in jobs.iter().zip(done) {
        let name = &job.texture.texture;
        for (file, reason) in done.failed {
            outcome.failed(&file, reason);
        }
        for warning in done.warnings {
            outcome.warn_of_all(format!("{name}: {warning}"));
        }
        match done.texture {
            Ok(made) => {
                outcome.note(Path::new(name), &made.summary);
                if let Some(tap) = &made.report.tap {
                    outcome.note(Path::new(name), &tap_text(tap));
                }
                let figures = figures(&made);
                let mut entry = made.entry;
                entry.id = outcome.claim_id(&entry.name);
                outcome.imported(entry, figures);
            }
            Err(error) => outcome.failed(job.folder, format!("{name}: {error}{}", hint(&error))),
        }
    }
    outcome.finish(json!({}))
}

/// What to do about an error, as the end of its sentence.
fn hint(error: &DirectionalError) -> String {
    let DirectionalError::UnknownDirections(directions) = error else { return String::new() };
    let first = directions.first().map_or("", String::as_str);
    format!("; state each in degrees, as in --direction {first}=90, or add the files of positions")
}

fn figures(made: &DirectionalTexture) -> Value {
    let report = &made.report;
    let directions: Vec<Value> = report
        .directions
        .iter()
        .map(|direction| {
            json!({
                "degrees": direction.direction_rad.to_degrees(),
                "strokes": direction.n_recordings,
                "seconds": direction.seconds,
                "level_db": direction.level_db,
            })
        })
        .collect();
    let named: BTreeMap<&String, f64> =
        made.angles_rad.iter().map(|(name, angle_rad)| (name, angle_rad.to_degrees())).collect();
    json!({
        "strokes": made.n_strokes,
        "directions": directions,
        "direction_degrees": named,
        "isotropic": report.lay_rad.is_none(),
        "lay_degrees": report.lay_rad.map(f64::to_degrees),
        "modulation_db": report.modulation_db,
        "chance_db": report.chance_db,
        "segments": report.n_segments,
        "nodes": made.entry.model.n_nodes(),
        "order": report.order,
        "rate_hz": report.rate.0,
        "coverage": report.coverage,
        "gfc_median": report.gfc_median,
        "level_error_db_median": report.level_error_db_median,
        "held_out": false,
        "tap": tap_json(report.tap.as_ref()),
    })
}

fn parse_direction(text: &str) -> Result<(String, f64), String> {
    let (name, degrees) = text.split_once('=').ok_or("write NAME=DEGREES as in along=90")?;
    let degrees: f64 = degrees.trim().parse().map_err(|_| "the angle must be a number of degrees")?;
    if (-360.0..=360.0).contains(&degrees) {
        Ok((name.trim().to_owned(), degrees))
    } else {
        Err("the angle must lie between -360 and 360 degrees".to_owned())
    }
}
