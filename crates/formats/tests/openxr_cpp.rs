//! The C++ reader of `examples/export` reads what is written for OpenXR.
#![cfg(unix)]
#![allow(clippy::unwrap_used, clippy::print_stdout, reason = "tests may panic and print what they skip")]

use std::path::{Path, PathBuf};
use std::process::Command;

use shagreen_formats::clip_scale::ClipScale;
use shagreen_formats::haptic_clip::{AmplitudePoint, HapticClip};
use shagreen_formats::openxr_parametric::{openxr_parametric, write_openxr_parametric};

/// Compiles the reader, with every warning as an error. Returns `None` and prints a message if there is no compiler.
fn compile(folder: &Path) -> Option<PathBuf> {
    let source =
        Path::new(env!("CARGO_MANIFEST_DIR")).join("../../examples/export/openxr_parametric_print.cpp");
    let program = folder.join("print");
    let flags = ["-std=c++17", "-Wall", "-Wextra", "-Werror", "-pedantic", "-o"];
    match Command::new("g++").args(flags).arg(&program).arg(source).output() {
        Ok(output) => {
            assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
            Some(program)
        }
        Err(error) => {
            println!("skipped: no C++ compiler is available ({error})");
            None
        }
    }
}

#[test]
fn the_reader_in_cpp_reads_what_is_written() {
    let folder = tempfile::tempdir().unwrap();
    let Some(program) = compile(folder.path()) else { return };
    let point = |i: u32| AmplitudePoint {
        time_secs: 0.005 * f64::from(i),
        amplitude: f64::from(i % 5) / 5.0,
        emphasis: None,
    };
    let clip = HapticClip { amplitude: (0..1100).map(point).collect(), ..HapticClip::default() };
    // A description may contain anything.
    let made = openxr_parametric(&clip, ClipScale::new(1.0, None), ("test", "Größe \"3\" \\ m/s²\n[{"));
    let path = folder.path().join("long.openxr.json");
    std::fs::write(&path, write_openxr_parametric(&made)).unwrap();
    let run = |path: &Path| Command::new(&program).arg(path).output().unwrap();
    let said = run(&path);
    assert!(said.status.success(), "{}", String::from_utf8_lossy(&said.stderr));
    let text = String::from_utf8_lossy(&said.stdout).into_owned();
    let lines: Vec<&str> = text.lines().collect();
    let expected = [
        "60 to 300 Hz",
        "frame 1: 499 amplitudes, 1 frequencies, 0 transients, to 2490 ms",
        "frame 2: 499 amplitudes, 0 frequencies, 0 transients, to 4985 ms",
        "frame 3: 102 amplitudes, 0 frequencies, 0 transients, to 5495 ms",
    ];
    assert_eq!(lines, expected);
    // A part of a file is an error, not a crash.
    let bytes = std::fs::read(&path).unwrap();
    std::fs::write(&path, &bytes[..bytes.len() / 2]).unwrap();
    let said = run(&path);
    assert_eq!(said.status.code(), Some(1));
    assert!(String::from_utf8_lossy(&said.stderr).contains("damaged"));
}
