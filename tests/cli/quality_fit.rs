//! `shagreen quality fit`, and `--model` of the commands that predict d'. All ratings are simulated.

use shagreen_core::maths::rng::{Random, lcg_noise};
use shagreen_core::signals::quality::Feature;
use shagreen_formats::wav::{SidecarV1, write_wav};
use std::fmt::Write as _;

use crate::support::Bench;

/// Simulated pairs of 8 textures, 5 each. d' is 2 × roughness + 0.5 × envelope plus noise, or noise alone.
fn simulated_table(seed: u64, is_noise: bool) -> String {
    let features = Feature::ALL.map(Feature::id).join(",");
    let mut text = format!("reference,comparison,d_prime,simulated,{features}\n");
    let mut random = Random::new(seed);
    for texture in 0..8 {
        for pair in 0..5 {
            let distances: [f64; 7] = std::array::from_fn(|_| random.uniform());
            let signal = if is_noise { 2.0 } else { 2.0 * distances[0] + 0.5 * distances[6] };
            let d_prime = signal + if is_noise { 1.0 } else { 0.3 } * random.normal();
            let distances = distances.map(|distance| distance.to_string()).join(",");
            writeln!(text, "t{texture},t{texture}-{pair},{d_prime},1,{distances}").unwrap();
        }
    }
    text
}

#[test]
fn a_fitted_model_has_its_weights_report_and_figures_and_predicts() {
    let bench = Bench::new();
    bench.write("pairs.csv", simulated_table(2, false));
    let said = bench.json("quality fit pairs.csv -o lab.json --figures plots");
    assert_eq!((said["n"].as_u64(), said["simulated"].as_bool()), (Some(40), Some(true)));
    assert_eq!(said["kept"], serde_json::json!(["roughness", "envelope"]));
    for (feature, slope) in [("roughness", 2.0), ("envelope", 0.5)] {
        let number = |key: &str| said[key][feature].as_f64().unwrap();
        let (found, error) = (number("weights"), number("standard_errors"));
        assert!((found - slope * number("lengths")).abs() < error, "{feature}: {found} ± {error}");
    }
    let [nested, own] = ["nested_r2", "r2"].map(|key| said[key].as_f64().unwrap());
    assert!(nested > 0.7 && nested < own, "{nested} {own}");
    let text = std::fs::read_to_string(bench.path("lab.report.json")).unwrap();
    assert_eq!(serde_json::from_str::<serde_json::Value>(&text).unwrap(), said);
    for name in
        ["lab.report.svg", "plots/predicted-d-prime.csv", "plots/predicted-d-prime.svg", "plots/weights.csv"]
    {
        assert!(bench.path(name).is_file(), "{name}");
    }
    let text = bench.run("quality fit pairs.csv").stdout;
    assert!(text.contains("in nested cross-validation") && text.contains("nothing about people"), "{text}");

    // The model predicts d' from the distances that the command prints.
    bench.json("render --texture cork --speed 100 --force 1 --seconds 0.8 --rate 2000 -o a.wav");
    bench.json("codec encode a.wav -o a.shgc --kbps 1.75");
    bench.json("codec decode a.shgc -o b.wav");
    let quality = bench.json("quality a.wav b.wav --model lab.json");
    let part = |feature: &str| {
        let number = |key: &str| said[key][feature].as_f64().unwrap();
        number("weights") / number("lengths") * quality[feature]["distance"].as_f64().unwrap()
    };
    let expected = part("roughness") + part("envelope");
    assert!((quality["dprime"].as_f64().unwrap() - expected).abs() < 1e-9, "{quality} {expected}");
    assert_eq!((&quality["model"]["name"], &quality["model"]["n"]), (&"lab.json".into(), &40.into()));
    let said = bench.run("quality a.wav b.wav --model lab.json");
    assert!(said.stdout.contains("the model lab.json (fitted to 40 pairs of 8 textures"), "{said:?}");
    assert!(said.stderr.contains("warning: lab.json: simulated participants rated its pairs"), "{said:?}");
    let built_in = bench.json("quality a.wav b.wav");
    assert_eq!(
        (&built_in["model"]["name"], &built_in["threshold"]),
        (&"built-in".into(), &"held-tool".into())
    );
    assert!(built_in["dprime"] != quality["dprime"]);
    // Fitting again replaces the files of the fit, but no other file.
    bench.json("quality fit pairs.csv -o lab.json --figures plots");
    bench.fails("quality fit pairs.csv -o pairs.csv", 1, &["overwrite an input file"]);
    bench.fails("quality fit pairs.csv -o a.json", 1, &["a file of another kind"]);
}

#[test]
fn noise_is_reported_as_noise() {
    let bench = Bench::new();
    bench.write("pairs.csv", simulated_table(5, true));
    let said = bench.run("quality fit pairs.csv -o noise.json");
    assert_eq!(said.code, 0, "{said:?}");
    assert!(said.stderr.contains("warning: The model predicts nothing"), "{said:?}");
    assert!(said.stdout.contains("Do not use it"), "{said:?}");
    let report = bench.json("quality fit pairs.csv");
    assert!(report["nested_r2"].as_f64().unwrap() < 0.1 && report["predicts_nothing"] == true, "{report}");
}

