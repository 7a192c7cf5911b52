//! `shagreen texture path`: a texture that changes along a stroke.

use std::path::PathBuf;

use serde_json::json;
use shagreen_core::authoring::{Authoring, Blending};
use shagreen_core::space::SpacePoint;
use shagreen_core::texture_path::{Along, AtEnd, Route, Stop, TexturePath};
use shagreen_formats::atomic;
use shagreen_formats::library::{Library, Provenance, read_library, write_library};

use crate::cli::guard::{refuse_foreign, refuse_inputs};
use crate::cli::library_source::{LibraryArgs, load};
use crate::cli::motion::quantity;
use crate::cli::output;
use crate::cli::target::{BlendArgs, authoring, parse_point};

/// Makes a texture that changes along a stroke, from stop to stop through the space, and writes it as a library of its own:
/// `render`, `play` and the window take it as any other texture.
#[derive(clap::Args)]
pub(crate) struct Args {
    /// A point of the space, and where along the stroke it is reached, in mm (or s, with --along time): 30,70@0. At least
    /// two, the first at 0.
    #[arg(long = "stop", value_name = "RS,HS@X", value_parser = parse_stop, required = true, allow_hyphen_values = true)]
    stops: Vec<(SpacePoint, f64)>,
    /// What counts along the stroke: the distance that the tip has traveled, or the time that it has touched.
    #[arg(long, value_name = "WHAT", value_parser = ["distance", "time"], default_value = "distance")]
    along: String,
    /// What happens at the end: the last texture stays, it goes back, or it begins again.
    #[arg(long, value_name = "WHAT", value_parser = ["hold", "turn", "repeat"], default_value = "hold")]
    at_end: String,
    #[command(flatten)]
    library: LibraryArgs,
    #[command(flatten)]
    blending: BlendArgs,
    /// Name of the texture.
    #[arg(long, value_name = "NAME", default_value = "Path")]
    name: String,
    /// Library file to write.
    #[arg(short, long, value_name = "OUT.json")]
    out: PathBuf,
    /// Print one JSON object.
    #[arg(long)]
    json: bool,
}

fn parse_stop(text: &str) -> Result<(SpacePoint, f64), String> {
    let (at, along) = text.split_once('@').ok_or("write RS,HS@X as in 30,70@0")?;
    Ok((parse_point(at)?, quantity(along.trim())?))
}

pub(crate) fn run(args: &Args) -> anyhow::Result<()> {
    refuse_inputs(&[&args.out], &[args.library.path()])?;
    refuse_foreign(&args.out, "a path", is_path)?;
    let library = load(&args.library)?;
    let blending = args.blending.blending(&library)?;
    let along = Along::from_id(&args.along).unwrap_or_default();
    let unit = if along == Along::Distance { (1e-3, "mm") } else { (1.0, "s") };
    let stops = args.stops.iter().map(|(at, x)| Stop { at: *at, along: unit.0 * x }).collect();
    let route = Route::new(along, AtEnd::from_id(&args.at_end).unwrap_or_default(), stops)?;
    let authoring = authoring(&library, blending.mode)?;
    let path = TexturePath::of_route(&authoring, &route, &blending)?;
    let (n_clamped, n_extrapolated) = outside(&authoring, &path, &blending);
    let (n_keys, length) = (path.keys().len(), path.length() / unit.0);
    let of: Vec<usize> = authoring.space().sites().iter().map(|(texture, _)| *texture).collect();
    let made = made(&library, &args.name, path, &of);
    let id = made.textures[0].id.clone();
    let is_restricted = made.textures[0].provenance == Provenance::Restricted;
    let warning =
        Provenance::warning(&is_restricted.then_some(args.name.as_str()).into_iter().collect::<Vec<_>>());
    if let Some(warning) = &warning {
        output::warn(warning);
    }
    atomic::write(&args.out, &write_library(&made))?;
    let file = args.out.display().to_string();
    output::print(
        args.json,
        &json!({
            "out": file, "id": id, "keys": n_keys, "length": length, "unit": unit.1,
            "along": args.along, "at_end": args.at_end, "blend": blending.mode.id(), "clamped": n_clamped, "extrapolated": n_extrapolated,
            "warnings": warning.into_iter().collect::<Vec<_>>(),
        }),
        || format!("Wrote \"{id}\", {length} {} long, {n_keys} textures along it: {file}", unit.1),
    );
    Ok(())
}

/// How many keys lie outside the textures and were moved to where there is a texture, and how many were extrapolated;
/// both are said.
fn outside(authoring: &Authoring, path: &TexturePath, blending: &Blending) -> (usize, usize) {
    let authored = path.keys().iter().filter_map(|key| authoring.author(key.stop.at, blending));
    let (mut n_clamped, mut n_extrapolated) = (0, 0);
    for authored in authored {
        n_clamped += usize::from(authored.location.clamped);
        n_extrapolated += usize::from(authored.is_extrapolated);
    }
    if n_clamped > 0 {
        output::warn(&format!(
            "{n_clamped} of {} textures along the path lie outside the textures of the library; the nearest points that \
             they support are used",
            path.keys().len()
        ));
    }
    if n_extrapolated > 0 {
        output::warn(&format!(
            "{n_extrapolated} of {} textures along the path are extrapolated: nothing was measured there",
            path.keys().len()
        ));
    }
    (n_clamped, n_extrapolated)
}

/// Whether a file is a library of one path, which a newer one may replace.
fn is_path(bytes: &[u8]) -> bool {
    let Ok(library) = read_library(bytes) else { return false };
    matches!(&library.value.textures[..], [only] if only.path.is_some())
}

/// A library of the path alone.
fn made(library: &Library, name: &str, path: TexturePath, of: &[usize]) -> Library {
    let entry = library.entry_of_path(name, path, of);
    Library {
        name: name.to_owned(),
        origin: entry.origin.clone(),
        license: entry.license.clone(),
        created_by: output::CREATED_BY.to_owned(),
        textures: vec![entry],
        ..Library::default()
    }
}

#[cfg(test)]
mod tests {
    use super::parse_stop;

    #[test]
    fn stops_say_what_is_wrong() {
        let (at, along) = parse_stop("30, 70.5 @ 12").unwrap();
        assert_eq!((at.rough_smooth, at.hard_soft, along), (30.0, 70.5, 12.0));
        for (text, words) in
            [("30,70", "RS,HS@X"), ("30@1", "RS,HS"), ("30,70@-1", "from 0 up"), ("130,7@0", "130")]
        {
            let error = parse_stop(text).unwrap_err();
            assert!(error.contains(words), "{error}");
        }
    }
}
