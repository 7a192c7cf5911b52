//! `shagreen texture path`: makes a texture that changes along a stroke.

use std::path::PathBuf;

use serde_json::json;
use shagreen_core::space::SpacePoint;
use shagreen_core::space::authoring::{Authored, Authoring, Blending};
use shagreen_core::space::texture_path::{Along, AtEnd, Key, MAX_KEYS, Route, Stop, TexturePath};
use shagreen_core::texture::shape::Shape;
use shagreen_formats::atomic;
use shagreen_formats::library::{Library, Provenance, TextureEntry, read_library, write_library};

use crate::cli::axes_args::AxesArgs;
use crate::cli::blending::BlendArgs;
use crate::cli::library_args::LibraryArgs;
use crate::cli::output::{self, Printed};
use crate::cli::point::{PointArg, parse_point};
use crate::cli::progress::Progress;
use crate::cli::quantity::within;
use crate::cli::shape_args::ShapeArgs;
use crate::cli::words::words;
use shagreen_studio::authoring::authoring;
use shagreen_studio::replace::{refuse_foreign, refuse_inputs};

/// Makes a texture that changes along a stroke, following a path of stops through the space, and writes it to a new
/// library file. `render`, `play` and the window use it like any other texture.
#[derive(clap::Args)]
pub(crate) struct Args {
    /// Position in the space, as with `render --at`, and its place along the stroke, in mm (or in s with --along time):
    /// 30,70@0. Give this option at least twice, first with @0.
    #[arg(long = "stop", value_name = "POINT@X", value_parser = parse_stop, required = true, allow_hyphen_values = true)]
    stops: Vec<(PointArg, f64)>,
    /// Quantity along the stroke: the distance that the tip has traveled, or the time in contact.
    #[arg(long, value_name = "WHAT", value_parser = words(Along::ALL, Along::id), default_value = Along::default().id())]
    along: Along,
    /// Behavior at the end of the path: hold the last texture, turn back, or repeat from the beginning.
    #[arg(long, value_name = "WHAT", value_parser = words(AtEnd::ALL, AtEnd::id), default_value = AtEnd::default().id())]
    at_end: AtEnd,
    #[command(flatten)]
    library: LibraryArgs,
    #[command(flatten)]
    axes: AxesArgs,
    #[command(flatten)]
    blending: BlendArgs,
    #[command(flatten)]
    shape: ShapeArgs,
    /// Name of the texture.
    #[arg(long, value_name = "NAME", default_value = "Path")]
    name: String,
    /// Library file to write.
    #[arg(short, long, value_name = "OUT.json")]
    out: PathBuf,
    /// Print the result as one JSON object.
    #[arg(long)]
    json: bool,
}

/// Distance of neighboring textures of a path above which a warning is printed, in points of the axes.
const COARSE: f64 = 8.0;

/// Range of the place of a point along a stroke, in mm or s.
const ALONG: std::ops::RangeInclusive<f64> = 0.0..=1e6;

fn parse_stop(text: &str) -> Result<(PointArg, f64), String> {
    let (at, along) = text.rsplit_once('@').ok_or("write RS,HS@X as in 30,70@0")?;
    Ok((parse_point(at)?, within(along.trim(), &ALONG, "mm or s")?))
}

pub(crate) fn run(args: &Args) -> anyhow::Result<()> {
    refuse_inputs(&[&args.out], &[args.library.path()])?;
    refuse_foreign(&args.out, "a path", is_path)?;
    let points: Vec<&PointArg> = args.stops.iter().map(|(at, _)| at).collect();
    let library = args.axes.place(args.library.load()?, None, &points)?;
    let blending = args.blending.blending(&library)?;
    let (scale, unit) = args.along.unit();
    let stop = |(at, x): &(PointArg, f64)| Ok(Stop { at: at.in_space(&library)?, along: scale * x });
    let stops = args.stops.iter().map(stop).collect::<anyhow::Result<_>>()?;
    let route = Route::new(args.along, args.at_end, stops)?;
    let progress = Progress::endless("interpolating the textures of the path");
    let authoring = authoring(&library, blending.mode, &Printed)?;
    let shape = args.shape.or(Shape::default());
    let path = TexturePath::of_route(&authoring, &route, &blending)?.shaped(&shape)?;
    let outside = HullCounts::of(&authoring, &path, &blending);
    let (n_keys, length) = (path.keys().len(), path.length() / scale);
    let of: Vec<usize> = authoring.space().sites().iter().map(|(texture, _)| *texture).collect();
    let entry = library.entry_of_path(&args.name, path, &of, outside.n_extrapolated);
    let made = alone(&library, entry);
    let id = made.textures[0].id.clone();
    let is_restricted = made.textures[0].provenance == Provenance::Restricted;
    let restricted: Vec<&str> = is_restricted.then_some(args.name.as_str()).into_iter().collect();
    let mut warnings = outside.warnings(n_keys);
    warnings.extend(coarse(made.textures[0].path.as_ref()));
    warnings.extend(Provenance::warning(&restricted));
    for warning in &warnings {
        output::warn(warning);
    }
    atomic::write(&args.out, &write_library(&made))?;
    progress.finish();
    let file = args.out.display().to_string();
    output::print(
        args.json,
        &json!({
            "out": file, "id": id, "keys": n_keys, "length": length, "unit": unit,
            "along": args.along.id(), "at_end": args.at_end.id(), "blend": blending.mode.id(),
            "clamped": outside.n_clamped, "extrapolated": outside.n_extrapolated,
            "warnings": warnings,
        }),
        || format!("Wrote \"{id}\", {length} {unit} long, {n_keys} textures along the path: {file}"),
    );
    Ok(())
}

