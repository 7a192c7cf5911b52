//! `shagreen generate`: generates a picture, a point of the space, a texture and a project from a prompt.

use std::path::{Path, PathBuf};
use std::sync::Arc;

use anyhow::{Context as _, bail, ensure};
use serde_json::{Value, json};
use shagreen_core::maths::gaussian_process::Estimate;
use shagreen_core::space::{LabelSource, SpacePoint};
use shagreen_core::surfaces::generated::{CombinedEstimate, Placed, Witness, place};
use shagreen_core::surfaces::picture_doubts::PictureDoubt;
use shagreen_core::surfaces::prompt::{PromptInterpretation, interpret, title};
use shagreen_core::surfaces::touch_words::ATTRIBUTES;
use shagreen_formats::bounded_file::{self, FileKind};
use shagreen_formats::built_in::BuiltIn;
use shagreen_formats::lexicon_toml::built_in_lexicon;
use shagreen_formats::library::{Library, TextureEntry, write_library};
use shagreen_formats::picture::{Picture, Rgb, encode_heights, encode_jpeg, encode_png};
use shagreen_formats::project::{AuthoredTexture, EXTENSION, write_project};
use shagreen_learn::diffusion::{LONGEST_SIDE, Wish};
use shagreen_learn::model_file::sha256_of;
use shagreen_learn::picture_predictor::PicturePredictor;

use crate::cli::backbone_source::{BackboneArgs, read_backbone};
use crate::cli::generated_texture::{project_of_picture, texture_of_picture};
use crate::cli::model_folder::model_folder;
use crate::cli::output;
use crate::cli::progress::Progress;
use crate::cli::prompt_summary::{disagreement, prompt_summary};
use crate::cli::seen_json::{doubts_json, materials_json};
use shagreen_studio::figure_files::{check_together, write_together};
use shagreen_studio::file;
use shagreen_studio::generate::{
    GeneratedPicture, PicturedRelief, generate_by_diffusion, generate_procedurally, nearest,
};
use shagreen_studio::replace::{has_format, refuse_foreign};
use shagreen_studio::seen_materials::{SeenMaterial, doubt_with_advice, looks_like, seen_materials};

/// Value of the field `format` of the description.
const FORMAT: &str = "shagreen-generated";
/// Names of the files in the folder.
const PICTURE: &str = "picture.png";
const HEIGHTS: &str = "heights.png";
const TEXTURE: &str = "texture.json";
const DESCRIPTION: &str = "generated.json";
/// Where a texture comes from, in words.
const FROM_HEIGHTS: &str = "simulated from its height field";
const FROM_LIBRARY: &str = "interpolated from the starter library";
/// Longest name of a texture, in characters.
const LONGEST_NAME: usize = 60;

/// Generates a picture from a prompt, predicts a position in the space from the prompt and the picture, and writes the
/// texture at this position.
///
/// The built-in procedural generator needs no neural network: a lexicon interprets words for materials, patterns,
/// colors, sizes and adjectives. Its picture is seamless, and the surface heights that it shows are written too. The
/// texture is simulated from the same heights: a pattern is felt where the picture shows it. The position follows the words:
/// a procedural picture is computed from them. A picture of a diffusion model is independent evidence, and is weighted by its
/// standard deviation. The command reports attributes for which prompt and picture predict different values.
#[derive(clap::Args)]
pub(crate) struct Args {
    /// Description of the surface, such as "a rough, soft carpet-like surface".
    #[arg(value_name = "PROMPT")]
    prompt: String,
    /// Folder to write to: the picture, its surface heights, the texture, a project and a description (generated.json).
    #[arg(long, value_name = "DIR")]
    out: PathBuf,
    /// Random seed; another seed gives another part of the same surface.
    #[arg(long, default_value_t = 1)]
    seed: u64,
    /// Pixels along each side of the picture.
    #[arg(long, default_value_t = 512, value_parser = clap::value_parser!(u32).range(64..=2048))]
    size: u32,
    /// Interpolate the texture from the starter library, instead of simulating it from the heights that the picture shows.
    /// The heights are then not written. Pictures of a diffusion model have no heights; their textures are always
    /// interpolated.
    #[arg(long)]
    interpolated: bool,
    /// Generate the picture with the diffusion model that `shagreen model add` registered; this takes minutes to hours
    /// on a CPU.
    #[arg(long)]
    diffusion: bool,
    /// Number of denoising steps.
    #[arg(long, default_value_t = 30, requires = "diffusion", value_parser = clap::value_parser!(u32).range(1..=500))]
    steps: u32,
    /// Negative prompt: content that the picture must not show.
    #[arg(long, default_value = "", hide_default_value = true, requires = "diffusion")]
    negative: String,
    #[command(flatten)]
    backbone: BackboneArgs,
    /// Print the result as one JSON object.
    #[arg(long)]
    json: bool,
}

