use std::collections::BTreeMap;
use std::fs;
use std::path::Path;
use std::sync::atomic::{AtomicUsize, Ordering};

use shagreen_core::maths::shard::Shard;
use shagreen_core::texture::shape::Shape;
use shagreen_core::units::Contact;
use shagreen_formats::batch_manifest::{
    BatchManifest, BatchMotion, batch_manifest_with_problems, batch_problems, read_batch_manifest,
};
use shagreen_formats::starter::starter_library;
use shagreen_formats::stroke::TimedContact;

use super::{BatchOptions, BatchOutcome, BatchPlan, BatchProject, BatchSources, LoadedStroke, MARK, plan};
use crate::project::{new_project, textures_of};
use crate::report::Warnings;
use crate::stroke_contacts::StrokeContacts;

/// Two textures, a point and a path, along a steady stroke and a recorded one, as WAV and as models.
const MANIFEST: &str = r#"format = "shagreen-batch"
version = "1.0"
name = "Test"
seed = 3
[[texture]]
ids = ["cork", "felt"]
shape = "level=-3"
[[texture]]
at = [[30, 70]]
[[texture]]
path = [[30, 70], [60, 20]]
name = "Way"
length_mm = 20
[[stroke]]
id = "slow"
speed_mm_per_s = 60
force_n = 0.5
seconds = 0.2
[[stroke]]
id = "table"
file = "table.csv"
[[output]]
id = "wav"
format = "wav"
rate_hz = 2000
bits = 16
[[output]]
id = "plain"
format = "wav"
strokes = ["slow"]
[[output]]
id = "models"
format = "hatt"
"#;
/// Four textures, of which each has two strokes in one output, one in another, and a model.
const N_JOBS: usize = 16;

fn manifest(text: &str) -> BatchManifest {
    read_batch_manifest(text.as_bytes()).unwrap()
}

fn loaded(motion: &BatchMotion) -> LoadedStroke {
    match motion {
        BatchMotion::Steady { speed_mm_per_s, force_n, seconds } => LoadedStroke::Steady {
            contact: Contact::from_mm_per_s_and_n(*speed_mm_per_s, *force_n),
            seconds: *seconds,
        },
        BatchMotion::File(name) => {
            let contact =
                |time_secs, force_n| TimedContact { time_secs, speed_mps: 0.1, force_n, impact_mps: None };
            let contacts = vec![contact(0.0, 0.0), contact(0.05, 0.0), contact(0.15, 1.0)];
            LoadedStroke::Recorded {
                contacts: StrokeContacts::given(contacts).unwrap(),
                file_name: name.clone(),
                sha256: "ab".to_owned(),
            }
        }
    }
}

fn planned(text: &str) -> Result<BatchPlan, String> {
    let manifest = manifest(text);
    let sources = BatchSources {
        library: starter_library().unwrap(),
        project: None,
        strokes: manifest.strokes.iter().map(|stroke| loaded(&stroke.motion)).collect(),
        actuators: vec![None; manifest.outputs.len()],
    };
    plan(manifest, sources, (Vec::new(), "test"), &Warnings::default())
        .map_err(|problems| batch_problems(text, problems).to_string())
}

fn run(plan: &BatchPlan, folder: &Path, n_threads: usize, shard: Shard) -> BatchOutcome {
    let options = BatchOptions { folder, n_threads, shard, created_by: "test" };
    plan.run(&options, &|| true).unwrap()
}

/// All files of a folder by their paths.
fn files(folder: &Path) -> BTreeMap<String, Vec<u8>> {
    let mut all = BTreeMap::new();
    let mut folders = vec![folder.to_owned()];
    while let Some(next) = folders.pop() {
        for entry in fs::read_dir(&next).unwrap() {
            let path = entry.unwrap().path();
            if path.is_dir() {
                folders.push(path);
            } else {
                let name = path.strip_prefix(folder).unwrap().display().to_string();
                all.insert(name, fs::read(&path).unwrap());
            }
        }
    }
    all
}

