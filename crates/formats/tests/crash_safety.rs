//! A library file survives a crash of its writer: this program starts itself as a writer and kills it at random times.

#![cfg(unix)]
#![allow(
    clippy::unwrap_used,
    clippy::print_stdout,
    reason = "a test may panic on an unexpected result, and the writer reports its progress to its parent"
)]

use std::io::{BufRead as _, BufReader, Write as _};
use std::path::{Path, PathBuf};
use std::{env, fs};

use shagreen_core::maths::rng::Random;
use shagreen_formats::atomic;
use shagreen_formats::library::{read_library, write_library};
use shagreen_formats::starter::{starter_bytes, starter_library};

use self::killed::{itself, kill_after};

#[path = "support/killed.rs"]
mod killed;

/// Environment variable for the writing method; if it is set, this program is the writer.
const HOW: &str = "SHAGREEN_CRASH_WRITER";
/// Environment variable for the path of the file.
const FILE: &str = "SHAGREEN_CRASH_FILE";
/// Message of the writer after its first complete file.
const READY: &str = "the first file is written";
/// Maximum lifetime of a writer after its first file, in µs: the time of some ten files.
const LONGEST_MICROS: u64 = 40_000;

/// Two libraries of different lengths, so that a partial overwrite is detectable.
fn two_libraries() -> [Vec<u8>; 2] {
    let mut shorter = starter_library().unwrap();
    shorter.textures.truncate(15);
    [starter_bytes().to_vec(), write_library(&shorter)]
}

/// The writer: writes both libraries in turn until it is killed. As an ordinary test it does nothing unless the
/// environment variables are set.
#[test]
fn writer() {
    let (Ok(how), Ok(file)) = (env::var(HOW), env::var(FILE)) else { return };
    let path = PathBuf::from(file);
    let write = |bytes: &[u8]| match how.as_str() {
        "atomic" => atomic::write(&path, bytes).unwrap(),
        _ => fs::write(&path, bytes).unwrap(),
    };
    let libraries = two_libraries();
    write(&libraries[0]);
    println!("\n{READY}");
    std::io::stdout().flush().unwrap();
    for bytes in libraries.iter().cycle() {
        write(bytes);
    }
}

/// Starts a writer, waits for its first file, and kills it after `micros` microseconds.
fn kill_writer(how: &str, path: &Path, micros: u64) {
    let mut child = itself("writer").env(HOW, how).env(FILE, path).spawn().unwrap();
    let lines = BufReader::new(child.stdout.take().unwrap()).lines();
    assert!(lines.map(Result::unwrap).any(|line| line == READY), "the writer did not report its first file");
    kill_after(child, micros);
}

/// Kills `n` writers; returns how often the file was neither library, and how many other files remained.
fn kills(how: &str, n: u32) -> (u32, usize) {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("library.json");
    let libraries = two_libraries();
    let mut random = Random::new(7);
    let mut torn = 0;
    for _ in 0..n {
        kill_writer(how, &path, random.next_u64() % LONGEST_MICROS);
        let found = fs::read(&path).unwrap();
        let whole = libraries.contains(&found);
        assert_eq!(whole, read_library(&found).is_ok(), "{} bytes", found.len());
        torn += u32::from(!whole);
    }
    (torn, fs::read_dir(folder.path()).unwrap().count() - 1)
}

#[test]
fn a_killed_writer_leaves_a_whole_library() {
    const KILLS: u32 = 80;
    let (torn, left) = kills("atomic", KILLS);
    assert_eq!(torn, 0, "files were damaged by {KILLS} killed writers");
    // A killed writer leaves at most one hidden temporary file.
    assert!(left <= KILLS as usize, "{left} files");
    // The test is only meaningful if some writers were killed while writing.
    assert!(left > 0, "no writer was killed while writing");
}

#[test]
fn a_plain_writer_would_be_caught() {
    let (torn, _) = kills("plain", 40);
    assert!(torn > 0, "40 writers that write in place were killed, but no file was damaged");
}
