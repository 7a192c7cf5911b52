//! Tables of judgments for a space, and the source of the judgments.

use std::path::{Path, PathBuf};

use anyhow::{Context as _, anyhow, bail};
use shagreen_core::people::panel::is_simulated;
use shagreen_core::people::ratings::{Rating, RelevanceVote};
use shagreen_core::people::sorting::Sort;
use shagreen_core::space::LabelSource;
use shagreen_core::space::space_build::SpaceBuildError;
use shagreen_formats::bounded_file::FileKind;
use shagreen_formats::imported::Imported;
use shagreen_formats::library::Library;
use shagreen_formats::places_csv::Scale;
use shagreen_formats::ratings_csv::{read_ratings, read_relevance_csv};
use shagreen_formats::similar_names::look_alikes;
use shagreen_formats::sorting_csv::read_sorting_csv;

use crate::cli::library_args::LibraryArgs;
use crate::cli::output;
use crate::cli::space_place::parse_scale;
use shagreen_studio::file;
use shagreen_studio::judgments::rescaled;
use shagreen_studio::near_names::meant;

#[derive(clap::Args)]
pub(crate) struct JudgmentArgs {
    /// CSV file of sorts, with a row for each texture of each sort (columns participant, trial, groups, texture,
    /// group), or a column for each texture. Without it, the space is built from the ratings alone.
    #[arg(long, value_name = "S.csv")]
    sorting: Option<PathBuf>,
    /// CSV file of ratings, with a row for each rating (columns participant, texture, adjective, value), or a column
    /// for each adjective pair.
    #[arg(long, value_name = "R.csv")]
    ratings: PathBuf,
    /// CSV file of votes on the relevance of adjectives (columns participant, adjective, relevant). Adjective pairs
    /// with less than half of the votes are not used.
    #[arg(long, value_name = "V.csv")]
    relevance: Option<PathBuf>,
    /// Scale of all ratings, if it is not 0,100; for example 1,7.
    #[arg(long, value_name = "LOW,HIGH", value_parser = parse_scale, allow_hyphen_values = true)]
    scale: Option<Scale>,
    /// Source of the judgments, if the names of participants do not state it: human or simulated.
    #[arg(long, value_name = "SOURCE", value_parser = ["human", "simulated"])]
    source: Option<String>,
}

/// Contents of the tables.
pub(crate) struct Judgments {
    pub(crate) sorts: Vec<Sort>,
    pub(crate) ratings: Vec<Rating>,
    pub(crate) votes: Vec<RelevanceVote>,
    /// Source of the judgments.
    pub(crate) source: LabelSource,
    /// Warnings of irregularities that do not prevent use.
    pub(crate) warnings: Vec<String>,
}

impl JudgmentArgs {
    /// Tables that other options name; without votes on relevance.
    pub(crate) fn of(
        sorting: Option<PathBuf>,
        ratings: PathBuf,
        scale: Option<Scale>,
        source: Option<String>,
    ) -> Self {
        Self { sorting, ratings, relevance: None, scale, source }
    }

    /// Returns the files.
    pub(crate) fn paths(&self) -> [Option<&Path>; 3] {
        [self.sorting.as_deref(), Some(&self.ratings), self.relevance.as_deref()]
    }

    /// Whether there are sorts.
    pub(crate) fn has_sorts(&self) -> bool {
        self.sorting.is_some()
    }

    /// Reads the tables and prints their warnings.
    pub(crate) fn read(&self) -> anyhow::Result<Judgments> {
        let mut warnings = Vec::new();
        let sorts = match &self.sorting {
            Some(path) => read(path, &mut warnings, |bytes| {
                let table = read_sorting_csv(bytes)?;
                Ok(Imported { value: table.sorts, warnings: table.warnings })
            })?,
            None => Vec::new(),
        };
        let ratings = read(&self.ratings, &mut warnings, |bytes| {
            let read = read_ratings(bytes)?;
            let value = read
                .value
                .into_iter()
                .map(|rating| self.rescaled(rating))
                .collect::<anyhow::Result<Vec<_>>>()?;
            Ok(Imported { value, warnings: read.warnings })
        })?;
        let votes = match &self.relevance {
            Some(path) => read(path, &mut warnings, |bytes| {
                Ok(Imported { value: read_relevance_csv(bytes)?, warnings: Vec::new() })
            })?,
            None => Vec::new(),
        };
        let names = participants(&sorts, &ratings, &votes);
        warnings.extend(look_alikes(&names, "participants"));
        for warning in &warnings {
            output::warn(warning);
        }
        let source = self.source(&names)?;
        Ok(Judgments { sorts, ratings, votes, source, warnings })
    }

