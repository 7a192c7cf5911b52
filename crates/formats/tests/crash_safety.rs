//! A library survives the death of its writer: this program starts itself as a writer and kills it at random moments.

#![cfg(unix)]
#![allow(
    clippy::unwrap_used,
    clippy::print_stdout,
    reason = "a test may stop at what it did not expect, and the writer tells its parent where it stands"
)]

use std::io::{BufRead as _, BufReader, Write as _};
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};
use std::time::Duration;
use std::{env, fs, thread};

use shagreen_core::rng::Random;
use shagreen_formats::atomic;
use shagreen_formats::library::{read_library, write_library};
use shagreen_formats::starter::{starter_bytes, starter_library};

/// How the writer writes; where it is set, this program is the writer.
const HOW: &str = "SHAGREEN_CRASH_WRITER";
/// The file that it writes.
const FILE: &str = "SHAGREEN_CRASH_FILE";
/// What the writer says once the file is there.
const READY: &str = "the first file is written";
/// Longest life of a writer after its first file: some ten files long.
const LONGEST_MICROS: u64 = 40_000;

/// Two libraries of different lengths, so that half of one in place of the other shows.
fn two_libraries() -> [Vec<u8>; 2] {
    let mut shorter = starter_library().unwrap();
    shorter.textures.truncate(15);
    [starter_bytes().to_vec(), write_library(&shorter)]
}

/// The writer: alternates both libraries for as long as it lives. A test like any other, that does nothing unless asked.
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

/// Starts a writer, waits for its first file, and kills it after so many microseconds.
fn kill_after(how: &str, path: &Path, micros: u64) {
    let mut child = Command::new(env::current_exe().unwrap())
        .args(["writer", "--exact", "--nocapture"])
        .env(HOW, how)
        .env(FILE, path)
        .stdout(Stdio::piped())
        .stderr(Stdio::null())
        .spawn()
        .unwrap();
    let lines = BufReader::new(child.stdout.take().unwrap()).lines();
    assert!(lines.map(Result::unwrap).any(|line| line == READY), "the writer wrote nothing");
    thread::sleep(Duration::from_micros(micros));
    // SIGKILL: nothing of the writer runs after it.
    child.kill().unwrap();
    child.wait().unwrap();
}

/// Kills so many writers; returns how often the file was neither library, and how many other files were left.
fn kills(how: &str, n: u32) -> (u32, usize) {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("library.json");
    let libraries = two_libraries();
    let mut random = Random::new(7);
    let mut torn = 0;
    for _ in 0..n {
        kill_after(how, &path, random.next_u64() % LONGEST_MICROS);
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
    assert_eq!(torn, 0, "of {KILLS} killed writers");
    // What a writer was at when it was killed stays under its hidden name, one file at most.
    assert!(left <= KILLS as usize, "{left} files");
    // The test is one only if writers die while they write.
    assert!(left > 0, "no writer was killed in the middle of its work");
}

#[test]
fn a_plain_writer_would_be_caught() {
    let (torn, _) = kills("plain", 40);
    assert!(torn > 0, "40 writers that write in place were killed, and no file was torn");
}
