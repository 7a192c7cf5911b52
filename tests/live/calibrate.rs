//! Actuator profiles and calibration through the program: a simulated actuator plays the sweep that the program wrote.

#[cfg(target_os = "linux")]
use serde_json::Value;
use shagreen_core::actuator::Response;
use shagreen_core::units::Hertz;

use crate::support::Bench;
use crate::{guard, sound};

/// A short sweep, at the sample rate of a sensor.
const SWEEP: &str = "--seconds 6 --silence 1";
const RATE_HZ: u32 = 4000;

fn actuator() -> Response {
    Response::new(Hertz(72.0), 5.5, 3.1).unwrap()
}

/// Writes the sweep and returns the acceleration in m/s² of an actuator that plays it with 2 V at full scale and a
/// delay of 0.5 s.
fn played(bench: &Bench) -> Vec<f64> {
    let written = bench.json(&format!("calibrate --make-sweep sweep.wav --rate {RATE_HZ} {SWEEP}"));
    assert_eq!(written["seconds"], 8.0);
    let (sweep, rate_hz) = bench.wav("sweep.wav");
    assert_eq!((sweep.len(), rate_hz), (32_000, f64::from(RATE_HZ)));
    let volts: Vec<f64> = vec![0.0; 2000].into_iter().chain(sweep.into_iter().map(|v| 2.0 * v)).collect();
    actuator().drive(&volts, Hertz(rate_hz))
}

/// Writes a 16-bit WAV file with one channel per function of the acceleration, and a full scale of 40 m/s².
fn record(bench: &Bench, name: &str, channels: &[fn(f64) -> f64]) {
    let spec = hound::WavSpec {
        channels: channels.len() as u16,
        sample_rate: RATE_HZ,
        bits_per_sample: 16,
        sample_format: hound::SampleFormat::Int,
    };
    let mut writer = hound::WavWriter::create(bench.path(name), spec).unwrap();
    for a in played(bench) {
        for channel in channels {
            writer.write_sample((channel(a) / 40.0 * 32_767.0).round() as i16).unwrap();
        }
    }
    writer.finalize().unwrap();
}

#[track_caller]
fn check_figures(said: &Value) {
    let near = |key: &str, expected: f64, share: f64| {
        let got = said[key].as_f64().unwrap();
        assert!((got / expected - 1.0).abs() < share, "{key}: {got} for {expected}");
    };
    // A 16-bit converter leaves noise of a thousandth, and the gain below 20 Hz is a fiftieth.
    near("f0_hz", 72.0, 0.003);
    near("q", 5.5, 0.01);
    near("gain", 3.1, 0.01);
    assert!(said["fit_error_db"].as_f64().unwrap() < 0.5, "{}", said["fit_error_db"]);
}

#[test]
fn a_recorded_sweep_becomes_a_profile() {
    let bench = Bench::new();
    record(&bench, "recorded.wav", &[|a| a + 9.81]);
    let said = bench.json(&format!(
        "calibrate --recording recorded.wav --sensitivity 40 --full-scale-volts 2 --load-g 35 --name Pen --actuator haptuator-mark-ii --out pen.toml --plots plots {SWEEP}"
    ));
    check_figures(&said);
    assert!((said["begins_s"].as_f64().unwrap() - 1.5).abs() < 0.05);
    let plots = ["distortion", "gain", "residual"].map(|name| [format!("{name}.csv"), format!("{name}.svg")]);
    for plot in plots.as_flattened() {
        assert!(bench.path("plots").join(plot).exists(), "{plot}");
    }
    // The profile is valid: it is shown, also for another load, and exported.
    let shown = bench.json("actuator show pen.toml");
    check_figures(&Value::from_iter([
        ("f0_hz", shown["f0_hz"].clone()),
        ("q", shown["q"].clone()),
        ("gain", shown["gain"].clone()),
        ("fit_error_db", shown["fit_error_db"].clone()),
    ]));
    assert_eq!((&shown["id"], &shown["load_g"]), (&"pen".into(), &35.0.into()));
    // The limits come from the profile that was named.
    assert_eq!(shown["limits"]["peak_v"], 4.5);
    let lighter = bench.json("actuator show pen.toml --load-g 20");
    assert!(lighter["gain"].as_f64().unwrap() > 1.3 * shown["gain"].as_f64().unwrap());
    bench.json("actuator acf pen.toml --full-scale-volts 2 -o pen.acf");
    let acf: Value = serde_json::from_slice(&std::fs::read(bench.path("pen.acf")).unwrap()).unwrap();
    assert_eq!(acf["metadata"]["device"], "Pen");
    // Files that the program wrote may be replaced.
    bench.json(&format!(
        "calibrate --recording recorded.wav --sensitivity 40 --full-scale-volts 2 --out pen.toml --plots plots {SWEEP}"
    ));
}

