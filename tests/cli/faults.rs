//! Commands that write files, under faults of the disk: the kernel refuses or kills at a chosen step of writing.
//!
//! The real program runs under a filter of system calls. Whatever fails, and whenever it is killed: no file is torn, an
//! error is one line that names the file, no temporary file stays after an error, and the next run succeeds.
//!
//! `SHAGREEN_FAULTS` is the number of faults to inject; `scripts/faults` sets it.

use std::ffi::OsString;
use std::os::unix::process::{CommandExt as _, ExitStatusExt as _};
use std::path::Path;
use std::process::{Command, Output, Stdio};
use std::time::Duration;

use rustix::process::{Resource, Rlimit, setrlimit};
use shagreen_core::maths::rng::Random;

use crate::disk_faults::{Act, EIO, ENOSPC, STEPS, Step, inject};
use crate::support::Bench;

/// Environment variable with the fault under which the launcher runs the program.
const FAULT: &str = "SHAGREEN_CLI_FAULT";
/// Environment variable with the number of faults to inject.
const COUNT: &str = "SHAGREEN_FAULTS";
const USUAL_COUNT: usize = 40;
const SIGKILL: i32 = 9;
const SIGSYS: i32 = 31;

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Fault {
    /// The step returns this error number.
    Fails(Step, u32),
    /// The kernel ends the program at this step.
    Killed(Step),
    /// A file can hold this number of bytes; the write beyond it fails.
    Full(u64),
    /// The program is killed after this number of microseconds.
    KilledAfter(u64),
    /// None, to show what the test would miss.
    None,
}

impl Fault {
    fn random(random: &mut Random) -> Self {
        let step = STEPS[random.below(STEPS.len())];
        match random.below(5) {
            0 => Self::Fails(step, if random.below(2) == 0 { EIO } else { ENOSPC }),
            1 => Self::Killed(step),
            2 => Self::Full(1 + random.next_u64() % 3000),
            // The commands take some 20 to 200 ms.
            _ => Self::KilledAfter(random.next_u64() % 150_000),
        }
    }

    fn kills(self) -> bool {
        matches!(self, Self::Killed(_) | Self::KilledAfter(_))
    }

    fn to_text(self) -> String {
        match self {
            Self::Fails(step, errno) => format!("{} {errno}", step as usize),
            Self::Killed(step) => format!("{} 0", step as usize),
            Self::Full(bytes) => format!("full {bytes}"),
            Self::KilledAfter(_) | Self::None => "none 0".to_owned(),
        }
    }
}

/// Does nothing in the test run itself; started as the launcher, it becomes the program under the fault.
#[test]
fn launcher() {
    let Ok(fault) = std::env::var(FAULT) else { return };
    let (kind, number) = fault.split_once(' ').unwrap();
    let number: u64 = number.parse().unwrap();
    match kind {
        "full" => {
            setrlimit(Resource::Fsize, Rlimit { current: Some(number), maximum: Some(number) }).unwrap();
        }
        "none" => {}
        step => {
            let step = STEPS[step.parse::<usize>().unwrap()];
            inject(step, if number == 0 { Act::Kill } else { Act::Fail(u32::try_from(number).unwrap()) });
        }
    }
    let arguments: Vec<OsString> =
        std::env::var("SHAGREEN_CLI_ARGUMENTS").unwrap().split(' ').map(OsString::from).collect();
    // The shell lets the program see the error of a full file; otherwise the kernel would end it.
    let failed = Command::new("sh")
        .args(["-c", "trap '' XFSZ; exec \"$0\" \"$@\"", env!("CARGO_BIN_EXE_shagreen")])
        .args(arguments)
        .env_remove(FAULT)
        .exec();
    panic!("{failed}");
}

/// Runs the program in the folder of the bench under a fault.
fn run(bench: &Bench, arguments: &str, fault: Fault) -> Output {
    let mut child = Command::new(std::env::current_exe().unwrap())
        .args(["faults::launcher", "--exact", "--nocapture", "--quiet"])
        .env(FAULT, fault.to_text())
        .env("SHAGREEN_CLI_ARGUMENTS", arguments)
        .env("XDG_DATA_HOME", bench.path("data"))
        .current_dir(bench.path("."))
        .stdin(Stdio::null())
        .stdout(Stdio::piped())
        .stderr(Stdio::piped())
        .spawn()
        .unwrap();
    if let Fault::KilledAfter(micros) = fault {
        std::thread::sleep(Duration::from_micros(micros));
        child.kill().unwrap();
    }
    child.wait_with_output().unwrap()
}

/// Command that writes files.
struct Case {
    /// Arguments; `{}` stands for what makes the content differ.
    arguments: &'static str,
    /// The old and the new content.
    variants: [&'static str; 2],
    files: &'static [&'static str],
}

