//! The paper on textures from texts: attributes predicted from pictures by AttributeNet and its rivals.

mod pictures;

use anyhow::ensure;
use shagreen_core::people::study::plan::Design;
use shagreen_core::words::counted;
use shagreen_formats::built_in::BuiltIn;
use shagreen_formats::library::USUAL_AXES;
use shagreen_formats::reproduction_report::ReproducedItem;
use shagreen_learn::picture_model::rivals::{Rival, rival_predictions};
use shagreen_learn::picture_model::{FeatureExtractor, PictureConfig, PictureModel, TrainingMetadata};
use shagreen_learn::picture_set::Seen;

use crate::method_predictions::MethodPredictions;
use crate::parallel::in_parallel;
use crate::picture_predictions::predict_texture;
use crate::reproduce::charts::attribute_chart;
use crate::reproduce::s1::pictures::{Features, Pictured, label_source, pictures};
use crate::reproduce::work::Work;
use crate::study::plans::template;

/// Fewest textures with a picture: a training needs eight pictures without those of the texture that is predicted.
const LEAST_TEXTURES: usize = 9;
/// Epochs of the paper, and those without progress after which it stops.
const N_EPOCHS: usize = 100;
const PATIENCE: usize = 10;
/// Participants of the user study.
const N_PARTICIPANTS: usize = 11;
/// Why a network was not trained.
const NOT_TRAINED: &str = "not trained; --full";
/// Network of the paper whose features its AttributeNet reads.
const BACKBONE: &str = "ResNet-50";
/// Why errors differ from the printed ones.
const OTHER_DATA: &str = "rendered pictures with physical labels in the place of photos and ratings, and of pictures by Stable Diffusion";
/// Abbreviations of the axes in the identifiers of the printed numbers.
const AXES: [&str; 2] = ["rs", "hs"];

/// Pictures on which a method is trained: the first one of each texture, or all.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Condition {
    First,
    All,
}

impl Condition {
    const BOTH: [Self; 2] = [Self::First, Self::All];

    /// Part of the identifiers of the printed numbers.
    fn id(self) -> &'static str {
        match self {
            Self::First => "real",
            Self::All => "more",
        }
    }

    fn words(self) -> &'static str {
        match self {
            Self::First => "one picture of each texture",
            Self::All => "all pictures",
        }
    }
}

pub(super) fn run(work: &mut Work<'_>) -> anyhow::Result<()> {
    let library = work.library(BuiltIn::Starter)?;
    ensure!(
        library.axis_names() == USUAL_AXES,
        "the axes of \"{}\" are {}; pictures predict rough-smooth and hard-soft, so choose a library with these axes",
        library.name,
        library.axis_names().join(" and ")
    );
    work.step("rendering pictures and computing their features")?;
    let textures = pictures(&library, work.options)?;
    ensure!(
        textures.len() >= LEAST_TEXTURES,
        "\"{}\" has {} with a picture and a position that is not an estimate, but at least {LEAST_TEXTURES} are needed; choose another library",
        library.name,
        counted(textures.len(), "texture")
    );
    let eyes = FeatureExtractor::of(work.options.backbone);
    let n_pictures: usize = textures.iter().map(|texture| texture.features.len()).sum();
    let source = format!(
        "{} with {}, positions from {}; features: {}",
        work.named(&library),
        counted(n_pictures, "picture"),
        label_source(&library),
        eyes.name()
    );
    let n_asked = textures.first().map_or(0, |texture| texture.features.len());
    sizes(work, (n_pictures, n_asked), textures.len(), &source);
    work.step("training AttributeNet without each texture")?;
    let of_conditions =
        Condition::BOTH.into_iter().map(|condition| attribute_net(work, &textures, &eyes, condition));
    let found = of_conditions.collect::<anyhow::Result<Vec<MethodPredictions>>>()?;
    let actual: Vec<Vec<f64>> = textures.iter().map(|texture| texture.labels.clone()).collect();
    if let Some(of_all) = found.last() {
        figure_4(work, &textures, of_all, &actual, &source);
    }
    let mut table = work.item("table-1", source.clone());
    for (condition, predictions) in Condition::BOTH.into_iter().zip(&found) {
        set_errors(&mut table, "attributenet", condition, predictions, &actual);
    }
    if work.options.is_full {
        work.step("training the rivals without each texture")?;
        for (rival, id) in Rival::ALL.into_iter().zip(["visual-cnn", "visionnet", "1d-cnn"]) {
            for condition in Condition::BOTH {
                let predictions = of_rival(work, &textures, rival, condition)?;
                set_errors(&mut table, id, condition, &predictions, &actual);
            }
        }
    }
    let baseline = MethodPredictions::mean_of_others(&actual);
    let of_baseline = baseline.mae(&actual);
    for (name, error) in USUAL_AXES.into_iter().zip(&of_baseline) {
        table.add(format!("{}, {name}", baseline.name), "%", Some(*error));
    }
    explain(&mut table, eyes.name());
    remark_on_baseline(&mut table, &of_baseline);
    table.commands.push("shagreen train photo --drawn 0 --heads 1".to_owned());
    work.done(table);
    user_study(work)
}