/// Three noises, each with two quieter versions: their roughness differs by 2 log10 of the gain.
#[test]
fn signals_and_stimuli_of_a_study_are_read_by_their_names() {
    let bench = Bench::new();
    std::fs::create_dir(bench.path("signals")).unwrap();
    let mut table = "reference,comparison,hits,n_different,false_alarms,n_same\n".to_owned();
    for (texture, seed) in [("steel", 1), ("wood", 2), ("stone", 3)] {
        for (name, gain, hits) in [("", 1.0, 0), ("-soft", 0.8, 12), ("-softer", 0.5, 19)] {
            let samples: Vec<f32> = lcg_noise(1600, seed).into_iter().map(|x| (gain * x) as f32).collect();
            let path = bench.path(&format!("signals/{texture}{name}.wav"));
            write_wav(&path, &samples, &SidecarV1::new(2000, 0.8, seed, "test")).unwrap();
            if hits > 0 {
                writeln!(table, "{texture},{texture}{name},{hits},20,3,20").unwrap();
            }
        }
    }
    bench.write("pairs.csv", &table);
    let said =
        bench.json("quality fit pairs.csv --signals signals --features roughness --threshold pacinian");
    assert_eq!((said["n"].as_u64(), &said["threshold"]), (Some(6), &"pacinian".into()));
    let of_pair = |index: usize, key: &str| said["pairs"][index][key].clone();
    let distance = of_pair(1, "distances")["roughness"].as_f64().unwrap();
    assert!((distance - 2.0 * 2.0_f64.log10()).abs() < 1e-6, "{distance}");
    // z(19.5 / 21) - z(3.5 / 21), with half an answer of each kind added.
    assert!((of_pair(1, "dprime").as_f64().unwrap() - 2.4327).abs() < 1e-3, "{}", of_pair(1, "dprime"));
    bench.fails(
        "quality fit pairs.csv",
        1,
        &["the pair of line 2", "\"steel-soft.wav\"", "--signals", "pairs.csv"],
    );

    // The stimuli of a plan are made again, as they were presented.
    bench.json("study new same-different --out plan.toml");
    let row = |(texture, d_prime): (&str, f64)| format!("{texture},{texture}-1.75,{d_prime}\n");
    let rows: String = [("steel", 1.5), ("rubber", 1.2), ("marble", 0.9)].map(row).concat();
    bench.write("study.csv", format!("reference,comparison,d_prime\n{rows}"));
    let said = bench.json("quality fit study.csv --plan plan.toml --features envelope");
    assert!(said["pairs"][0]["distances"]["envelope"].as_f64().unwrap() > 0.0, "{said}");
    bench.write("study.csv", "reference,comparison,d_prime\nsteel,steam,1\n");
    bench.fails(
        "quality fit study.csv --plan plan.toml",
        1,
        &["line 2", "no stimulus \"steam\"", "study.csv"],
    );
}

#[test]
fn tables_and_models_that_cannot_be_used_say_why() {
    let bench = Bench::new();
    bench.write("pairs.csv", "reference,comparison,d_prime,envelope\na,b,x,1\n");
    bench.fails("quality fit pairs.csv", 1, &["d_prime in line 2 is \"x\"", "pairs.csv"]);
    bench.write("pairs.csv", "reference,comparison,d_prime,envelope\na,b,1,1\nc,d,1,1\n");
    bench.fails("quality fit pairs.csv", 1, &["needs 3 or more, got 2", "pairs.csv"]);
    bench.fails("quality fit pairs.csv --features warmth", 2, &["warmth"]);
    bench.fails("quality fit pairs.csv --library x.json", 2, &["--plan"]);
    bench.fails("quality fit", 2, &["PAIRS.csv"]);
    bench.fails("quality", 2, &["see --help"]);
    bench.fails("quality a.wav", 2, &["TEST.wav"]);
    bench.write("other.json", "{}");
    bench.fails("quality a.wav b.wav --model other.json", 1, &["this is not a quality model", "other.json"]);
    bench.fails("evaluate codec --model none.json", 1, &["no such file", "none.json"]);
}

#[test]
fn the_signal_that_is_too_short_is_named() {
    let bench = Bench::new();
    for (name, n_samples) in [("short.wav", 400), ("long.wav", 4000)] {
        let samples: Vec<f32> = lcg_noise(n_samples, 1).into_iter().map(|x| x as f32).collect();
        write_wav(&bench.path(name), &samples, &SidecarV1::new(2000, 0.8, 1, "test")).unwrap();
    }
    for arguments in ["short.wav long.wav", "long.wav short.wav"] {
        bench.fails(&format!("quality {arguments}"), 1, &["one segment needs 1600", ": short.wav"]);
    }
}
