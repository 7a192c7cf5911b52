//! `shagreen play` on the silent output, and `shagreen devices`.

use crate::support::Bench;

#[test]
fn devices_are_listed() {
    let devices = Bench::new().json("devices");
    let ids = |list: &str| -> Vec<String> {
        devices[list].as_array().unwrap().iter().map(|d| d["id"].as_str().unwrap().to_owned()).collect()
    };
    assert!(ids("styluses").contains(&"mouse".to_owned()));
    assert!(ids("outputs").contains(&"null".to_owned()));
    assert!(devices["serial"].is_array());
}

#[test]
fn a_steady_contact_and_a_stroke_are_played_in_real_time() {
    let bench = Bench::new();
    bench.write("stroke.csv", "t_s,speed_mm/s,force_N\n0,100,1\n0.4,100,1\n");
    for what in ["--texture cork --speed 100 --force 1 --seconds 0.4", "--at 30,70 --stroke stroke.csv"] {
        let started = std::time::Instant::now();
        let played = bench.json(&format!("play {what} --output null"));
        assert!(started.elapsed().as_secs_f64() >= 0.4);
        assert_eq!(played["underruns"], 0);
        assert_eq!(played["limited"], 0);
        assert!(
            played["latency_ms"].as_f64().unwrap() > 0.0 && played["latency_ms"].as_f64().unwrap() < 30.0
        );
        assert!(played["callback_load_max"].as_f64().unwrap() > 0.0);
    }
}

/// Negative control of `limited`: a full scale far too small for the texture.
#[test]
fn what_is_limited_is_counted() {
    let played =
        Bench::new().json("play --texture brick --speed 200 --force 2 --seconds 0.4 --full-scale 0.1");
    assert!(played["limited"].as_u64().unwrap() > 1000, "{played}");
}

/// A known actuator has two limiters in series; a sample that both attenuate counts once.
#[test]
fn no_more_is_limited_than_was_played_and_the_limit_is_named() {
    let bench = Bench::new();
    let steady = "play --texture brick --speed 200 --force 2 --seconds 0.5";
    let coil = "--actuator haptuator-mark-ii --full-scale-volts";
    for (limits, words) in [
        (
            "--full-scale 0.0001".to_owned(),
            &["exceeded the limit of the output's full scale", "--full-scale"][..],
        ),
        (format!("{coil} 0.001"), &["exceeded the limit of the actuator", "--speed"]),
    ] {
        let said = bench.run(&format!("{steady} {limits} --json"));
        assert_eq!(said.code, 0, "{}", said.stderr);
        let played: serde_json::Value = serde_json::from_str(&said.stdout).unwrap();
        let share = played["limited_share"].as_f64().unwrap();
        assert!(share > 0.5 && share <= 1.0, "{share}");
        assert!(words.iter().all(|word| said.stderr.contains(word)), "{}", said.stderr);
    }
    // No warning without limiting.
    let said = bench.run("play --texture glass --speed 50 --force 0.2 --seconds 0.3");
    assert!(said.stdout.contains("samples limited: none") && !said.stderr.contains("warning"), "{said:?}");
}

/// Profile of an actuator that was measured with 2 V at digital full scale.
const MEASURED: &str = r#"format = "shagreen-actuator"
version = "1.0"
id = "my-pen"
name = "My pen"
source = "Made up for a test"
lowest_hz = 20

[response]
load_g = 40.0
resonance_hz = 120.0
q = 8.0
gain_mps2_per_v = 15.0

[limits]
thermal_time_s = 10.0

[calibration]
fit_error_db = 0.02
resonance_error_hz = 0.01
q_error = 0.01
gain_error_mps2_per_v = 0.01
full_scale_v = 2.0
"#;

/// Before, the command asked for a voltage that the profile states.
#[test]
fn a_measured_profile_states_the_voltage_at_full_scale() {
    let bench = Bench::new();
    bench.write("pen.toml", MEASURED);
    let steady = "play --texture cork --speed 100 --force 1 --seconds 0.2";
    let said = bench.run(&format!("{steady} --actuator pen.toml"));
    assert!(said.code == 0 && said.stderr.contains("2 V at digital full scale"), "{said:?}");
    // A voltage on the command line has priority.
    let said = bench.run(&format!("{steady} --actuator pen.toml --full-scale-volts 3"));
    assert!(said.code == 0 && !said.stderr.contains("digital full scale"), "{said:?}");
    // A profile that was not measured states none.
    bench.fails(
        &format!("{steady} --actuator haptuator-mark-ii"),
        2,
        &["haptuator-mark-ii", "states no voltage at digital full scale", "--full-scale-volts"],
    );
}

#[test]
fn a_channel_that_is_not_there_is_refused() {
    let bench = Bench::new();
    bench.fails("play --texture cork --seconds 0.2 --channel 9", 1, &["no channel 9", "`null` has 2"]);
    bench.json("play --texture cork --seconds 0.2 --channel 2");
    // Channels by name: the silent output has two.
    let front_right =
        bench.command("play --texture cork --seconds 0.2 --json --channel").arg("front right").output();
    assert!(front_right.unwrap().status.success());
    let controller = "play --texture cork --seconds 0.2 --actuator dualsense";
    bench.fails(
        &format!("{controller} --channel tail"),
        1,
        &["no channel \"tail\"", "left grip, right grip"],
    );
    bench.fails(&format!("{controller} --channel 1"), 1, &["names no channel 1", "3 (left grip)"]);
    bench.fails(&format!("{controller} --channel 3"), 1, &["`null` has 2 channels", "needs 4"]);
    let said = bench.run(&format!("{controller} --json"));
    assert!(
        said.stderr.contains("`null` has 2 channels, and the profile of the actuator needs 4"),
        "{said:?}"
    );
    assert!(said.code == 0 && said.stderr.contains("calibrate it"), "{said:?}");
    let shown = bench.json("actuator show dualsense");
    assert_eq!(shown["channels"][1], serde_json::json!({"number": 4, "name": "right grip"}));
    assert!(shown["f0_hz"].is_null());
}

/// The sound library of the system writes no lines of its own beside the error.
#[cfg(target_os = "linux")]
#[test]
fn a_missing_sound_card_is_one_error() {
    let bench = Bench::new();
    let settings = "</usr/share/alsa/alsa.conf>\npcm.!default { type plug slave.pcm \"nosuch\" }\n";
    let config = bench.write("asound.conf", settings);
    for arguments in [
        "play --texture cork --output alsa:default --seconds 0.1",
        "latency --output null --input alsa:default --strokes 1",
    ] {
        let output = bench.command(arguments).env("ALSA_CONFIG_PATH", &config).output().unwrap();
        let said = String::from_utf8(output.stderr).unwrap();
        assert_eq!(output.status.code(), Some(1), "{said}");
        let lines: Vec<&str> = said.lines().filter(|line| !line.starts_with("note: ")).collect();
        assert!(
            lines.len() == 1 && lines[0].starts_with("error: ") && lines[0].contains("alsa:default"),
            "{said}"
        );
    }
}
