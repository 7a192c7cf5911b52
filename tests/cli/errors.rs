//! Failures print one line, return the right exit status and leave no files.

use crate::support::{Bench, strokes};

const STEADY: &str = "--speed 100 --force 1 --seconds 0.2";

#[test]
fn wrong_usage_is_two() {
    let bench = Bench::new();
    for (arguments, words) in [
        (
            "render --at 130,70 --speed 1 --force 1 --seconds 1 -o o.wav",
            &["rough-smooth is 130", "0 and 100"][..],
        ),
        ("render --at 30,-1 --speed 1 --force 1 --seconds 1 -o o.wav", &["hard-soft is -1"]),
        ("render --at NaN,1 --speed 1 --force 1 --seconds 1 -o o.wav", &["rough-smooth is NaN"]),
        ("render --at 30 --speed 1 --force 1 --seconds 1 -o o.wav", &["RS,HS"]),
        ("render --at 30,70 --texture cork --speed 1 --force 1 --seconds 1 -o o.wav", &["--texture"]),
        ("render --speed 1 --force 1 --seconds 1 -o o.wav", &["--at", "--texture"]),
        ("render --at 30,70 -o o.wav", &["--speed", "--stroke"]),
        ("render --at 30,70 --speed 1 --force 1 -o o.wav", &["--seconds"]),
        ("render --at 30,70 --speed -1 --force 1 --seconds 1 -o o.wav", &["--speed", "0 or greater"]),
        ("render --at 30,70 --speed 1 --force NaN --seconds 1 -o o.wav", &["--force"]),
        ("render --at 30,70 --speed 1 --force 1 --seconds 1", &["--out"]),
        ("render --at 30,70 --blend loud --speed 1 --force 1 --seconds 1 -o o.wav", &["loud", "paper"]),
        ("render --at 30,70 --stroke s.svc --force-min 2 --force-max 1 -o o.wav", &["--force-max"]),
        ("render --nonsense", &["--nonsense"]),
        ("play --texture cork --buffer 4294967295", &["--buffer", "65536"]),
        ("play --texture cork --buffer 15", &["--buffer", "16"]),
        ("play --texture cork --output null --baud 9600", &["cannot be used with", "--output"]),
        ("play --texture cork --output null --serial-mode control", &["cannot be used with", "--output"]),
        ("play --texture cork --full-scale 3 --load-g 40", &["cannot be used with", "--full-scale"]),
        ("play --texture cork --full-scale 3 --full-scale-volts 4", &["cannot be used with", "--full-scale"]),
        ("play --texture cork --full-scale 3 --no-equalizer", &["cannot be used with", "--full-scale"]),
        // A negative number is a wrong value, not another option.
        ("calibrate --recording r.wav --sensitivity -5", &["--sensitivity", "above 0"]),
        ("calibrate --recording r.wav --load-g -5", &["--load-g", "from 0.01 to 100000"]),
        ("calibrate --make-sweep s.wav --low -5", &["--low", "needs 0.1 to"]),
        ("calibrate --make-sweep s.wav --rate -5", &["--rate"]),
        ("actuator show mm1c --load-g -0.5", &["--load-g", "a mass in g"]),
        ("play --texture cork --full-scale -1", &["--full-scale", "0 or greater"]),
        ("play --texture cork --channel -1", &["--channel", "-1"]),
        ("play --texture cork --seed -1", &["--seed", "-1"]),
        ("latency --input x --report-rate -5", &["--report-rate", "from 20"]),
        ("devices --decode a.txt --size-mm -5x10", &["--size-mm", "width and height"]),
        ("texture psd --at 30,70 --speed 100", &["--force"]),
        ("texture psd --at 30,70 --speed 100 --force 1 --bins 1", &["--bins"]),
    ] {
        bench.fails(arguments, 2, words);
    }
}

