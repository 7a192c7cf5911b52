//! The examples in C and C++ play the same samples as the renderer, bit by bit, and touch no memory that is not theirs. Those in C#
//! compile, and the console program plays the same level.
#![cfg(unix)]
#![allow(clippy::unwrap_used, clippy::print_stdout, reason = "tests may panic and print what they skip")]

mod support;

use std::path::{Path, PathBuf};
use std::process::{Command, Output};

use shagreen_runtime::synth::contact::Contact;
use shagreen_runtime::synth::runtime_voice::{RuntimeVoice, Touch, VoiceSettings};
use support::Exported;

const RATE_HZ: u32 = 48_000;
const BLOCK: usize = 256;
/// Bytes before the samples of the WAV file.
const WAV_HEAD: usize = 44;
/// Length of the stroke in s, as the programs take it.
const SECONDS: &str = "1.1";

/// The library that Cargo has built for this test program, with this ending.
fn library(ending: &str) -> PathBuf {
    let program = std::env::current_exe().unwrap();
    let built = program.ancestors().skip(1).take(2).flat_map(|folder| {
        let entries = std::fs::read_dir(folder).unwrap();
        entries.map(|entry| entry.unwrap().path())
    });
    let is_it = |path: &PathBuf| {
        let name = path.file_name().and_then(|name| name.to_str()).unwrap_or_default();
        name.starts_with("libshagreen_runtime") && name.ends_with(ending)
    };
    let newest = built.filter(is_it).max_by_key(|path| path.metadata().unwrap().modified().unwrap());
    newest.unwrap_or_else(|| {
        panic!("Cargo has built no libshagreen_runtime{ending} beside {}", program.display())
    })
}

/// Endings of the libraries. The loader of other systems finds a shared library by its name alone.
const ENDINGS: &[&str] = if cfg!(target_os = "linux") { &[".a", ".so"] } else { &[".a"] };

/// Compiles an example against a library, with every warning as an error. Returns `None` and prints a message if there is no
/// compiler.
fn compile(source: &str, library: &Path, folder: &Path) -> Option<PathBuf> {
    let root = Path::new(env!("CARGO_MANIFEST_DIR"));
    let source = root.join("../../examples/runtime").join(source);
    let is_c = source.extension().is_some_and(|ending| ending == "c");
    let (compiler, standard) = if is_c { ("cc", "-std=c99") } else { ("c++", "-std=c++17") };
    let program = folder.join(if is_c { "render-c" } else { "render-cpp" });
    let done = Command::new(compiler)
        .args([standard, "-Wall", "-Wextra", "-Werror", "-pedantic", "-O2", "-ffp-contract=off"])
        .arg("-I")
        .arg(root.join("include"))
        .arg(source)
        .arg(library)
        .args(["-lpthread", "-ldl", "-lm", "-o"])
        .arg(&program)
        .output();
    match done {
        Ok(output) => {
            assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
            Some(program)
        }
        Err(error) => {
            println!("skipped: {compiler} is not available ({error})");
            None
        }
    }
}

/// Runs a program on a table. Returns its output, and the bytes that it wrote.
fn run(command: &mut Command, table: &[u8], folder: &Path) -> (Output, Option<Vec<u8>>) {
    let (input, out) = (folder.join("texture.shgt"), folder.join("out"));
    std::fs::write(&input, table).unwrap();
    if out.exists() {
        std::fs::remove_file(&out).unwrap();
    }
    let output = command.arg(&input).arg(&out).arg(SECONDS).output().unwrap();
    (output, std::fs::read(&out).ok())
}

/// Samples that a program renders.
fn rendered(program: &Path, table: &[u8], folder: &Path) -> Vec<u32> {
    let (output, bytes) = run(&mut Command::new(program), table, folder);
    assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
    let bytes = bytes.unwrap();
    let is_wav = bytes.starts_with(b"RIFF");
    let (samples, rest) = bytes[if is_wav { WAV_HEAD } else { 0 }..].as_chunks::<4>();
    assert!(rest.is_empty());
    samples.iter().map(|bytes| u32::from_le_bytes(*bytes)).collect()
}

