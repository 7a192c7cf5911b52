//! Plans of studies and logs of sessions.

use std::sync::Arc;

use shagreen_core::people::study::plan::{Design, Plan, problems};
use shagreen_core::people::study::simulated::{Observers, World, simulated_session};
use shagreen_formats::study_log::{LogHeader, StudyLog, TimedEvent, read_study_log};
use shagreen_formats::study_plan::{read_study_plan, study_template, study_templates, write_study_plan};

/// The built-in plans that are small.
pub(crate) fn plan_seeds() -> Vec<Vec<u8>> {
    let small = study_templates().iter().filter(|template| template.text.len() < 5000);
    small.map(|template| template.text.as_bytes().to_vec()).collect()
}

pub(crate) fn read_a_plan(bytes: &[u8]) -> Result<(), String> {
    let Ok(plan) = read_study_plan(bytes) else { return Ok(()) };
    if !problems(&plan).is_empty() {
        return Err("a plan with problems was read".into());
    }
    match read_study_plan(&write_study_plan(&plan)) {
        Ok(again) if again == plan => Ok(()),
        Ok(_) => Err("the written plan is another one".into()),
        Err(error) => Err(format!("the written plan cannot be read: {error}")),
    }
}

/// A log of a simulated participant.
pub(crate) fn log_seeds() -> Vec<Vec<u8>> {
    let text = study_template("anchor-rating").unwrap().text;
    let plan: Arc<Plan> = Arc::new(read_study_plan(text.as_bytes()).unwrap());
    let world = World::invented(&plan, 1);
    let events = simulated_session(&plan, &world, &Observers::usual(), 1, 1).unwrap();
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("log.jsonl");
    let header = LogHeader::new("simulated-01", 1, true, 1, "fuzz", 1.5e9, text).unwrap();
    let mut log = StudyLog::create(&path, &header).unwrap();
    for event in events {
        log.append(&TimedEvent { unix_secs: 1.5e9, event }).unwrap();
    }
    vec![std::fs::read(path).unwrap()]
}

pub(crate) fn read_a_log(bytes: &[u8]) -> Result<(), String> {
    let Ok(log) = read_study_log(bytes) else { return Ok(()) };
    let is_of_plan =
        |part: &str| log.plan.part(part).is_some_and(|part| Design::IDS.contains(&part.design.id()));
    match log.record().answers.iter().find(|answer| !is_of_plan(&answer.trial.part)) {
        Some(answer) => Err(format!("an answer has no part: {:?}", answer.trial)),
        None => Ok(()),
    }
}
