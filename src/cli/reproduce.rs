//! `shagreen reproduce`: repeats the procedures of the five papers, and shows the printed results beside ours.

use std::path::{Path, PathBuf};

use anyhow::Context as _;
use shagreen_formats::places_csv::Scale;
use shagreen_formats::printed_results::Paper;
use shagreen_formats::reproduction_report::{Reproduction, reproduction_report, reproduction_text};
use shagreen_studio::library;
use shagreen_studio::reproduce::{
    Extent, GivenJudgments, ReproduceOptions, check_reproduction_folder, reproduce, write_reproductions,
};

use crate::cli::backbone_source::{BackboneArgs, read_backbone};
use crate::cli::output::{self, Printed, Usage};
use crate::cli::progress::Progress;
use crate::cli::quantity::count;
use crate::cli::space_judgments::{JudgmentArgs, Judgments};
use crate::cli::space_place::parse_scale;
use crate::cli::words::words;

/// Repeats the procedures of the five papers behind the program, and shows the printed results beside ours.
///
/// S0: authoring by interpolation in affective space; S1: textures from texts; S2: attributes by a CNN-LSTM; S3: quality of
/// compressed signals; S4: spatial spectrograms. A number that differs from the printed one, or is missing, has a reason.
/// Raters and participants are simulated unless judgments are given, and are called simulated. Without --full, only the
/// network of S1 is trained.
#[derive(clap::Args)]
pub(crate) struct Args {
    /// Papers to repeat, one or more.
    #[arg(value_name = "PAPER", required = true, value_parser = words(Paper::ALL, Paper::id))]
    papers: Vec<Paper>,
    /// Folder for a page of each paper, its tables and figures, and an index of all papers in the folder.
    #[arg(long, value_name = "DIR")]
    out: Option<PathBuf>,
    /// Train all networks: also the rivals of S1, and those of S2; test the features of S0 by permutations. This takes hours
    /// to days.
    #[arg(long)]
    full: bool,
    /// Library file or folder whose textures are used for S0 to S3. Default: the built-in library that suits the paper.
    #[arg(long, value_name = "L")]
    library: Option<PathBuf>,
    /// CSV file of ratings of these textures, for S0 and S2 in the place of simulated raters.
    #[arg(long, value_name = "R.csv")]
    ratings: Option<PathBuf>,
    /// CSV file of sorts of these textures, for S0.
    #[arg(long, value_name = "S.csv", requires = "ratings")]
    sorting: Option<PathBuf>,
    /// Scale of all ratings, if it is not 0,100; for example 1,7.
    #[arg(long, value_name = "LOW,HIGH", value_parser = parse_scale, allow_hyphen_values = true, requires = "ratings")]
    scale: Option<Scale>,
    /// Source of the judgments, if the names of participants do not state it: human or simulated.
    #[arg(long, value_name = "SOURCE", value_parser = ["human", "simulated"], requires = "ratings")]
    source: Option<String>,
    #[command(flatten)]
    backbone: BackboneArgs,
    /// Largest number of epochs of each network of S1 and, with --full, of S2 [default: that of the paper].
    #[arg(long, value_name = "N", value_parser = count(1..=100_000))]
    epochs: Option<usize>,
    /// Random seed.
    #[arg(long, default_value_t = 1)]
    seed: u64,
    /// Print the result as one JSON object.
    #[arg(long)]
    json: bool,
}

