//! `shagreen generate`: a prompt becomes a picture, a point of the space, a texture and a project.

use std::borrow::Cow;
use std::path::{Path, PathBuf};
use std::sync::Arc;

use anyhow::{Context as _, bail, ensure};
use serde_json::{Value, json};
use shagreen_core::authoring::Blending;
use shagreen_core::blend::Mode;
use shagreen_core::gaussian_process::Estimate;
use shagreen_core::generated::{Agreed, GENERATOR, Witness, generate, place};
use shagreen_core::height_field::HeightField;
use shagreen_core::material::Material;
use shagreen_core::prompt::{Understood, title, understand};
use shagreen_core::shading::{Picture as Pixels, shade_tile};
use shagreen_core::space::{LabelSource, SpacePoint};
use shagreen_core::texture::TextureModel;
use shagreen_core::touch_words::ATTRIBUTES;
use shagreen_formats::built_in::BuiltIn;
use shagreen_formats::lexicon_toml::built_in_lexicon;
use shagreen_formats::library::{Library, Place, TextureEntry, id_from_name, write_library};
use shagreen_formats::picture::{Rgb, encode_heights, encode_jpeg, encode_png};
use shagreen_formats::project::{EXTENSION, Project, ProjectLibrary, write_project};
use shagreen_formats::starter::starter_anchors;
use shagreen_learn::diffusion::{LONGEST_SIDE, Wish};
use shagreen_learn::looking::Looker;
use shagreen_learn::model_file::sha256_of;

use crate::cli::backbone_source::{BackboneArgs, read_backbone};
use crate::cli::figures_folder::{check_together, write_together};
use crate::cli::guard::{has_format, refuse_foreign};
use crate::cli::model_folder::model_folder;
use crate::cli::output::{self, Progress};
use crate::cli::said_of_prompt::said_of;
use crate::cli::target::authoring;

/// What the field `format` of the description holds.
const FORMAT: &str = "shagreen-generated";
/// Files of a folder.
const PICTURE: &str = "picture.png";
const HEIGHTS: &str = "heights.png";
const TEXTURE: &str = "texture.json";
const DESCRIPTION: &str = "generated.json";
/// Pixels along each side of the picture that is judged.
const JUDGED_SIDE: usize = 512;
/// Longest name of a texture, in letters.
const LONGEST_NAME: usize = 60;

/// Makes a picture of what a prompt describes, finds its place in the space, and writes the texture that is felt there.
///
/// The picture can be laid beside itself without a seam, and comes with the heights that it shows. It works without any
/// network: a lexicon understands materials, patterns, colors, sizes and adjectives. Where the words and the picture disagree on
/// what it feels like, that is said.
#[derive(clap::Args)]
pub(crate) struct Args {
    /// What it is to be, as in "a rough, soft carpet-like surface".
    #[arg(value_name = "PROMPT")]
    prompt: String,
    /// Folder for the picture, the heights, the texture, the project and a description of them.
    #[arg(long, value_name = "DIR")]
    out: PathBuf,
    /// Another seed makes another piece of the same surface.
    #[arg(long, default_value_t = 1)]
    seed: u64,
    /// Pixels along each side of the picture.
    #[arg(long, default_value_t = 512, value_parser = clap::value_parser!(u32).range(64..=2048))]
    size: u32,
    /// Let the diffusion model that was added by `shagreen model add` make the picture: minutes to hours on a processor.
    #[arg(long)]
    diffusion: bool,
    /// Steps from noise to picture.
    #[arg(long, default_value_t = 30, requires = "diffusion", value_parser = clap::value_parser!(u32).range(1..=500))]
    steps: u32,
    /// What the picture is not to show.
    #[arg(long, default_value = "", hide_default_value = true, requires = "diffusion")]
    negative: String,
    #[command(flatten)]
    backbone: BackboneArgs,
    /// Print one JSON object.
    #[arg(long)]
    json: bool,
}