/// The same bytes on one thread and on several, in parts, and after an interruption anywhere.
#[test]
fn files_do_not_depend_on_how_they_are_made() {
    let root = tempfile::tempdir().unwrap();
    let plan = planned(MANIFEST).unwrap();
    let [one, many, parts] = ["one", "many", "parts"].map(|name| root.path().join(name));
    let outcome = run(&plan, &one, 1, Shard::WHOLE);
    assert_eq!(outcome.failed().count(), 0, "{:?}", outcome.failed().next());
    assert_eq!((outcome.n_written(), outcome.n_kept(), outcome.n_jobs), (N_JOBS, 0, N_JOBS));
    let expected = files(&one);
    for name in [
        MARK,
        "wav/cork--slow.wav",
        "wav/cork--slow.json",
        "wav/at-30-70--table.wav",
        "plain/way--slow.wav",
        "models/felt.xml",
        "records/wav/felt--table.json",
    ] {
        assert!(expected.contains_key(name), "{name}: {:?}", expected.keys());
    }
    run(&plan, &many, 4, Shard::WHOLE);
    assert_eq!(files(&many), expected);
    for number in [2, 1] {
        let shard = Shard::new(number, 2).unwrap();
        assert_eq!(run(&plan, &parts, 2, shard).n_written(), plan.n_jobs(shard));
    }
    assert_eq!(files(&parts), expected);
    // A second run has nothing to do.
    let again = run(&plan, &one, 2, Shard::WHOLE);
    assert_eq!((again.n_written(), again.n_kept()), (0, N_JOBS));
    // A file without a record, a record without its file, a damaged file, and files of a job that was killed halfway.
    fs::remove_file(one.join("records/wav/cork--slow.json")).unwrap();
    fs::remove_file(one.join("wav/felt--slow.wav")).unwrap();
    fs::write(one.join("models/cork.xml"), "cut").unwrap();
    fs::remove_file(one.join("plain/cork--slow.json")).unwrap();
    fs::write(one.join("records/plain/felt--slow.json"), "{").unwrap();
    let repaired = run(&plan, &one, 2, Shard::WHOLE);
    assert_eq!((repaired.n_written(), repaired.n_kept()), (5, N_JOBS - 5));
    assert_eq!(files(&one), expected);
}

#[test]
fn a_run_that_is_stopped_goes_on_later() {
    let root = tempfile::tempdir().unwrap();
    let plan = planned(MANIFEST).unwrap();
    let n_done = AtomicUsize::new(0);
    let options = BatchOptions { folder: root.path(), n_threads: 1, shard: Shard::WHOLE, created_by: "test" };
    let stopped = plan.run(&options, &|| n_done.fetch_add(1, Ordering::Relaxed) < 2).unwrap();
    assert_eq!(stopped.n_written(), 3);
    let rest = run(&plan, root.path(), 1, Shard::WHOLE);
    assert_eq!((rest.n_kept(), rest.n_written()), (3, N_JOBS - 3));
}

/// Only what depends on a change is made again.
#[test]
fn a_change_makes_the_files_again_that_depend_on_it() {
    let root = tempfile::tempdir().unwrap();
    run(&planned(MANIFEST).unwrap(), root.path(), 2, Shard::WHOLE);
    let written = |text: &str| run(&planned(text).unwrap(), root.path(), 2, Shard::WHOLE).n_written();
    assert_eq!(written(&MANIFEST.replace("name = \"Test\"", "name = \"Other\"")), 0);
    assert_eq!(written(&MANIFEST.replace("seconds = 0.2", "seconds = 0.3")), 8);
    assert_eq!(written(MANIFEST), 8);
    assert_eq!(written(&MANIFEST.replace("bits = 16", "bits = 24")), 8);
    // The files of bits = 24, and the other files of the two textures.
    assert_eq!(written(&MANIFEST.replace("level=-3", "level=-6")), 8 + 4);
}

#[test]
fn a_job_that_fails_leaves_the_others_alone() {
    let root = tempfile::tempdir().unwrap();
    // A shaped texture has no heights, which the job finds.
    let text = MANIFEST.replace("format = \"hatt\"", "format = \"maps\"");
    let outcome = run(&planned(&text).unwrap(), root.path(), 2, Shard::WHOLE);
    let failed: Vec<(&str, &str)> = outcome.failed().collect();
    assert!(failed[0].0 == "models/cork" && failed[0].1.contains("no height map"), "{failed:?}");
    assert!(failed.iter().all(|(job, _)| job.starts_with("models/")), "{failed:?}");
    assert_eq!(outcome.n_written(), N_JOBS - failed.len());
    assert!(root.path().join("wav/cork--slow.wav").is_file());
    assert!(!root.path().join("models/cork.gltf").exists());
}

