//! `shagreen library list`: lists the textures of a library.

use serde_json::{Value, json};
use shagreen_core::space::LabelSource;
use shagreen_core::words::counted;
use shagreen_formats::axis_sources::axis_sources;
use shagreen_formats::library::{Library, Provenance, TextureEntry};
use shagreen_studio::axes::{KnownAxis, known_axes};

use crate::cli::axes_args::AxesArgs;
use crate::cli::library_args::LibraryArgs;
use crate::cli::output;

#[derive(clap::Args)]
pub(crate) struct Args {
    #[command(flatten)]
    library: LibraryArgs,
    #[command(flatten)]
    axes: AxesArgs,
    /// Print the result as one JSON object.
    #[arg(long)]
    json: bool,
}

pub(crate) fn run(args: &Args) -> anyhow::Result<()> {
    let library = args.library.load()?;
    let known = known_axes(&library);
    let library = args.axes.place(library, None, &[])?;
    let textures: Vec<Value> = library.textures.iter().map(|texture| describe(&library, texture)).collect();
    output::print(
        args.json,
        &json!({
            "library": library.name,
            "axes": library.axis_names(),
            "known_axes": known.iter().map(known_axis).collect::<Vec<_>>(),
            "axis_sources": library.space_report.as_ref().and_then(axis_sources),
            "textures": textures,
        }),
        || table(&library, &known),
    );
    Ok(())
}

fn known_axis(axis: &KnownAxis) -> Value {
    json!({"name": axis.name, "source": axis.source.label(), "textures": axis.n_known, "range": axis.range})
}

fn describe(library: &Library, texture: &TextureEntry) -> Value {
    json!({
        "id": texture.id,
        "name": texture.name,
        "tags": texture.tags,
        "at": texture.at().map(|at| at.coordinates().to_vec()),
        "label_source": texture.label_source().map(LabelSource::id),
        "nodes": texture.model.n_nodes(),
        "order": texture.model.order(),
        "rate_hz": texture.model.rate().0,
        "path": texture.path.as_ref().map(|path| {
            let (scale, unit) = path.along().unit();
            let length = path.length() / scale;
            json!({"keys": path.keys().len(), "length": length, "unit": unit, "at_end": path.at_end().id()})
        }),
        "relief": texture.model.relief().map(|relief| {
            json!({"length_mm": 1e3 * relief.profile().length_m(), "force_n": relief.force().0})
        }),
        "directional": texture.model.along().is_some(),
        "height_map": texture.model.height_map().map(|map| {
            json!({"side_mm": 1e3 * map.side_m(), "n": map.n(), "force_n": map.options().force.0})
        }),
        "stick_slip": texture.model.stick_slip().map(|stick_slip| {
            let stribeck_mm_per_s = stick_slip.stribeck_speed.mm_per_s();
            json!({"static_ratio": stick_slip.static_ratio, "stribeck_mm_per_s": stribeck_mm_per_s})
        }),
        "turn_deg": texture.model.turn_rad().to_degrees(),
        "restricted": texture.provenance == Provenance::Restricted,
        "licence": library.license_of(texture),
    })
}

fn table(library: &Library, known: &[KnownAxis]) -> String {
    let widest = library
        .textures
        .iter()
        .map(|texture| texture.id.chars().count())
        .max()
        .unwrap_or(0)
        .min(output::MAX_WIDTH);
    let line = |texture: &TextureEntry| {
        let place = texture.place.map_or_else(
            || "no position".to_owned(),
            |place| format!("position {} ({})", place.at, place.source.label()),
        );
        let model = &texture.model;
        let path = texture.path.as_ref().map_or_else(String::new, |path| {
            let (scale, unit) = path.along().unit();
            let length = path.length() / scale;
            format!(", path of {} textures over {length} {unit}", path.keys().len())
        });
        let relief = model.relief().map_or_else(String::new, |relief| {
            format!(", relief of {:.1} mm", 1e3 * relief.profile().length_m())
        });
        let direction = if model.along().is_some() { ", directional" } else { "" };
        let height_map = model
            .height_map()
            .map_or_else(String::new, |map| format!(", height map of {:.1} mm", 1e3 * map.side_m()));
        let stick_slip = if model.stick_slip().is_some() { ", stick-slip" } else { "" };
        format!(
            "{:widest$}  {}, {place}, {} speed-force points, model order {}, model rate {}{path}{relief}{direction}{height_map}{stick_slip}",
            texture.id,
            texture.name,
            model.n_nodes(),
            model.order(),
            model.rate()
        )
    };
    let n_textures = counted(library.textures.len(), "texture");
    let mut lines =
        vec![format!("{}: {n_textures}; axes: {}", library.name, library.axis_names().join(", "))];
    let in_words = |axis: &KnownAxis| {
        let [low, high] = axis.range;
        format!("{} ({}, {}, {low:.0} to {high:.0})", axis.name, axis.source.label(), axis.n_known)
    };
    let known: Vec<String> = known.iter().map(in_words).collect();
    lines.push(format!("known axes (source, textures, range): {}", known.join(", ")));
    let sources = library.space_report.as_ref().and_then(axis_sources);
    lines.extend(sources.map(|sources| format!("positions: {sources}")));
    lines.extend(library.textures.iter().map(line));
    lines.join("\n")
}
