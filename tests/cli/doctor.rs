//! `shagreen doctor` on this machine, with parts of its environment removed.

use crate::support::Bench;

const STATES: [&str; 5] = ["works", "limited", "fails", "absent", "unknown"];

/// Variables by which a session states its parts.
const OF_SESSION: [&str; 6] = [
    "DISPLAY",
    "WAYLAND_DISPLAY",
    "DBUS_SESSION_BUS_ADDRESS",
    "XDG_RUNTIME_DIR",
    "PULSE_SERVER",
    "PULSE_RUNTIME_PATH",
];

/// The report without a session, except for these variables.
fn doctor(bench: &Bench, json: &str, with: &[(&str, &str)]) -> String {
    let mut command = bench.command(&format!("doctor {json}"));
    for variable in OF_SESSION {
        command.env_remove(variable);
    }
    command.envs(with.iter().copied());
    command.env("PATH", bench.path("empty")).env("HOME", bench.path("home"));
    command.env("XDG_CONFIG_HOME", bench.path("config"));
    let output = command.output().unwrap();
    assert!(output.status.success(), "{output:?}");
    String::from_utf8(output.stdout).unwrap()
}

#[test]
fn every_line_says_its_state_what_was_seen_and_what_to_do() {
    let bench = Bench::new();
    let report: serde_json::Value = serde_json::from_str(&doctor(&bench, "--json", &[])).unwrap();
    let lines = report["lines"].as_array().unwrap();
    let mut counts = [0_u64; STATES.len()];
    for line in lines {
        let state = line["state"].as_str().unwrap();
        counts[STATES.iter().position(|known| *known == state).unwrap()] += 1;
        assert!(!line["seen"].as_str().unwrap().is_empty());
        assert_eq!(line["remedy"].is_null(), ["works", "absent"].contains(&state), "{line}");
    }
    for (state, count) in STATES.iter().zip(counts) {
        assert_eq!(report["counts"][state], count, "{state}");
    }
    let state = |topic: &str| {
        let found = lines.iter().find(|line| line["topic"] == topic).unwrap();
        found["state"].as_str().unwrap().to_owned()
    };
    if cfg!(target_os = "linux") {
        assert_eq!((state("display"), state("file dialogs")), ("fails".to_owned(), "limited".to_owned()));
        // Without a sound server, the sound system of the kernel may still have outputs.
        let has_outputs = ["works", "limited"].contains(&state("outputs").as_str());
        assert_eq!(state("sound server"), if has_outputs { "limited" } else { "fails" });
    }
    assert_eq!(state("image network"), "absent");
    let text = doctor(&bench, "", &[]);
    assert_eq!(
        text.lines().filter(|line| STATES.iter().any(|state| line.starts_with(state))).count(),
        lines.len()
    );
    assert!(text.contains("-> "), "{text}");
}

#[cfg(target_os = "linux")]
#[test]
fn folders_that_cannot_be_made_are_failures() {
    let bench = Bench::new();
    std::fs::write(bench.path("file"), "").unwrap();
    for (variable, folder) in [("XDG_CONFIG_HOME", "/proc".into()), ("HOME", bench.path("file"))] {
        let mut command = bench.command("doctor");
        command.env_remove("XDG_CONFIG_HOME").env(variable, &folder);
        let text = String::from_utf8(command.output().unwrap().stdout).unwrap();
        let line = text.lines().find(|line| line.contains("settings")).unwrap();
        assert!(line.starts_with("fails") && line.contains("cannot be written"), "{variable}: {line}");
    }
}

#[cfg(target_os = "linux")]
#[test]
fn a_display_and_a_sound_server_that_nobody_runs_are_failures() {
    let bench = Bench::new();
    let gone = [("DISPLAY", ":60999"), ("PULSE_SERVER", "unix:/nowhere/native")];
    let text = doctor(&bench, "", &gone);
    assert!(text.contains("no X11 display responds where DISPLAY says"), "{text}");
    assert!(text.contains("no sound server runs in this session"), "{text}");
    let away = doctor(&bench, "", &[("DISPLAY", "localhost:10.0")]);
    assert!(away.contains("X11, on another computer"), "{away}");
}
