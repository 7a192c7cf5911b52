//! Every reader withstands any input: no panic, no hang, and no more memory than [`MEMORY_FACTOR`] times the input plus
//! [`MEMORY_BYTES`].
//!
//! Valid files are mutated by a seeded generator ([`mutate`]), with the same inputs in the same order every time. As a
//! test, all readers together take about [`SECS`]. `SHAGREEN_FUZZ_INPUTS` requests a number of inputs per reader
//! instead, which `scripts/fuzz` sets to a million.

#![allow(
    clippy::unwrap_used,
    clippy::print_stdout,
    clippy::print_stderr,
    reason = "a test may panic on an unexpected result, and reports what it did"
)]

mod batches;
mod clips;
mod documents;
mod experiences;
mod imports;
mod judgments;
mod memory;
mod mutate;
mod photos;
mod pictures;
mod readers;
mod recordings;
mod signals;
mod studies;
mod textures;

use std::panic::{AssertUnwindSafe, catch_unwind};
use std::sync::atomic::{AtomicU64, Ordering};
use std::time::{Duration, Instant};
use std::{env, fs, process, thread};

use shagreen_core::maths::rng::{Random, derive_seed};
use shagreen_formats::map_toml::read_map;
use shagreen_formats::recording::read_recording;
use shagreen_formats::stroke_csv::read_stroke_csv;
use shagreen_formats::svc::read_svc;

use crate::memory::peak_of;
use crate::mutate::mutate;
use crate::readers::{READERS, Reader};

/// Random seed of all inputs.
const SEED: u64 = 3;
/// Time for all readers together in a test, in s.
const SECS: f64 = 10.0;
/// Maximum time of a reader for one input.
const LONGEST: Duration = Duration::from_secs(10);
/// Time after which a reader counts as an endless loop.
const NEVER: Duration = Duration::from_secs(90);
/// Permitted memory of a reader, in bytes per byte of its input.
const MEMORY_FACTOR: usize = 10;
/// Permitted memory of a reader for any input, in bytes.
const MEMORY_BYTES: usize = 64 << 20;

/// A violated property, with the input that caused it.
#[derive(Debug)]
struct Failure {
    what: String,
    input: Vec<u8>,
}

/// Reads one input; returns the violated property as an error.
fn read_one(reader: &Reader, input: &[u8]) -> Result<(), String> {
    let timed = || {
        let start = Instant::now();
        let (outcome, peak) = peak_of(|| catch_unwind(AssertUnwindSafe(|| (reader.read)(input))));
        (outcome, peak, start.elapsed())
    };
    let (outcome, peak, mut took) = timed();
    match outcome {
        Err(panic) => {
            let message = panic.downcast_ref::<String>().cloned();
            let message = message.or_else(|| panic.downcast_ref::<&str>().map(|text| (*text).to_owned()));
            return Err(format!("panic: {}", message.unwrap_or_default()));
        }
        Ok(Err(broken)) => return Err(broken),
        Ok(Ok(())) => {}
    }
    let most = MEMORY_FACTOR * input.len() + MEMORY_BYTES;
    if peak > most {
        return Err(format!("memory: {peak} bytes for an input of {}", input.len()));
    }
    // The measurement is repeated, because the machine may be busy once but not every time.
    for _ in 0..3 {
        if took <= LONGEST {
            return Ok(());
        }
        took = timed().2;
    }
    Err(format!("hang: {took:?} for an input of {} bytes", input.len()))
}

/// Reads inputs until there are `n_inputs` or the time is over. Returns the number of inputs.
fn fuzz(reader: &Reader, n_inputs: Option<u64>, secs: f64) -> Result<u64, Box<Failure>> {
    let seeds = (reader.seeds)();
    for seed in &seeds {
        read_one(reader, seed).map_err(|what| Box::new(Failure { what, input: seed.clone() }))?;
    }
    let start = Instant::now();
    let current = AtomicU64::new(0);
    let is_over = AtomicU64::new(0);
    thread::scope(|scope| {
        scope.spawn(|| watch(reader.name, &current, &is_over));
        let mut index = 0;
        let outcome = loop {
            let goes_on = match n_inputs {
                Some(n) => index < n,
                None => start.elapsed().as_secs_f64() < secs,
            };
            if !goes_on {
                break Ok(index);
            }
            index += 1;
            current.store(index, Ordering::Relaxed);
            let input = input(reader, &seeds, index);
            if let Err(what) = read_one(reader, &input) {
                break Err(Box::new(Failure { what: format!("input {index}: {what}"), input }));
            }
        };
        is_over.store(1, Ordering::Relaxed);
        outcome
    })
}

/// Input number `index` of a reader, determined by the reader's name and the number alone.
fn input(reader: &Reader, seeds: &[Vec<u8>], index: u64) -> Vec<u8> {
    let mut random = Random::new(derive_seed(SEED, &format!("{} {index}", reader.name)));
    let mut bytes = mutate(seeds, &mut random);
    if let Some(repair) = reader.repair {
        repair(&mut bytes);
    }
    bytes
}

