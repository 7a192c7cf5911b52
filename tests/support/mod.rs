//! Running the real program from outside, in a folder of its own.
#![allow(dead_code, reason = "each test program uses its own part of this")]
#![allow(clippy::unwrap_used, clippy::print_stdout, reason = "a test may stop, and says what it skips")]

pub(crate) mod strokes;

use std::path::{Path, PathBuf};
use std::process::Command;

/// A folder that goes away with the test.
pub(crate) struct Bench {
    folder: tempfile::TempDir,
}

/// What the program said.
#[derive(Debug)]
pub(crate) struct Said {
    pub(crate) code: i32,
    pub(crate) stdout: String,
    pub(crate) stderr: String,
}

impl Bench {
    pub(crate) fn new() -> Self {
        Self { folder: tempfile::tempdir().unwrap() }
    }

    pub(crate) fn path(&self, name: &str) -> PathBuf {
        self.folder.path().join(name)
    }

    pub(crate) fn write(&self, name: &str, bytes: impl AsRef<[u8]>) -> PathBuf {
        let path = self.path(name);
        std::fs::create_dir_all(path.parent().unwrap()).unwrap();
        std::fs::write(&path, bytes).unwrap();
        path
    }

    /// Names of the files in the folder, in order.
    pub(crate) fn files(&self) -> Vec<String> {
        let entries = std::fs::read_dir(self.folder.path()).unwrap();
        let mut names: Vec<String> =
            entries.map(|entry| entry.unwrap().file_name().into_string().unwrap()).collect();
        names.sort();
        names
    }

    /// The program, to be run in the folder, with arguments parted by spaces.
    pub(crate) fn command(&self, arguments: &str) -> Command {
        let mut command = Command::new(env!("CARGO_BIN_EXE_shagreen"));
        command.args(arguments.split_whitespace()).current_dir(self.folder.path());
        // What this machine has of its user must not tell.
        command.env("XDG_DATA_HOME", self.path("data"));
        command
    }

    /// Runs the program in the folder, with arguments parted by spaces.
    pub(crate) fn run(&self, arguments: &str) -> Said {
        let output = self.command(arguments).output().unwrap();
        Said {
            code: output.status.code().unwrap_or(-1),
            stdout: String::from_utf8(output.stdout).unwrap(),
            stderr: String::from_utf8(output.stderr).unwrap(),
        }
    }

    /// Runs the program with `--json`, which must succeed and print one object and nothing else on standard output.
    pub(crate) fn json(&self, arguments: &str) -> serde_json::Value {
        let said = self.run(&format!("{arguments} --json"));
        assert_eq!(said.code, 0, "{arguments}: {}", said.stderr);
        let value: serde_json::Value = serde_json::from_str(&said.stdout).unwrap();
        assert!(value.is_object() && said.stdout.trim_end().lines().count() == 1);
        value
    }

    /// Runs the program, which must fail with this status and one line that holds all the words, and leave the folder
    /// as it was.
    #[track_caller]
    pub(crate) fn fails(&self, arguments: &str, code: i32, words: &[&str]) {
        let before = self.files();
        let said = self.run(arguments);
        assert_eq!(said.code, code, "{arguments}: {said:?}");
        assert_eq!(said.stdout, "", "{arguments}");
        let errors: Vec<&str> = said.stderr.lines().filter(|line| line.starts_with("error: ")).collect();
        assert_eq!(errors.len(), 1, "{arguments}: {}", said.stderr);
        // Beside the error there may be warnings and notes, and nothing without a label.
        let is_labeled =
            |line: &str| ["error: ", "warning: ", "note: "].iter().any(|label| line.starts_with(label));
        assert!(said.stderr.lines().all(is_labeled), "{}", said.stderr);
        for word in words {
            assert!(errors[0].contains(word), "{arguments}: {word:?} is not in {:?}", errors[0]);
        }
        assert_eq!(self.files(), before, "{arguments}");
    }

    /// Samples of a mono float WAV file, and its rate.
    pub(crate) fn wav(&self, name: &str) -> (Vec<f64>, f64) {
        read_wav(&self.path(name))
    }
}

fn read_wav(path: &Path) -> (Vec<f64>, f64) {
    let mut reader = hound::WavReader::open(path).unwrap();
    let spec = reader.spec();
    assert_eq!(
        (spec.channels, spec.bits_per_sample, spec.sample_format),
        (1, 32, hound::SampleFormat::Float)
    );
    (reader.samples::<f32>().map(|sample| f64::from(sample.unwrap())).collect(), f64::from(spec.sample_rate))
}

/// Root mean square.
pub(crate) fn rms(signal: &[f64]) -> f64 {
    (signal.iter().map(|v| v * v).sum::<f64>() / signal.len().max(1) as f64).sqrt()
}

/// A file of the data that may lie beside the checkout; says that the test is skipped where it does not.
pub(crate) fn shared_data(name: &str) -> Option<PathBuf> {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("../shared/data").join(name);
    if path.exists() {
        return Some(path);
    }
    println!("skipped: {} is not there", path.display());
    None
}
