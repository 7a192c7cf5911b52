//! Files that a command cannot read: the name of the file stands once in what is printed, in plain words.

use crate::support::Bench;

/// Every way to give a file to read; `{}` stands for the file.
const COMMANDS: [&str; 30] = [
    "library list --library {}",
    "library make {} --out made.json",
    "library places --library {} --out made.csv",
    "library relief {} --texture cork --level 1 --out made.json",
    "project show {}",
    "import hatt {} --out made.json",
    "import recording {} --out made.json",
    "render --texture cork --stroke {} -o made.wav",
    "render --texture cork --library {} --speed 100 --force 1 --seconds 0.1 -o made.wav",
    "play --texture cork --stroke {}",
    "texture psd --at 30,70 --speed 100 --force 1 --library {}",
    "texture path --stop 30,70@0 --stop 40,60@50 --library {} --out made.json",
    "export --texture cork --format hatt --library {} -o made.xml",
    "space build --sorting {} --ratings {} --out made.json",
    "space panel --library {} --sorting s.csv --ratings r.csv",
    "space place --attributes {} --source human --out made.json",
    "evaluate leave-one-out --library {}",
    "evaluate codec --library {}",
    "devices --descriptor {}",
    "devices --decode {}",
    "actuator show {}",
    "calibrate --recording {}",
    "quality {} {}",
    "codec encode {} -o made.shgc",
    "codec decode {} -o made.wav",
    "spatial analyse {}",
    "predict attributes --recording {}",
    "predict attributes --photo {}",
    "predict attributes --photo {} --backbone {}",
    "train photo --library {}",
];

/// What the files contain; the first one does not exist.
const FILES: [(&str, Option<&[u8]>); 5] = [
    ("missing", None),
    ("empty", Some(b"")),
    ("text", Some(b"hello, world\n")),
    ("cut", Some(b"{\"format\": \"shagreen-library\", \"version\": \"1.0\", \"textures\": [1,")),
    ("picture", Some(b"\x89PNG\r\n\x1a\n0000IHDR")),
];

/// Words of parsers and of the system.
const RAW: [&str; 9] = [
    "os error",
    "EOF while",
    "missing field",
    "invalid type",
    "invalid digit",
    "is not in ",
    "column 0 at",
    "ChunkType",
    "untagged",
];

/// A picture is asked for its width before it is read.
fn needs_an_option(command: &str, kind: &str) -> bool {
    kind == "picture" && (command.starts_with("spatial") || command.starts_with("library relief"))
}

#[test]
fn the_name_of_a_bad_file_stands_once() {
    let bench = Bench::new();
    for (kind, content) in FILES {
        let name = format!("{kind}.bad");
        if let Some(content) = content {
            bench.write(&name, content);
        }
        for command in COMMANDS.into_iter().filter(|command| !needs_an_option(command, kind)) {
            let arguments = command.replace("{}", &name);
            let said = bench.run(&arguments);
            assert!([1, 2].contains(&said.code), "{arguments}: {said:?}");
            let lines = said.stdout.lines().chain(said.stderr.lines());
            let shown: Vec<&str> = lines.filter(|line| !line.starts_with("note: ")).collect();
            let shown = shown.join("\n");
            assert_eq!(shown.matches(&name).count(), 1, "{arguments}:\n{shown}");
            for raw in RAW {
                assert!(!shown.contains(raw), "{arguments}:\n{shown}");
            }
        }
    }
    let made: Vec<String> = bench.files().into_iter().filter(|file| !file.contains(".bad")).collect();
    assert_eq!(made, [""; 0]);
}

#[test]
fn files_of_other_kinds_say_what_they_are() {
    let bench = Bench::new();
    for (kind, content) in FILES {
        if let Some(content) = content {
            bench.write(&format!("{kind}.bad"), content);
        }
    }
    bench.write("sound.bad", b"RIFF\x04\0\0\0WAVE");
    for (arguments, words) in [
        ("project show empty.bad", &["the file is empty", "restore it from a copy"][..]),
        ("library list --library empty.bad", &["the file is empty"]),
        ("project show picture.bad", &["this is a PNG picture, neither a project nor a texture library"]),
        ("library list --library picture.bad", &["this is a PNG picture, not a texture library"]),
        ("library list --library sound.bad", &["this is a WAV file, not a texture library"]),
        ("library list --library text.bad", &["this is not a texture library; choose another file"]),
        ("import hatt empty.bad --out l.json", &["nothing was imported"]),
        ("codec decode text.bad -o back.mp3", &["only WAV files are written, not .mp3", "back.mp3"]),
        ("calibrate --make-sweep sweep.flac", &["only WAV files are written, not .flac", "sweep.flac"]),
    ] {
        bench.fails(arguments, 1, words);
    }
}

#[test]
fn fields_of_the_wrong_kind_are_named_in_plain_words() {
    let bench = Bench::new();
    let starter = include_str!("../../assets/starter/starter.json");
    for (name, text, words) in [
        (
            "units.json",
            "{\"format\": \"shagreen-library\", \"version\": \"1.0\"}".to_owned(),
            &["the field `units` is missing (line 1, column"][..],
        ),
        (
            "short.json",
            starter[..starter.len() / 2].to_owned(),
            &["the library is damaged: it ends too early (line "],
        ),
        (
            "type.json",
            starter.replacen("\"textures\": [", "\"textures\": [{\"id\": 5},", 1),
            &["it has the number 5 where a text is needed (line "],
        ),
    ] {
        bench.write(name, text);
        bench.fails(&format!("library list --library {name}"), 1, words);
    }
    let profile = "format = \"shagreen-actuator\"\nversion = \"1.0\"\nid = 5\n";
    bench.write("coil.toml", profile);
    let words = ["it has the number 5 where a text is needed at line 3", "coil.toml"];
    bench.fails("actuator show coil.toml", 1, &words);
    for (arguments, words) in [
        ("render --texture cork --seed x", &["--seed", "it must be a whole number"][..]),
        ("play --texture cork --channel 999", &["--channel", "it must be 1 to 64"]),
        ("space panel --noise abc --sorting s.csv --ratings r.csv", &["--noise", "it must be a number"]),
    ] {
        bench.fails(arguments, 2, words);
    }
}
