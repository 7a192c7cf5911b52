//! Plans of studies: built-in ones, new ones from the textures of a project, and plan files.

use std::path::Path;
use std::sync::Arc;

use anyhow::{Context as _, bail};
use shagreen_core::people::study::plan::{Plan, missing_sources};
use shagreen_core::words::near;
use shagreen_formats::bounded_file::FileKind;
use shagreen_formats::study_log::ReadLog;
use shagreen_formats::study_plan::{
    PlanProblem, StudyPlanError, StudyTemplate, located_problems, read_study_plan, read_study_plan_with,
    study_templates,
};

use crate::file::{in_file, read_file};
use crate::study::textures::StudyTextures;

/// A plan with the text of its file.
#[derive(Clone, Debug, PartialEq)]
pub struct StudyPlan {
    /// The plan.
    pub plan: Arc<Plan>,
    /// Text of the plan file, which every log contains.
    pub text: String,
}

/// Built-in plan, as a list shows it.
#[derive(Clone, Debug, PartialEq)]
pub struct ListedTemplate {
    /// Identifier.
    pub id: &'static str,
    /// The plan.
    pub study: StudyPlan,
}

impl StudyPlan {
    /// Reads the bytes of a plan file.
    ///
    /// # Errors
    /// See [`StudyPlanError`]; [`StudyPlanError::Problems`] has all problems with their lines and keys.
    pub fn read(bytes: &[u8]) -> Result<Self, StudyPlanError> {
        let plan = Arc::new(read_study_plan(bytes)?);
        Ok(Self { plan, text: String::from_utf8_lossy(bytes).into_owned() })
    }

    /// Reads the bytes of a plan file whose textures and profiles must be among these.
    ///
    /// # Errors
    /// See [`StudyPlanError`]; [`StudyPlanError::Problems`] has all problems with their lines and keys, missing textures
    /// included.
    pub fn read_with(bytes: &[u8], textures: &StudyTextures) -> Result<Self, StudyPlanError> {
        let plan = Arc::new(read_study_plan_with(bytes, |source| textures.advice(source))?);
        Ok(Self { plan, text: String::from_utf8_lossy(bytes).into_owned() })
    }

    /// The plan with which the session of a log began.
    pub fn of_log(log: &ReadLog) -> Self {
        Self { plan: Arc::new(log.plan.clone()), text: log.header.plan_text().to_owned() }
    }

    /// Stimuli whose texture or profile does not exist, with their lines in the plan file.
    pub fn missing(&self, textures: &StudyTextures) -> Vec<PlanProblem> {
        located_problems(&self.text, missing_sources(&self.plan, |source| textures.advice(source)))
    }

    /// Checks that all textures and profiles of the plan exist.
    ///
    /// # Errors
    /// Some do not; the message names each with its line and key.
    pub fn check_textures(&self, textures: &StudyTextures) -> Result<(), StudyPlanError> {
        let missing = self.missing(textures);
        if missing.is_empty() { Ok(()) } else { Err(StudyPlanError::Problems(missing)) }
    }
}

/// Reads a plan file.
///
/// # Errors
/// The file cannot be read, or it is not a plan that can be run. `downcast_ref::<StudyPlanError>()` of the error then has all
/// problems with their lines and keys.
pub fn load_plan(path: &Path) -> anyhow::Result<StudyPlan> {
    let bytes = read_file(path, FileKind::Small)?;
    StudyPlan::read(&bytes).with_context(|| in_file(path))
}

/// Reads a plan file whose textures and profiles must be among these.
///
/// # Errors
/// As [`load_plan`]; missing textures are among the problems.
pub fn load_plan_with(path: &Path, textures: &StudyTextures) -> anyhow::Result<StudyPlan> {
    let bytes = read_file(path, FileKind::Small)?;
    StudyPlan::read_with(&bytes, textures).with_context(|| in_file(path))
}

/// The built-in plans, in the order of lists.
///
/// # Errors
/// A built-in plan is damaged.
pub fn templates() -> anyhow::Result<Vec<ListedTemplate>> {
    let listed = |template: &StudyTemplate| {
        let study = StudyPlan::read(template.text.as_bytes())
            .context("a built-in plan is damaged; reinstall Shagreen")?;
        Ok(ListedTemplate { id: template.id, study })
    };
    study_templates().iter().map(listed).collect()
}