pub(crate) fn run(args: &Args) -> anyhow::Result<()> {
    ensure!(
        !args.prompt.trim().is_empty(),
        "the prompt is empty; describe a surface, such as \"rough sandstone\""
    );
    let project_name = format!("project.{EXTENSION}");
    let earlier_heights = check_folder(&args.out, &project_name)?;
    let all = [PICTURE, HEIGHTS, TEXTURE, &project_name, DESCRIPTION].map(|name| args.out.join(name));
    check_together::<&str>(&all.each_ref().map(PathBuf::as_path), Some(&args.out), &[])?;
    let understood = interpret(&args.prompt, built_in_lexicon()?);
    let name = title(&args.prompt, LONGEST_NAME).unwrap_or_else(|| "Generated".to_owned());
    // Whatever can fail is checked before hours of computing.
    let looker = read_looker(args)?;
    let made = picture_of_prompt(args, &name, &understood)?;
    let progress = Progress::endless("predicting the position of the picture");
    let seen = looker.look(&made.for_prediction())?;
    let [rough, hard] = seen.attributes[..] else {
        bail!("the picture model does not predict rough-smooth and hard-soft; reinstall Shagreen")
    };
    let materials = seen_materials(&seen.materials, built_in_lexicon()?);
    let [of_rough, of_hard, ..] = understood.attributes;
    let witness = made.witness();
    let placed = place([of_rough, of_hard], [rough, hard], witness);
    let at = placed.at;
    progress.finish();

    let library = BuiltIn::Starter.read()?;
    let rgb = Rgb::from(&made.picture);
    let picture = encode_jpeg(&rgb, made.picture.millimeters)?;
    let neighbors = neighbors(&library, at);
    // The folder contains only what its texture is made from.
    let relief = made.relief.as_ref().filter(|_| !args.interpolated);
    let surface = relief.map(|relief| &relief.surface);
    let entry = texture_of_picture(surface, &library, &name, at, &picture)?;
    let texture_id = entry.id.clone();
    let authored = authored_texture(args, &name, &made.by, at, picture);
    let project = project_of_picture(authored, surface.map(|_| &entry), &library);
    let file = |name: &str| args.out.join(name);
    let shown = |name: &str| file(name).display().to_string();
    let mut result = json!({
        "format": FORMAT,
        "prompt": args.prompt,
        "image": shown(PICTURE),
        "millimeters": made.picture.millimeters,
        "millimeters_source": if made.relief.is_some() { "made" } else { "assumed" },
        "at": at.coordinates(),
        "texture": shown(TEXTURE),
        "texture_id": texture_id,
        "texture_source": if surface.is_some() { "height field" } else { "interpolation" },
        "project": shown(&project_name),
        "seed": args.seed,
        "model": made.by,
        "label_source": LabelSource::Estimated.id(),
        "by_words": described(&understood.attributes),
        "by_picture": described(&[rough, hard]),
        "picture_model": format!("{} ({})", looker.model().eyes().name(), looker.model().learned_from()),
        "picture_model_sha256": looker.sha256(),
        "together": described(&placed.axes.map(|axis| axis.estimate)),
        "words_and_picture_differ": placed.disputed(),
        "picture_is_independent": witness == Witness::OnItsOwn,
        "materials": materials_json(&materials),
        "doubts": doubts_json(&seen.doubts),
        "neighbors": neighbors,
        "unknown": understood.unknown,
        "is_about_touch": understood.is_about_touch(),
    });
    let mut files = vec![(file(PICTURE), encode_png(&rgb)?)];
    if let Some(PicturedRelief { field, .. }) = relief {
        result["heights"] = json!(shown(HEIGHTS));
        result["heights_um"] = json!(range_um(field.heights_m()));
        files.push((file(HEIGHTS), encode_heights(field.heights_m(), field.tile().n_cells)?));
    }
    let source = if surface.is_some() { FROM_HEIGHTS } else { FROM_LIBRARY };
    let library_of_one = Library {
        origin: format!("Generated from a prompt by the {} of Shagreen; {source}.", made.by),
        ..library_of_one(args, &name, &library, entry)
    };
    files.push((file(TEXTURE), write_library(&library_of_one)));
    files.push((file(&project_name), write_project(&project, &args.out, output::CREATED_BY)));
    write(&args.out, files, &mut result)?;
    remove_heights(&file(HEIGHTS), earlier_heights.filter(|_| relief.is_none()))?;
    output::print(args.json, &result, || {
        let line = |(name, axis): (&str, &CombinedEstimate)| {
            format!("{name:<13}  {:5.1} ± {:.1}\n", axis.estimate.mean, axis.estimate.deviation)
        };
        let lines: String = ATTRIBUTES.into_iter().zip(&placed.axes).map(line).collect();
        let notes = notes_on_picture(&placed, witness, &materials, &seen.doubts);
        let near: Vec<&str> = neighbors.iter().filter_map(|near| near["name"].as_str()).collect();
        format!(
            "{lines}nearest textures: {}{notes}{}\npicture by the {}: {}\ntexture {texture_id}, {source}: {}\nproject: {}\n{}",
            near.join(", "),
            prompt_summary(&understood),
            made.by,
            shown(PICTURE),
            shown(TEXTURE),
            shown(&project_name),
            next_step(&shown(TEXTURE), &texture_id)
        )
    });
    Ok(())
}

