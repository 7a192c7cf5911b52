//! `shagreen space build`: builds an authoring space from ratings, with or without sorts.

use std::collections::BTreeSet;
use std::path::PathBuf;
use std::sync::{Arc, Mutex, PoisonError};

use anyhow::bail;
use shagreen_core::dsp::mfcc::{MfccOptions, htk, paper, recommended};
use shagreen_core::people::mds::{MAX_DIMS, Transform};
use shagreen_core::people::ratings::{AdjectivePair, Rating};
use shagreen_core::people::sorting::Finding;
use shagreen_core::space::features::NamedTexture;
use shagreen_core::space::selection::Method;
use shagreen_core::space::space_build::{FeatureKind, PlacedBy, SpaceBuild, SpaceData, SpaceOptions, Step};
use shagreen_core::words::counted;
use shagreen_formats::figure::page_svg;
use shagreen_formats::library::write_library;
use shagreen_formats::space_report::{FORMAT, figure_names, space_report, space_subtitle};

use crate::cli::library_args::LibraryArgs;
use crate::cli::output::{self, Usage, warn_of_restricted};
use crate::cli::progress::Progress;
use crate::cli::quantity::count;
use crate::cli::space_judgments::{JudgmentArgs, Judgments};
use crate::cli::words::words;
use shagreen_studio::figure_files::{check_figures, figure_files, write_together};
use shagreen_studio::replace::{has_format, is_library, refuse_foreign, refuse_inputs};
use shagreen_studio::space::{self, BuiltSpace};

/// Builds an authoring space from judgments of textures and features of their vibrations.
///
/// Multidimensional scaling of the sorts gives a perceptual space. The ratings give the direction of each adjective
/// pair in this space. The textures are projected onto the directions of two pairs, the axes. Without sorts, the
/// positions are the mean ratings on two pairs. Features of the vibrations predict the positions on the axes; nested
/// cross-validation and a permutation test measure the accuracy. A report (L2.report.json) and a page of plots
/// (L2.report.svg) are written next to the library.
#[derive(clap::Args)]
pub(crate) struct Args {
    #[command(flatten)]
    library: LibraryArgs,
    #[command(flatten)]
    judgments: JudgmentArgs,
    /// Library file to write.
    #[arg(long, value_name = "L2")]
    out: PathBuf,
    /// Adjective pairs of the two axes. Default: rough-smooth and hard-soft, or the pair that correlates best with each
    /// dimension. Without sorts, the default is the two least correlated pairs with reliable ratings.
    #[arg(long, value_name = "A,B", value_parser = parse_axes)]
    axes: Option<Axes>,
    /// Number of dimensions of the perceptual space; needs sorts [default: 2]. With three or more, the coordinates of the
    /// textures become attributes of the library, named "dimension 1", "dimension 2" and so on, which can be axes.
    #[arg(long, value_parser = clap::value_parser!(u8).range(2..=MAX_DIMS as i64))]
    dimensions: Option<u8>,
    /// Treatment of tied dissimilarities: primary allows different disparities, secondary keeps them equal. With
    /// interval, disparities are a linear function of the dissimilarities (metric scaling). Auto is primary, or interval
    /// if the solution of primary is degenerate. It needs sorts.
    #[arg(long, default_value = "auto", value_parser = words(Ties::ALL, Ties::id))]
    ties: Ties,
    /// Rotate the second axis to a right angle with the first; needs sorts.
    #[arg(long)]
    orthogonal: bool,
    /// Features of the vibrations.
    #[arg(long, default_value = "mfcc", value_parser = words(FeatureKind::ALL, FeatureKind::id))]
    features: FeatureKind,
    /// Parameters of the mel-frequency cepstral coefficients, if they are among the features [default: recommended].
    #[arg(long, value_parser = ["recommended", "paper", "htk"])]
    mfcc: Option<String>,
    /// Method that predicts an axis from features: practical, a mean of ridge regressions, which predicts better;
    /// paper, as published by Hassan, Abdulali and Jeon (2020); paper-ranked, the same with features in a fixed order
    /// of correlation.
    #[arg(long, default_value = "practical", value_parser = words(Method::ALL, Method::id))]
    selection: Method,
    /// Positions of the textures: felt, from the judgments; predicted, from the features; auto selects for each axis
    /// the positions that are probably closer to perception, and felt without sorts.
    #[arg(long, default_value = "auto", value_parser = words(Placement::ALL, Placement::id))]
    placement: Placement,
    /// Number of permutations for the null distribution of the permutation test.
    #[arg(long, default_value_t = 1000, value_name = "N", value_parser = count(0..=1_000_000))]
    permutations: usize,
    /// Folder for each figure as SVG and CSV.
    #[arg(long, value_name = "FOLDER")]
    figures: Option<PathBuf>,
    /// Random seed; the same seed repeats the result exactly.
    #[arg(long, default_value_t = 1)]
    seed: u64,
    /// Print the report as one JSON object.
    #[arg(long)]
    json: bool,
}