const CASES: [Case; 8] = [
    Case {
        arguments: "render --at 30,70 --speed 100 --force 1 --seconds 0.2 --seed {} -o a.wav",
        variants: ["1", "2"],
        files: &["a.wav", "a.json"],
    },
    Case {
        arguments: "space panel --participants {} --sorting s.csv --ratings r.csv",
        variants: ["3", "4"],
        files: &["s.csv", "r.csv"],
    },
    Case {
        arguments: "codec encode in.wav --kbps {} -o a.shgc",
        variants: ["3.15", "1.75"],
        files: &["a.shgc"],
    },
    Case {
        arguments: "import recording in.wav --order {} --replace --out b.json",
        variants: ["4", "6"],
        files: &["b.json"],
    },
    Case {
        arguments: "export --texture cork --format hatt --replace -o cork.xml",
        variants: ["", ""],
        files: &["cork.xml"],
    },
    Case { arguments: "spatial make gaps --seed {} -o gaps.csv", variants: ["1", "2"], files: &["gaps.csv"] },
    Case {
        arguments: "actuator acf haptuator-mark-ii --full-scale-volts {} -o a.acf",
        variants: ["1", "2"],
        files: &["a.acf"],
    },
    Case {
        arguments: "study run abx.toml --simulated 2 --seed {} --out . --replace",
        variants: ["1", "2"],
        files: &["simulated-01.jsonl", "simulated-02.jsonl"],
    },
];

/// Contents of the files of a case after a run without faults.
fn contents(bench: &Bench, case: &Case) -> Vec<Vec<u8>> {
    case.files.iter().map(|file| std::fs::read(bench.path(file)).unwrap()).collect()
}

fn command(case: &Case, variant: usize) -> String {
    case.arguments.replace("{}", case.variants[variant])
}

/// A folder with the input of all commands.
fn bench() -> Bench {
    let bench = Bench::new();
    for input in
        ["render --texture cork --speed 100 --force 1 --seconds 1 -o in.wav", "study new abx --out abx.toml"]
    {
        let said = bench.run(input);
        assert_eq!(said.code, 0, "{said:?}");
    }
    bench
}

fn hidden(folder: &Path) -> Vec<String> {
    let entries = std::fs::read_dir(folder).unwrap();
    let names = entries.map(|entry| entry.unwrap().file_name().into_string().unwrap());
    names.filter(|name| name.starts_with('.')).collect()
}

/// Injects one fault while a case replaces its old files with new ones. Returns whether the new files came.
fn replace_under(bench: &Bench, case: &Case, contents: &[Vec<Vec<u8>>; 2], fault: Fault) -> bool {
    let what = format!("{} under {fault:?}", command(case, 1));
    for (file, old) in case.files.iter().zip(&contents[0]) {
        bench.write(file, old);
    }
    let output = run(bench, &command(case, 1), fault);
    let errors = String::from_utf8_lossy(&output.stderr).into_owned();
    let mut n_new = 0;
    for (index, file) in case.files.iter().enumerate() {
        let found = std::fs::read(bench.path(file)).unwrap();
        let is_new = found == contents[1][index];
        assert!(is_new || found == contents[0][index], "{what}: {file} is torn");
        n_new += usize::from(is_new);
    }
    let all_new = n_new == case.files.len();
    let is_same = contents[0] == contents[1];
    if output.status.success() {
        assert!(all_new, "{what}: success, but the file is old");
        assert!(hidden(&bench.path(".")).is_empty(), "{what}: {:?}", hidden(&bench.path(".")));
    } else if let Some(signal) = output.status.signal() {
        assert!(fault.kills() && [SIGKILL, SIGSYS].contains(&signal), "{what}: signal {signal}");
        for left in hidden(&bench.path(".")) {
            std::fs::remove_file(bench.path(&left)).unwrap();
        }
    } else {
        assert!(!fault.kills(), "{what}: {errors}");
        assert_eq!(output.status.code(), Some(1), "{what}: {errors}");
        assert!(n_new == 0 || is_same, "{what}: failed, and {n_new} files are new");
        let lines: Vec<&str> = errors.lines().filter(|line| line.starts_with("error: ")).collect();
        assert_eq!(lines.len(), 1, "{what}: {errors}");
        assert!(case.files.iter().any(|file| lines[0].contains(file)), "{what}: {}", lines[0]);
        assert!(!lines[0].contains(".shagreen-"), "{what} names a temporary file: {}", lines[0]);
        assert!(hidden(&bench.path(".")).is_empty(), "{what}: {:?}", hidden(&bench.path(".")));
    }
    output.status.success()
}

#[test]
fn no_fault_of_the_disk_tears_a_file() {
    let count = std::env::var(COUNT).map_or(USUAL_COUNT, |count| count.parse().unwrap());
    let bench = bench();
    let contents = CASES.each_ref().map(|case| {
        [0, 1].map(|variant| {
            let said = bench.run(&command(case, variant));
            assert_eq!(said.code, 0, "{said:?}");
            contents(&bench, case)
        })
    });
    let mut random = Random::new(11);
    let (mut failed, mut killed, mut done) = (0, 0, 0);
    for index in 0..count {
        let n = index % CASES.len();
        // Each step fails once for some case before the faults are random.
        let fault = match index {
            0..4 => Fault::Fails(STEPS[index], ENOSPC),
            4..8 => Fault::Killed(STEPS[index - 4]),
            8..12 => Fault::Fails(STEPS[index - 8], EIO),
            _ => Fault::random(&mut random),
        };
        match (replace_under(&bench, &CASES[n], &contents[n], fault), fault.kills()) {
            (true, _) => done += 1,
            (false, true) => killed += 1,
            (false, false) => failed += 1,
        }
    }
    println!(
        "{count} faults: {failed} commands failed, {killed} were killed, {done} were done before or without it"
    );
    // The faults must reach the program.
    assert!(failed >= count / 5 && killed >= count / 10, "{failed} {killed} {done}");
    for (n, case) in CASES.iter().enumerate() {
        assert!(
            replace_under(&bench, case, &contents[n], Fault::None),
            "{} fails after faults",
            case.arguments
        );
    }
}