/// Returns the lowest and the highest height, in µm.
pub(crate) fn range_um(heights_m: &[f64]) -> [f64; 2] {
    let low = heights_m.iter().copied().fold(f64::INFINITY, f64::min);
    let high = heights_m.iter().copied().fold(f64::NEG_INFINITY, f64::max);
    [1e6 * low, 1e6 * high]
}

fn authored_texture(args: &Args, name: &str, by: &str, at: SpacePoint, picture: Picture) -> AuthoredTexture {
    AuthoredTexture {
        at,
        picture: Some(Arc::new(picture)),
        notes: format!("Generated from a prompt by the {by}, seed {}: {}", args.seed, args.prompt),
        ..AuthoredTexture::new(1, name)
    }
}

/// Returns lines about the picture. Materials and doubts matter only where the picture contributes to the position.
fn notes_on_picture(
    placed: &Placed,
    witness: Witness,
    materials: &[SeenMaterial],
    doubts: &[PictureDoubt],
) -> String {
    let mut lines = vec![String::new()];
    lines.extend(disagreement(&placed.disputed(), witness));
    if witness == Witness::OnItsOwn {
        lines.extend(looks_like(materials));
        lines.extend(doubts.iter().map(|doubt| doubt_with_advice(*doubt)));
    }
    lines.join("\n")
}

/// Returns the command that renders the texture.
fn next_step(library: &str, id: &str) -> String {
    let library =
        if library.contains(char::is_whitespace) { format!("\"{library}\"") } else { library.to_owned() };
    format!(
        "to render it: shagreen render --library {library} --texture {id} --speed 100 --force 1 --seconds 2 -o texture.wav"
    )
}

/// Returns a library of the generated texture alone.
fn library_of_one(args: &Args, name: &str, library: &Library, entry: TextureEntry) -> Library {
    Library {
        name: name.to_owned(),
        license: library.license.clone(),
        created_by: output::CREATED_BY.to_owned(),
        seed: Some(args.seed),
        textures: vec![entry],
        ..Library::default()
    }
}

fn read_looker(args: &Args) -> anyhow::Result<PicturePredictor> {
    let _progress = Progress::endless("reading the picture model");
    Ok(PicturePredictor::built_in(read_backbone(&args.backbone)?)?)
}

fn picture_of_prompt(
    args: &Args,
    name: &str,
    understood: &PromptInterpretation,
) -> anyhow::Result<GeneratedPicture> {
    if args.diffusion {
        return by_diffusion(args);
    }
    let _progress = Progress::endless("generating the picture");
    generate_procedurally(name, understood, args.size as usize, args.seed)
}