/// Aborts the program if a reader does not return; nothing else can stop it.
fn watch(name: &str, current: &AtomicU64, is_over: &AtomicU64) {
    let (mut seen, mut since) = (0, Instant::now());
    while is_over.load(Ordering::Relaxed) == 0 {
        thread::sleep(Duration::from_millis(50));
        let index = current.load(Ordering::Relaxed);
        if index != seen {
            (seen, since) = (index, Instant::now());
        } else if since.elapsed() > NEVER {
            eprintln!("hang: {name} does not return from input {index}");
            process::abort();
        }
    }
}

#[test]
fn every_reader_takes_whatever_comes() {
    let n_inputs = env::var("SHAGREEN_FUZZ_INPUTS").ok().map(|n| n.parse().unwrap());
    let only = env::var("SHAGREEN_FUZZ_READER").ok();
    let readers: Vec<&Reader> =
        READERS.iter().filter(|r| only.as_ref().is_none_or(|only| r.name == only)).collect();
    assert!(!readers.is_empty(), "no reader has the name {only:?}");
    // Panics are caught and reported once.
    let hook = std::panic::take_hook();
    std::panic::set_hook(Box::new(|_| {}));
    let mut failures = Vec::new();
    for reader in &readers {
        let start = Instant::now();
        match fuzz(reader, n_inputs, SECS / READERS.len() as f64) {
            Ok(n) => println!("{}: {n} inputs in {:.1} s", reader.name, start.elapsed().as_secs_f64()),
            Err(failure) => {
                let path = env::temp_dir().join(format!("shagreen-fuzz-{}", reader.name));
                fs::write(&path, &failure.input).unwrap();
                failures.push(format!("{}: {} ({})", reader.name, failure.what, path.display()));
            }
        }
    }
    std::panic::set_hook(hook);
    assert!(failures.is_empty(), "{failures:#?}");
}

/// A small file may decode to a large picture, and a short text to deep nesting; random mutations do not find these.
#[test]
fn what_is_made_to_be_large_is_refused() {
    for reader in READERS {
        for bomb in (reader.bombs)() {
            if let Err(what) = read_one(reader, &bomb) {
                panic!("{}: {what}", reader.name);
            }
        }
    }
}

/// Files of several MB with the shortest possible cells.
#[test]
fn dense_tables_are_read_in_the_same_bounds() {
    const N_ROWS: usize = 700_000;
    let table = |head: &str, row: fn(usize) -> String| {
        (0..N_ROWS).fold(head.to_owned(), |text, i| text + &row(i) + "\n").into_bytes()
    };
    let recording = |bytes: &[u8]| {
        let map = b"rate_hz = 1000\nacceleration = [1]\nacceleration_unit = \"g\"\nspeed = 2\n\
            speed_unit = \"mm/s\"\nforce = 3\nforce_unit = \"N\"";
        read_recording("a.csv", bytes, None, &read_map(map).unwrap()).is_ok()
    };
    let check = |name: &str, bytes: &[u8], read: &dyn Fn(&[u8]) -> bool| {
        let (is_read, peak) = peak_of(|| read(bytes));
        assert!(is_read, "{name}");
        let share = peak as f64 / bytes.len() as f64;
        println!("{name}: {share:.1} times the {} bytes of the file", bytes.len());
        assert!(peak <= MEMORY_FACTOR * bytes.len() + MEMORY_BYTES, "{name}: {share:.1} times");
    };
    check("recording", &table("", |i| format!("{},2,3", i * i % 10)), &recording);
    check("recording of many columns", &table("", |i| format!("{},2,3,,,,,,,,,", i * i % 10)), &recording);
    check("stroke", &table("t_ms,speed,force\n", |i| format!("{i},1,1")), &|bytes| {
        read_stroke_csv(bytes).is_ok()
    });
    check("pen", &table("700000\n", |i| format!("1 1 {i} 1 1 1 1")), &|bytes| read_svc(bytes).is_ok());
    let words = "1 ".repeat(5 << 20);
    check("a line of words", words.as_bytes(), &|bytes| read_svc(bytes).is_err());
}

#[test]
fn planted_faults_are_caught() {
    let check = |read: fn(&[u8]) -> Result<(), String>, expected: &str| {
        let reader = Reader { name: "planted", seeds: || vec![b"seed 17, 4".to_vec()], read, ..READERS[0] };
        let failure = fuzz(&reader, Some(2000), 0.0).unwrap_err();
        assert!(failure.what.contains(expected), "{}", failure.what);
    };
    check(|bytes| if bytes.first() == Some(&b'x') { panic!("planted") } else { Ok(()) }, "panic: planted");
    check(
        |bytes| {
            let n = if bytes.len() == 7 { 70 << 20 } else { 0 };
            std::hint::black_box(Vec::<u8>::with_capacity(n));
            Ok(())
        },
        "memory: ",
    );
    check(
        |bytes| {
            if bytes.contains(&b'9') {
                thread::sleep(LONGEST + Duration::from_millis(200));
            }
            Ok(())
        },
        "hang: ",
    );
    check(|bytes| if bytes.len() > 12 { Err("broken".into()) } else { Ok(()) }, "broken");
}
