use proptest::prelude::proptest;
use shagreen_core::space::texture_path::{Along, AtEnd};
use shagreen_core::texture::blend::Mode;

use super::{BatchChoice, BatchManifestError, BatchMotion, BatchSource, batch_problems, read_batch_manifest};
use crate::wav_encoding::{Level, SampleType};

const HEAD: &str = "format = \"shagreen-batch\"\nversion = \"1.0\"\n";

/// A manifest of one texture, one stroke and one output, with further lines after the header and at the end.
fn manifest(head: &str, end: &str) -> String {
    format!(
        "{HEAD}{head}\n[[texture]]\nids = [\"cork\"]\n\n[[stroke]]\nid = \"slow\"\nspeed_mm_per_s = 60\nforce_n = 0.5\nseconds = 2\n\n[[output]]\nid = \"wav\"\nformat = \"wav\"\n{end}\n"
    )
}

#[track_caller]
fn check_error(text: &str, words: &[&str]) {
    let message = read_batch_manifest(text.as_bytes()).unwrap_err().to_string();
    assert!(!message.contains('\n'), "{message}");
    for expected in words {
        assert!(message.contains(expected), "{expected:?} is not in {message:?}");
    }
}

#[test]
fn keys_have_their_meaning() {
    let read = |head: &str, end: &str| read_batch_manifest(manifest(head, end).as_bytes()).unwrap();
    let plain = read("", "");
    assert_eq!((plain.name.as_str(), plain.seed), ("", 1));
    assert_eq!(plain.source, BatchSource::Library("starter".to_owned()));
    assert_eq!(plain.textures[0].choice, BatchChoice::Ids(vec!["cork".to_owned()]));
    let steady = BatchMotion::Steady { speed_mm_per_s: 60.0, force_n: 0.5, seconds: 2.0 };
    assert_eq!((plain.strokes[0].id.as_str(), &plain.strokes[0].motion), ("slow", &steady));
    assert!(plain.outputs[0].stated.is_empty() && plain.outputs[0].strokes.is_none());

    let full = read(
        "name = \"All\"\nproject = \"p.shagreen\"\nseed = 7\n[[texture]]\nall = true\nshape = \"level=-3\"\n[[texture]]\nat = [[30, 70.5], [1, 2]]\nblend = \"power\"\n[[texture]]\nauthored = [\"Mine\"]\n[[texture]]\npath = [[0, 0], [50, 60]]\nname = \"Way\"\nlength_mm = 40\nat_end = \"turn\"\n",
        "rate_hz = 8000\nbits = 16\nnormalize = true\nloop = true\nfull_scale_mps2 = 4\nactuator = \"mm1c\"\nstrokes = [\"slow\"]\n[[stroke]]\nid = \"scribble\"\nfile = \"scribble.csv\"",
    );
    assert_eq!((full.name.as_str(), full.seed), ("All", 7));
    assert_eq!(full.source, BatchSource::Project("p.shagreen".to_owned()));
    assert_eq!(full.textures[0].choice, BatchChoice::All);
    assert_eq!(full.textures[0].shape.map(|shape| shape.level_db), Some(-3.0));
    assert_eq!(full.textures[1].choice, BatchChoice::Points(vec![vec![30.0, 70.5], vec![1.0, 2.0]]));
    assert_eq!(full.textures[1].blend, Mode::Power);
    let BatchChoice::Path(path) = &full.textures[3].choice else { panic!("a path") };
    assert_eq!((path.name.as_str(), path.along, path.length), ("Way", Along::Distance, 0.04));
    assert_eq!((path.points.len(), path.at_end), (2, AtEnd::Turn));
    let output = &full.outputs[0];
    assert_eq!((output.rate_hz, output.full_scale_mps2), (Some(8000), Some(4.0)));
    assert_eq!((output.encoding.samples, output.encoding.level), (SampleType::Pcm16, Level::Peak));
    assert_eq!((output.actuator.as_deref(), output.stated.len()), (Some("mm1c"), 7));
    assert!(output.loops && !plain.outputs[0].loops);
    assert_eq!(full.strokes[1].motion, BatchMotion::File("scribble.csv".to_owned()));
}

#[test]
fn a_file_of_another_kind_is_named() {
    check_error("format = \"shagreen-study\"\nversion = \"1.0\"", &["`format` is \"shagreen-study\""]);
    check_error("x = 1", &["`format` is missing"]);
    check_error("format = \"shagreen-batch\"\nversion = \"2.0\"\nnew = 1", &["version \"2.0\""]);
    check_error("format = \"shagreen-batch\"", &["version missing"]);
    check_error("a = [", &["line 1"]);
    let error = read_batch_manifest(b"name = \"\xff\"").unwrap_err();
    assert_eq!(error, BatchManifestError::NotText { at: 8 });
}