/// The same stroke, rendered from the texture itself instead of its table.
fn expected(exported: &Exported) -> Vec<u32> {
    let seconds: f64 = SECONDS.parse().unwrap();
    let view = exported.prepared.view();
    let settings = VoiceSettings { sample_rate_hz: RATE_HZ as f32, max_mps2: 500.0, seed: 7 };
    let mut voice = RuntimeVoice::new(&view, exported.tap, settings).unwrap();
    let n_blocks = (seconds * f64::from(RATE_HZ)) as usize / BLOCK;
    let (mut x_m, mut was_down) = (0.0, false);
    let mut samples = vec![f32::NAN; n_blocks * BLOCK];
    for (i, block) in samples.chunks_mut(BLOCK).enumerate() {
        let t = ((i + 1) * BLOCK) as f64 / f64::from(RATE_HZ);
        let is_down = t >= 0.05 && t < seconds - 0.3;
        let speed_mps = 0.2 * t / seconds;
        x_m += speed_mps * BLOCK as f64 / f64::from(RATE_HZ);
        let force_n = if is_down { (0.5 + t / seconds) as f32 } else { 0.0 };
        if is_down && !was_down {
            voice.tap(Some(0.1));
        }
        was_down = is_down;
        let contact = Contact { speed_mps: speed_mps as f32, force_n };
        voice.process(&view, &[Touch { x_m, y_m: 0.0, contact }], block);
    }
    assert!(samples.iter().any(|x| x.abs() > 0.1), "{} is silent", exported.id);
    samples.into_iter().map(f32::to_bits).collect()
}

/// Fails at the first sample that differs.
fn check(program: &Path, folder: &Path) {
    let three = Exported::three();
    let all: Vec<Vec<u32>> = three.iter().map(expected).collect();
    for (exported, expected) in three.iter().zip(&all) {
        let found = rendered(program, &exported.table, folder);
        assert_eq!(found.len(), expected.len());
        let differs = found.iter().zip(expected).position(|(a, b)| a != b);
        assert_eq!(differs, None, "{} differs", exported.id);
    }
    // Negative control: another texture gives other samples.
    assert_ne!(rendered(program, &three[0].table, folder), all[1]);
}

#[test]
fn the_example_in_c_plays_the_same_samples() {
    for ending in ENDINGS {
        let folder = tempfile::tempdir().unwrap();
        let Some(program) = compile("c/render.c", &library(ending), folder.path()) else { return };
        check(&program, folder.path());
    }
}

#[test]
fn the_example_in_cpp_plays_the_same_samples() {
    let folder = tempfile::tempdir().unwrap();
    let Some(program) = compile("cpp/render.cpp", &library(".a"), folder.path()) else { return };
    check(&program, folder.path());
}

#[test]
fn a_file_that_is_no_table_ends_the_examples_with_a_message() {
    let folder = tempfile::tempdir().unwrap();
    for source in ["c/render.c", "cpp/render.cpp"] {
        let Some(program) = compile(source, &library(".a"), folder.path()) else { return };
        let (output, bytes) = run(&mut Command::new(program), b"my notes", folder.path());
        let message = String::from_utf8(output.stderr).unwrap();
        assert!(message.contains("not a runtime table; export one"), "{message}");
        assert_eq!((output.status.code(), bytes), (Some(1), None));
    }
}

/// What the component for Unity uses of Unity, without any behavior.
#[cfg(target_os = "linux")]
const UNITY: &str = "namespace UnityEngine {
  public struct Vector2 { public float x, y; public Vector2(float x, float y) { this.x = x; this.y = y; } }
  public class Texture {}
  public class MonoBehaviour {}
  public sealed class AudioSource {}
  public static class Application { public static string streamingAssetsPath { get { return null; } } }
  public static class AudioSettings { public static int outputSampleRate { get { return 48000; } } }
  public sealed class TooltipAttribute : System.Attribute { public TooltipAttribute(string text) {} }
  public sealed class RequireComponent : System.Attribute { public RequireComponent(System.Type type) {} }
}";

/// Level in m/s² of the stroke of the console program in C#: 0.1 m/s and 1 N for a second, in blocks of 10 ms.
#[cfg(target_os = "linux")]
fn level_in_csharp(exported: &Exported) -> f64 {
    let view = exported.prepared.view();
    let settings = VoiceSettings { sample_rate_hz: RATE_HZ as f32, max_mps2: 500.0, seed: 7 };
    let mut voice = RuntimeVoice::new(&view, exported.tap, settings).unwrap();
    let (mut samples, mut squares, mut x_m) = ([f32::NAN; 480], 0.0, 0.0);
    for _ in 0..100 {
        x_m += 0.1 * 480.0 / f64::from(RATE_HZ);
        let contact = Contact { speed_mps: 0.1, force_n: 1.0 };
        voice.process(&view, &[Touch { x_m, y_m: 0.0, contact }], &mut samples);
        squares += samples.iter().map(|x| f64::from(*x).powi(2)).sum::<f64>();
    }
    (squares / 48_000.0).sqrt()
}