/// Number of textures on a path that lie outside the convex hull.
struct HullCounts {
    /// Textures that were moved to the nearest supported point, farther than can be seen from displayed coordinates.
    n_clamped: usize,
    /// Textures that were extrapolated.
    n_extrapolated: usize,
}

impl HullCounts {
    fn of(authoring: &Authoring, path: &TexturePath, blending: &Blending) -> Self {
        let at = |key: &Key| Some((key.stop.at, authoring.author(key.stop.at, blending)?));
        let authored: Vec<(SpacePoint, Authored)> = path.keys().iter().filter_map(at).collect();
        let is_moved = |(at, authored): &&(SpacePoint, Authored)| {
            authored.location.clamped && at.most_different_axis(authored.location.at).is_some()
        };
        Self {
            n_clamped: authored.iter().filter(is_moved).count(),
            n_extrapolated: authored.iter().filter(|(_, authored)| authored.is_extrapolated).count(),
        }
    }

    fn warnings(&self, n_keys: usize) -> Vec<String> {
        let of_all =
            |n: usize, what: &str| (n > 0).then(|| format!("{n} of {n_keys} textures along the path {what}"));
        let clamped =
            "lie outside the convex hull of the library's textures; the nearest supported points are used";
        let extrapolated = "are extrapolated: no texture was measured there";
        [of_all(self.n_clamped, clamped), of_all(self.n_extrapolated, extrapolated)]
            .into_iter()
            .flatten()
            .collect()
    }
}

/// Returns a warning if neighboring textures of a path lie far apart.
fn coarse(path: Option<&TexturePath>) -> Option<String> {
    let step = path?.widest_step();
    (step > COARSE).then(|| {
        format!(
            "some neighboring textures of the path are {step:.0} points apart in the space, and only their signals are mixed in between: \
             a path has at most {MAX_KEYS} textures; use fewer stops, or a shorter path"
        )
    })
}

/// Returns whether a file is a library with a single path, which a newer one may replace.
fn is_path(bytes: &[u8]) -> bool {
    let Ok(library) = read_library(bytes) else { return false };
    matches!(&library.value.textures[..], [only] if only.path.is_some())
}

/// Returns a library with only the path.
fn alone(library: &Library, entry: TextureEntry) -> Library {
    Library {
        name: entry.name.clone(),
        origin: entry.origin.clone(),
        license: entry.license.clone(),
        created_by: output::CREATED_BY.to_owned(),
        axes: library.axes.clone(),
        textures: vec![entry],
        ..Library::default()
    }
}

#[cfg(test)]
mod tests {
    use super::{PointArg, parse_stop};

    #[test]
    fn stops_say_what_is_wrong() {
        let (at, along) = parse_stop("30, 70.5 @ 12").unwrap();
        assert_eq!((at, along), (PointArg::Ordered(vec![30.0, 70.5]), 12.0));
        let (at, _) = parse_stop("rough-smooth=30@1").unwrap();
        assert_eq!(at, PointArg::Named(vec![("rough-smooth".to_owned(), 30.0)]));
        for (text, words) in [("30,70", "RS,HS@X"), ("30,70@-1", "0 or greater"), ("a,7@0", "\"a\"")] {
            let error = parse_stop(text).unwrap_err();
            assert!(error.contains(words), "{error}");
        }
    }
}
