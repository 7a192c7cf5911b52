//! `shagreen train attributes --network`: rivals, time budget, recordings with three axes.

use crate::import::table;
use crate::support::Bench;
use serde_json::Value;

/// Writes a library of five textures with positions, and returns their ids.
fn five(bench: &Bench) -> Vec<String> {
    let starter = std::fs::read(concat!(env!("CARGO_MANIFEST_DIR"), "/assets/starter/starter.json")).unwrap();
    let mut library: Value = serde_json::from_slice(&starter).unwrap();
    library["textures"].as_array_mut().unwrap().truncate(5);
    bench.write("five.json", library.to_string());
    let textures = library["textures"].as_array().unwrap();
    textures.iter().map(|texture| texture["id"].as_str().unwrap().to_owned()).collect()
}

/// Rows of a table of recordings, one for each texture.
fn lines(ids: &[String]) -> String {
    ids.iter().flat_map(|id| [id.as_str(), ",", id.as_str(), ".csv\n"]).collect()
}

#[test]
fn rivals_stand_in_one_table_and_a_time_budget_ends_them_all() {
    let bench = Bench::new();
    five(&bench);
    let said = bench.json(
        "train attributes --library five.json --network serial --network 1d-cnn --share 0.2 --patience 0 --minutes 0.05 -o net.safetensors",
    );
    let of_networks = ["network serial", "network convolutions"];
    for method in
        ["gaussian process", "linear regression", "mean of the others"].into_iter().chain(of_networks)
    {
        for name in ["rough-smooth", "hard-soft"] {
            let rmse = said["baselines"][method]["rmse"][name].as_f64().unwrap();
            assert!(rmse.is_finite() && rmse >= 0.0, "{method}: {rmse}");
        }
    }
    for (kind, method) in [("serial", "serial CNN-LSTM"), ("convolutions", "1D-CNN")] {
        let of = &said["networks"][kind];
        assert_eq!((&of["method"], &of["most_epochs"]), (&method.into(), &200.into()));
        assert_eq!(of["minutes"], 0.05);
        let epochs: Vec<f64> = of["epochs"].as_array().unwrap().iter().map(|n| n.as_f64().unwrap()).collect();
        // Each network has learned something, and none was trained to the end.
        assert!(epochs.len() == 5 && epochs.iter().all(|n| (0.01..200.0).contains(n)), "{epochs:?}");
    }

    // The file says which predictor is better, and that the training was cut short.
    bench.write("stroke.csv", table(&bench, "brick"));
    let predict =
        "predict attributes --recording stroke.csv --set acceleration_unit=m/s^2 --model net.safetensors";
    let told = bench.json(predict);
    let beats = &said["networks"]["serial"]["beats_gaussian_process"];
    assert!(beats.is_boolean() && told["beats_gaussian_process"] == *beats, "{told}");
    let text = bench.run(predict).stdout;
    assert_eq!(text.contains("does not beat the Gaussian process"), *beats == Value::Bool(false), "{text}");
    assert!(text.contains("at most 200 epochs") && text.contains("0.05 minutes"), "{text}");
}

#[test]
fn networks_have_options_that_fit_each_other() {
    let bench = Bench::new();
    let ids = five(&bench);
    let train = |more: &str| format!("train attributes --library five.json {more}");
    for option in ["--recordings x.csv", "--axes three", "--minutes 5"] {
        let words = [option.trim_end_matches(" x.csv").trim_end_matches(" 5"), "--network"];
        bench.fails(&train(option), 1, &words);
    }
    bench.fails(&train("--network serial --axes three"), 1, &["--axes three", "DFT", "--recordings"]);
    for (options, word) in [
        ("--network serial --minutes 0", "above 0"),
        ("--network serial --recordings x.csv --share 0.5", "--share"),
        ("--network serial --set acceleration_unit=g", "--recordings"),
        ("--network rnn", "paper320"),
    ] {
        bench.fails(&train(options), 2, &[word]);
    }
    bench.write("few.csv", format!("texture,recording\n{}", lines(&ids[1..])));
    bench.write("strange.csv", format!("texture,recording\n{}crok,crok.csv\n", lines(&ids)));
    bench.fails(&train("--network serial --recordings few.csv"), 1, &[ids[0].as_str(), "few.csv"]);
    bench.fails(&train("--network serial --recordings strange.csv"), 1, &["line 7", "crok", "strange.csv"]);
    bench.fails(&train("--network serial --recordings nowhere.csv"), 1, &["nowhere.csv"]);
}