/// Transformation of the dissimilarities; `None` selects it.
#[derive(Clone, Copy, Debug)]
struct Ties(Option<Transform>);

impl Ties {
    const ALL: [Self; 4] = [
        Self(None),
        Self(Some(Transform::PrimaryTies)),
        Self(Some(Transform::SecondaryTies)),
        Self(Some(Transform::Interval)),
    ];

    fn id(self) -> &'static str {
        self.0.map_or("auto", Transform::id)
    }
}

/// Kind of positions; `None` selects it for each axis.
#[derive(Clone, Copy, Debug)]
struct Placement(Option<PlacedBy>);

impl Placement {
    const ALL: [Self; 3] = [Self(None), Self(Some(PlacedBy::Felt)), Self(Some(PlacedBy::Predicted))];

    fn id(self) -> &'static str {
        self.0.map_or("auto", PlacedBy::id)
    }
}

/// Adjective pairs of the two axes.
#[derive(Clone, Debug)]
struct Axes([AdjectivePair; 2]);

fn parse_axes(text: &str) -> Result<Axes, String> {
    let pairs: Vec<AdjectivePair> = text
        .split(',')
        .map(|name| {
            name.parse().map_err(|error: shagreen_core::people::ratings::PairNameError| error.to_string())
        })
        .collect::<Result<_, String>>()?;
    <[AdjectivePair; 2]>::try_from(pairs)
        .map(Axes)
        .map_err(|_| "give two pairs, such as rough-smooth,hard-soft".to_owned())
}

pub(crate) fn run(args: &Args) -> anyhow::Result<()> {
    let options = options(args)?;
    let [report_json, report_svg] =
        ["report.json", "report.svg"].map(|ending| args.out.with_extension(ending));
    let [sorting, ratings, relevance] = args.judgments.paths();
    let inputs = [sorting, ratings, relevance, args.library.path()];
    refuse_inputs(&[&args.out, &report_json, &report_svg], &inputs)?;
    refuse_foreign(&args.out, "the library", is_library)?;
    refuse_foreign(&report_json, "the report", |bytes| has_format(bytes, FORMAT))?;
    refuse_foreign(&report_svg, "the page of plots", |bytes| bytes.starts_with(b"<svg"))?;
    if let Some(folder) = &args.figures {
        check_figures(folder, &figure_names(0), &inputs)?;
    }
    // Checked before minutes of computing.
    if let Some(folder) = [&args.out, &report_json, &report_svg].into_iter().find(|path| path.is_dir()) {
        bail!("this is a folder; choose the name of a file to write: {}", folder.display());
    }
    let library = args.library.load()?;
    let Judgments { sorts, ratings, votes, source, warnings } = args.judgments.read()?;
    if let Some(folder) = &args.figures {
        check_figures(folder, &figure_names(n_pairs(&ratings)), &inputs)?;
    }
    let textures = library.textures.iter().map(|t| NamedTexture { name: &t.id, model: &t.model }).collect();
    let data = SpaceData { textures, sorts, ratings, votes, source };
    let progress = Progress::new("building the space", Step::COUNT);
    let n_done = Mutex::new(0);
    let BuiltSpace { build: built, placed, figures, validation } = space::build(&data, &options, &|step| {
        let mut n_done = n_done.lock().unwrap_or_else(PoisonError::into_inner);
        while *n_done < step.index() {
            progress.step();
            *n_done += 1;
        }
        true
    })
    .map_err(|error| args.judgments.in_files(error, &library, &args.library))?;
    progress.finish();
    let mut report = space_report(&built);
    for finding in &built.findings {
        output::warn(finding);
    }
    report["warnings"] = warnings.into_iter().chain(built.findings.iter().cloned()).collect();
    let mut placed = placed.place(&library);
    output::CREATED_BY.clone_into(&mut placed.created_by);
    warn_of_restricted(&placed);
    let mut text = serde_json::to_string_pretty(&report)?;
    text.push('\n');
    let mut files: Vec<(PathBuf, Vec<u8>)> = Vec::new();
    if let Some(folder) = &args.figures {
        files.extend(figures.iter().flat_map(|(name, figure)| figure_files(folder, name, figure)));
    }
    let on_page: Vec<_> = figures.into_iter().map(|(_, figure)| Arc::unwrap_or_clone(figure)).collect();
    let page = page_svg("Authoring space", &space_subtitle(&built), &on_page);
    files.push((report_json, text.into_bytes()));
    files.push((report_svg, page.into_bytes()));
    files.push((args.out.clone(), write_library(&placed)));
    write_together(&files, args.figures.as_deref())?;
    output::print(args.json, &report, || in_words(args, &built, validation));
    Ok(())
}