/// Returns the built-in plan with this identifier, with its comments.
///
/// # Errors
/// There is none; the message names similar ones, or all.
pub fn template(id: &str) -> anyhow::Result<ListedTemplate> {
    let all = templates()?;
    let ids: Vec<&str> = all.iter().map(|template| template.id).collect();
    let near = near(ids.iter().copied(), id);
    let meant = if near.is_empty() { ids.join(", ") } else { near.join(", ") };
    match all.into_iter().find(|template| template.id == id) {
        Some(found) => Ok(found),
        None => bail!("there is no study \"{id}\" among the built-in plans; choose one of {meant}"),
    }
}

#[cfg(test)]
mod tests {
    use super::{StudyPlan, load_plan, load_plan_with, template, templates};
    use crate::study::logs::{list_logs, usual_log_folder, usual_simulated_log_folder};
    use crate::study::textures::StudyTextures;
    use shagreen_formats::starter::starter_library;
    use shagreen_formats::study_plan::StudyPlanError;
    use std::path::Path;

    #[test]
    fn the_built_in_plans_name_textures_of_the_starter_library() {
        let textures = StudyTextures::of_library(starter_library().unwrap());
        for template in templates().unwrap() {
            assert!(template.study.missing(&textures).is_empty(), "{}", template.id);
            assert!(template.study.text.starts_with("# "), "{}: comments are kept", template.id);
        }
        assert_eq!(template("abx").unwrap().id, "abx");
        let error = template("gap").unwrap_err().to_string();
        assert!(error.contains("choose one of gap-detection"), "{error}");
    }

    #[test]
    fn all_problems_of_a_file_come_with_their_lines() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("plan.toml");
        let text = template("anchor-rating").unwrap().study.text;
        std::fs::write(&path, text.replace("repeats = 2", "repeats = 0").replace("-20 }", "20 }")).unwrap();
        let error = load_plan(&path).unwrap_err();
        let Some(StudyPlanError::Problems(problems)) = error.downcast_ref::<StudyPlanError>() else {
            panic!("{error:#}")
        };
        assert_eq!(problems.len(), 2);
        assert!(problems.iter().all(|problem| problem.line.is_some()), "{problems:?}");
        assert!(format!("{error:#}").contains("plan.toml"));
        assert!(matches!(StudyPlan::read(b"\xff"), Err(StudyPlanError::NotText { .. })));
    }

    /// Keys, meaning and textures in one list, in the order of the file.
    #[test]
    fn missing_textures_are_reported_with_all_other_problems() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("plan.toml");
        let text = template("anchor-rating").unwrap().study.text;
        let text = text.replacen("texture = \"mdf\"", "texture = \"mfd\"", 1);
        std::fs::write(&path, text.replace("repeats = 2", "repeat = 0")).unwrap();
        let textures = StudyTextures::of_library(starter_library().unwrap());
        let error = load_plan_with(&path, &textures).unwrap_err();
        let Some(StudyPlanError::Problems(problems)) = error.downcast_ref::<StudyPlanError>() else {
            panic!("{error:#}")
        };
        let texts: Vec<String> = problems.iter().map(ToString::to_string).collect();
        assert_eq!(texts.len(), 2, "{texts:?}");
        assert!(texts[0].contains("there is no texture \"mfd\"; did you mean mdf?"), "{texts:?}");
        assert!(texts[1].contains("part[1].repeat: the key is unknown; did you mean repeats?"), "{texts:?}");
        assert!(load_plan(&path).unwrap_err().to_string().contains("plan.toml"));
    }

    #[test]
    fn logs_lie_beside_their_plan() {
        assert_eq!(usual_log_folder(Path::new("a/ten.toml")), Path::new("a/ten-logs"));
        let simulated = usual_simulated_log_folder(Path::new("a/ten.toml"));
        assert_eq!(simulated, Path::new("a/ten-logs-simulated"));
        assert!(list_logs(Path::new("no/such/folder")).unwrap().is_empty());
    }
}
