//! `shagreen space questionnaire`: lists questionnaires, and writes blank tables and instructions for an experiment.

use std::path::{Path, PathBuf};

use anyhow::{Context as _, bail};
use serde_json::{Value, json};
use shagreen_core::people::ratings::AdjectivePair;
use shagreen_core::words::counted;
use shagreen_formats::atomic;
use shagreen_formats::bounded_file::FileKind;
use shagreen_formats::questionnaire::{Questionnaire, USUAL_PARTICIPANTS, questionnaires};
use shagreen_formats::ratings_csv::read_relevance_csv;

use crate::cli::library_args::LibraryArgs;
use crate::cli::output::{self, Usage};
use crate::cli::quantity::count;
use shagreen_studio::file;
use shagreen_studio::questionnaire::{Experiment, ExperimentFile, questionnaire};
use shagreen_studio::replace::{refuse_foreign, refuse_inputs};

/// Lists the questionnaires of published rating experiments, shows one, or writes its files for an experiment.
///
/// Each questionnaire has adjectives for a vote on their relevance, and pairs of opposite adjectives to rate. The blank
/// tables have a row for each participant and texture of the library. The textures are in a random order for each
/// participant. `space build` reads the tables once they are filled in.
#[derive(clap::Args)]
pub(crate) struct Args {
    /// Questionnaire; without it, all are listed.
    questionnaire: Option<String>,
    #[command(flatten)]
    library: LibraryArgs,
    /// CSV file to write: a blank table of ratings.
    #[arg(long, value_name = "R.csv", requires = "questionnaire")]
    ratings: Option<PathBuf>,
    /// CSV file to write: a blank table of votes on the relevance of the adjectives.
    #[arg(long, value_name = "V.csv", requires = "questionnaire")]
    votes: Option<PathBuf>,
    /// Text file to write: instructions for experimenter and participants.
    #[arg(long, value_name = "I.txt", requires = "questionnaire")]
    instructions: Option<PathBuf>,
    /// CSV file of filled-in votes: the pairs to rate are those of whose adjectives at least half of the votes find each
    /// one relevant. Default: the published pairs.
    #[arg(long, value_name = "V.csv", requires = "questionnaire")]
    relevance: Option<PathBuf>,
    /// Number of participants.
    #[arg(long, default_value_t = USUAL_PARTICIPANTS, value_name = "N", value_parser = count(1..=1000))]
    participants: usize,
    /// Random seed; the same seed gives the same order of the textures.
    #[arg(long, default_value_t = 1)]
    seed: u64,
    /// Print the result as one JSON object.
    #[arg(long)]
    json: bool,
}

pub(crate) fn run(args: &Args) -> anyhow::Result<()> {
    let Some(id) = &args.questionnaire else { return list(args) };
    let questionnaire = questionnaire(id)?;
    let files: Vec<(ExperimentFile, &Path)> = [
        (ExperimentFile::Ratings, &args.ratings),
        (ExperimentFile::Votes, &args.votes),
        (ExperimentFile::Instructions, &args.instructions),
    ]
    .into_iter()
    .filter_map(|(file, path)| Some((file, path.as_deref()?)))
    .collect();
    let pairs = pairs(args, questionnaire)?;
    if files.is_empty() {
        let as_json = json!(described(questionnaire, &pairs));
        output::print(args.json, &as_json, || in_words(questionnaire, &pairs));
        return Ok(());
    }
    for (i, (file, path)) in files.iter().enumerate() {
        if files[..i].iter().any(|(_, other)| other == path) {
            let text = format!("two files cannot have the same name; choose another one: {}", path.display());
            return Err(Usage(text).into());
        }
        refuse_inputs(&[*path], &[args.library.path(), args.relevance.as_deref()])?;
        refuse_foreign(path, "the blank table or the instructions", |bytes| file.may_replace(bytes))?;
    }
    let library = args.library.load()?;
    let textures: Vec<&str> = library.textures.iter().map(|texture| texture.id.as_str()).collect();
    if textures.is_empty() {
        bail!("the library has no textures; give another one with --library");
    }
    let experiment = Experiment {
        questionnaire,
        pairs: &pairs,
        textures: &textures,
        n_participants: args.participants,
        seed: args.seed,
    };
    let contents: Vec<Vec<u8>> = files.iter().map(|(file, _)| file.bytes(&experiment)).collect();
    let written: Vec<(&Path, &[u8])> =
        files.iter().zip(&contents).map(|((_, path), bytes)| (*path, bytes.as_slice())).collect();
    atomic::write_all(&written)?;
    let names: Vec<String> = files.iter().map(|(_, path)| path.display().to_string()).collect();
    let result = json!({
        "questionnaire": questionnaire.id,
        "pairs": pairs.iter().map(AdjectivePair::name).collect::<Vec<_>>(),
        "textures": textures.len(),
        "participants": args.participants,
        "seed": args.seed,
        "files": names,
    });
    output::print(args.json, &result, || {
        format!(
            "Wrote {} for {} and {}: {}",
            questionnaire.name,
            counted(args.participants, "participant"),
            counted(textures.len(), "texture"),
            names.join(", ")
        )
    });
    Ok(())
}

