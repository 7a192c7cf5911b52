//! Runs the real program in a temporary folder.
#![allow(dead_code, reason = "each test program uses a part of this module")]
#![allow(clippy::unwrap_used, clippy::print_stdout, reason = "a test may panic, and prints what it skips")]

pub(crate) mod strokes;

use std::path::{Path, PathBuf};
use std::process::Command;

/// Temporary folder of a test.
pub(crate) struct Bench {
    folder: tempfile::TempDir,
}

/// Exit code and output of the program.
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

    /// Returns the names of the files in the folder, sorted.
    pub(crate) fn files(&self) -> Vec<String> {
        let entries = std::fs::read_dir(self.folder.path()).unwrap();
        let mut names: Vec<String> =
            entries.map(|entry| entry.unwrap().file_name().into_string().unwrap()).collect();
        names.sort();
        names
    }

    /// Returns the command that runs the program in the folder, with arguments separated by spaces.
    pub(crate) fn command(&self, arguments: &str) -> Command {
        let mut command = Command::new(env!("CARGO_BIN_EXE_shagreen"));
        command.args(arguments.split_whitespace()).current_dir(self.folder.path());
        // The result must not depend on the user's files on this machine.
        command.env("XDG_DATA_HOME", self.path("data"));
        command
    }

    /// Runs the program in the folder, with arguments separated by spaces.
    pub(crate) fn run(&self, arguments: &str) -> Said {
        let output = self.command(arguments).output().unwrap();
        Said {
            code: output.status.code().unwrap_or(-1),
            stdout: String::from_utf8(output.stdout).unwrap(),
            stderr: String::from_utf8(output.stderr).unwrap(),
        }
    }

    /// Runs the program with `--json`. It must succeed and print one JSON object, and nothing else, on standard output.
    pub(crate) fn json(&self, arguments: &str) -> serde_json::Value {
        let said = self.run(&format!("{arguments} --json"));
        assert_eq!(said.code, 0, "{arguments}: {}", said.stderr);
        let value: serde_json::Value = serde_json::from_str(&said.stdout).unwrap();
        assert!(value.is_object() && said.stdout.trim_end().lines().count() == 1);
        value
    }

    /// Runs the program. It must fail with this exit code and one error line that contains all the words, and leave the
    /// folder unchanged.
    #[track_caller]
    pub(crate) fn fails(&self, arguments: &str, code: i32, words: &[&str]) {
        let before = self.files();
        let said = self.run(arguments);
        assert_eq!(said.code, code, "{arguments}: {said:?}");
        assert_eq!(said.stdout, "", "{arguments}");
        let errors: Vec<&str> = said.stderr.lines().filter(|line| line.starts_with("error: ")).collect();
        assert_eq!(errors.len(), 1, "{arguments}: {}", said.stderr);
        // Other lines must be warnings or notes; every line has a label.
        let is_labeled =
            |line: &str| ["error: ", "warning: ", "note: "].iter().any(|label| line.starts_with(label));
        assert!(said.stderr.lines().all(is_labeled), "{}", said.stderr);
        for word in words {
            assert!(errors[0].contains(word), "{arguments}: {word:?} is not in {:?}", errors[0]);
        }
        assert_eq!(self.files(), before, "{arguments}");
    }

    /// Returns the samples of a mono float WAV file, and its sample rate.
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

/// Returns the root mean square.
pub(crate) fn rms(signal: &[f64]) -> f64 {
    (signal.iter().map(|v| v * v).sum::<f64>() / signal.len().max(1) as f64).sqrt()
}

/// Returns the path of a shared data file; if it does not exist, prints that the test is skipped.
pub(crate) fn shared_data(name: &str) -> Option<PathBuf> {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("../shared/data").join(name);
    if path.exists() {
        return Some(path);
    }
    println!("skipped: {} does not exist", path.display());
    None
}
