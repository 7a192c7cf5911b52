//! New plans: built-in ones with other textures, such as the authored textures of a project.

use std::collections::BTreeSet;

use anyhow::{Context as _, bail};
use shagreen_core::people::study::plan::{
    Comparison, Design, MushraPage, Part, Plan, Source, Stimulus, Variant, Varied,
};
use shagreen_formats::library::{free_id, id_from_name};
use shagreen_formats::study_plan::{StudyPlanError, write_study_plan};

use crate::near_names::meant;
use crate::study::plans::{ListedTemplate, StudyPlan};
use crate::study::textures::{Found, StudyTextures};

/// Names of the authored textures of a project, in its order.
///
/// # Errors
/// There is no project; or a name is that of another authored texture or of a texture of the library, so that a plan cannot use
/// it.
pub fn authored_names(textures: &StudyTextures) -> anyhow::Result<Vec<String>> {
    let project = textures.project().context("there is no project whose authored textures could be used")?;
    for texture in &project.authored {
        if !matches!(textures.find(&texture.name), Some(Found::Authored(_))) {
            bail!(
                "\"{}\" is the name of several textures, but a plan names each texture once; rename one of them in the project",
                texture.name
            );
        }
    }
    Ok(project.authored.iter().map(|texture| texture.name.clone()).collect())
}

/// A built-in plan with these textures as its stimuli, instead of its own. Designs of pairs compare all pairs; a page of ratings
/// has the first texture as its reference; the anchors of a line are the first and the last one.
///
/// # Errors
/// A texture does not exist or is listed twice, the design has no textures to choose, or there are too few for it.
pub fn plan_with_textures(
    template: &ListedTemplate,
    names: &[String],
    textures: &StudyTextures,
) -> anyhow::Result<StudyPlan> {
    let own = &template.study.plan;
    if own.stimuli.is_empty() {
        bail!("\"{}\" has no textures to choose; its stimuli are made in each trial", template.id);
    }
    let stimuli = stimuli_of(names, textures)?;
    let ids: Vec<String> = stimuli.iter().map(|stimulus| stimulus.id.clone()).collect();
    let mut seen = BTreeSet::new();
    let parts: Vec<Part> = own
        .parts
        .iter()
        // Parts for other textures of the plan would be the same.
        .filter(|part| seen.insert(part.design.id()))
        .map(|part| Part { design: with_stimuli(&part.design, &ids), ..part.clone() })
        .collect();
    let description = format!(
        "{} chosen textures, with the design of the built-in plan {}. That plan says about itself:\n{}",
        names.len(),
        template.id,
        own.description
    );
    let plan = Plan { description, stimuli, parts, ..Plan::clone(own) };
    let head = format!(
        "# Made from the built-in plan {}. `shagreen study preview` shows what a participant meets.\n\n",
        template.id
    );
    let text = head + &String::from_utf8_lossy(&write_study_plan(&plan));
    StudyPlan::read(text.as_bytes()).map_err(|error| too_few(error, names.len()))
}

/// Explains problems of a plan that was not written by the user.
fn too_few(error: StudyPlanError, n: usize) -> anyhow::Error {
    let error = anyhow::Error::from(error);
    error.context(format!("the study cannot be made with {n} textures; choose more, or another study"))
}

fn stimuli_of(names: &[String], textures: &StudyTextures) -> anyhow::Result<Vec<Stimulus>> {
    let mut stimuli: Vec<Stimulus> = Vec::with_capacity(names.len());
    for name in names {
        if textures.find(name).is_none() {
            bail!("there is no texture \"{name}\"; {}", meant(textures.library(), name));
        }
        if stimuli.iter().any(|stimulus| stimulus.source == Source::Texture(name.clone())) {
            bail!("\"{name}\" is listed twice; leave one out");
        }
        let id = free_id(&id_from_name(name), |id| stimuli.iter().any(|stimulus| stimulus.id == id));
        stimuli.push(Stimulus {
            id,
            source: Source::Texture(name.clone()),
            variant: Variant::Original,
            level_db: 0.0,
        });
    }
    Ok(stimuli)
}

