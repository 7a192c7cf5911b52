//! `shagreen export --format hjif` and `--format maps`, and `shagreen check`.

use crate::support::Bench;

#[test]
fn a_texture_is_exported_as_mpeg_haptics_and_checked() {
    let bench = Bench::new();
    let done = bench.json("export --texture cork --format hjif --actuator haptuator-mark-ii -o cork.hjif");
    assert_eq!(done["files"].as_array().unwrap().len(), 1, "{done}");
    let lost = done["lost"].to_string();
    assert!(lost.contains("randomness") && lost.contains("tap transient"), "{lost}");
    let file: serde_json::Value =
        serde_json::from_slice(&std::fs::read(bench.path("cork.hjif")).unwrap()).unwrap();
    let vibration = &file["perceptions"][0];
    assert_eq!(vibration["perception_modality"], "Vibrotactile Texture");
    assert_eq!(vibration["reference_devices"][0]["type"], "VCA");
    // 25 speeds and forces, with six bands up to 500 Hz each.
    assert_eq!(vibration["effect_library"].as_array().unwrap().len(), 150);

    let checked = bench.json("check cork.hjif");
    assert_eq!((&checked["valid"], &checked["n_faults"]), (&true.into(), &0.into()), "{checked}");
    let said = bench.run("check cork.hjif");
    assert!(said.stdout.contains("follows the rules of MPEG haptics"), "{}", said.stdout);
    let broken =
        std::fs::read_to_string(bench.path("cork.hjif")).unwrap().replace("\"level\": 1", "\"level\": 4");
    bench.write("broken.hjif", broken);
    let said = bench.run("check broken.hjif");
    assert_eq!(said.code, 1, "{}", said.stderr);
    assert!(said.stdout.contains("level: the level is 4"), "{}", said.stdout);
    assert!(said.stderr.contains("1 fault") && said.stderr.contains("broken.hjif"), "{}", said.stderr);

    bench.fails(
        "export --texture cork --format hatt --actuator mm1c -o cork.xml",
        2,
        &["--actuator", "hjif"],
    );
    bench.fails("export --texture cork --format hjif --actuator none -o a.hjif", 1, &["neither a built-in"]);
    bench.fails("check cork.wav", 1, &[".hjif", ".gltf", "cork.wav"]);
    bench.fails("check none.hjif", 1, &["no such file", "none.hjif"]);
    // What is wrong with a file does not hide the others.
    let said = bench.run("check none.hjif broken.hjif cork.hjif --json");
    let files = serde_json::from_str::<serde_json::Value>(&said.stdout).unwrap()["files"].clone();
    assert!(files[0]["error"].as_str().unwrap().contains("no such file"), "{files}");
    assert_eq!((&files[1]["n_faults"], &files[2]["valid"]), (&1.into(), &true.into()), "{files}");
    assert_eq!(said.code, 1, "{}", said.stderr);
    let said = bench.run("check none.hjif broken.hjif cork.hjif");
    for words in ["not checked: ", "level: the level is 4", "cork.hjif follows"] {
        assert!(said.stdout.contains(words), "{words}: {}", said.stdout);
    }
    assert!(said.code == 1 && said.stderr.contains("2 of 3 files"), "{}", said.stderr);
    assert_eq!(bench.json("check cork.hjif cork.hjif")["valid"], true);
}

#[test]
fn maps_are_written_with_all_their_files_or_refused() {
    let bench = Bench::new();
    let done = bench.json("export --texture brick --format maps -o brick.gltf");
    let files: Vec<&str> =
        done["files"].as_array().unwrap().iter().map(|file| file.as_str().unwrap()).collect();
    let expected = ["brick.gltf", "brick.bin", "brick.height.png", "brick.maps.json", "brick.friction.png"];
    assert_eq!(files, expected);
    assert!(done["lost"].to_string().contains("grain"), "{done}");
    assert_eq!(bench.json("check brick.gltf")["valid"], true);
    bench.fails(
        "export --texture brick --shape level=-6 --format maps -o quiet.gltf",
        1,
        &["no height map", "relief from a picture"],
    );
    bench.fails(
        "export --texture brick --format maps -o wall.png",
        1,
        &["a .gltf file, not to .png", "wall.png"],
    );
    // A relief from a picture is a height map.
    let heights: Vec<f64> = (0..64 * 64).map(|i| f64::from((i % 64 + 8) % 32 / 16)).collect();
    bench.write("ridges.png", shagreen_formats::picture::encode_heights(&heights, 64).unwrap());
    bench.json("library relief ridges.png --side-mm 40 --height-um 50 --texture felt --out felt.json");
    let export = "export --library felt.json --texture felt --format maps -o felt.gltf";
    bench.json(export);
    let described: serde_json::Value =
        serde_json::from_slice(&std::fs::read(bench.path("felt.maps.json")).unwrap()).unwrap();
    let height = &described["height"];
    let range_um = height["white_um"].as_f64().unwrap() - height["black_um"].as_f64().unwrap();
    assert!((range_um - 50.0).abs() < 0.01, "{height}");
    assert_eq!((&height["side_mm"], &height["source"]), (&40.0.into(), &"height map".into()));
    // The files are replaced together, and only beside a scene with a haptic material.
    bench.fails(export, 1, &["exist already", "--replace", "felt.gltf"]);
    bench.json(&format!("{export} --replace"));
    std::fs::remove_file(bench.path("felt.gltf")).unwrap();
    bench.fails(export, 1, &["would replace", "felt.bin"]);
}