/// A rate below that of the models is found once, before any job runs, for textures, points and paths.
#[test]
fn a_rate_that_is_too_low_is_a_problem_of_the_manifest() {
    // The models have 1000 Hz.
    let low = MANIFEST.replace("rate_hz = 2000", "rate_hz = 500");
    let problems = planned(&low).err().unwrap();
    for words in ["1 problem: ", "output[1].rate_hz: it is 500 Hz", "of 4 textures", "at least 1000 Hz"] {
        assert!(problems.contains(words), "{words:?} is not in {problems:?}");
    }
    let mixing = low.replace("at = [[30, 70]]", "at = [[30, 70]]\nblend = \"shared\"");
    let problems = planned(&mixing).err().unwrap();
    assert!(problems.contains("of 4 textures"), "{problems}");
    assert!(planned(&MANIFEST.replace("rate_hz = 2000", "rate_hz = 1000")).is_ok());
}

/// Problems of one kind hide none of another, and consequences are not reported.
#[test]
fn problems_that_were_found_before_come_first_and_hide_their_consequences() {
    let text = MANIFEST
        .replace("\"felt\"]", "\"fellt\"]")
        .replace("format = \"hatt\"", "format = 3")
        .replace("rate_hz = 2000", "rate_hz = 500");
    let problems = |further: Option<&str>| {
        let (manifest, mut found) = batch_manifest_with_problems(text.as_bytes()).unwrap();
        found.extend(further.map(|key| (key.to_owned(), "cannot be read".to_owned())));
        let sources = BatchSources {
            library: starter_library().unwrap(),
            project: None,
            strokes: manifest.strokes.iter().map(|stroke| loaded(&stroke.motion)).collect(),
            actuators: vec![None; manifest.outputs.len()],
        };
        let planned = plan(manifest, sources, (found, "test"), &Warnings::default());
        planned.err().unwrap().into_iter().map(|(key, _)| key).collect::<Vec<String>>()
    };
    assert_eq!(problems(None), ["output[3].format", "texture[1].ids", "output[1].rate_hz"]);
    // Without a library, nothing is known about textures and their rates.
    assert_eq!(problems(Some("library")), ["output[3].format", "library"]);
}

#[test]
fn files_of_others_are_safe() {
    let root = tempfile::tempdir().unwrap();
    fs::write(root.path().join("notes.txt"), "x").unwrap();
    let plan = planned(MANIFEST).unwrap();
    let options = BatchOptions { folder: root.path(), n_threads: 1, shard: Shard::WHOLE, created_by: "test" };
    let error = plan.run(&options, &|| true).unwrap_err().to_string();
    assert!(error.contains("no batch has written"), "{error}");
    let file = root.path().join("notes.txt");
    let error = plan.run(&BatchOptions { folder: &file, ..options }, &|| true).unwrap_err().to_string();
    assert!(error.contains("this is a file"), "{error}");
}

#[test]
fn all_problems_of_names_are_reported_at_once() {
    let text = MANIFEST
        .replace("\"felt\"]", "\"fellt\"]")
        .replace("[[30, 70]]", "[[30, 70, 5]]")
        .replace("format = \"hatt\"", "format = \"hat\"\nbits = 16");
    let problems = planned(&text).err().unwrap();
    for words in [
        "the manifest has 3 problems: ",
        "line 6, texture[1].ids: the library has no texture \"fellt\"; did you mean felt",
        "texture[2].at: the point has 3 coordinates",
        "output[3].format: there is no format \"hat\"; did you mean hatt",
    ] {
        assert!(problems.contains(words), "{words:?} is not in {problems:?}");
    }
    let check = |text: &str, words: &str| {
        let problems = planned(text).err().unwrap();
        assert!(problems.contains(words), "{words:?} is not in {problems:?}");
    };
    check(&MANIFEST.replace("format = \"hatt\"", "format = \"hatt\"\nbits = 16"), "output[3].bits");
    check(&MANIFEST.replace("id = \"models\"", "id = \"records\""), "the folder of the records");
    let (before, rest) = MANIFEST.split_once("[[stroke]]").unwrap();
    let outputs = &rest[rest.find("[[output]]").unwrap()..];
    let without = format!("{before}{outputs}").replace("strokes = [\"slow\"]\n", "");
    check(&without, "signals need a stroke");
    check(&MANIFEST.replace("[60, 20]", "[160, 20]"), "texture[3].path: ");
}