/// The bindings, the console program and the component for Unity compile without a warning, and the program plays a table.
#[cfg(target_os = "linux")]
#[test]
fn the_example_in_csharp_compiles_and_plays() {
    let folder = tempfile::tempdir().unwrap();
    let [program, unity, table] =
        ["program.exe", "unity.cs", "texture.shgt"].map(|name| folder.path().join(name));
    std::fs::write(&unity, UNITY).unwrap();
    let sources = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../examples/runtime/csharp");
    let compiled = Command::new("mcs")
        .args(["-langversion:7.2", "-warn:4", "-warnaserror"])
        .arg(format!("-out:{}", program.display()))
        .args(["Shagreen.cs", "Program.cs", "ShagreenSource.cs"].map(|name| sources.join(name)))
        .arg(&unity)
        .output();
    let run =
        || Command::new("mono").arg(&program).arg(&table).env("LD_LIBRARY_PATH", folder.path()).output();
    let said = |bytes: &[u8]| String::from_utf8_lossy(bytes).into_owned();
    let Ok(compiled) = compiled else {
        println!("skipped: there is no mcs, the C# compiler of Mono");
        return;
    };
    assert!(compiled.status.success(), "{}{}", said(&compiled.stdout), said(&compiled.stderr));
    std::fs::copy(library(".so"), folder.path().join("libshagreen_runtime.so")).unwrap();
    for exported in &Exported::three() {
        std::fs::write(&table, &exported.table).unwrap();
        let Ok(played) = run() else {
            println!("skipped: there is no mono");
            return;
        };
        let (text, expected) = (said(&played.stdout), level_in_csharp(exported));
        let level = text.lines().nth(1).and_then(|line| line.split(' ').next()?.parse::<f64>().ok());
        // The program prints three decimals.
        let is_same = level.is_some_and(|level| (level - expected).abs() < 1e-3);
        assert!(is_same && expected > 0.01, "{expected}: {text}{}", said(&played.stderr));
    }
    std::fs::write(&table, "my notes").unwrap();
    let refused = run().unwrap();
    let message = said(&refused.stderr);
    assert!(message.contains("not a runtime table; export one"), "{message}");
    assert_eq!(refused.status.code(), Some(1));
}

/// Options of valgrind: a fault or a leak ends the program with [`FAULT`].
const VALGRIND: [&str; 3] = ["--quiet", "--error-exitcode=9", "--leak-check=full"];
const FAULT: i32 = 9;

/// No access outside an object, no use of a value that nobody set, no leak.
#[test]
fn valgrind_finds_nothing_in_the_example_in_c() {
    let folder = tempfile::tempdir().unwrap();
    let Some(program) = compile("c/render.c", &library(".a"), folder.path()) else { return };
    if let Err(error) = Command::new("valgrind").arg("--version").output() {
        println!("skipped: valgrind is not available ({error})");
        return;
    }
    let [exported, ..] = Exported::three();
    let mut valgrind = Command::new("valgrind");
    valgrind.args(VALGRIND).arg(program);
    let (output, bytes) = run(&mut valgrind, &exported.table, folder.path());
    assert_eq!(output.status.code(), Some(0), "{}", String::from_utf8_lossy(&output.stderr));
    assert_eq!(bytes.unwrap().len(), WAV_HEAD + 4 * expected(&exported).len());
}

/// Negative control: the same options find each kind of fault, and nothing in a program without one. What is read decides the
/// result, because valgrind leaves out a read that nothing depends on.
#[test]
fn valgrind_would_find_a_fault() {
    let folder = tempfile::tempdir().unwrap();
    let (source, program) = (folder.path().join("fault.c"), folder.path().join("fault"));
    for (body, expected) in [
        ("p[1] = 1; free((void *)p); return p[1] == 7;", FAULT),
        ("p[4] = 1; free((void *)p); return 0;", FAULT),
        ("int n = 0; if (p[1] == 7) n = 2; free((void *)p); return n;", FAULT),
        ("p[0] = 1; p = 0; return p != 0;", FAULT),
        ("p[0] = 1; free((void *)p); return 0;", 0),
    ] {
        let code =
            format!("#include <stdlib.h>\nint main(void) {{ volatile char *p = malloc(4); {body} }}\n");
        std::fs::write(&source, code).unwrap();
        let compiled = Command::new("cc").arg("-O0").arg(&source).arg("-o").arg(&program).output();
        if compiled.is_err() || Command::new("valgrind").arg("--version").output().is_err() {
            println!("skipped: cc or valgrind is not available");
            return;
        }
        let output = Command::new("valgrind").args(VALGRIND).arg(&program).output().unwrap();
        let said = String::from_utf8_lossy(&output.stderr);
        assert_eq!(output.status.code(), Some(expected), "{body}: {said}");
    }
}
