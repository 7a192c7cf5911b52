//! `--shape`: a neutral shape changes no byte, and every command takes the same controls.

use crate::support::Bench;
use serde_json::{Value, json};

fn psd(bench: &Bench, what: &str) -> Value {
    bench.json(&format!("texture psd {what} --speed 80 --force 0.6 --bins 100"))
}

fn rms(value: &Value) -> f64 {
    value["rms"].as_f64().unwrap()
}

/// Power-weighted mean frequency of the bins of a spectrum, in Hz.
fn centroid_hz(value: &Value) -> f64 {
    let numbers = |field: &str| -> Vec<f64> {
        value[field].as_array().unwrap().iter().map(|x| x.as_f64().unwrap()).collect()
    };
    let (hz, psd) = (numbers("hz"), numbers("psd"));
    hz.iter().zip(&psd).map(|(f, p)| f * p).sum::<f64>() / psd.iter().sum::<f64>()
}

#[test]
fn a_neutral_shape_changes_no_byte() {
    let bench = Bench::new();
    let bytes = |target: &str, shape: &str, name: &str| {
        bench.json(&format!("render {target} {shape} --speed 100 --force 1 --seconds 0.5 -o {name}.wav"));
        ["wav", "json"].map(|ending| std::fs::read(bench.path(&format!("{name}.{ending}"))).unwrap())
    };
    for target in ["--texture cork", "--at 30,70", "--at 30,70 --blend shared"] {
        let plain = bytes(target, "", "plain");
        assert_eq!(bytes(target, "--shape neutral", "neutral"), plain, "{target}");
        assert_eq!(bytes(target, "--shape level=0,grain=1,direction=0", "zero"), plain, "{target}");
        assert_ne!(bytes(target, "--shape grain=1.01", "coarser"), plain, "{target}");
    }
    let sidecar: Value = serde_json::from_slice(&std::fs::read(bench.path("coarser.json")).unwrap()).unwrap();
    assert_eq!(sidecar["shape"], "grain=1.01");
}

#[test]
fn a_level_of_minus_six_decibels_halves_the_signal() {
    let bench = Bench::new();
    let render =
        |rest: &str| rms(&bench.json(&format!("render {rest} --speed 100 --force 1 --seconds 1 -o out.wav")));
    for target in ["--texture cork", "--at 30,70", "--at 30,70 --blend power"] {
        let ratio = render(&format!("{target} --shape level=-6")) / render(target);
        // The same noise at another level. Stick-slip, which friction determines, could differ by some thousandths.
        assert!((ratio - 10_f64.powf(-0.3)).abs() < 5e-3, "{target}: {ratio}");
    }
}

#[test]
fn every_mode_and_command_takes_a_shape() {
    let bench = Bench::new();
    for mode in ["field", "parametric", "shared", "power", "paper"] {
        let at = format!("--at 45,40 --blend {mode}");
        let (plain, coarse) = (psd(&bench, &at), psd(&bench, &format!("{at} --shape grain=2")));
        assert!(centroid_hz(&coarse) < 0.75 * centroid_hz(&plain), "{mode}");
        assert!((rms(&coarse) / rms(&plain) - 1.0).abs() < 0.1, "{mode}: the level stays");
        assert_eq!(coarse["parents"], plain["parents"], "{mode}");
        assert_eq!((&plain["shape"], &coarse["shape"]), (&Value::Null, &json!("grain=2")));
    }
    let played = bench.json("play --texture cork --shape softness=2 --seconds 0.1 --output null");
    assert_eq!(played["shape"], "softness=2");
    bench.json("export --texture cork --format hatt -o plain.xml");
    bench.json("export --texture cork --shape level=-6 --format hatt -o quiet.xml");
    let read = |name: &str| std::fs::read_to_string(bench.path(name)).unwrap();
    assert_ne!(read("plain.xml"), read("quiet.xml"));
    let path = "texture path --stop 20,40@0 --stop 30,45@20";
    bench.json(&format!("{path} -o plain.json"));
    bench.json(&format!("{path} --shape level=-6 -o quiet.json"));
    let of = |library: &str| rms(&psd(&bench, &format!("--library {library} --texture path")));
    assert!((of("quiet.json") / of("plain.json") - 10_f64.powf(-0.3)).abs() < 1e-3);
}

/// The shape of an authored texture is that of its project, unless the command line states another one.
#[test]
fn an_authored_texture_has_its_own_shape() {
    let bench = Bench::new();
    bench.json("project new -o a.shagreen");
    let mut project: Value =
        serde_json::from_slice(&std::fs::read(bench.path("a.shagreen")).unwrap()).unwrap();
    project["version"] = json!("1.1");
    project["authored"][0]["shape"] = json!({"level_db": -6.0, "grain": 1.5});
    bench.write("a.shagreen", project.to_string());
    let shown = bench.json("project show a.shagreen");
    assert_eq!(shown["authored"][0]["shape"], "level=-6,grain=1.5");
    assert!(bench.run("project show a.shagreen").stdout.contains("level=-6,grain=1.5"));
    let authored = "--project a.shagreen --authored 1";
    let own = psd(&bench, authored);
    assert_eq!(own, psd(&bench, "--at 50,50 --shape level=-6,grain=1.5"));
    assert_eq!(psd(&bench, &format!("{authored} --shape neutral")), psd(&bench, "--at 50,50"));
}

#[test]
fn a_wrong_shape_is_refused_with_what_is_right() {
    let bench = Bench::new();
    for (shape, words) in [
        ("level=30", "level of the shape is 30; it must be from -24 to 12 dB"),
        ("grain=fine", "\"fine\", which is not a number"),
        ("lavel=-3", "did you mean level?"),
        ("bright=2", "did you mean brightness?"),
        ("level", "not of the form control=value"),
        ("grain=1,grain=2", "only once"),
    ] {
        let render =
            format!("render --texture cork --shape {shape} --speed 1 --force 1 --seconds 1 -o out.wav");
        bench.fails(&render, 2, &[words]);
    }
}