/// A loop says so in its sidecar, and its clip ends as it begins.
#[test]
fn loops_are_rendered_along_steady_strokes() {
    let looped = MANIFEST.replace("strokes = [\"slow\"]", "strokes = [\"slow\"]\nloop = true");
    let root = tempfile::tempdir().unwrap();
    let plan = planned(&looped).unwrap();
    run(&plan, root.path(), 2, Shard::WHOLE);
    let made = files(root.path());
    let is_loop = |name: &str| {
        let sidecar: serde_json::Value = serde_json::from_slice(&made[name]).unwrap();
        sidecar["loop"] == true
    };
    assert!(is_loop("plain/cork--slow.json") && !is_loop("wav/cork--slow.json"));
    // Samples of 32 bits in m/s² are not scaled.
    assert_eq!(plan.scaled_apart(), ["wav"]);
    let stated = MANIFEST.replace("bits = 16", "bits = 16\nfull_scale_mps2 = 4");
    assert!(planned(&stated).unwrap().scaled_apart().is_empty());
    let problems = planned(&MANIFEST.replace("bits = 16", "loop = true")).err().unwrap();
    assert!(problems.contains("output[1].loop: the stroke \"table\" is recorded"), "{problems}");
}

#[test]
fn a_silent_job_has_a_warning() {
    let root = tempfile::tempdir().unwrap();
    let plan = planned(&MANIFEST.replace("speed_mm_per_s = 60", "speed_mm_per_s = 0")).unwrap();
    let outcome = run(&plan, root.path(), 2, Shard::WHOLE);
    let job = outcome.jobs.iter().find(|job| job.name == "wav/cork--slow").unwrap();
    let warnings = &job.record.as_ref().unwrap().warnings;
    assert!(warnings.iter().any(|warning| warning.contains("the speed is 0")), "{warnings:?}");
}

/// The authored textures of a project, with their own shapes.
#[test]
fn authored_textures_of_a_project_are_rendered() {
    let text = "format = \"shagreen-batch\"\nversion = \"1.0\"\nproject = \"p\"\n[[texture]]\nauthored = [\"New texture\", \"1\"]\n[[stroke]]\nid = \"slow\"\nspeed_mm_per_s = 60\nforce_n = 0.5\nseconds = 0.1\n[[output]]\nid = \"wav\"\nformat = \"wav\"\n";
    let planned = |shape: Shape| {
        let mut project = new_project();
        std::sync::Arc::make_mut(&mut project.authored[0]).shape = shape;
        let placed = textures_of(&project).unwrap();
        let library = project.with_places_of(&placed, |_| false);
        let manifest = manifest(text);
        let strokes = manifest.strokes.iter().map(|stroke| loaded(&stroke.motion)).collect();
        let project = Some(BatchProject { project, placed });
        let sources = BatchSources { library, project, strokes, actuators: vec![None] };
        plan(manifest, sources, (Vec::new(), "test"), &Warnings::default()).ok().unwrap()
    };
    let root = tempfile::tempdir().unwrap();
    assert_eq!(run(&planned(Shape::default()), root.path(), 1, Shard::WHOLE).n_written(), 2);
    let neutral = files(root.path());
    assert_eq!(neutral["wav/new-texture--slow.wav"], neutral["wav/1--slow.wav"]);
    let quiet = Shape { level_db: -6.0, ..Shape::default() };
    assert_eq!(run(&planned(quiet), root.path(), 1, Shard::WHOLE).n_written(), 2);
    assert_ne!(files(root.path())["wav/1--slow.wav"], neutral["wav/1--slow.wav"]);
}
