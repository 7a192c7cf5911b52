//! `shagreen train photo --photos` and `shagreen model show`.

use std::fmt::Write as _;

use crate::prediction_figures::rows;
use crate::support::Bench;
use serde_json::Value;

/// Classes that the lexicon knows, with their softness and the size of the grain in their pictures, in pixels.
const CLASSES: [(&str, u32, usize); 4] =
    [("brick", 9, 1), ("cork", 57, 3), ("carpet", 85, 8), ("paper", 45, 20)];

/// Writes photos of four classes from two sources, and their table.
fn write_photos(bench: &Bench) {
    std::fs::create_dir_all(bench.path("photos")).unwrap();
    let mut table = "file,cls,softness,softness_sd,repo,licence,author,note,extra\n".to_owned();
    for (class, softness, grain) in CLASSES {
        for number in 0..4_u32 {
            let level = |x: u32, y: u32, channel: u32| {
                let cell = |at: u32| at / grain as u32;
                let mixed =
                    (cell(x) * 73 + cell(y) * 151 + channel * 7 + number * 31).wrapping_mul(2_654_435_761);
                40 + (mixed >> 24) as u8 % 160
            };
            let photo =
                image::RgbImage::from_fn(72, 64, |x, y| image::Rgb([0, 1, 2].map(|c| level(x, y, c))));
            let file = format!("{class}-{number}.png");
            photo.save(bench.path(&format!("photos/{file}"))).unwrap();
            let (source, license) = if number < 2 { ("mine", "CC0") } else { ("theirs", "CC-BY 3.0") };
            let note = if number == 3 { "No Provenance" } else { "" };
            writeln!(table, "{file},{class},{softness},8,{source},{license},A. Author,{note},x").unwrap();
        }
    }
    bench.write("photos/photos.csv", table);
}

const TRAIN: &str = "train photo --backbone none --photos photos/photos.csv --state kept --variations 1 --network-epochs 2 --networks 1 --class-folds 3 --source-folds 2";

fn figure<'a>(said: &'a Value, attribute: &str, left_out: &str, predictor: &str) -> &'a Value {
    let is_it = |of: &&Value| {
        of["attribute"] == attribute && of["left_out"] == left_out && of["predictor"] == predictor
    };
    said["left_out"].as_array().unwrap().iter().find(is_it).unwrap()
}

#[test]
fn a_model_is_trained_on_labelled_photos_and_says_how_far_it_holds() {
    let bench = Bench::new();
    write_photos(&bench);
    let said = bench.json(&format!("{TRAIN} --drawn 8 --epochs 2 --heads 1 -o model.safetensors"));
    assert_eq!((&said["photos"], &said["classes"], &said["sources"]), (&16.into(), &4.into(), &2.into()));
    for (attribute, left_out) in [
        ("hard-soft", "classes"),
        ("hard-soft", "sources"),
        ("rough-smooth", "classes"),
        ("rough-smooth", "sources"),
    ] {
        let of_model = figure(&said, attribute, left_out, "the model");
        assert!(of_model["mae"].as_f64().unwrap() >= 0.0 && of_model["n"] == 16, "{of_model}");
        assert!(of_model["error_over_deviation"].as_f64().unwrap() > 0.0, "{of_model}");
        let baseline = figure(&said, attribute, left_out, "mean of the others");
        assert!(baseline["error_over_deviation"].is_null(), "{baseline}");
    }

    // The features are kept, and the labels beside them; heads of an earlier model need no drawn materials.
    let kept = std::fs::read(bench.path("kept/photos-1.safetensors")).unwrap();
    let again = bench.json(&format!("{TRAIN} --drawn-heads model.safetensors -o again.safetensors"));
    assert_eq!(again["left_out"], said["left_out"], "the same seed");
    assert_eq!(std::fs::read(bench.path("kept/photos-1.safetensors")).unwrap(), kept);
    let bytes = |name: &str| std::fs::read(bench.path(name)).unwrap();
    assert_eq!(bytes("again.safetensors"), bytes("model.safetensors"));

    let shown = bench.json("model show model.safetensors");
    assert_eq!(shown["kind"], "attributes from photos");
    assert_eq!(shown["card"]["figures"], said["left_out"]);
    let text = bench.run("model show model.safetensors").stdout;
    for words in ["16 photos of 4 classes", "mine: 8; CC0; A. Author", "CC-BY 3.0", "no person", "limit:"] {
        assert!(text.to_lowercase().contains(&words.to_lowercase()), "{words}: {text}");
    }

    let photo = "predict attributes --photo photos/carpet-0.png --model model.safetensors";
    let predicted = bench.json(photo);
    for name in ["rough-smooth", "hard-soft"] {
        let (value, sd) = (&predicted["attributes"][name]["value"], &predicted["attributes"][name]["sd"]);
        assert!((0.0..=100.0).contains(&value.as_f64().unwrap()), "{predicted}");
        assert!((5.0..29.0).contains(&sd.as_f64().unwrap()), "{predicted}");
    }
    assert!(predicted["model"].as_str().unwrap().contains("16 photos of 4 classes"), "{predicted}");

    // The likely materials, each with its lexicon entry.
    let materials = predicted["materials"].as_array().unwrap();
    assert!((1..=3).contains(&materials.len()), "{predicted}");
    for material in materials {
        let name = material["name"].as_str().unwrap();
        assert!(CLASSES.iter().any(|(class, ..)| *class == name), "{material}");
        assert!((0.05..=1.0).contains(&material["probability"].as_f64().unwrap()), "{material}");
        assert_eq!(material["lexicon_entry"], name);
        let of_word = bench.json(&format!("predict attributes --prompt {name}"));
        let (said, estimate) = (&of_word["attributes"], &material["lexicon_attributes"]);
        for attribute in ["rough-smooth", "hard-soft"] {
            let off =
                said[attribute]["value"].as_f64().unwrap() - estimate[attribute]["value"].as_f64().unwrap();
            assert!(off.abs() < 1e-9, "{name}: {off}");
        }
    }
    let text = bench.run(photo).stdout;
    assert!(text.contains(&format!("looks like {}", materials[0]["name"].as_str().unwrap())), "{text}");
}