/// A stroke of two seconds over a surface that vibrates in one direction; `axes` are the columns, and `angle` is the
/// direction of the vibration.
fn stroke(axes: &[&str], angle: f64, seed: u32) -> String {
    let mut state = seed;
    let row = |i: u32| {
        state = state.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
        let noise = f64::from(state >> 8) / f64::from(1 << 23) - 1.0;
        let shares = [angle.cos(), angle.sin(), 0.1];
        let values: Vec<String> =
            shares.iter().take(axes.len()).map(|share| format!("{:.6}", share * noise)).collect();
        format!("{:.3},{},100,0.5\n", f64::from(i) / 1000.0, values.join(","))
    };
    let rows: String = (0..2200).map(row).collect();
    format!("time_s,{},speed_mm_s,force_n\n{rows}", axes.join(","))
}

#[test]
fn a_network_of_three_axes_is_trained_on_recordings_and_predicts_from_them() {
    let bench = Bench::new();
    let ids = five(&bench);
    for (index, id) in ids.iter().enumerate() {
        let angle = 0.3 * (index + 1) as f64;
        bench.write(&format!("made/{id}.csv"), stroke(&["ax", "ay", "az"], angle, index as u32 + 1));
    }
    bench.write("made/table.csv", format!("texture,recording\n{}", lines(&ids)));
    let options =
        "--library five.json --recordings made/table.csv --set acceleration_unit=m/s^2 --network 1d-cnn";
    let said = bench.json(&format!(
        "train attributes {options} --axes three --epochs 1 --patience 0 -o three.safetensors"
    ));
    let name = "convolutions-three-axes";
    let mae = &said["baselines"][format!("network {name}")]["mae"];
    assert!(mae["hard-soft"].as_f64().unwrap() >= 0.0, "{said}");
    assert_eq!(said["networks"][name]["epochs"], serde_json::json!([1.0, 1.0, 1.0, 1.0, 1.0]));

    let predict = |file: &str| {
        format!(
            "predict attributes --recording {file} --set acceleration_unit=m/s^2 --model three.safetensors"
        )
    };
    let told = bench.json(&predict(&format!("made/{}.csv", ids[2])));
    assert!(told["model"].as_str().unwrap().contains(name), "{told}");
    bench.write("one.csv", stroke(&["ax"], 0.3, 9));
    bench.fails(&predict("one.csv"), 1, &["three columns of acceleration", "one.csv"]);

    // The same recordings train a network of the combined signal; a recording with one axis has no three.
    let combined = bench.json(&format!("train attributes {options} --epochs 1 --patience 0"));
    assert!(combined["networks"]["convolutions"].is_object(), "{combined}");
    bench.write(&format!("made/{}.csv", ids[0]), stroke(&["ax"], 0.3, 9));
    let words = ["three columns of acceleration", ids[0].as_str()];
    bench.fails(&format!("train attributes {options} --axes three --epochs 1"), 1, &words);
}

/// Networks that several computers train are those of one run: the last run only evaluates them.
#[test]
fn parts_of_a_training_are_the_whole() {
    let bench = Bench::new();
    let ids = five(&bench);
    for (index, id) in ids.iter().enumerate() {
        bench.write(&format!("made/{id}.csv"), stroke(&["a"], 0.3 * index as f64, index as u32 + 1));
    }
    bench.write("made/table.csv", format!("texture,recording\n{}", lines(&ids)));
    let train = "train attributes --library five.json --recordings made/table.csv --set acceleration_unit=m/s^2 --network 1d-cnn --epochs 1 --patience 0";
    let whole = bench.json(train);
    let mut trained = Vec::new();
    for shard in ["2/2", "1/2"] {
        let part = bench.json(&format!("{train} --state parts --shard {shard}"));
        trained.extend(part["textures"].as_array().unwrap().iter().map(|id| id.as_str().unwrap().to_owned()));
    }
    trained.sort();
    let mut expected = ids;
    expected.sort();
    assert_eq!(trained, expected);
    let said = bench.run(&format!("{train} --state parts --json"));
    assert!(said.code == 0 && !said.stderr.contains("epoch 1 of"), "{}", said.stderr);
    let joined: Value = serde_json::from_str(&said.stdout).unwrap();
    assert_eq!(joined["baselines"], whole["baselines"]);
    bench.fails(&format!("{train} --shard 1/2"), 2, &["--state"]);
    bench.fails(&format!("{train} --state parts --shard 1/2 -o net.safetensors"), 2, &["--out"]);
}