#[test]
fn the_axis_that_moves_is_taken_unless_another_is_asked_for() {
    let bench = Bench::new();
    record(&bench, "three.wav", &[|_| 9.81, |a| a, |a| 0.2 * a]);
    let arguments = format!("calibrate --recording three.wav --sensitivity 40 --full-scale-volts 2 {SWEEP}");
    let said = bench.json(&arguments);
    assert_eq!(said["channel"], 2);
    check_figures(&said);
    let third = bench.json(&format!("{arguments} --channel 3"));
    assert!((third["gain"].as_f64().unwrap() / 0.62 - 1.0).abs() < 0.02, "{}", third["gain"]);
    bench.fails(&format!("{arguments} --channel 4"), 1, &["no channel 4", "three.wav"]);
    bench.fails(&format!("{arguments} --channel 1"), 1, &["silent", "three.wav"]);
}

#[test]
fn a_table_is_a_recording_too() {
    let bench = Bench::new();
    let rows: Vec<String> = played(&bench)
        .iter()
        .enumerate()
        .map(|(i, a)| format!("{:.6},{:.5}", i as f64 / f64::from(RATE_HZ), a + 9.81))
        .collect();
    bench.write("recorded.csv", format!("time_s,acceleration_mps2\n{}\n", rows.join("\n")));
    let said = bench.json(&format!("calibrate --recording recorded.csv --full-scale-volts 2 {SWEEP}"));
    check_figures(&said);
    // Without a stated voltage the gain refers to digital full scale, and a note states this.
    let said = bench.run(&format!("calibrate --recording recorded.csv {SWEEP} --json"));
    let value: Value = serde_json::from_str(&said.stdout).unwrap();
    assert!((value["gain"].as_f64().unwrap() / 6.2 - 1.0).abs() < 0.01, "{}", value["gain"]);
    assert!(said.stderr.contains("note: 1 V is assumed"), "{}", said.stderr);
}