/// Pairs to rate: the published ones, or those that the votes find relevant.
fn pairs(args: &Args, questionnaire: &Questionnaire) -> anyhow::Result<Vec<AdjectivePair>> {
    let Some(path) = &args.relevance else { return Ok(questionnaire.pairs.clone()) };
    let bytes = file::read_file(path, FileKind::Table)?;
    let votes = read_relevance_csv(&bytes).with_context(|| file::in_file(path))?;
    let pairs = questionnaire.relevant_pairs(&votes).with_context(|| file::in_file(path))?;
    if pairs.len() < 2 {
        let text = format!(
            "the votes find both adjectives of {} relevant, but a space needs two; collect more votes, or use the published pairs",
            counted(pairs.len(), "pair")
        );
        return Err(anyhow::anyhow!(text)).with_context(|| file::in_file(path));
    }
    Ok(pairs)
}

fn list(args: &Args) -> anyhow::Result<()> {
    let all = questionnaires()?;
    let as_json: Vec<Value> = all.iter().map(|each| described(each, &each.pairs)).collect();
    output::print(args.json, &json!({ "questionnaires": as_json }), || {
        let line = |each: &Questionnaire| {
            format!(
                "{:16} {}: {} to vote on, {} to rate",
                each.id,
                each.name,
                counted(each.adjectives.len(), "adjective"),
                counted(each.pairs.len(), "pair")
            )
        };
        all.iter().map(line).collect::<Vec<_>>().join("\n")
    });
    Ok(())
}

fn described(questionnaire: &Questionnaire, pairs: &[AdjectivePair]) -> Value {
    let Questionnaire { id, name, source, note, adjectives, further_pairs, .. } = questionnaire;
    let names = |pairs: &[AdjectivePair]| pairs.iter().map(AdjectivePair::name).collect::<Vec<_>>();
    json!({
        "id": id,
        "name": name,
        "source": source,
        "note": note,
        "adjectives": adjectives,
        "pairs": names(pairs),
        "further_pairs": names(further_pairs),
    })
}

fn in_words(questionnaire: &Questionnaire, pairs: &[AdjectivePair]) -> String {
    let names = |pairs: &[AdjectivePair]| {
        let names: Vec<String> = pairs.iter().map(AdjectivePair::name).collect();
        if names.is_empty() { "none".to_owned() } else { names.join(", ") }
    };
    let Questionnaire { id, name, source, note, adjectives, further_pairs, .. } = questionnaire;
    format!(
        "{id}: {name}\nSource: {source}\n{note}\nAdjectives: {}\nPairs to rate: {}\nFurther pairs: {}",
        adjectives.join(", "),
        names(pairs),
        names(further_pairs)
    )
}
