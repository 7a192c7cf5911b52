//! A sound server for one test, with null sinks that are recorded.

#![allow(dead_code, reason = "each test uses a part of this module")]

use std::io::Read as _;
use std::path::Path;
use std::process::{Child, Command, Stdio};
use std::time::{Duration, Instant};

use crate::guard::Guard;

/// Sample rate of the sinks, in Hz.
pub(crate) const RATE_HZ: f64 = 48_000.0;
/// Number of bytes per recorded frame.
const FRAME_BYTES: usize = 8;

/// Sound server with two null sinks: `ci`, the default, and `other`.
pub(crate) struct SoundServer {
    folder: tempfile::TempDir,
    daemon: Guard,
}

impl SoundServer {
    pub(crate) fn new() -> Self {
        let folder = tempfile::tempdir().unwrap();
        let d = folder.path();
        for name in ["run", "state"] {
            std::fs::create_dir(d.join(name)).unwrap();
        }
        let write = |name: &str, text: String| std::fs::write(d.join(name), text).unwrap();
        write(
            "daemon.conf",
            "default-sample-format = float32le\ndefault-sample-rate = 48000\navoid-resampling = yes\n\
             flat-volumes = no\nenable-shm = no\n"
                .to_owned(),
        );
        // Without norewinds the null sink runs up to two seconds ahead and every stream stalls at its start.
        write(
            "pulse.pa",
            format!(
                ".fail\nload-module module-null-sink sink_name=ci rate=48000 channels=2 format=float32le norewinds=1\n\
                 load-module module-null-sink sink_name=other rate=48000 channels=2 format=float32le norewinds=1\n\
                 load-module module-native-protocol-unix auth-anonymous=1 socket={}/native\n\
                 set-default-sink ci\nset-default-source ci.monitor\n",
                d.display()
            ),
        );
        write(
            "asound.conf",
            "</usr/share/alsa/alsa.conf>\npcm.!default { type pulse }\nctl.!default { type pulse }\n\
             pcm.pulse { type pulse }\n"
                .to_owned(),
        );
        let daemon = with_server(Command::new("pulseaudio"), d)
            .args(["-n", "-F"])
            .arg(d.join("pulse.pa"))
            .args(["--daemonize=no", "--exit-idle-time=-1", "--disallow-exit", "--use-pid-file=no"])
            .args(["--log-target=stderr", "--high-priority=no", "--realtime=no"])
            .stderr(Stdio::null())
            .spawn()
            .unwrap();
        let server = Self { folder, daemon: Guard(daemon) };
        let start = Instant::now();
        while !server.command("pactl").arg("info").output().unwrap().status.success() {
            assert!(start.elapsed() < Duration::from_secs(20), "the sound server does not answer");
            std::thread::sleep(Duration::from_millis(100));
        }
        put_first(&server.daemon.0);
        server
    }

    pub(crate) fn command(&self, program: &str) -> Command {
        with_server(Command::new(program), self.folder.path())
    }

    /// Records both channels of sink `ci` while `during` runs. Samples are those of the device, -1..1.
    pub(crate) fn record(&self, during: impl FnOnce(&Self)) -> Vec<[f64; 2]> {
        self.record_of("ci", during).frames
    }

    /// Records any sink, with its start time. The recording ends if its sink is removed.
    pub(crate) fn record_of(&self, sink: &str, during: impl FnOnce(&Self)) -> Recording {
        let mut recorder = self
            .command("parec")
            .args([
                "-d",
                &format!("{sink}.monitor"),
                "--format=float32le",
                "--rate=48000",
                "--channels=2",
                "--raw",
            ])
            .arg("--latency-msec=20")
            .stdout(Stdio::piped())
            .spawn()
            .unwrap();
        let mut recorded = recorder.stdout.take().unwrap();
        let recorder = Guard(recorder);
        let reader = std::thread::spawn(move || {
            let (mut bytes, mut begun) = (Vec::new(), None::<Instant>);
            let mut part = vec![0; 1 << 16];
            while let Ok(n) = recorded.read(&mut part)
                && n > 0
            {
                bytes.extend_from_slice(&part[..n]);
                // The data with the shortest delay give the best estimate of the start.
                let frames_secs = (bytes.len() / FRAME_BYTES) as f64 / RATE_HZ;
                let first = Instant::now().checked_sub(Duration::from_secs_f64(frames_secs)).unwrap();
                begun = Some(begun.map_or(first, |begun| begun.min(first)));
            }
            (bytes, begun)
        });
        std::thread::sleep(Duration::from_millis(700));
        during(self);
        std::thread::sleep(Duration::from_millis(700));
        drop(recorder);
        let (bytes, begun) = reader.join().unwrap();
        let float = |b: &[u8]| f64::from(f32::from_le_bytes([b[0], b[1], b[2], b[3]]));
        let frames = bytes.chunks_exact(FRAME_BYTES).map(|b| [float(&b[..4]), float(&b[4..])]).collect();
        Recording { frames, begun: begun.unwrap() }
    }
}

/// Recorded signal of a sink.
pub(crate) struct Recording {
    /// Both channels, as samples of the device, -1..1.
    pub(crate) frames: Vec<[f64; 2]>,
    /// Time of the first frame, at most some milliseconds late.
    pub(crate) begun: Instant,
}

/// Gives a process real-time priority, where the system allows it: a desktop's sound server has it too, and other tests
/// must not delay it.
fn put_first(process: &Child) {
    let first = ["--all-tasks", "--rr", "--pid", "20"];
    // Without `chrt`, or without the permission, the server runs at normal priority.
    Command::new("chrt").args(first).arg(process.id().to_string()).stderr(Stdio::null()).status().ok();
}

fn with_server(mut command: Command, d: &Path) -> Command {
    command
        .env("XDG_RUNTIME_DIR", d.join("run"))
        .env("PULSE_RUNTIME_PATH", d.join("run/pulse"))
        .env("PULSE_STATE_PATH", d.join("state"))
        .env("PULSE_COOKIE", d.join("cookie"))
        .env("PULSE_SERVER", format!("unix:{}/native", d.display()))
        .env("PULSE_CONFIG", d.join("daemon.conf"))
        .env("ALSA_CONFIG_PATH", d.join("asound.conf"));
    command
}

pub(crate) fn shagreen(server: &SoundServer, words: &[&str]) -> serde_json::Value {
    let output = server.command(env!("CARGO_BIN_EXE_shagreen")).args(words).arg("--json").output().unwrap();
    assert!(output.status.success(), "{words:?}: {}", String::from_utf8_lossy(&output.stderr));
    serde_json::from_slice(&output.stdout).unwrap()
}
