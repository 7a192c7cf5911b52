//! The open plan: read in the background, with everything that is wrong with it.

use std::path::{Path, PathBuf};

use shagreen_formats::atomic;
use shagreen_formats::library::{free_id, id_from_name};
use shagreen_formats::project::Project;
use shagreen_formats::study_plan::StudyPlanError;
use shagreen_studio::file::one_line;
use shagreen_studio::open::PLAN_ENDING;
use shagreen_studio::study::new_plan::{authored_names, plan_with_textures};
use shagreen_studio::study::plans::{StudyPlan, template};
use shagreen_studio::study::preview::{StudyPreview, preview};
use shagreen_studio::study::textures::StudyTextures;

use crate::state::source::Source;

/// Where a plan comes from.
#[derive(Clone, Debug)]
pub(super) enum Origin {
    /// A plan file.
    File(Source),
    /// A built-in plan, by its identifier.
    Template(&'static str),
    /// A built-in plan with the authored textures of the project.
    OfProject(&'static str),
}

/// A plan that can be run.
#[derive(Clone, Debug)]
pub(super) struct OpenStudy {
    pub(super) study: StudyPlan,
    /// File of the plan; `None` until it is saved.
    pub(super) path: Option<PathBuf>,
    /// What the first participant meets.
    pub(super) preview: StudyPreview,
}

/// Reads a plan, and checks that its textures are those of a library or project.
///
/// # Errors
/// All problems of the plan, each in a sentence with its line.
pub(super) fn read(origin: &Origin, project: &Project) -> Result<OpenStudy, Vec<String>> {
    let (study, path, textures) = content(origin, project).map_err(|error| problems(&error))?;
    study.check_textures(&textures).map_err(|error| problems(&error.into()))?;
    let preview = preview(&study, 1).map_err(|error| vec![error.to_string()])?;
    Ok(OpenStudy { study, path, preview })
}

fn content(
    origin: &Origin,
    project: &Project,
) -> anyhow::Result<(StudyPlan, Option<PathBuf>, StudyTextures)> {
    let textures = StudyTextures::of_project(project)?;
    let (study, path) = match origin {
        Origin::File(source) => {
            let bytes = source.bytes().map_err(anyhow::Error::msg)?;
            // The window system may pass a file without its folder.
            let path = Some(source.path()).filter(|path| path.is_file()).map(std::path::absolute);
            (StudyPlan::read_with(&bytes, &textures)?, path.transpose()?)
        }
        Origin::Template(id) => (template(id)?.study, None),
        Origin::OfProject(id) => {
            (plan_with_textures(&template(id)?, &authored_names(&textures)?, &textures)?, None)
        }
    };
    Ok((study, path, textures))
}

/// Problems of a plan, each in a sentence.
fn problems(error: &anyhow::Error) -> Vec<String> {
    match error.downcast_ref::<StudyPlanError>() {
        Some(StudyPlanError::Problems(all)) => all.iter().map(ToString::to_string).collect(),
        _ => vec![one_line(error)],
    }
}

/// Usual path of a plan that is saved in a folder: no file has it yet.
pub(super) fn usual_path(folder: &Path, study: &StudyPlan) -> PathBuf {
    let path_of = |stem: &str| folder.join(format!("{stem}.{PLAN_ENDING}"));
    path_of(&free_id(&id_from_name(&study.plan.name), |stem| path_of(stem).exists()))
}

/// Saves the text of a plan to a new file.
///
/// # Errors
/// There is such a file with another text, or the file cannot be written.
pub(super) fn save(study: &StudyPlan, path: &Path) -> Result<(), String> {
    if path.exists() {
        let present = Source::Path(path.to_owned()).bytes()?;
        return if present == study.text.as_bytes() {
            Ok(())
        } else {
            Err(crate::strings::studies::exists(&path.display().to_string()))
        };
    }
    atomic::write(path, study.text.as_bytes()).map_err(|error| error.to_string())
}

#[cfg(test)]
mod tests {
    use std::path::PathBuf;

    use shagreen_studio::project::new_project;

    use super::{Origin, read, save, usual_path};
    use crate::state::source::Source;

    #[test]
    fn problems_of_a_plan_have_their_lines() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("plan.toml");
        let text = "format = \"shagreen-study\"\nversion = \"1.0\"\nname = \"A\"\nseed = 1\n\n[[stimulus]]\nid = \"a\"\ntexture = \"no-such-texture\"\n\n[[part]]\nid = \"r\"\ndesign = \"rating\"\nscales = [\"rough-smooth\"]\nslider_mm = 127\n";
        std::fs::write(&path, text).unwrap();
        let origin = Origin::File(Source::Path(path));
        let problems = read(&origin, &new_project()).unwrap_err();
        assert_eq!(problems.len(), 1);
        assert!(problems[0].contains("line 8") && problems[0].contains("no-such-texture"), "{problems:?}");
        let missing = Origin::File(Source::Path(PathBuf::from("/no/such/plan.toml")));
        assert!(read(&missing, &new_project()).unwrap_err()[0].contains("cannot be read"));
    }

    #[test]
    fn a_built_in_plan_is_saved_once_and_never_over_another_file() {
        let folder = tempfile::tempdir().unwrap();
        let open = read(&Origin::Template("abx"), &new_project()).unwrap();
        assert!(open.path.is_none() && open.preview.n_trials > 0);
        let path = usual_path(folder.path(), &open.study);
        save(&open.study, &path).unwrap();
        assert_eq!(std::fs::read_to_string(&path).unwrap(), open.study.text);
        save(&open.study, &path).unwrap();
        assert_ne!(usual_path(folder.path(), &open.study), path, "the name is taken");
        std::fs::write(&path, "mine").unwrap();
        assert!(save(&open.study, &path).unwrap_err().contains("another"));
        assert_eq!(std::fs::read_to_string(&path).unwrap(), "mine");
    }

    #[test]
    fn the_authored_textures_of_a_project_are_rated() {
        let open = read(&Origin::OfProject("bipolar-rating"), &new_project()).unwrap();
        assert_eq!(open.study.plan.stimuli.len(), 1);
    }
}