/// Numbers of pictures, of all textures and of one, and of networks.
fn sizes(work: &mut Work<'_>, (n_pictures, n_asked): (usize, usize), n_textures: usize, source: &str) {
    let mut item = work.item("sizes", source);
    let n_networks = Condition::BOTH.len() * n_textures;
    for (id, n) in [
        ("pictures", n_pictures),
        ("training", n_pictures - n_asked),
        ("test", n_asked),
        ("networks", n_networks),
    ] {
        item.set(id, Some(n as f64), "");
    }
    item.explain("other textures, or other numbers of pictures");
    work.done(item);
}

/// Gives every number of Table I its reason. `features` names what AttributeNet reads.
fn explain(table: &mut ReproducedItem, features: &str) {
    // Numbers that are equal by coincidence come from other data as well.
    for row in table.rows.iter_mut().filter(|row| row.printed.is_some() && row.reason.is_empty()) {
        row.reason = match &row.printed {
            Some(_) if row.ours.is_none() => NOT_TRAINED.to_owned(),
            Some(printed) if !printed.id.starts_with("attributenet") => {
                format!("{OTHER_DATA}; published weights of the rivals are not at hand")
            }
            _ if features == BACKBONE => OTHER_DATA.to_owned(),
            _ => format!("{OTHER_DATA}; in the paper, features by {BACKBONE}"),
        };
    }
}

/// Says of every error of ours that it is no smaller than that of the mean of the other textures, by axis, if it is not.
fn remark_on_baseline(table: &mut ReproducedItem, of_baseline: &[f64]) {
    for row in &mut table.rows {
        let Some((ours, printed)) = row.ours.zip(row.printed.as_ref()) else { continue };
        let of_axis =
            AXES.into_iter().zip(of_baseline).find(|(axis, _)| printed.id.ends_with(&format!("-{axis}")));
        if of_axis.is_some_and(|(_, error)| ours >= *error) {
            row.reason.push_str("; no better than the mean of the other textures: the features of these pictures do not tell this axis");
        }
    }
}

/// Sets the mean absolute errors of a method, in points of 0 to 100, which the paper calls percent.
fn set_errors(
    table: &mut ReproducedItem,
    id: &str,
    condition: Condition,
    predictions: &MethodPredictions,
    actual: &[Vec<f64>],
) {
    for (axis, error) in AXES.into_iter().zip(predictions.mae(actual)) {
        table.set(&format!("{id}-{}-{axis}", condition.id()), Some(error), "");
    }
}

fn config(work: &Work<'_>) -> PictureConfig {
    let n_epochs = work.options.extent.n_epochs.unwrap_or(N_EPOCHS);
    PictureConfig::paper(n_epochs, PATIENCE, 1, work.options.seed)
}

/// The pictures of a texture that a condition uses, with the features that `of` chooses.
fn seen(texture: &Pictured, condition: Condition, of: fn(&Features) -> &[f32]) -> Vec<Seen> {
    let n = if condition == Condition::First { 1 } else { texture.features.len() };
    let seen = |features: &Features| Seen { features: of(features).to_vec(), labels: texture.labels.clone() };
    texture.features.iter().take(n).map(seen).collect()
}

/// Predictions by one head on features of the pictures, each texture with all of its pictures left out.
fn attribute_net(
    work: &Work<'_>,
    textures: &[Pictured],
    eyes: &FeatureExtractor,
    condition: Condition,
) -> anyhow::Result<MethodPredictions> {
    let all: Vec<Vec<Seen>> =
        textures.iter().map(|texture| seen(texture, condition, Features::extracted)).collect();
    let lesson = TrainingMetadata {
        eyes: eyes.clone(),
        attributes: USUAL_AXES.map(str::to_owned).to_vec(),
        learned_from: "rendered pictures".to_owned(),
    };
    let config = config(work);
    let predicted = in_parallel(all.len(), |left_out| {
        let others: Vec<&Seen> = others(&all, left_out);
        let model = PictureModel::learn(&others, lesson.clone(), &config, |_| true)?;
        let estimates = predict_texture(&model, &all[left_out])?;
        anyhow::Ok(estimates.iter().map(|of| of.mean).collect::<Vec<f64>>())
    });
    let predicted = predicted.into_iter().collect::<anyhow::Result<Vec<Vec<f64>>>>()?;
    Ok(MethodPredictions { name: "AttributeNet".to_owned(), predicted })
}

