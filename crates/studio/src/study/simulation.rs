//! Simulated participants of a plan, and their logs.
//!
//! They show that a plan and its analysis work, before people are invited. Their names and all results from them say that they
//! are simulated.

mod effect;

use std::path::{Path, PathBuf};

use anyhow::bail;
use shagreen_core::people::panel::simulated_name;
use shagreen_core::people::study::answer::Event;
use shagreen_core::people::study::plan::Plan;
use shagreen_core::people::study::simulated::{Observers, World, simulated_session};
use shagreen_formats::study_log::{LogHeader, TimedEvent, write_study_log};

use crate::figure_files::write_together;
use crate::study::logs::{ListedLog, check_same_study, list_logs, log_path};
use crate::study::plans::StudyPlan;
use crate::study::program;

use self::effect::{with_conditions, with_effect};

/// What is simulated.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Simulation {
    /// Number of participants, 1 or more.
    pub n_participants: usize,
    /// Seed: the same one gives the same logs.
    pub seed: u64,
    /// How the participants perceive and answer.
    pub observers: Observers,
    /// Difference between what they compare, in points of a scale of 0 to 100; `None` for random positions, and for conditions of
    /// a questionnaire that differ by [`USUAL_CONDITION_POINTS`].
    pub effect_points: Option<f64>,
}

/// Difference between the first and the last condition of a questionnaire, in points of a scale of 0 to 100; that of the
/// published study is 43.
pub const USUAL_CONDITION_POINTS: f64 = 40.0;

/// Logs of simulated participants, and what was hidden in them.
#[derive(Clone, Debug)]
pub struct SimulatedLogs {
    /// Name of each participant, and its log.
    pub logs: Vec<(String, Vec<u8>)>,
    /// Number of answers of all participants.
    pub n_answers: usize,
    /// Positions from which they answered.
    pub world: World,
}

impl Simulation {
    /// Attentive participants with random positions.
    pub fn usual(n_participants: usize, seed: u64) -> Self {
        Self { n_participants, seed, observers: Observers::usual(), effect_points: None }
    }

    /// What the participants perceive of a plan.
    pub fn world(&self, plan: &Plan) -> World {
        let world = World::invented(plan, self.seed);
        match self.effect_points {
            Some(points) => with_effect(world, plan, points),
            None => with_conditions(world, plan, USUAL_CONDITION_POINTS),
        }
    }
}

/// Simulates the sessions of a plan. `on_step` receives the number of simulated participants and the number of all, and returns
/// whether to continue. Times in the logs count from 0, so that equal seeds give equal logs.
///
/// # Errors
/// The plan cannot be run, a parameter is out of range, or `on_step` ended the work.
pub fn simulated_logs(
    study: &StudyPlan,
    simulation: &Simulation,
    on_step: &mut dyn FnMut(usize, usize) -> bool,
) -> anyhow::Result<SimulatedLogs> {
    let Simulation { n_participants, seed, observers, .. } = *simulation;
    let world = simulation.world(&study.plan);
    let (mut logs, mut n_answers) = (Vec::with_capacity(n_participants), 0);
    for number in 1..=n_participants {
        if !on_step(number - 1, n_participants) {
            bail!("no participants were simulated: the work was ended");
        }
        let events = simulated_session(&study.plan, &world, &observers, number, seed)?;
        n_answers += events.iter().filter(|event| matches!(event, Event::Answered(_))).count();
        let name = simulated_name(number);
        let header = LogHeader::new(&name, number, true, seed, &program(), 0.0, &study.text)?;
        logs.push((name, write_study_log(&header, &timed(events))));
    }
    on_step(n_participants, n_participants);
    Ok(SimulatedLogs { logs, n_answers, world })
}

/// Writes the logs of simulated participants into a folder without logs of simulated participants, all or none.
///
/// # Errors
/// The folder has logs of simulated participants ([`ReplacesLogs`]) or of another plan, or a file of another kind in the place of
/// a log; or the logs cannot be written.
pub fn write_simulated_logs(
    study: &StudyPlan,
    simulated: &SimulatedLogs,
    folder: &Path,
) -> anyhow::Result<Vec<PathBuf>> {
    let present = present_logs(study, folder)?;
    let simulated_log = |listed: &&ListedLog| listed.log.as_ref().is_ok_and(|log| log.header.is_simulated());
    if let Some(ListedLog { path, .. }) = present.iter().find(simulated_log) {
        return Err(ReplacesLogs { path: path.clone() }.into());
    }
    write_logs(simulated, &present, folder)
}

/// Writes the logs of simulated participants into a folder, all or none, in the place of logs of simulated participants. Logs of
/// people are never replaced.
///
/// # Errors
/// The folder has logs of another plan, of further simulated participants, or a file of another kind in the place of a log; or
/// the logs cannot be written.
pub fn replace_simulated_logs(
    study: &StudyPlan,
    simulated: &SimulatedLogs,
    folder: &Path,
) -> anyhow::Result<Vec<PathBuf>> {
    let present = present_logs(study, folder)?;
    write_logs(simulated, &present, folder)
}

/// The folder has logs of simulated participants already.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error(
    "the folder has logs of simulated participants, which are replaced only on request; choose another folder, or replace them: {}",
    .path.display()
)]
pub struct ReplacesLogs {
    /// Path of the first one.
    pub path: PathBuf,
}

/// Logs of the folder, which must be of this study.
fn present_logs(study: &StudyPlan, folder: &Path) -> anyhow::Result<Vec<ListedLog>> {
    if folder.exists() && !folder.is_dir() {
        bail!(
            "logs are written into a folder, but this is a file; choose another folder: {}",
            folder.display()
        );
    }
    let present = list_logs(folder)?;
    check_same_study(&study.plan, &present)?;
    Ok(present)
}

/// Writes logs into a folder with these logs.
fn write_logs(
    simulated: &SimulatedLogs,
    present: &[ListedLog],
    folder: &Path,
) -> anyhow::Result<Vec<PathBuf>> {
    let files: Vec<(PathBuf, Vec<u8>)> =
        simulated.logs.iter().map(|(name, bytes)| (log_path(folder, name), bytes.clone())).collect();
    let is_written = |path: &Path| files.iter().any(|(file, _)| file == path);
    for ListedLog { path, log } in present {
        match log {
            Ok(log) if log.header.is_simulated() == is_written(path) => {}
            Ok(log) if log.header.is_simulated() => bail!(
                "the folder has logs of further simulated participants, which would be mixed with these; choose another folder, or remove them: {}",
                path.display()
            ),
            Ok(_) => bail!(
                "the log of a person has the name of a simulated participant; choose another folder: {}",
                path.display()
            ),
            Err(_) if !is_written(path) => {}
            Err(_) => bail!(
                "a file that is not a log has the name of a log; choose another folder: {}",
                path.display()
            ),
        }
    }
    write_together(&files, Some(folder))?;
    Ok(files.into_iter().map(|(path, _)| path).collect())
}

/// Events with their times in s: each answer takes its response time.
fn timed(events: Vec<Event>) -> Vec<TimedEvent> {
    let mut unix_secs = 0.0;
    let with_time = |event: Event| {
        if let Event::Answered(answer) = &event {
            unix_secs += answer.measured.response_secs.unwrap_or(0.0);
        }
        TimedEvent { unix_secs, event }
    };
    events.into_iter().map(with_time).collect()
}

#[cfg(test)]
mod tests;