/// The design about these stimuli.
fn with_stimuli(design: &Design, ids: &[String]) -> Design {
    let mut design = design.clone();
    let all = || ids.to_vec();
    match &mut design {
        Design::Sorting { stimuli, groups } => {
            *stimuli = all();
            // As many groups as stimuli would be no sort.
            groups.retain(|n| *n < ids.len());
        }
        Design::Relevance { stimuli, .. } | Design::Rating { stimuli, .. } => *stimuli = all(),
        Design::Dissimilarity { pairs, reference } => {
            *pairs = all_pairs(ids);
            *reference = None;
        }
        Design::SameDifferent { pairs, n_segments } => {
            *pairs = all_pairs(ids);
            *n_segments = 1;
        }
        Design::Similarity { pairs, .. } | Design::Abx { pairs } => *pairs = all_pairs(ids),
        Design::Staircase { varied: Varied::Level { stimulus }, .. } => {
            if let Some(first) = ids.first() {
                stimulus.clone_from(first);
            }
        }
        Design::Staircase { varied: Varied::Gap, .. } | Design::Likert { .. } => {}
        Design::Mushra { pages } => {
            let (first, tested) = ids
                .split_first()
                .map_or((String::new(), Vec::new()), |(first, rest)| (first.clone(), rest.to_vec()));
            *pages = vec![MushraPage { reference: first, tested, anchors: Vec::new() }];
        }
        Design::Anchors { stimuli, low, high } => {
            let (first, last) = (ids.first().cloned(), ids.last().cloned());
            *stimuli = ids.iter().skip(1).take(ids.len().saturating_sub(2)).cloned().collect();
            *low = first.unwrap_or_default();
            *high = last.unwrap_or_default();
        }
    }
    design
}

fn all_pairs(ids: &[String]) -> Vec<Comparison> {
    let with_later = |(index, first): (usize, &String)| {
        let first = first.clone();
        ids[index + 1..].iter().map(move |second| Comparison::new(first.clone(), second.clone()))
    };
    ids.iter().enumerate().flat_map(with_later).collect()
}

#[cfg(test)]
mod tests {
    use super::{authored_names, plan_with_textures};
    use crate::project::new_project;
    use crate::study::plans::{template, templates};
    use crate::study::textures::StudyTextures;
    use shagreen_core::people::study::plan::{Design, Source};
    use shagreen_formats::starter::starter_library;

    fn names(names: &[&str]) -> Vec<String> {
        names.iter().map(|name| (*name).to_owned()).collect()
    }

    #[test]
    fn every_built_in_plan_with_stimuli_takes_other_textures() {
        let textures = StudyTextures::of_library(starter_library().unwrap());
        let chosen = names(&["cork", "felt", "denim", "brick"]);
        for template in templates().unwrap() {
            let made = plan_with_textures(&template, &chosen, &textures);
            if template.study.plan.stimuli.is_empty() {
                assert!(made.unwrap_err().to_string().contains("no textures to choose"), "{}", template.id);
                continue;
            }
            let made = made.unwrap_or_else(|error| panic!("{}: {error:#}", template.id));
            assert_eq!(made.plan.stimuli.len(), 4, "{}", template.id);
            assert!(made.missing(&textures).is_empty() && made.text.starts_with("# Made from"));
        }
    }

    #[test]
    fn unknown_repeated_and_too_few_textures_are_refused() {
        let textures = StudyTextures::of_library(starter_library().unwrap());
        let sorting = template("cluster-sorting").unwrap();
        let error = |list: &[&str]| {
            format!("{:#}", plan_with_textures(&sorting, &names(list), &textures).unwrap_err())
        };
        assert!(error(&["crok", "felt"]).contains("did you mean cork?"));
        assert!(error(&["cork", "felt", "cork"]).contains("\"cork\" is listed twice"));
        assert!(error(&["cork", "felt"]).contains("cannot be made with 2 textures"));
    }

    #[test]
    fn authored_textures_of_a_project_become_stimuli() {
        let mut project = new_project();
        let mut further = (*project.authored[0]).clone();
        (further.key, further.name) = (2, "Bark & moss".to_owned());
        project.authored.push(further.into());
        let textures = StudyTextures::of_project(&project).unwrap();
        let authored = authored_names(&textures).unwrap();
        assert_eq!(authored, ["New texture", "Bark & moss"]);
        let made = plan_with_textures(&template("bipolar-rating").unwrap(), &authored, &textures).unwrap();
        let Design::Rating { stimuli, .. } = &made.plan.parts[0].design else { panic!("ratings") };
        assert_eq!(stimuli, &["new-texture", "bark-moss"]);
        assert_eq!(made.plan.stimuli[1].source, Source::Texture("Bark & moss".to_owned()));
        assert!(made.missing(&textures).is_empty());
        // Without the project, the authored textures are missing, and each is named with its line.
        let missing = made.missing(&StudyTextures::of_library(starter_library().unwrap()));
        assert_eq!(missing.len(), 2);
        assert!(missing[0].line.is_some() && missing[0].key == "stimulus[1].texture", "{missing:?}");
    }

    #[test]
    fn a_name_of_two_textures_is_refused() {
        let mut project = new_project();
        std::sync::Arc::make_mut(&mut project.authored[0]).name = "cork".to_owned();
        let error = authored_names(&StudyTextures::of_project(&project).unwrap()).unwrap_err().to_string();
        assert!(error.contains("\"cork\" is the name of several textures"), "{error}");
    }
}