pub(crate) fn run(args: &Args) -> anyhow::Result<()> {
    let project_name = format!("project.{EXTENSION}");
    check_folder(&args.out, &project_name)?;
    let all = [PICTURE, HEIGHTS, TEXTURE, &project_name, DESCRIPTION].map(|name| args.out.join(name));
    check_together::<&str>(&all.each_ref().map(PathBuf::as_path), Some(&args.out), &[])?;
    let understood = understand(&args.prompt, built_in_lexicon()?);
    let name = title(&args.prompt, LONGEST_NAME).unwrap_or_else(|| "Nothing said".to_owned());
    // What can fail fails before hours are spent.
    let looker = Looker::built_in(read_backbone(&args.backbone)?)?;
    let made = if args.diffusion { by_diffusion(args)? } else { by_procedure(args, &name, &understood)? };
    let [rough, hard] = looker.look(&made.judged())?[..] else {
        bail!("the model of pictures has other axes")
    };
    let [of_rough, of_hard, ..] = understood.attributes;
    let placed = place([of_rough, of_hard], [rough, hard], made.witness());
    let at = placed.at;

    let library = BuiltIn::Starter.read()?;
    let model = felt_at(&library, at)?;
    let rgb = Rgb::from(&made.picture);
    let picture = encode_jpeg(&rgb, made.picture.millimeters)?;
    let neighbors = neighbors(&library, at);
    let entry = TextureEntry {
        description: format!("Made of the words \"{name}\": nobody rated it."),
        place: Some(Place { at, source: LabelSource::Estimated }),
        picture: Some(picture.clone()),
        ..TextureEntry::new(id_from_name(&name), &name, model)
    };
    let mut project = Project::new(ProjectLibrary::BuiltIn(BuiltIn::Starter), &name);
    if let Some(texture) = project.authored.first_mut().map(Arc::make_mut) {
        texture.at = at;
        texture.picture = Some(Arc::new(picture));
        texture.notes = format!("Made of a prompt by the {}, seed {}: {}", made.by, args.seed, args.prompt);
    }
    let file = |name: &str| args.out.join(name);
    let shown = |name: &str| file(name).display().to_string();
    let mut result = json!({
        "format": FORMAT,
        "prompt": args.prompt,
        "image": shown(PICTURE),
        "millimeters": made.picture.millimeters,
        "millimeters_source": if made.relief.is_some() { "made" } else { "assumed" },
        "at": [at.rough_smooth, at.hard_soft],
        "texture": shown(TEXTURE),
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
        "neighbors": neighbors,
        "unknown": understood.unknown,
        "is_about_touch": understood.is_about_touch(),
    });
    let mut files = vec![(file(PICTURE), encode_png(&rgb)?)];
    if let Some((field, _)) = &made.relief {
        let heights = field.heights_m();
        let low = heights.iter().copied().fold(f64::INFINITY, f64::min);
        let high = heights.iter().copied().fold(f64::NEG_INFINITY, f64::max);
        result["heights"] = json!(shown(HEIGHTS));
        result["heights_um"] = json!([1e6 * low, 1e6 * high]);
        files.push((file(HEIGHTS), encode_heights(heights, field.tile().n_cells)?));
    }
    let library_of_one = Library {
        name: name.clone(),
        origin: format!("Made of a prompt by the {} of Shagreen; blended of the starter library.", made.by),
        license: library.license.clone(),
        created_by: output::CREATED_BY.to_owned(),
        seed: Some(args.seed),
        textures: vec![entry],
        ..Library::default()
    };
    files.push((file(TEXTURE), write_library(&library_of_one)));
    files.push((file(&project_name), write_project(&project, &args.out, output::CREATED_BY)));
    write(&args.out, files, &mut result)?;
    output::print(args.json, &result, || {
        let line = |(name, axis): (&str, &Agreed)| {
            format!("{name:<13}  {:5.1} ± {:.1}\n", axis.estimate.mean, axis.estimate.deviation)
        };
        let lines: String = ATTRIBUTES.into_iter().zip(&placed.axes).map(line).collect();
        let disputed = placed.disputed();
        let quarrel = if disputed.is_empty() {
            String::new()
        } else {
            format!("\nthe words and the picture disagree about {}", disputed.join(" and "))
        };
        let near: Vec<&str> = neighbors.iter().filter_map(|near| near["name"].as_str()).collect();
        format!(
            "{lines}near {}{quarrel}{}\npicture by the {}: {}\ntexture: {}\nproject: {}",
            near.join(", "),
            said_of(&understood),
            made.by,
            shown(PICTURE),
            shown(TEXTURE),
            shown(&project_name)
        )
    });
    Ok(())
}

/// The texture of a place; that another one is felt where nothing lies around is said.
fn felt_at(library: &Library, at: SpacePoint) -> anyhow::Result<TextureModel> {
    let authoring = authoring(library, Mode::Field)?;
    let blending = Blending::default();
    let authored = authoring.author(at, &blending).context("the starter library has no places")?;
    if authored.location.clamped {
        output::note(&format!("{at} lies outside the textures; the nearest point among them is felt"));
    }
    authored.model.with_context(|| format!("the field has no texture at {at}; say more, or something else"))
}

/// A picture, and what made it.
struct Made {
    by: String,
    picture: Pixels,
    /// The relief that it shows and its material, where they are known.
    relief: Option<(HeightField, Material)>,
}

impl Made {
    /// The picture that is judged: what it feels like does not hang on how many pixels somebody wants.
    fn judged(&self) -> Cow<'_, Pixels> {
        match &self.relief {
            Some((field, material)) if self.picture.width != JUDGED_SIDE => {
                Cow::Owned(shade_tile(field, material, JUDGED_SIDE))
            }
            _ => Cow::Borrowed(&self.picture),
        }
    }

    /// Whether the picture knows more than the words.
    fn witness(&self) -> Witness {
        if self.relief.is_some() { Witness::OfTheWords } else { Witness::OnItsOwn }
    }
}