fn options(args: &Args) -> anyhow::Result<SpaceOptions> {
    let usual = SpaceOptions::usual(args.seed);
    if let (Some(mfcc), FeatureKind::Physical) = (&args.mfcc, args.features) {
        let text = format!(
            "--mfcc {mfcc} has no effect with --features physical: leave it out, or give --features mfcc+physical"
        );
        return Err(Usage(text).into());
    }
    // Options that have an effect only with sorts.
    let unused = [
        ("--dimensions", args.dimensions.is_some()),
        ("--ties", args.ties.0.is_some()),
        ("--orthogonal", args.orthogonal),
    ];
    if let Some((option, _)) =
        unused.into_iter().find(|(_, is_given)| *is_given && !args.judgments.has_sorts())
    {
        let text = format!("{option} has no effect without --sorting: leave it out, or give --sorting S.csv");
        return Err(Usage(text).into());
    }
    Ok(SpaceOptions {
        n_dims: args.dimensions.map_or(usual.n_dims, usize::from),
        transform: args.ties.0,
        axes: args.axes.clone().map(|axes| axes.0),
        is_orthogonal: args.orthogonal,
        features: args.features,
        mfcc: mfcc(args.mfcc.as_deref()),
        method: args.selection,
        placement: args.placement.0,
        n_permutations: args.permutations,
        ..usual
    })
}

/// Number of adjective pairs among the ratings.
fn n_pairs(ratings: &[Rating]) -> usize {
    ratings.iter().map(|rating| (&rating.pair.low, &rating.pair.high)).collect::<BTreeSet<_>>().len()
}

fn mfcc(name: Option<&str>) -> MfccOptions {
    match name {
        Some("paper") => paper(),
        Some("htk") => htk(),
        _ => recommended(),
    }
}

fn in_words(args: &Args, built: &SpaceBuild, validation: Vec<String>) -> String {
    let pairs: Vec<String> = built.adjectives.iter().map(|adjective| adjective.pair.name()).collect();
    let mut lines = vec![
        format!(
            "Built a space of {} (judgments: {}; positions: {}): {}",
            counted(built.textures.len(), "texture"),
            built.source.label(),
            built.place_source().label(),
            args.out.display()
        ),
        format!("Rated on {}: {}.", counted(pairs.len(), "adjective pair"), pairs.join(", ")),
    ];
    lines.extend(validation);
    lines.extend(outliers_explained(built));
    lines.join("\n")
}

/// Returns an explanation if a participant's judgments are outliers.
fn outliers_explained(built: &SpaceBuild) -> Option<String> {
    let is_rater = built.raters.iter().any(|(_, fit)| fit.outlying);
    let mut of_sorters = built.perceptual.iter().flat_map(|space| &space.similarity.findings);
    let is_sorter = of_sorters.any(|finding| matches!(finding, Finding::Outlying { .. }));
    (is_rater || is_sorter).then(|| {
        format!(
            "Outliers {}: nobody is excluded for it. Check for swapped poles or confused names, and build again without the outlier to see its influence.",
            match (is_sorter, is_rater) {
                (true, true) => "in the sorting table and in the ratings table",
                (true, false) => "in the sorting table",
                _ => "in the ratings table",
            }
        )
    })
}