fn by_diffusion(args: &Args) -> anyhow::Result<GeneratedPicture> {
    let most = LONGEST_SIDE;
    ensure!(
        args.size as usize <= most,
        "a diffusion model generates pictures of at most {most} pixels per side; give a smaller --size"
    );
    let folder = model_folder()?;
    let added = folder.added_diffusion()?.context(
        "no diffusion model is registered; register one with `shagreen model add FOLDER`, or leave --diffusion out",
    )?;
    let wish = Wish {
        negative: &args.negative,
        side: args.size as usize,
        n_steps: args.steps as usize,
        ..Wish::usual(&args.prompt, args.seed)
    };
    let progress = Progress::new("generating the picture", wish.n_steps);
    let made = generate_by_diffusion(&folder, &added, &wish, || {
        progress.step();
        true
    })?;
    progress.finish();
    made.context("the generation was stopped")
}

/// Writes all files and the description, which contains their hashes.
fn write(folder: &Path, mut files: Vec<(PathBuf, Vec<u8>)>, result: &mut Value) -> anyhow::Result<()> {
    let hash = |(path, bytes): &(PathBuf, Vec<u8>)| (file::file_name(path), Value::from(sha256_of(bytes)));
    result["sha256"] = files.iter().map(hash).collect::<serde_json::Map<String, Value>>().into();
    // The folder may be moved: the description names files without their folder.
    let mut kept = result.clone();
    for field in ["image", "heights", "texture", "project"] {
        let name = kept[field].as_str().map(Path::new).and_then(Path::file_name);
        if let Some(name) = name.map(|name| name.to_string_lossy().into_owned()) {
            kept[field] = Value::from(name);
        }
    }
    files.push((folder.join(DESCRIPTION), serde_json::to_vec_pretty(&kept)?));
    write_together(&files, Some(folder))
}

/// Removes the heights of an earlier result, if they still have this SHA-256.
fn remove_heights(path: &Path, sha256: Option<String>) -> anyhow::Result<()> {
    let Some(sha256) = sha256 else { return Ok(()) };
    let bytes = bounded_file::read(path, FileKind::Document);
    if bytes.is_ok_and(|bytes| sha256_of(&bytes) == sha256) {
        std::fs::remove_file(path)
            .context("the heights of an earlier result cannot be removed; remove this file")
            .with_context(|| file::in_file(path))?;
    }
    Ok(())
}

/// Returns an error if a file that must not be replaced is in the folder. Otherwise returns the SHA-256 of the heights of
/// an earlier result, if they are there.
fn check_folder(folder: &Path, project_name: &str) -> anyhow::Result<Option<String>> {
    ensure!(
        !folder.exists() || folder.is_dir(),
        "--out needs a folder, but this is a file; choose another folder: {}",
        folder.display()
    );
    let description = folder.join(DESCRIPTION);
    refuse_foreign(&description, "the description", |bytes| has_format(bytes, FORMAT))?;
    // A generated file that is unchanged may be replaced; a file that was edited since may not.
    let before: Option<Value> = bounded_file::read(&description, FileKind::Document)
        .ok()
        .and_then(|bytes| serde_json::from_slice(&bytes).ok());
    let is_ours = |name: &str, bytes: &[u8]| {
        let hash = before.as_ref().and_then(|before| before["sha256"][name].as_str());
        hash == Some(&sha256_of(bytes))
    };
    for name in [PICTURE, HEIGHTS, TEXTURE, project_name] {
        let path = folder.join(name);
        if let Ok(bytes) = bounded_file::read(&path, FileKind::Document)
            && !is_ours(name, &bytes)
        {
            bail!(
                "this file was not written by `shagreen generate`, or was changed since, and is not replaced; choose another folder: {}",
                path.display()
            );
        }
    }
    let heights = folder.join(HEIGHTS).is_file();
    let sha256 = before.as_ref().and_then(|before| before["sha256"][HEIGHTS].as_str());
    Ok(sha256.filter(|_| heights).map(str::to_owned))
}

/// Returns attributes with their standard deviations, by name.
fn described(estimates: &[Estimate]) -> Value {
    let of = |(name, of): (&str, &Estimate)| (name.to_owned(), json!({"value": of.mean, "sd": of.deviation}));
    let by_name: serde_json::Map<String, Value> = ATTRIBUTES.into_iter().zip(estimates).map(of).collect();
    by_name.into()
}

/// Returns the three nearest textures as they stand in results.
fn neighbors(library: &Library, at: SpacePoint) -> Vec<Value> {
    nearest(library, at, 3)
        .into_iter()
        .map(|(texture, distance)| json!({"id": texture.id, "name": texture.name, "distance": distance}))
        .collect()
}