#[test]
fn what_cannot_be_done_is_one() {
    let bench = Bench::new();
    for (arguments, words) in [
        (
            format!("render --texture crok {STEADY} -o o.wav"),
            &["no texture \"crok\"", "did you mean cork"][..],
        ),
        (format!("render --texture xyzzy {STEADY} -o o.wav"), &["xyzzy", "library list"]),
        (
            format!("render --texture cork {STEADY} -o none/o.wav"),
            &["none/o.wav", "its folder does not exist"],
        ),
        ("library list --library none/l.json".to_owned(), &["there is no such file", "none/l.json"]),
        (
            "export --texture cork --format hatt -o none/o.xml".to_owned(),
            &["its folder does not exist", "none/o.xml"],
        ),
        (format!("render --texture cork {STEADY} -o o.json"), &["o.json", ".wav"]),
        (format!("render --texture cork {STEADY} --rate 500 -o o.wav"), &["1000 Hz", "500"]),
        ("render --texture cork --speed 1 --force 1 --seconds 9999 -o o.wav".to_owned(), &["3600"]),
        ("play --texture cork --speed 1 --force 1 --seconds 1e20".to_owned(), &["3600"]),
        (
            "render --texture cork --speed 1 --force 1 --seconds 3600 --rate 768000 -o o.wav".to_owned(),
            &["at most 1073741806 samples", "lower its sample rate"],
        ),
        ("render --texture cork --stroke none.svc -o o.wav".to_owned(), &["cannot read", "none.svc"]),
        ("library list --library none.json".to_owned(), &["cannot read", "none.json"]),
        ("library make none.toml --out l.json".to_owned(), &["none.toml"]),
        (
            "texture psd --texture cork --without cork --speed 1 --force 1".to_owned(),
            &["no texture \"cork\""],
        ),
        ("texture psd --at 3,4 --without crok --speed 1 --force 1".to_owned(), &["did you mean cork"]),
        ("play --texture cork --output nosuch --seconds 0.1".to_owned(), &["nosuch", "shagreen devices"]),
    ] {
        bench.fails(&arguments, 1, words);
    }
}

#[test]
fn damaged_strokes_are_named_with_their_line() {
    let bench = Bench::new();
    let whole = strokes::synthetic();
    let lines: Vec<&str> = whole.lines().collect();
    let cases: [(&str, String, &[&str]); 8] = [
        ("cut.svc", lines[..200].join("\n"), &["damaged", "the file has 199"]),
        ("torn.svc", whole[..whole.len() - 9].to_owned(), &["line", "values"]),
        ("nan.svc", whole.replacen(" 1190 ", " NaN ", 1), &["azimuth in line 2", "NaN"]),
        (
            "back.svc",
            whole.replacen("354642407", "354642399", 1).replacen("354642408", "354642399", 1),
            &["time decreases in line 3"],
        ),
        ("empty.svc", String::new(), &["first line"]),
        ("text.csv", "hello, world\n".to_owned(), &["hello"]),
        ("nan.csv", "t_s,speed,force\n0,100,NaN\n".to_owned(), &["force in line 2", "NaN"]),
        ("back.csv", "t_s,speed,force\n1,100,1\n0,100,1\n".to_owned(), &["time", "line 3"]),
    ];
    for (name, text, words) in &cases {
        bench.write(name, text);
        let mut words = words.to_vec();
        words.push(name);
        bench.fails(&format!("render --at 30,70 --stroke {name} -o out.wav"), 1, &words);
    }
    let binary: Vec<u8> = (0..=255).cycle().take(4000).collect();
    bench.write("binary.svc", binary);
    bench.fails("render --at 30,70 --stroke binary.svc -o out.wav", 1, &["binary.svc"]);
}

#[test]
fn a_stroke_of_ages_is_refused() {
    let bench = Bench::new();
    bench.write("ages.csv", "t_s,speed,force\n0,100,1\n1e12,100,1\n");
    let words = ["lasts 1000000000000 s", "in seconds?", "ages.csv"];
    bench.fails("play --texture cork --stroke ages.csv", 1, &words);
    bench.fails("render --texture cork --stroke ages.csv -o out.wav", 1, &words);
}

/// A reader that closes the pipe, as `head` does, causes no panic.
#[test]
fn closed_pipes_are_no_failure() {
    let bench = Bench::new();
    let closed = || {
        let (reader, writer) = std::io::pipe().unwrap();
        drop(reader);
        writer
    };
    for (arguments, code) in [
        ("--help", 0),
        ("--version", 0),
        ("library list", 0),
        ("devices --json", 0),
        ("render --nonsense", 2),
    ] {
        let output = bench.command(arguments).stdout(closed()).output().unwrap();
        let said = String::from_utf8_lossy(&output.stderr);
        assert!(output.status.code() == Some(code) && !said.contains("panic"), "{arguments}: {said}");
        let status = bench.command(arguments).stdout(closed()).stderr(closed()).status().unwrap();
        assert_eq!(status.code(), Some(code), "{arguments}");
    }
}

