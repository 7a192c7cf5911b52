use std::fmt::Write as _;
use std::path::{Path, PathBuf};

use shagreen_core::maths::rng::{Random, lcg_noise};
use shagreen_core::signals::quality::{Feature, PAPER_RATE, QualityMeter, USUAL_TOLERANCE};
use shagreen_formats::figure::{Figure, figure_csv, figure_svg};
use shagreen_formats::quality_model::{read_quality_model, write_quality_model};
use shagreen_formats::thresholds::ThresholdKind;

use super::{
    FIGURE_NAMES, FittedModel, RatedPairs, fit_figures, fit_pairs, fit_report, fit_text, load_pairs,
    signal_file, verdict,
};
use crate::file::one_line;
use crate::report::Warnings;

/// Simulated pairs of 8 textures, 5 each: d′ is 2 × roughness + 0.5 × envelope, plus noise.
fn simulated_table() -> String {
    let features = Feature::ALL.map(Feature::id).join(",");
    let mut text = format!("reference,comparison,d_prime,simulated,{features}\n");
    let mut random = Random::new(2);
    for texture in 0..8 {
        for pair in 0..5 {
            let distances: [f64; 7] = std::array::from_fn(|_| random.uniform());
            let d_prime = 2.0 * distances[0] + 0.5 * distances[6] + 0.3 * random.normal();
            let distances = distances.map(|distance| distance.to_string()).join(",");
            writeln!(text, "t{texture},t{texture}-{pair},{d_prime},1,{distances}").unwrap();
        }
    }
    text
}

/// Reads a table that names no signals, or signals that `load` makes.
fn read(
    text: &str,
    load: &mut dyn FnMut(&str) -> anyhow::Result<Vec<f64>>,
) -> (anyhow::Result<RatedPairs>, Vec<String>) {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("pairs.csv");
    std::fs::write(&path, text).unwrap();
    let reporter = Warnings::default();
    let pairs = load_pairs(&path, ThresholdKind::Pacinian, load, &reporter, &mut |_, _| true);
    (pairs, reporter.into_vec())
}

fn without_signals(text: &str) -> RatedPairs {
    let (pairs, warnings) = read(text, &mut |name| panic!("{name} is read"));
    assert_eq!(warnings, [""; 0]);
    pairs.unwrap()
}

fn fitted() -> FittedModel {
    fit_pairs(without_signals(&simulated_table()), None, USUAL_TOLERANCE).unwrap()
}

#[test]
fn simulated_weights_come_back_in_file_report_and_figures() {
    let fitted = fitted();
    let report = fit_report(&fitted);
    assert_eq!(
        (&report["n"], &report["n_textures"], &report["simulated"]),
        (&40.into(), &8.into(), &true.into())
    );
    assert_eq!(report["kept"], serde_json::json!(["roughness", "envelope"]));
    for (feature, slope) in [("roughness", 2.0), ("envelope", 0.5)] {
        let number = |key: &str| report[key][feature].as_f64().unwrap();
        let (found, error) = (number("weights"), number("standard_errors"));
        let length = number("lengths");
        assert!(
            (found - slope * length).abs() < error,
            "{feature}: {found} ± {error}, not {}",
            slope * length
        );
        let range = &report["weights_of_rotations"][feature];
        assert!(range[0].as_f64().unwrap() < found && found < range[1].as_f64().unwrap(), "{range}");
    }
    let [nested, own] = ["nested_r2", "r2"].map(|key| report[key].as_f64().unwrap());
    assert!(nested > 0.7 && nested < own, "{nested} {own}");
    assert_eq!(
        (&report["predicts_nothing"], report["rotations"].as_array().unwrap().len()),
        (&false.into(), 28)
    );
    assert_eq!(report["pairs"][39]["comparison"], "t7-4");

    // The file predicts what the report states.
    let file = read_quality_model(&write_quality_model(&fitted.file())).unwrap();
    assert_eq!(file, fitted.file());
    let fit = file.fit.as_ref().unwrap();
    assert!((fit.n_pairs, fit.n_textures, fit.is_simulated) == (40, 8, true) && fit.table_sha256.len() == 64);
    assert!(
        file.corpus.contains("40 rated pairs of 8 textures in pairs.csv, rated by simulated participants")
    );
    let predicted = report["pairs"][3]["predicted"].as_f64().unwrap();
    assert_eq!(file.model.d_prime(&fitted.pairs.rated[3].distances), predicted);

    let figures = fit_figures(&fitted);
    assert!(figures.iter().map(|(name, _)| *name).eq(FIGURE_NAMES));
    let Figure::Chart(chart) = &figures[0].1 else { panic!("no chart") };
    assert_eq!(chart.series.iter().map(|series| series.points.len()).collect::<Vec<_>>(), [2, 40, 40]);
    assert!(chart.title.contains("nested cross-validation R²"), "{}", chart.title);
    for (_, figure) in &figures {
        assert!(figure.title().contains("simulated participants"));
        assert!(figure_svg(figure).ends_with("</svg>\n"));
        assert!(String::from_utf8(figure_csv(figure)).unwrap().contains("simulated participants"));
    }
    let text = fit_text(&fitted);
    for part in ["40 pairs of 8 textures", "roughness", "eliminated, in this order: ", "nothing about people"]
    {
        assert!(text.contains(part), "{text}");
    }
}