#[test]
fn all_problems_are_reported_at_once_with_their_lines() {
    check_error(
        &manifest("nam = \"a\"\nseed = -1\n", "rate = 8000\nbits = 12\nstrokes = [\"fast\"]"),
        &[
            "the manifest has 5 problems: ",
            "line 3, nam: the key is unknown; did you mean name?",
            "line 4, seed: it is -1, but must be a whole number from 0",
            "line 18, output[1].rate: the key is unknown; did you mean rate_hz?",
            "line 19, output[1].bits: it is 12, but must be a whole number from 16 to 32",
            "line 20, output[1].strokes: there is no stroke \"fast\"; the strokes are: slow",
        ],
    );
    check_error(
        HEAD,
        &["2 problems", "texture: the manifest has no textures", "output: the manifest has no files"],
    );
    check_error(&format!("{HEAD}texture = 3\noutput = []\n"), &["texture: it is 3", "at most 1000 tables"]);
}

#[test]
fn what_contradicts_itself_is_a_problem() {
    for (texture, words) in [
        ("all = true\nids = [\"cork\"]", "a table has one of all, ids, authored, at, path"),
        ("", "nothing chooses textures"),
        ("all = false", "remove the table"),
        ("ids = []", "a list of 1 to 100000 texts"),
        ("at = [30, 70]", "such as [[30, 70], [40, 60]]"),
        ("at = [[30, nan]]", "such as [[30, 70], [40, 60]]"),
        ("authored = [\"Mine\"]", "state `project`"),
        ("all = true\nblend = \"field\"", "only points and paths are interpolated"),
        ("all = true\nlength_mm = 4", "only a path has this key"),
        ("at = [[1, 2]]\nblend = \"loud\"", "one of field, parametric, shared, power, paper"),
        ("all = true\nshape = \"loudness=3\"", "texture[1].shape"),
        ("path = [[0, 0], [50, 60]]\nlength_mm = 4", "texture[1].name: the key is missing"),
        ("path = [[0, 0], [50, 60]]\nname = \"a\"", "the path has no length"),
        ("path = [[0, 0], [50, 60]]\nname = \"a\"\nlength_mm = 4\nlength_s = 4", "remove one"),
        ("path = [[0, 0]]\nname = \"a\"\nlength_mm = 4", "a list of 2 to 48 points"),
    ] {
        check_error(&manifest("", "").replace("ids = [\"cork\"]", texture), &[words]);
    }
    for (stroke, words) in [
        ("speed_mm_per_s = 60", "stroke[1].force_n: the key is missing"),
        ("file = \"a.csv\"\nseconds = 2", "a recorded stroke has its own"),
        ("speed_mm_per_s = \"fast\"\nforce_n = 1\nseconds = 1", "it is \"fast\", but must be a number"),
        (
            "speed_mm_per_s = 1\nforce_n = 1\nseconds = 1\n[[stroke]]\nid = \"slow\"\nfile = \"a\"",
            "the id of another stroke",
        ),
        (
            "speed_mm_per_s = 1\nforce_n = 1\nseconds = 1\n[[stroke]]\nid = \"A b\"\nfile = \"a\"",
            "such as \"a-b\"",
        ),
    ] {
        let text = manifest("", "").replace("speed_mm_per_s = 60\nforce_n = 0.5\nseconds = 2", stroke);
        check_error(&text, &[words]);
    }
    check_error(&manifest("library = \"a\"\nproject = \"b\"", ""), &["state either `library` or `project`"]);
}

#[test]
fn later_problems_have_their_lines_too() {
    let text = manifest("", "");
    let error = batch_problems(&text, vec![("texture[1].ids".to_owned(), "there is no \"cork\"".to_owned())]);
    assert_eq!(error.to_string(), "the manifest has 1 problem: line 5, texture[1].ids: there is no \"cork\"");
}

proptest! {
    #[test]
    fn no_bytes_panic(bytes in proptest::collection::vec(proptest::num::u8::ANY, 0..200)) {
        let _ = read_batch_manifest(&bytes);
    }

    #[test]
    fn no_keys_panic(end in "[a-z_]{1,12} = [\\[\\]0-9a-z\"., -]{0,20}") {
        let _ = read_batch_manifest(manifest(&end, &end).as_bytes());
    }
}