#[test]
fn pressures_beyond_the_full_scale_are_refused() {
    let bench = Bench::new();
    bench.write("stroke.svc", strokes::synthetic());
    let words = ["pressure in line 2 is 12000", "8191", "--pressure-max", "stroke.svc"];
    bench.fails("render --at 30,70 --stroke stroke.svc --pressure-max 8191 -o out.wav", 1, &words);
    bench.fails("render --at 30,70 --stroke stroke.svc --mm-per-count 0 -o out.wav", 1, &["mm", "positive"]);
}

/// Options that do not apply to the given stroke are rejected.
#[test]
fn how_a_stroke_is_read_is_asked_of_what_can_tell() {
    let bench = Bench::new();
    bench.write("stroke.svc", strokes::synthetic());
    bench.write("contacts.csv", "t_s,speed,force\n0,100,1\n1,100,1\n");
    bench.write("newtons.csv", "t_s,x,y,force\n0,0,0,1\n0.01,1,0,1\n");
    bench.write("shares.csv", "t_s,x,y,pressure\n0,0,0,0.5\n0.01,1,0,0.5\n");
    // A pen that declares neither its size nor its force.
    let descriptor = "05 0d 09 02 a1 01 85 01 09 20 a1 00 09 42 15 00 25 01 75 01 95 01 81 02 95 07 81 03 05 01 09 30 \
        75 10 95 01 26 10 27 81 02 09 31 81 02 05 0d 09 30 26 ff 0f 81 02 c0 c0";
    let events = (0..50).map(|i| format!("E: 0.{i:02} 8 01 01 {i:02x} 00 00 00 00 08\n"));
    let n_bytes = descriptor.split_whitespace().count();
    let hid = format!("R: {n_bytes} {descriptor}\n{}", events.collect::<String>());
    bench.write("hid.txt", hid);
    let render = |options: &str| format!("render --texture cork {options} -o out.wav");
    for (options, words) in [
        ("--stroke stroke.svc --size-mm 216x135", &["--size-mm", "a .svc file", "stroke.svc"][..]),
        ("--stroke contacts.csv --force-max 3", &["--force-max", "speed and force"]),
        ("--stroke contacts.csv --pressure-max 3", &["--pressure-max"]),
        ("--stroke newtons.csv --pressure-curve 1", &["--pressure-curve", "force in N"]),
        ("--stroke shares.csv --mm-per-count 1", &["--mm-per-count", "with pressure"]),
        ("--stroke hid.txt --size-mm 200x100 --mm-per-count 1", &["--mm-per-count", "HID"]),
        ("--stroke hid.txt --size-mm 200x100 --ms-per-tick 1", &["--ms-per-tick", "HID"]),
        (&format!("{STEADY} --mm-per-count 1"), &["--mm-per-count", "--stroke"]),
        (&format!("{STEADY} --force-min 0.1"), &["--force-min", "--stroke"]),
    ] {
        bench.fails(&render(options), 2, words);
    }
    for options in [
        "--stroke stroke.svc --mm-per-count 0.01 --force-max 3",
        "--stroke shares.csv --pressure-curve 1",
        "--stroke hid.txt --size-mm 200x100 --force-max 3",
    ] {
        bench.json(&render(options));
    }
}