pub(crate) fn run(args: &Args) -> anyhow::Result<()> {
    let papers: Vec<Paper> = Paper::ALL.into_iter().filter(|paper| args.papers.contains(paper)).collect();
    check_options(args, &papers)?;
    if let Some(folder) = &args.out {
        check_reproduction_folder(folder, &papers)?;
    }
    let library = args.library.as_deref().map(|path| library::load(Some(path), &Printed)).transpose()?;
    let judgments = judgments(args)?;
    let backbone = if papers.contains(&Paper::S1) { read_backbone(&args.backbone)? } else { None };
    let options = ReproduceOptions {
        library: library.as_ref(),
        judgments: judgments.as_ref(),
        backbone: backbone.as_ref(),
        is_full: args.full,
        extent: Extent { n_epochs: args.epochs, ..Extent::paper() },
        seed: args.seed,
        command: command(args, &papers),
    };
    let mut all = Vec::with_capacity(papers.len());
    for paper in papers {
        let mut progress: Option<Progress> = None;
        let mut on_step = |what: &'static str| {
            // Only one progress exists at a time.
            drop(progress.take());
            progress = Some(Progress::endless(what));
            true
        };
        let done = reproduce(paper, &options, &mut on_step, &Printed);
        drop(progress);
        all.push(done.with_context(|| format!("{} cannot be reproduced", paper.id()))?);
    }
    // The result of minutes or days is printed even if it cannot be written.
    let written = args.out.as_deref().map(|folder| write_reproductions(folder, &all));
    let index = written.as_ref().and_then(|written| written.as_deref().ok());
    output::print(args.json, &reproduction_report(&all, index.is_some()), || text(&all, index));
    written.transpose()?;
    Ok(())
}

/// Refuses options that no chosen paper uses.
fn check_options(args: &Args, papers: &[Paper]) -> anyhow::Result<()> {
    let options: [(&str, bool, &[Paper]); 4] = [
        ("--library", args.library.is_some(), &[Paper::S0, Paper::S1, Paper::S2, Paper::S3]),
        ("--ratings", args.ratings.is_some(), &[Paper::S0, Paper::S2]),
        ("--backbone", args.backbone.is_given(), &[Paper::S1]),
        ("--epochs", args.epochs.is_some(), &[Paper::S1, Paper::S2]),
    ];
    for (option, is_given, of) in options {
        if is_given && !of.iter().any(|paper| papers.contains(paper)) {
            let of: Vec<&str> = of.iter().map(|paper| paper.id()).collect();
            let text = format!(
                "{option} has an effect on {} only: leave it out, or add one of these papers",
                of.join(", ")
            );
            return Err(Usage(text).into());
        }
    }
    // Without --full, the only network that is trained is that of S1.
    if args.epochs.is_some() && !args.full && !papers.contains(&Paper::S1) {
        let text = "--epochs has no effect on S2 without --full: add --full, or leave --epochs out";
        return Err(Usage(text.to_owned()).into());
    }
    Ok(())
}

/// Reads the judgments, if there are any.
fn judgments(args: &Args) -> anyhow::Result<Option<GivenJudgments>> {
    let Some(ratings) = &args.ratings else { return Ok(None) };
    let given = JudgmentArgs::of(args.sorting.clone(), ratings.clone(), args.scale, args.source.clone());
    let Judgments { sorts, ratings, source, .. } = given.read()?;
    Ok(Some(GivenJudgments { sorts, ratings, source }))
}

/// The command that repeats this.
fn command(args: &Args, papers: &[Paper]) -> String {
    let mut words = vec!["shagreen reproduce".to_owned()];
    words.extend(papers.iter().map(|paper| paper.id().to_owned()));
    if args.full {
        words.push("--full".to_owned());
    }
    let files = [
        ("--library", args.library.as_deref()),
        ("--ratings", args.ratings.as_deref()),
        ("--sorting", args.sorting.as_deref()),
        ("--backbone", args.backbone.path()),
        ("--out", args.out.as_deref()),
    ];
    for (option, path) in files {
        words.extend(path.map(|path| format!("{option} {}", quoted(path))));
    }
    words.extend(args.scale.map(Scale::ends).map(|[low, high]| format!("--scale {low},{high}")));
    words.extend(args.source.as_ref().map(|source| format!("--source {source}")));
    words.extend(args.epochs.map(|epochs| format!("--epochs {epochs}")));
    words.push(format!("--seed {}", args.seed));
    words.join(" ")
}

fn quoted(path: &Path) -> String {
    let text = path.display().to_string();
    if text.contains(char::is_whitespace) { format!("\"{text}\"") } else { text }
}

fn text(all: &[Reproduction], index: Option<&Path>) -> String {
    let mut parts: Vec<String> = all.iter().map(reproduction_text).collect();
    parts.extend(index.map(|index| format!("Pages, tables and figures: {}", index.display())));
    parts.join("\n\n")
}