#[test]
fn what_cannot_be_calibrated_is_told_in_a_line_and_leaves_nothing() {
    let bench = Bench::new();
    record(&bench, "good.wav", &[|a| a]);
    let calibrate =
        |arguments: &str| format!("calibrate --out p.toml --plots plots --full-scale-volts 2 {arguments}");
    let fails = |arguments: &str, words: &[&str]| bench.fails(&calibrate(arguments), 1, words);
    fails(&format!("--recording good.wav {SWEEP}"), &["full scale", "--sensitivity", "good.wav"]);
    fails(&format!("--recording none.wav --sensitivity 40 {SWEEP}"), &["cannot read the file", "none.wav"]);
    // The recording contains a short sweep, not the default one.
    fails(
        "--recording good.wav --sensitivity 40 --seconds 12",
        &["does not contain the sweep of 12 s", "good.wav"],
    );
    fails("--recording good.wav --sensitivity 40 --seconds 60", &["8.5 s, the sweep 60.0 s", "good.wav"]);
    fails(
        &format!("--recording good.wav --sensitivity 40 --actuator mark-3 {SWEEP}"),
        &["neither a built-in actuator nor a file", "mm1c"],
    );
    // The output signal itself instead of the sensor's.
    fails(
        &format!("--recording sweep.wav --sensitivity 40 {SWEEP}"),
        &["no resonance was found", "sweep.wav"],
    );
    record(&bench, "silent.wav", &[|_| 0.0]);
    fails(&format!("--recording silent.wav --sensitivity 40 {SWEEP}"), &["silent", "silent.wav"]);
    bench.write("text.wav", "not sound");
    fails(&format!("--recording text.wav --sensitivity 40 {SWEEP}"), &["WAV", "text.wav"]);
    bench.write("notes.toml", "title = \"mine\"");
    let over = format!("calibrate --recording good.wav --sensitivity 40 {SWEEP} --out notes.toml");
    bench.fails(&over, 1, &["a file of another kind", "notes.toml"]);
    bench.fails(
        &format!("calibrate --recording good.wav --sensitivity 40 {SWEEP} --out good.wav"),
        1,
        &["good.wav"],
    );
    bench.fails(
        "calibrate --make-sweep s.wav --rate 1500",
        1,
        &["--high: the end in Hz of the sweep is 1000, needs 675"],
    );
    let limits = "--output null --input x --sensitivity 1";
    bench.fails(&format!("calibrate {limits} --seconds 1000"), 2, &["--seconds", "needs 1 to 600"]);
    bench.fails("calibrate --recording good.wav --amplitude 2", 2, &["--amplitude", "needs 0.000001 to 1"]);
    let bytes = std::fs::read(bench.path("good.wav")).unwrap();
    bench.write("torn.wav", &bytes[..30]);
    fails(&format!("--recording torn.wav --sensitivity 40 {SWEEP}"), &["the WAV file", "torn.wav"]);
    let (head, sound) = bytes.split_at(44);
    // Two sweeps, and the first half of one, with placeholder sizes that the reader ignores.
    let open = |sound: &[u8]| {
        let mut file = head.to_vec();
        file[40..44].fill(0xff);
        file.extend(sound);
        file
    };
    bench.write("twice.wav", open(&[sound, sound].concat()));
    fails(&format!("--recording twice.wav --sensitivity 40 {SWEEP}"), &["several sweeps", "twice.wav"]);
    // With silence between them one sweep is found, and the other is reported.
    let quiet = vec![0; 2 * 20 * RATE_HZ as usize];
    let quieter: Vec<u8> = sound
        .chunks_exact(2)
        .flat_map(|pair| ((f64::from(i16::from_le_bytes([pair[0], pair[1]])) * 0.8) as i16).to_le_bytes())
        .collect();
    bench.write("apart.wav", open(&[sound, &quiet, &quieter].concat()));
    let said =
        bench.run(&format!("calibrate --recording apart.wav --sensitivity 40 --full-scale-volts 2 {SWEEP}"));
    assert!(
        said.code == 0 && said.stderr.contains("other vibration more than half as strong as the sweep"),
        "{said:?}"
    );
    bench.write("half.wav", open(&sound[..sound.len() / 2]));
    fails(&format!("--recording half.wav --sensitivity 40 {SWEEP}"), &["half.wav"]);
    bench.fails("calibrate --out p.toml", 2, &["--make-sweep"]);
    bench.fails("calibrate --make-sweep s.wav --recording good.wav", 2, &["cannot be used with"]);
    bench.fails(&calibrate("--recording good.wav --sensitivity 0"), 2, &["above 0"]);
}

/// The input does not exist, which would be reported as soon as a device is opened.
#[test]
fn places_for_what_is_measured_are_looked_at_before_anything_is_opened() {
    let bench = Bench::new();
    let live = "calibrate --output null --input nosuch --sensitivity 10 --seconds 6";
    bench.fails(live, 1, &["nosuch"]);
    bench.write("notes.toml", "title = \"mine\"");
    bench.write("file", "mine");
    std::fs::create_dir_all(bench.path("taken/gain.svg")).unwrap();
    for (places, words) in [
        ("--out none/p.toml", &["none/p.toml", "folder does not exist"][..]),
        ("--out taken", &["taken", "the path is a folder"]),
        ("--out notes.toml", &["notes.toml", "a file of another kind"]),
        ("--plots file", &["file", "into a folder"]),
        ("--plots file/plots", &["file/plots", "cannot create the folder"]),
        ("--plots taken", &["taken/gain.svg", "the path is a folder"]),
        ("--out plots/gain.csv --plots plots", &["plots/gain.csv", "the same file"]),
    ] {
        bench.fails(&format!("{live} {places}"), 1, words);
    }
    // Writable paths are left unchanged.
    bench.fails(&format!("{live} --out p.toml --plots new/plots"), 1, &["nosuch"]);
}

