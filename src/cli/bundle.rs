//! `shagreen bundle`: a project or a library with everything that belongs to it, in one file to share.

use std::path::{Path, PathBuf};

use anyhow::Context as _;
use serde_json::{Value, json};
use shagreen_core::words::counted;
use shagreen_formats::atomic;
use shagreen_formats::bundle::{Bundle, BundleKind, BundleManifestV1, BundleRole};
use shagreen_studio::bundle::{BundleOptions, BundleSource, Bundled, bundle, check_bundle, extract_bundle};
use shagreen_studio::file::{check_ending, file_name, in_file};
use shagreen_studio::replace::{refuse_foreign, refuse_inputs};

use crate::cli::out_name::refuse_dash;
use crate::cli::output::{self, Printed};
use crate::cli::own_folder::permitted_libraries;

/// Bundles a project or a library with its pictures, terms of use and sources in one ZIP file, checks such a file, or unpacks it.
///
/// Every file in a bundle has a SHA-256. Textures that must not be redistributed are refused, and authored textures that are made
/// of them.
#[derive(clap::Args)]
pub(crate) struct Args {
    /// Project, library or folder of libraries to bundle.
    #[arg(value_name = "PROJECT|LIBRARY", required_unless_present_any = ["check", "extract"])]
    source: Option<PathBuf>,
    /// Bundle to write.
    #[arg(short, long, value_name = "FILE.zip", required_unless_present_any = ["check", "extract"])]
    out: Option<PathBuf>,
    /// File or folder to add, such as exported signals. Can be given several times.
    #[arg(long = "export", value_name = "PATH")]
    exports: Vec<PathBuf>,
    /// Include textures that must not be redistributed, because their data are yours. The bundle says so.
    #[arg(long)]
    override_restriction: bool,
    /// Check that every file of a bundle is the one that was bundled.
    #[arg(long, value_name = "FILE.zip", conflicts_with_all = ["source", "out", "exports", "override_restriction"])]
    check: Option<PathBuf>,
    /// Unpack a bundle into a new or empty folder, after the same check.
    #[arg(
        long,
        num_args = 2,
        value_names = ["FILE.zip", "FOLDER"],
        conflicts_with_all = ["source", "out", "exports", "override_restriction", "check"]
    )]
    extract: Option<Vec<PathBuf>>,
    /// Print the result as one JSON object.
    #[arg(long)]
    json: bool,
}

pub(crate) fn run(args: &Args) -> anyhow::Result<()> {
    match (args, args.extract.as_deref()) {
        (Args { check: Some(path), .. }, _) => {
            let manifest = check_bundle(path)?;
            print(args, &manifest, path, "every file is the one that was bundled");
        }
        (_, Some([path, folder])) => {
            let manifest = extract_bundle(path, folder)?;
            print(args, &manifest, path, &unpacked(&manifest, folder));
        }
        (Args { source: Some(source), out: Some(out), .. }, _) => {
            let manifest = write(args, source, out)?;
            print(args, &manifest, out, "written");
        }
        _ => return Err(output::Usage("give a project or a library, and --out".to_owned()).into()),
    }
    Ok(())
}

/// Writes a bundle and returns its list.
fn write(args: &Args, source: &Path, out: &Path) -> anyhow::Result<BundleManifestV1> {
    refuse_dash(out)?;
    let inputs: Vec<Option<&Path>> =
        [source].into_iter().chain(args.exports.iter().map(PathBuf::as_path)).map(Some).collect();
    refuse_inputs(&[out], &inputs)?;
    refuse_foreign(out, "the bundle", |bytes| Bundle::open(bytes).is_ok())?;
    check_ending("a bundle", "zip", out)?;
    let name = name_of(source);
    let read = BundleSource::read(source, &permitted_libraries(), &Printed)?;
    let options = BundleOptions {
        name: &name,
        created_by: output::CREATED_BY,
        exports: &args.exports,
        overrides_restriction: args.override_restriction,
    };
    let Bundled { bytes, manifest } = bundle(&read, &options, &Printed).with_context(|| in_file(source))?;
    atomic::write(out, &bytes)?;
    if let Some(shared) = &manifest.override_restriction {
        output::warn(&format!(
            "the bundle has what must not be redistributed, and says that you have the right to share it: {}",
            shared.textures.join(", ")
        ));
    }
    Ok(manifest)
}

/// Name of a project or library: that of its file without the ending, or of its folder.
fn name_of(source: &Path) -> String {
    let name = file_name(source);
    let stem = source.file_stem().filter(|_| !source.is_dir());
    let stem = stem.map_or(name, |stem| stem.to_string_lossy().into_owned());
    if stem.is_empty() { "textures".to_owned() } else { stem }
}

/// What was unpacked, and what to do with it.
fn unpacked(manifest: &BundleManifestV1, folder: &Path) -> String {
    let role = match manifest.kind {
        BundleKind::Project => BundleRole::Project,
        BundleKind::Library => BundleRole::Library,
    };
    let main = manifest.files.iter().find(|file| file.role == role);
    let main = main.map_or_else(|| folder.to_owned(), |file| folder.join(&file.path));
    format!("unpacked; open {}", main.display())
}

fn print(args: &Args, manifest: &BundleManifestV1, bundle: &Path, done: &str) {
    let bytes: u64 = manifest.files.iter().map(|file| file.bytes).sum();
    let n_restricted = manifest.textures.iter().filter(|texture| texture.restricted).count();
    let files: Vec<Value> = manifest
        .files
        .iter()
        .map(|file| json!({"path": file.path, "bytes": file.bytes, "sha256": file.sha256}))
        .collect();
    let kind = match manifest.kind {
        BundleKind::Project => "project",
        BundleKind::Library => "library",
    };
    let result = json!({
        "bundle": bundle.display().to_string(),
        "name": manifest.name,
        "kind": kind,
        "created_by": manifest.created_by,
        "licence": manifest.licence,
        "override_restriction": manifest.override_restriction.as_ref().map(|shared| &shared.statement),
        "textures": manifest.textures.len(),
        "restricted": n_restricted,
        "bytes": bytes,
        "files": files,
    });
    output::print(args.json, &result, || {
        let stated = manifest.override_restriction.as_ref();
        let stated = stated.map_or(String::new(), |shared| {
            format!("\n{} Restricted: {}.", shared.statement, shared.textures.join(", "))
        });
        format!(
            "{}: {kind} \"{}\" by {}, {}, {}, {bytes} bytes: {done}\nterms of use: {}{stated}",
            bundle.display(),
            manifest.name,
            manifest.created_by,
            counted(manifest.textures.len(), "texture"),
            counted(manifest.files.len(), "file"),
            manifest.licence
        )
    });
}
