//! Figures of predictors: predicted against actual attributes, and the table of all predictions.

use serde_json::Value;

use crate::support::Bench;

const FIVE: [&str; 5] = ["rough-smooth", "hard-soft", "flat-bumpy", "sticky-slippery", "irritating-pleasant"];

/// Rows of a table of predictions: texture, attribute, method, actual, predicted and deviation.
pub(crate) fn rows(bench: &Bench, name: &str) -> Vec<[String; 6]> {
    let text = std::fs::read_to_string(bench.path(name)).unwrap();
    let mut lines = text.lines();
    assert_eq!(lines.next(), Some("texture,attribute,method,actual,predicted,deviation"));
    let fields = |line: &str| {
        assert!(!line.contains('"'), "{line}");
        let fields: Vec<String> = line.split(',').map(str::to_owned).collect();
        <[String; 6]>::try_from(fields).unwrap()
    };
    lines.map(fields).collect()
}

/// Checks that the mean absolute error of a table is that of the result, for each attribute.
pub(crate) fn check_errors(said: &Value, rows: &[[String; 6]], attributes: &[&str]) {
    let method = said["chosen"].as_str().unwrap();
    for attribute in attributes {
        let errors: Vec<f64> = rows
            .iter()
            .filter(|[_, of, by, ..]| of == attribute && by == method)
            .map(|[.., actual, predicted, _]| {
                (predicted.parse::<f64>().unwrap() - actual.parse::<f64>().unwrap()).abs()
            })
            .collect();
        let mae = errors.iter().sum::<f64>() / errors.len() as f64;
        let expected = said["mae"][attribute].as_f64().unwrap();
        assert!((mae - expected).abs() < 1e-9, "{attribute}: {mae} is not {expected}");
    }
}

#[test]
fn attributes_of_texture_models_are_drawn_beside_the_ratings() {
    let bench = Bench::new();
    let said = bench.json("train attributes --library simulated --figures drawn");
    assert_eq!(said["figures"], "drawn");
    let rows = rows(&bench, "drawn/predictions.csv");
    assert_eq!(rows.len(), 25 * 5 * 3, "25 textures, five attributes and three methods");
    check_errors(&said, &rows, &FIVE);
    // Only the Gaussian process states standard deviations.
    for [.., method, _, _, deviation] in &rows {
        let is_stated = deviation.parse::<f64>().is_ok_and(|deviation| deviation > 0.0);
        assert_eq!(is_stated, method == "gaussian process", "{method}: {deviation}");
    }
    for name in FIVE {
        let svg = std::fs::read_to_string(bench.path(&format!("drawn/predicted-{name}.svg"))).unwrap();
        for words in
            [name, "leave-one-texture-out", "predicted = actual", "simulated raters", "Cork", "Glass"]
        {
            assert!(svg.contains(words), "{name}: {words}");
        }
        let points = std::fs::read_to_string(bench.path(&format!("drawn/predicted-{name}.csv"))).unwrap();
        assert_eq!(points.lines().filter(|line| line.starts_with("textures,")).count(), 25);
    }
    assert!(bench.run("train attributes").code == 0 && bench.json("train attributes")["figures"].is_null());
    // Nothing else is replaced, and it is said before the training.
    bench.write("notes.txt", "mine");
    bench.fails("train attributes --figures notes.txt", 1, &["this is a file", "notes.txt"]);
    bench.write("other/predictions.csv", "mine");
    bench.fails("train attributes --figures other", 1, &["a file of another kind", "predictions.csv"]);
    assert_eq!(std::fs::read_to_string(bench.path("other/predictions.csv")).unwrap(), "mine");
}

const AXES: [&str; 2] = ["rough-smooth", "hard-soft"];
/// Training of heads on pictures that takes little time.
const TRAIN_PHOTO: &str = "train photo --backbone none --epochs 2 --patience 1 --heads 1 --drawn 6";