    /// Converts a rating on another scale to 0..100.
    fn rescaled(&self, rating: Rating) -> anyhow::Result<Rating> {
        match self.scale {
            Some(scale) => rescaled(rating, scale).map_err(|reason| anyhow!("{reason} (--scale)")),
            None => Ok(rating),
        }
    }

    /// Returns the source of the judgments. Participants with names of simulated raters are never taken for people.
    fn source(&self, names: &[&str]) -> anyhow::Result<LabelSource> {
        let (simulated, others): (Vec<&str>, Vec<&str>) = names.iter().partition(|name| is_simulated(name));
        if let ([one, ..], [other, ..]) = (&simulated[..], &others[..]) {
            bail!(
                "there are both simulated participants and others (\"{one}\" and \"{other}\"): a space of both is meaningless; leave one kind out"
            )
        }
        let simulated = simulated.first();
        match (self.source.as_deref(), simulated) {
            (Some("human"), Some(name)) => {
                bail!(
                    "participant \"{name}\" is simulated, so the space is not of human ratings; leave --source out"
                )
            }
            (Some("simulated"), _) | (None, Some(_)) => Ok(LabelSource::SimulatedRaters),
            (None, None) => {
                output::note(
                    "the participants are assumed to be people; if they are not, give --source simulated",
                );
                Ok(LabelSource::HumanRatings)
            }
            _ => Ok(LabelSource::HumanRatings),
        }
    }

    /// Returns the reason why judgments form no space, with the files in which to correct it.
    pub(crate) fn in_files(
        &self,
        error: SpaceBuildError,
        library: &Library,
        of_library: &LibraryArgs,
    ) -> anyhow::Error {
        let (sorting, ratings) = (self.sorting.as_deref(), Some(&*self.ratings));
        let files = match &error {
            SpaceBuildError::UnknownTexture { what: "sorted", .. }
            | SpaceBuildError::TooFewTextures { .. }
            | SpaceBuildError::Sorting(_)
            | SpaceBuildError::Dissimilarities(_)
            | SpaceBuildError::Mds(_) => [sorting, None],
            SpaceBuildError::UnknownTexture { .. }
            | SpaceBuildError::Ratings(_)
            | SpaceBuildError::NoRatings
            | SpaceBuildError::TooFewRated { .. }
            | SpaceBuildError::RatedApart
            | SpaceBuildError::TooFewPairs { .. }
            | SpaceBuildError::NoSuchAxis { .. }
            | SpaceBuildError::Axis { .. } => [ratings, None],
            SpaceBuildError::Votes(_) => [self.relevance.as_deref(), None],
            SpaceBuildError::TextureTwice { .. } | SpaceBuildError::Features(_) => [of_library.path(), None],
            SpaceBuildError::NothingShared
            | SpaceBuildError::FlatAxis { .. }
            | SpaceBuildError::Selection { .. }
            | SpaceBuildError::Space(_) => [sorting, ratings],
            _ => [None, None],
        };
        let error = match &error {
            SpaceBuildError::UnknownTexture { texture, .. } => {
                let hint = meant(library, texture);
                anyhow!("{error}, or remove the column if it is not a texture; {hint}")
            }
            _ => error.into(),
        };
        // The last context is shown first.
        files.into_iter().rev().flatten().fold(error, |error, path| error.context(file::in_file(path)))
    }
}

/// Reads a file of judgments and adds its warnings to `warnings`.
fn read<T>(
    path: &Path,
    warnings: &mut Vec<String>,
    reader: impl FnOnce(&[u8]) -> anyhow::Result<Imported<T>>,
) -> anyhow::Result<T> {
    let bytes = file::read_file(path, FileKind::Table)?;
    let imported = reader(&bytes).with_context(|| file::in_file(path))?;
    warnings.extend(imported.warnings.iter().map(|warning| format!("{warning}: {}", path.display())));
    Ok(imported.value)
}

/// Returns the participant of every sort, rating and vote, with repetitions.
fn participants<'a>(sorts: &'a [Sort], ratings: &'a [Rating], votes: &'a [RelevanceVote]) -> Vec<&'a str> {
    let sorted = sorts.iter().map(|sort| &*sort.participant);
    let rated = ratings.iter().map(|rating| &*rating.participant);
    sorted.chain(rated).chain(votes.iter().map(|vote| &*vote.participant)).collect()
}