#[test]
fn candidates_are_those_of_the_table() {
    let pairs = without_signals(&simulated_table());
    let fitted = fit_pairs(pairs, Some(&[Feature::Brightness, Feature::Envelope]), USUAL_TOLERANCE).unwrap();
    assert!(fitted.fit.model.terms().iter().all(|term| term.feature != Feature::Roughness));
    let few = without_signals("reference,comparison,d_prime,envelope\na,b,1,0.5\n");
    let error = fit_pairs(few, Some(&[Feature::Roughness]), USUAL_TOLERANCE).unwrap_err().to_string();
    assert!(error.contains("no distances in roughness, only in envelope"), "{error}");
    let few = without_signals("reference,comparison,d_prime,envelope\na,b,1,0.5\n");
    let error = fit_pairs(few, None, USUAL_TOLERANCE).unwrap_err().to_string();
    assert!(error.contains("needs 3 or more, got 1"), "{error}");
}

/// Two noises, the first one with half its amplitude, and a signal that is too short.
fn signal(name: &str) -> anyhow::Result<Vec<f64>> {
    match name {
        "a" => Ok(lcg_noise(1600, 1)),
        "a-half" => Ok(lcg_noise(1600, 1).into_iter().map(|x| 0.5 * x).collect()),
        "b" => Ok(lcg_noise(2000, 2)),
        "short" => Ok(vec![0.0; 10]),
        _ => anyhow::bail!("there is no {name}"),
    }
}

#[test]
fn signals_are_compared_and_doubtful_pairs_are_named() {
    let table = "reference,comparison,d_prime\na,a-half,1\na,b,2\n";
    let mut names = Vec::new();
    let (pairs, warnings) = read(table, &mut |name| {
        names.push(name.to_owned());
        signal(name)
    });
    let pairs = pairs.unwrap();
    assert_eq!(names, ["a-half", "a", "b"], "the reference is read once");
    let meter = QualityMeter::new(PAPER_RATE, &ThresholdKind::Pacinian.read().unwrap()).unwrap();
    let expected = meter.distances(&signal("a").unwrap(), &signal("a-half").unwrap()).unwrap();
    assert_eq!(pairs.rated[0].distances, expected);
    assert_eq!((pairs.threshold, pairs.features.len()), (Some(ThresholdKind::Pacinian), 7));
    assert_eq!((pairs.textures.len(), pairs.rated[1].texture), (1, 0));
    assert!(warnings[0].contains("1 pair do not correlate (first in line 3)"), "{warnings:?}");
    assert!(warnings[1].contains("different lengths (first in line 3)"), "{warnings:?}");
    for (name, reason) in [("short", "one segment needs 1600"), ("none", "there is no none")] {
        let (pairs, _) = read(&format!("{table}a,{name},1\n"), &mut signal);
        let error = one_line(&pairs.unwrap_err());
        let is_located = error.starts_with("the pair of line 4: ") && error.ends_with("pairs.csv");
        assert!(is_located && error.contains(reason), "{error}");
    }
}

#[test]
fn signals_have_the_names_of_files_or_of_stimuli() {
    let folder = tempfile::tempdir().unwrap();
    for name in ["steel.wav", "steel-1.75.wav", "clip"] {
        std::fs::write(folder.path().join(name), "").unwrap();
    }
    let file = |name: &str| signal_file(folder.path(), name);
    let at = |name: &str| -> PathBuf { folder.path().join(name) };
    assert_eq!(file("steel").unwrap(), at("steel.wav"));
    assert_eq!(file("steel-1.75").unwrap(), at("steel-1.75.wav"), "what follows the dot is no ending");
    assert_eq!(file("steel.wav").unwrap(), at("steel.wav"));
    assert_eq!(file("clip").unwrap(), at("clip"));
    let error = file("wood").unwrap_err().to_string();
    assert!(error.contains("\"wood.wav\"") && error.contains("--signals"), "{error}");
    assert!(signal_file(Path::new("no/such/folder"), "steel").is_err());
}

#[test]
fn noise_is_not_praised() {
    assert!(verdict(Some(0.71)).contains("explains 71 %"));
    for nothing in [Some(-0.4), Some(0.0), Some(0.1)] {
        let sentence = verdict(nothing);
        assert!(sentence.contains("predicts nothing") && sentence.contains("Do not use it"), "{sentence}");
    }
    assert!(verdict(None).contains("nothing can be said"));
}