fn by_procedure(args: &Args, name: &str, understood: &Understood) -> anyhow::Result<Made> {
    let (anchors, span) = starter_anchors()?;
    let made = generate(name, understood, &anchors, &span, args.size as usize, args.seed)
        .context("the starter library has no materials; get this program again")?;
    Ok(Made { by: GENERATOR.to_owned(), picture: made.picture, relief: Some((made.field, made.material)) })
}

fn by_diffusion(args: &Args) -> anyhow::Result<Made> {
    let most = LONGEST_SIDE;
    ensure!(
        args.size as usize <= most,
        "a diffusion model makes pictures of up to {most} pixels a side; give --size up to that"
    );
    let folder = model_folder()?;
    let added = folder.added_diffusion()?.context(
        "there is no diffusion model on this machine; add one by `shagreen model add FOLDER`, or leave --diffusion out",
    )?;
    let diffusion = folder.diffusion(&added)?;
    let wish = Wish {
        negative: &args.negative,
        side: args.size as usize,
        n_steps: args.steps as usize,
        ..Wish::usual(&args.prompt, args.seed)
    };
    let progress = Progress::new("steps from noise", wish.n_steps);
    let picture = diffusion.picture(&wish, |_| {
        progress.step();
        true
    })?;
    progress.finish();
    let picture = picture.context("it was stopped")?;
    Ok(Made { by: added.name(), picture, relief: None })
}

/// Writes all files and the description, which gets their hashes.
fn write(folder: &Path, mut files: Vec<(PathBuf, Vec<u8>)>, result: &mut Value) -> anyhow::Result<()> {
    let hash = |(path, bytes): &(PathBuf, Vec<u8>)| {
        let name = path.file_name().unwrap_or_default().to_string_lossy().into_owned();
        (name, Value::from(sha256_of(bytes)))
    };
    result["sha256"] = files.iter().map(hash).collect::<serde_json::Map<String, Value>>().into();
    // The folder may go elsewhere: in it, files are told by their names.
    let mut kept = result.clone();
    for field in ["image", "heights", "texture", "project"] {
        let name = kept[field].as_str().map(Path::new).and_then(Path::file_name);
        if let Some(name) = name.map(|name| name.to_string_lossy().into_owned()) {
            kept[field] = Value::from(name);
        }
    }
    files.push((folder.join(DESCRIPTION), serde_json::to_vec_pretty(&kept)?));
    write_together(&files, Some(folder))?;
    let heights = folder.join(HEIGHTS);
    if result.get("heights").is_none() && heights.exists() {
        // The relief of the picture that was there before.
        std::fs::remove_file(&heights).with_context(|| output::in_file(&heights))?;
    }
    Ok(())
}

/// Nothing of somebody else's may be replaced.
fn check_folder(folder: &Path, project_name: &str) -> anyhow::Result<()> {
    ensure!(
        !folder.exists() || folder.is_dir(),
        "what is generated goes into a folder, and this is a file; name another: {}",
        folder.display()
    );
    let description = folder.join(DESCRIPTION);
    refuse_foreign(&description, "the description", |bytes| has_format(bytes, FORMAT))?;
    // What was generated and is still as it was may be replaced; what somebody worked on since may not.
    let before: Option<Value> =
        std::fs::read(&description).ok().and_then(|bytes| serde_json::from_slice(&bytes).ok());
    let is_ours = |name: &str, bytes: &[u8]| {
        let hash = before.as_ref().and_then(|before| before["sha256"][name].as_str());
        hash == Some(&sha256_of(bytes))
    };
    for name in [PICTURE, HEIGHTS, TEXTURE, project_name] {
        let path = folder.join(name);
        if let Ok(bytes) = std::fs::read(&path)
            && !is_ours(name, &bytes)
        {
            bail!(
                "this file was there before, or was changed since it was generated; name another folder: {}",
                path.display()
            );
        }
    }
    Ok(())
}

/// Attributes with how unsure they are, by name.
fn described(estimates: &[Estimate]) -> Value {
    let of = |(name, of): (&str, &Estimate)| (name.to_owned(), json!({"value": of.mean, "sd": of.deviation}));
    let by_name: serde_json::Map<String, Value> = ATTRIBUTES.into_iter().zip(estimates).map(of).collect();
    by_name.into()
}

/// The three nearest textures, nearest first.
fn neighbors(library: &Library, at: SpacePoint) -> Vec<Value> {
    let mut near: Vec<(f64, &TextureEntry)> =
        library.textures.iter().filter_map(|texture| Some((texture.at()?.distance(at), texture))).collect();
    near.sort_by(|a, b| a.0.total_cmp(&b.0));
    near.iter()
        .take(3)
        .map(|(distance, texture)| json!({"id": texture.id, "name": texture.name, "distance": distance}))
        .collect()
}