/// Plays a sweep on a sink of a sound server, with further options, and returns the peaks of the sink's channels.
#[cfg(target_os = "linux")]
fn peaks(server: &sound::SoundServer, more: &[&str]) -> [f64; 2] {
    let words = ["calibrate", "--output", "pulse:ci", "--input", "alsa:pulse", "--sensitivity", "10"];
    let sweep = ["--seconds", "1", "--silence", "0"];
    let recorded = server.record(|server| {
        // Only the played signal matters here, not the recorded one.
        let said = server.command(env!("CARGO_BIN_EXE_shagreen")).args(words).args(sweep).args(more).output();
        let said = String::from_utf8_lossy(&said.unwrap().stderr).into_owned();
        assert!(!said.contains("cannot calibrate"), "{said}");
    });
    [0, 1].map(|channel| recorded.iter().fold(0.0, |peak: f64, frame| peak.max(frame[channel].abs())))
}

#[cfg(target_os = "linux")]
#[test]
fn the_sweep_sounds_on_the_channel_that_is_asked_for() {
    if !guard::have(&["pulseaudio", "pactl", "parec"]) {
        return;
    }
    let server = sound::SoundServer::new();
    let is_sweep = |peak: f64| (0.4..0.6).contains(&peak);
    let [left, right] = peaks(&server, &[]);
    assert!(is_sweep(left) && is_sweep(right), "{left} {right}");
    let [left, right] = peaks(&server, &["--output-channel", "2"]);
    assert!(left == 0.0 && is_sweep(right), "{left} {right}");
}

/// No option is ignored: one without meaning next to the others is wrong usage.
#[test]
fn what_would_be_ignored_is_refused() {
    let bench = Bench::new();
    record(&bench, "good.wav", &[|a| a]);
    let cannot = &["cannot be used with"][..];
    for (arguments, words) in [
        ("--recording good.wav --input alsa:x --sensitivity 40", cannot),
        ("--recording good.wav --serial-sensor serial:x", cannot),
        ("--recording good.wav --baud 9600 --sensitivity 40", cannot),
        ("--recording good.wav --rate 4000", cannot),
        ("--recording good.wav --output-channel 2", cannot),
        ("--recording good.wav --sensitivity 40 --name Pen", &["--out", "--plots"]),
        ("--make-sweep s.wav --out p.toml", cannot),
        ("--make-sweep s.wav --name Pen", cannot),
        ("--make-sweep s.wav --plots plots", cannot),
        ("--make-sweep s.wav --sensitivity 3", cannot),
        ("--make-sweep s.wav --channel 2", cannot),
        ("--make-sweep s.wav --set rate_hz=4000", cannot),
        ("--make-sweep s.wav --actuator mm1c", cannot),
        ("--output null --input x --sensitivity 4 --set rate_hz=4000", cannot),
        ("--output null --input x --sensitivity 4 --rate 4000", cannot),
        ("--output null --input x --sensitivity 4 --baud 9600", cannot),
        ("--output null --baud 9600", &["--serial-sensor"]),
        ("--output null --serial-sensor serial:x --sensitivity 4", cannot),
        ("--output null --serial-sensor serial:x --channel 2", cannot),
    ] {
        bench.fails(&format!("calibrate {arguments}"), 2, words);
    }
    bench.fails(
        &format!("calibrate --recording good.wav --sensitivity 40 --channel 2 {SWEEP}"),
        1,
        &["no channel 2", "leave --channel out", "good.wav"],
    );
    bench.write("recorded.csv", "time_s,acceleration_g\n0,1\n0.001,2\n");
    let table = format!("calibrate --recording recorded.csv --sensitivity 40 {SWEEP}");
    bench.fails(&table, 2, &["--sensitivity is for WAV files", "--set"]);
}

