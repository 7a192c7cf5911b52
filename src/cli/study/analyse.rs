//! `shagreen study analyse`: computes the results of a study from its logs.

use std::path::{Path, PathBuf};

use shagreen_studio::figure_files::write_together;
use shagreen_studio::replace::refuse_inputs;
use shagreen_studio::study::analysis::{
    ParticipantKind, StudyReport, analyze, check_report_files, read_logs_with, report_files, report_text,
};
use shagreen_studio::study::plans::load_plan;

use crate::cli::output;

/// Computes the results of a study from its logs: means with confidence intervals, tests, thresholds, d', similarities.
///
/// Damaged lines of a log are named and skipped. People and simulated participants are never mixed in one result. Answers
/// without a touch, on a silent output and so on are named and counted.
#[derive(clap::Args)]
pub(crate) struct Args {
    /// Logs, or folders of logs.
    #[arg(value_name = "LOG", required = true)]
    logs: Vec<PathBuf>,
    /// Analyze the people only, if there are logs of people and of simulated participants.
    #[arg(long, conflicts_with = "simulated")]
    people: bool,
    /// Analyze the simulated participants only.
    #[arg(long)]
    simulated: bool,
    /// Plan file of the study, for logs whose first line is damaged. Default: the plan of the other logs.
    #[arg(long, value_name = "PLAN.toml")]
    plan: Option<PathBuf>,
    /// Folder for the report (report.json, report.svg), all answers as a tidy table (answers.csv), the figures as SVG and CSV,
    /// tables for `space build` (sorting.csv, ratings.csv, votes.csv), and counts and d' of same-different pairs (pairs.csv).
    #[arg(short, long, value_name = "FOLDER")]
    out: Option<PathBuf>,
    /// Print the report as one JSON object.
    #[arg(long)]
    json: bool,
}

pub(crate) fn run(args: &Args) -> anyhow::Result<()> {
    let kind = match (args.people, args.simulated) {
        (true, _) => Some(ParticipantKind::People),
        (_, true) => Some(ParticipantKind::Simulated),
        _ => None,
    };
    let plan = args.plan.as_deref().map(load_plan).transpose()?;
    let logs = read_logs_with(&args.logs, plan.as_ref())?;
    if let ([n_people, n_simulated], None) = (logs.counts(), kind)
        && n_people > 0
        && n_simulated > 0
    {
        let text = format!(
            "there are logs of people ({n_people}) and of simulated participants ({n_simulated}), which are never mixed in one result; give --people or --simulated"
        );
        return Err(output::Usage(text).into());
    }
    let report = analyze(&logs, kind)?;
    for warning in &report.warnings {
        output::warn(warning);
    }
    if let Some(folder) = &args.out {
        let files = report_files(&report, folder);
        check_report_files(folder, &files)?;
        let written: Vec<&Path> = files.iter().map(|(path, _)| path.as_path()).collect();
        let inputs: Vec<Option<&Path>> = logs.paths().map(Some).chain([args.plan.as_deref()]).collect();
        refuse_inputs(&written, &inputs)?;
        write_together(&files, Some(folder))?;
    }
    output::print(args.json, &report.json, || in_words(&report, args.out.as_deref()));
    Ok(())
}

fn in_words(report: &StudyReport, out: Option<&Path>) -> String {
    let text = report_text(report);
    match out {
        Some(folder) => format!("{text}\n\nThe report is in {}", folder.display()),
        None => text,
    }
}