/// Predictions by a rival, each texture with all of its pictures left out.
fn of_rival(
    work: &Work<'_>,
    textures: &[Pictured],
    rival: Rival,
    condition: Condition,
) -> anyhow::Result<MethodPredictions> {
    let of: fn(&Features) -> &[f32] =
        if rival.reads_pixels() { Features::pixels } else { Features::extracted };
    let all: Vec<Vec<Seen>> = textures.iter().map(|texture| seen(texture, condition, of)).collect();
    let config = config(work);
    let predicted = in_parallel(all.len(), |left_out| {
        let asked: Vec<&Seen> = all[left_out].iter().collect();
        let of_pictures = rival_predictions(rival, &others(&all, left_out), &asked, &config, |_| true)?;
        let n = of_pictures.len() as f64;
        let mean = |axis: usize| of_pictures.iter().map(|of| of[axis]).sum::<f64>() / n;
        anyhow::Ok(vec![mean(0), mean(1)])
    });
    let predicted = predicted.into_iter().collect::<anyhow::Result<Vec<Vec<f64>>>>()?;
    work.reporter.note(&format!("{} was trained on {}", rival.name(), condition.words()));
    Ok(MethodPredictions { name: rival.name().to_owned(), predicted })
}

/// Pictures of all textures but one.
fn others(all: &[Vec<Seen>], left_out: usize) -> Vec<&Seen> {
    let others = all.iter().enumerate().filter(|(index, _)| *index != left_out);
    others.flat_map(|(_, pictures)| pictures).collect()
}

/// Figure 4: actual and predicted attributes by AttributeNet, trained on all pictures.
fn figure_4(
    work: &mut Work<'_>,
    textures: &[Pictured],
    found: &MethodPredictions,
    actual: &[Vec<f64>],
    source: &str,
) {
    let mut item = work.item("figure-4", source);
    let names: Vec<&str> = textures.iter().map(|texture| texture.name.as_str()).collect();
    for (axis, attribute) in USUAL_AXES.into_iter().enumerate() {
        let chart = attribute_chart((axis, attribute), &names, actual, found, source);
        item.figures.push((attribute.to_owned(), chart));
    }
    work.done(item);
}

/// Figure 5: ratings of people, which nothing computes, and their number in the built-in plan.
fn user_study(work: &mut Work<'_>) -> anyhow::Result<()> {
    let mut item =
        work.item("figure-5", "people only; the numbers of ratings are those of the built-in plan");
    item.commands.push("shagreen study new text-to-texture --out text-to-texture.toml".to_owned());
    let plan = template("text-to-texture")?.study.plan;
    let design = plan.parts.first().map(|part| &part.design);
    if let Some(Design::Likert { conditions, statements, prompts, .. }) = design {
        let n_averages = conditions.len() * statements.len();
        item.set("ratings", Some((prompts.n_texts() * n_averages) as f64), "");
        item.set("averages", Some((N_PARTICIPANTS * n_averages) as f64), "");
    }
    item.explain("only people can tell; the built-in plan text-to-texture asks them");
    work.done(item);
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::{explain, remark_on_baseline};
    use shagreen_formats::printed_results::{Paper, printed_results};
    use shagreen_formats::reproduction_report::ReproducedItem;

    #[test]
    fn an_error_above_that_of_the_mean_has_a_remark() {
        let printed = printed_results(Paper::S1).unwrap().into_iter().find(|item| item.id == "table-1");
        let mut table = ReproducedItem::new(printed.unwrap(), "");
        table.set("attributenet-real-rs", Some(30.0), "");
        table.set("attributenet-real-hs", Some(9.3), "");
        explain(&mut table, "none");
        remark_on_baseline(&mut table, &[25.0, 26.0]);
        let reason = |id: &str| {
            let row = table.rows.iter().find(|row| row.printed.as_ref().is_some_and(|of| of.id == id));
            row.unwrap().reason.clone()
        };
        assert!(
            reason("attributenet-real-rs").ends_with("do not tell this axis"),
            "{}",
            reason("attributenet-real-rs")
        );
        // The other one is below the mean, and says where it comes from although it equals the printed one.
        assert!(reason("attributenet-real-hs").contains("in the paper, features by"));
        assert!(!reason("attributenet-real-hs").contains("no better than the mean"));
        assert!(!reason("1d-cnn-real-rs").contains("no better than the mean"), "it was not trained");
    }
}