/// If only the resonance exceeds the full scale, a warning is printed; if most of the sweep does, the measurement is
/// rejected.
#[test]
fn what_is_cut_off_is_told_and_refused_where_it_is_too_much() {
    let bench = Bench::new();
    record(&bench, "loud.wav", &[|a| a.clamp(-12.0, 12.0)]);
    record(&bench, "cut.wav", &[|a| a.clamp(-2.0, 2.0)]);
    let calibrate =
        |name: &str| format!("calibrate --recording {name} --sensitivity 40 --full-scale-volts 2 {SWEEP}");
    let said = bench.run(&format!("{} --json", calibrate("loud.wav")));
    assert_eq!(said.code, 0, "{}", said.stderr);
    assert!(said.stderr.contains("warning: ") && said.stderr.contains("clipped at 12"), "{}", said.stderr);
    assert!(said.stderr.contains("with less gain"), "{}", said.stderr);
    let value: Value = serde_json::from_str(&said.stdout).unwrap();
    assert!(!value["warnings"].as_array().unwrap().is_empty());
    bench.fails(
        &format!("{} --out p.toml --plots plots", calibrate("cut.wav")),
        1,
        &["of the sweep are clipped at 2.0 m/s²", "record again", "cut.wav"],
    );
}

#[test]
fn the_built_in_actuators_are_listed_and_shown() {
    let bench = Bench::new();
    let listed = bench.json("actuator list");
    let actuators = listed["actuators"].as_array().unwrap();
    assert_eq!(actuators.len(), 6);
    assert!(actuators.iter().all(|a| !a["source"].as_str().unwrap().is_empty()));
    let shown = bench.json("actuator show haptuator-mark-ii --rate 2000");
    // The same sections as in vectors/b_act; the profile has six digits.
    for (got, expected) in
        shown["inverse"]["b"].as_array().unwrap().iter().zip([0.464_132, -0.886_970, 0.441_657])
    {
        assert!((got.as_f64().unwrap() - expected).abs() < 3e-6, "{got} for {expected}");
    }
    assert!((shown["headroom"]["volts_per_mps2"].as_f64().unwrap() / 0.655 - 1.0).abs() < 0.01);
    // JSON has the filter's coefficients, text a description. The gain computed from the coefficients never exceeds the
    // bound.
    let (inverse, lowest_hz) = (&shown["inverse"], shown["lowest_hz"].as_f64().unwrap());
    assert_eq!(
        (&inverse["lowest_hz"], &inverse["band_hz"]),
        (&lowest_hz.into(), &vec![lowest_hz, 200.0].into())
    );
    let bound = inverse["volts_per_mps2_max"].as_f64().unwrap();
    let number = |key: &str, i: usize| inverse[key][i].as_f64().unwrap();
    let dc = (number("b", 0) + number("b", 1) + number("b", 2)) / (number("a", 0) + number("a", 1) + 1.0);
    assert!(dc <= bound && bound < 1.2 * dc, "{dc} V for 1 m/s² at 0 Hz, bound {bound}");
    let said = bench.run("actuator show haptuator-mark-ii --rate 2000").stdout;
    let words = format!(
        "flat response from {lowest_hz} Hz (3 dB down) to 200 Hz; gain at most {bound:.3} V per m/s²"
    );
    assert!(said.contains(&words), "{said}");
    assert!(!bench.run("actuator show mm1c").stdout.contains("Equalizer"));
    let pen = bench.json("actuator show haptuator-mark-ii --load-g 40");
    assert!(pen["f0_hz"].as_f64().unwrap() > 65.5 && pen["gain"].as_f64().unwrap() > 5.0, "{pen}");
    let unknown = bench.json("actuator show mm1c");
    assert!(unknown["f0_hz"].is_null() && unknown["source"].as_str().unwrap().contains("calibrate it"));
    bench.fails("actuator acf mm1c -o mm1c.acf", 1, &["mm1c", "calibrate it"]);
    bench.fails("actuator show mm1c --load-g 40", 1, &["mm1c", "calibrate it"]);
    bench.fails("actuator show nothing", 1, &["neither a built-in actuator nor a file", "haptuator-mark-ii"]);
    bench.write("broken.toml", "format = \"shagreen-actuator\"\nversion = \"1.0\"\nid = \"x\"\nname = \"x\"\nsource = \"x\"\nloud = 3\n");
    bench.fails("actuator show broken.toml", 1, &["the field `loud` is unknown", "line 6", "broken.toml"]);
}