#[test]
fn pictures_of_one_texture_are_left_out_together_and_its_prediction_is_drawn() {
    let bench = Bench::new();
    for (name, level) in [("a.png", 40), ("b.png", 90)] {
        let pixel = |x: u32, y: u32| image::Rgb([level + (x * y % 7) as u8; 3]);
        image::RgbImage::from_fn(64, 64, pixel).save(bench.path(name)).unwrap();
    }
    bench.write("more.csv", "texture,picture\ncork,a.png\ncork,b.png\n");
    let said = bench.json(&format!("{TRAIN_PHOTO} --pictures more.csv --figures drawn -o model.safetensors"));
    assert_eq!((&said["textures"], &said["pictures"]), (&25.into(), &27.into()));
    assert_eq!(said["figures"], "drawn");
    let with_more = rows(&bench, "drawn/predictions.csv");
    assert_eq!(
        with_more.len(),
        25 * 2 * 2,
        "25 textures, two attributes, and statistics beside the baseline"
    );
    check_errors(&said, &with_more, &AXES);
    for [.., method, _, _, deviation] in &with_more {
        let is_stated = deviation.parse::<f64>().is_ok_and(|deviation| deviation > 0.0);
        assert_eq!(is_stated, method == "statistics of the picture", "{method}: {deviation}");
    }
    for name in AXES {
        let svg = std::fs::read_to_string(bench.path(&format!("drawn/predicted-{name}.svg"))).unwrap();
        for words in [name, "statistics of the picture", "leave-one-texture-out", "Cork"] {
            assert!(svg.contains(words), "{name}: {words}");
        }
        let points = std::fs::read_to_string(bench.path(&format!("drawn/predicted-{name}.csv"))).unwrap();
        assert_eq!(points.lines().filter(|line| line.starts_with("textures,")).count(), 25);
    }
    let black = "predict attributes --photo a.png --model model.safetensors";
    assert!(bench.json(black)["model"].as_str().unwrap().contains("25 textures with 27 pictures"));

    let said = bench.json(&format!("{TRAIN_PHOTO} --figures fewer"));
    assert_eq!(said["pictures"], 25);
    let fewer = rows(&bench, "fewer/predictions.csv");
    let of_cork = |rows: &[[String; 6]]| {
        let is_it = |row: &&[String; 6]| row[0] == "Cork" && row[2] == "statistics of the picture";
        rows.iter().filter(is_it).map(|row| row[4].clone()).collect::<Vec<String>>()
    };
    assert_ne!(of_cork(&with_more), of_cork(&fewer));
    // The picture of the library once more: if it were used for the training, cork would be predicted better.
    let library = shagreen_formats::starter::starter_library().unwrap();
    let cork = &library.textures[library.index_of("cork").unwrap()];
    bench.write("cork.png", &cork.picture.as_ref().unwrap().bytes);
    bench.write("same.csv", "texture,picture\ncork,cork.png\n");
    bench.json(&format!("{TRAIN_PHOTO} --pictures same.csv --figures same"));
    assert_eq!(of_cork(&rows(&bench, "same/predictions.csv")), of_cork(&fewer));

    bench.write("wrong.csv", "texture,picture\ncrok,a.png\n");
    bench.fails(&format!("{TRAIN_PHOTO} --pictures wrong.csv"), 1, &["line 2", "crok", "wrong.csv"]);
    bench.write("gone.csv", "texture,picture\ncork,gone.png\n");
    bench.fails(&format!("{TRAIN_PHOTO} --pictures gone.csv"), 1, &["no such file", "gone.png"]);
    bench.fails(&format!("{TRAIN_PHOTO} --pictures more.csv -o more.csv"), 1, &["more.csv"]);
    bench.fails(&format!("{TRAIN_PHOTO} --unjudged -o m.safetensors --figures f"), 2, &["--figures"]);
    bench.fails(&format!("{TRAIN_PHOTO} --figures a.png"), 1, &["this is a file", "a.png"]);
}