#[test]
fn classes_that_were_left_out_are_drawn_beside_their_labels() {
    let bench = Bench::new();
    write_photos(&bench);
    let said = bench.json(&format!("{TRAIN} --drawn 8 --epochs 1 --heads 1 --figures drawn"));
    assert_eq!(said["figures"], "drawn");
    let rows = rows(&bench, "drawn/predictions.csv");
    assert_eq!(
        rows.len(),
        4 * (3 + 5),
        "four classes, three predictors of the roughness of small photos and five of the hardness"
    );
    for [.., method, _, _, deviation] in &rows {
        let is_stated = deviation.parse::<f64>().is_ok_and(|deviation| deviation > 0.0);
        assert_eq!(is_stated, method == "the model", "{method}: {deviation}");
    }
    for (class, softness, _) in CLASSES {
        let is_it = |row: &&[String; 6]| row[0] == class && row[1] == "hard-soft";
        let labels: Vec<&str> = rows.iter().filter(is_it).map(|row| row[3].as_str()).collect();
        assert_eq!(labels, [softness.to_string().as_str(); 5]);
    }
    for (name, source) in [("hard-soft", "physical labels"), ("rough-smooth", "estimates of the lexicon")] {
        let svg = std::fs::read_to_string(bench.path(&format!("drawn/predicted-{name}.svg"))).unwrap();
        for words in ["predicted by the model", "class left out", "nobody", "carpet"] {
            assert!(svg.contains(words), "{name}: {words}");
        }
        let points = std::fs::read_to_string(bench.path(&format!("drawn/predicted-{name}.csv"))).unwrap();
        let dots: Vec<&str> = points.lines().filter(|line| line.starts_with("materials,")).collect();
        assert!(dots.len() == 4 && dots.iter().all(|line| line.contains(source)), "{points}");
    }
    bench.fails(&format!("{TRAIN} --pictures more.csv"), 2, &["--pictures"]);
}

#[test]
fn photos_without_provenance_can_be_left_out() {
    let bench = Bench::new();
    write_photos(&bench);
    let said = bench
        .json(&format!("{TRAIN} --drawn 8 --epochs 1 --heads 1 --without-note provenance -o m.safetensors"));
    assert_eq!((&said["photos"], &said["sources"]), (&12.into(), &2.into()));
    let card = &bench.json("model show m.safetensors")["card"];
    assert_eq!(card["sources"][0]["n_photos"], 8);
    assert_eq!(card["left_out"][1], "4 photos");
    // Features of photos that are left out are kept all the same, for experiments.
    let kept = std::fs::read(bench.path("kept/photos-1.safetensors")).unwrap();
    assert!(String::from_utf8_lossy(&kept).contains("carpet-3.png"), "the file lacks a photo");
}

#[test]
fn tables_of_photos_that_cannot_be_used_say_why() {
    let bench = Bench::new();
    write_photos(&bench);
    let train = "train photo --backbone none --photos";
    bench.fails(&format!("{train} nowhere.csv"), 1, &["nowhere.csv"]);
    bench.write("short.csv", "file,class\na.png,brick\n");
    bench.fails(&format!("{train} short.csv"), 1, &["softness", "short.csv"]);
    let header = "file,class,softness,softness_sd,source,license";
    bench.write("one.csv", format!("{header}\nphotos/brick-0.png,brick,9,7,a,CC0\n"));
    bench.fails(&format!("{train} one.csv"), 1, &["at least 3 classes and 2 sources"]);
    let table = std::fs::read_to_string(bench.path("photos/photos.csv")).unwrap();
    bench.write("photos/gone.csv", table.replace("cork-1.png", "gone.png"));
    bench.fails(&format!("{train} photos/gone.csv --drawn 8"), 1, &["gone.png"]);
    bench.write("photos/broken.png", "no picture");
    bench.write("photos/broken.csv", table.replace("cork-1.png", "broken.png"));
    bench.fails(&format!("{train} photos/broken.csv --drawn 8"), 1, &["broken.png"]);
    let train = "train photo --backbone none --photos photos/photos.csv";
    bench.fails(&format!("{train} --head-weights 1,2"), 2, &["three or four numbers"]);
    bench.fails(&format!("{train} --ridge-penalty 0"), 1, &["--ridge-penalty"]);
    bench.fails(&format!("{train} --drawn-only"), 2, &["--photos"]);
    bench.fails("train photo --without-note x", 2, &["--photos"]);
    bench.fails("model show photos/photos.csv", 1, &["safetensors", "photos.csv"]);
}