#[test]
fn damaged_libraries_name_the_texture_and_the_file() {
    let bench = Bench::new();
    let starter = include_str!("../../assets/starter/starter.json");
    let start = starter.find("\"lsf\":[").unwrap();
    let (before, after) = starter.split_at(start + "\"lsf\":[".len());
    let cases: [(&str, String, &[&str]); 5] = [
        ("cut.json", starter[..starter.len() / 2].to_owned(), &["damaged", "line"]),
        ("nan.json", format!("{before}NaN,{after}"), &["damaged", "line"]),
        (
            "order.json",
            format!("{before}3.0,{}", &after[after.find(',').unwrap() + 1..]),
            &["\"glass\"", "ascend"],
        ),
        ("newer.json", starter.replacen("\"version\": \"1.7\"", "\"version\": \"2.0\"", 1), &["version 2.0"]),
        ("other.json", "{\"format\": \"other\"}".to_owned(), &["not a texture library"]),
    ];
    for (name, text, words) in &cases {
        bench.write(name, text);
        let mut words = words.to_vec();
        words.push(name);
        bench.fails(&format!("render --at 30,70 {STEADY} --library {name} -o out.wav"), 1, &words);
        bench.fails(&format!("library list --json --library {name}"), 1, &words);
    }
}

#[test]
fn a_failure_leaves_an_existing_file_as_it_was() {
    let bench = Bench::new();
    bench.write("out.wav", "mine");
    bench.write("cut.svc", "5\n1 2 3 1 5 6 7\n");
    bench.fails("render --at 30,70 --stroke cut.svc -o out.wav", 1, &["damaged"]);
    assert_eq!(std::fs::read(bench.path("out.wav")).unwrap(), b"mine");
    // A signal replaces only another signal of this program.
    let render = format!("render --at 30,70 {STEADY} -o out.wav");
    bench.fails(&render, 1, &["out.wav", "a file of another kind"]);
    assert_eq!(std::fs::read(bench.path("out.wav")).unwrap(), b"mine");
    std::fs::remove_file(bench.path("out.wav")).unwrap();
    std::fs::create_dir(bench.path("out.json")).unwrap();
    bench.fails(&render, 1, &["out.json"]);
    std::fs::remove_dir(bench.path("out.json")).unwrap();
    assert_eq!((bench.run(&render).code, bench.run(&render).code), (0, 0));
}

#[test]
fn what_is_read_is_not_written_over() {
    let bench = Bench::new();
    let starter = shagreen_formats::starter::starter_bytes();
    std::fs::write(bench.path("mine.json"), starter).unwrap();
    // The sidecar of mine.wav would be mine.json.
    bench.fails(
        &format!("render --texture cork {STEADY} --library mine.json -o mine.wav"),
        1,
        &["the signal mine.wav gets a sidecar file", "another name for the signal", "mine.json"],
    );
    assert_eq!(std::fs::read(bench.path("mine.json")).unwrap(), starter);
    bench.write("hand.json", "t_s,speed,force\n0,100,1\n1,100,1\n");
    bench.fails(
        "render --texture cork --stroke hand.json -o hand.wav",
        1,
        &["the signal hand.wav gets a sidecar file", "hand.json"],
    );
    // An unrelated file next to the signal is not a sidecar.
    bench.write("notes.json", "{\"mine\": true}");
    bench.fails(&format!("render --texture cork {STEADY} -o notes.wav"), 1, &["would replace", "notes.json"]);
    assert!(!bench.path("notes.wav").exists());
    bench.write("stroke.csv", "t,speed,force\n0,100,1\n1,100,1\n");
    bench.fails("render --texture cork --stroke stroke.csv -o stroke.csv", 1, &["stroke.csv"]);
    bench.write("materials.toml", "seed = 1\n");
    bench.fails("library make materials.toml --out materials.toml", 1, &["materials.toml"]);
    assert_eq!(std::fs::read_to_string(bench.path("materials.toml")).unwrap(), "seed = 1\n");
}

#[test]
fn a_render_without_a_sample_is_no_success() {
    let bench = Bench::new();
    bench.fails("render --texture cork --speed 100 --force 1 --seconds 0 -o out.wav", 1, &["no sample"]);
    assert!(!bench.path("out.wav").exists());
}

#[cfg(unix)]
#[test]
fn what_is_no_file_is_not_replaced() {
    use std::os::unix::fs::FileTypeExt as _;
    let bench = Bench::new();
    let _bound = std::os::unix::net::UnixListener::bind(bench.path("socket")).unwrap();
    bench.fails(&format!("render --texture cork {STEADY} -o socket"), 1, &["device or a pipe", "socket"]);
    assert!(std::fs::metadata(bench.path("socket")).unwrap().file_type().is_socket());
}
