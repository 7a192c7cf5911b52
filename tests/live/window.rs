//! The real program in a window on a virtual display, with a real pointer. Screenshots are stored in
//! `target/screenshots`.
#![cfg(target_os = "linux")]

use std::io::{BufRead, BufReader};
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};
use std::time::{Duration, Instant};

use crate::guard::{Guard, have};
use image::RgbImage;

/// Color of the authored point in the dark theme: `shagreen_app::theme::DARK.accent`.
const ACCENT: [u8; 3] = [0x5F, 0xC9, 0xB0];

/// Pause between actions of the pointer.
const PAUSE: Duration = Duration::from_millis(400);

struct Display {
    name: String,
    runtime: tempfile::TempDir,
    shots: PathBuf,
    _server: Guard,
}

impl Display {
    fn new() -> Self {
        let mut server = Command::new("Xvfb")
            .args(["-displayfd", "1", "-screen", "0", "1280x720x24", "-nolisten", "tcp", "+extension", "GLX"])
            .stdout(Stdio::piped())
            .stderr(Stdio::null())
            .spawn()
            .unwrap();
        let mut number = String::new();
        BufReader::new(server.stdout.take().unwrap()).read_line(&mut number).unwrap();
        let shots = Path::new(env!("CARGO_MANIFEST_DIR")).join("target/screenshots");
        std::fs::create_dir_all(&shots).unwrap();
        let name = format!(":{}", number.trim());
        let runtime = tempfile::tempdir().unwrap();
        // The tour was seen already; otherwise it would cover the window.
        std::fs::create_dir_all(runtime.path().join("config/shagreen")).unwrap();
        std::fs::write(runtime.path().join("config/shagreen/settings.json"), r#"{"has_seen_tour": true}"#)
            .unwrap();
        Self { name, runtime, shots, _server: Guard(server) }
    }

    fn command(&self, program: &str) -> Command {
        let mut command = Command::new(program);
        command
            .env("DISPLAY", &self.name)
            .env("XDG_RUNTIME_DIR", self.runtime.path())
            .env("XDG_STATE_HOME", self.runtime.path().join("state"))
            .env("XDG_CONFIG_HOME", self.runtime.path().join("config"))
            .env_remove("WAYLAND_DISPLAY");
        command
    }

    fn xdotool(&self, words: &[&str]) {
        assert!(self.command("xdotool").args(words).status().unwrap().success(), "xdotool {words:?}");
    }

    fn shot(&self, name: &str) -> RgbImage {
        let path = self.shots.join(format!("{name}.png"));
        assert!(self.command("import").args(["-window", "root"]).arg(&path).status().unwrap().success());
        image::open(&path).unwrap().to_rgb8()
    }

    /// Takes screenshots until one satisfies a condition, for at most one minute.
    #[track_caller]
    fn wait_for(&self, name: &str, what: &str, is_right: impl Fn(&RgbImage) -> bool) -> RgbImage {
        let start = Instant::now();
        loop {
            let shot = self.shot(name);
            if is_right(&shot) {
                return shot;
            }
            assert!(start.elapsed() < Duration::from_mins(1), "timed out: {what}; see {name}.png");
            std::thread::sleep(Duration::from_millis(200));
        }
    }

    /// Presses, moves and releases with pauses, so that a window with a few frames per second registers each event.
    fn drag(&self, from: (u32, u32), to: (u32, u32)) {
        let at = |share: f64, a: u32, b: u32| (f64::from(a) + share * (f64::from(b) - f64::from(a))) as i64;
        self.xdotool(&["mousemove", &from.0.to_string(), &from.1.to_string()]);
        std::thread::sleep(PAUSE);
        self.xdotool(&["mousedown", "1"]);
        std::thread::sleep(PAUSE);
        for i in 1..=10 {
            let share = f64::from(i) / 10.0;
            let (x, y) = (at(share, from.0, to.0), at(share, from.1, to.1));
            self.xdotool(&["mousemove", &x.to_string(), &y.to_string()]);
            std::thread::sleep(Duration::from_millis(30));
        }
        std::thread::sleep(PAUSE);
        self.xdotool(&["mouseup", "1"]);
        std::thread::sleep(PAUSE);
        self.xdotool(&["mousemove", "1278", "470"]);
    }

    /// Presses keys in the window, which needs the focus first: there is no window manager.
    fn key(&self, keys: &str) {
        self.xdotool(&["search", "--name", "^Shagreen$", "windowfocus"]);
        std::thread::sleep(PAUSE);
        self.xdotool(&["key", keys]);
    }

    fn click(&self, at: (u32, u32)) {
        self.xdotool(&["mousemove", &at.0.to_string(), &at.1.to_string()]);
        std::thread::sleep(PAUSE);
        self.xdotool(&["click", "1"]);
        std::thread::sleep(PAUSE);
        self.xdotool(&["mousemove", "1278", "470"]);
    }
}

fn is_accent(pixel: image::Rgb<u8>) -> bool {
    pixel.0.iter().zip(ACCENT).all(|(a, b)| a.abs_diff(b) < 12)
}

/// Returns the position of the authored point: the center of the accent pixels between the columns of textures and
/// sliders, above the pad.
fn point(shot: &RgbImage) -> Option<(u32, u32)> {
    let inside = |x: u32, y: u32| (220..980).contains(&x) && (45..470).contains(&y);
    let found: Vec<(u32, u32)> = shot
        .enumerate_pixels()
        .filter(|(x, y, p)| inside(*x, *y) && is_accent(**p))
        .map(|(x, y, _)| (x, y))
        .collect();
    let n = found.len() as u32;
    (n > 100)
        .then(|| (found.iter().map(|p| p.0).sum::<u32>() / n, found.iter().map(|p| p.1).sum::<u32>() / n))
}

/// Returns the number of rows of the waveform with accent pixels.
fn waveform_height(shot: &RgbImage) -> usize {
    (510..670).filter(|y| (486..795).any(|x| is_accent(*shot.get_pixel(x, *y)))).count()
}

#[test]
fn the_program_opens_and_its_point_follows_a_real_pointer() {
    if !have(&["Xvfb", "xdotool", "import"]) {
        return;
    }
    let display = Display::new();
    let program = display
        .command(env!("CARGO_BIN_EXE_shagreen"))
        .args(["--output", "null"])
        .stderr(Stdio::null())
        .spawn()
        .unwrap();
    let _program = Guard(program);
    let opened = display.wait_for("author-opened", "the window", |shot| point(shot).is_some());
    let from = point(&opened).unwrap();
    assert!(waveform_height(&opened) < 10, "no signal is played yet");

    // Drag the point towards rough and soft.
    let to = (from.0 - 150, from.1 - 60);
    display.drag(from, to);
    let near = |a: (u32, u32)| a.0.abs_diff(to.0) < 12 && a.1.abs_diff(to.1) < 12;
    display.wait_for("author-dragged", "the point follows", |shot| point(shot).is_some_and(near));

    // Start the automatic stroke with a click on its button.
    display.click((36, 495));
    display.wait_for("author-stroking", "the waveform moves", |shot| waveform_height(shot) > 30);
}

/// Returns the coordinate of the first authored texture of a project file on the first axis.
fn place_in(path: &Path) -> Option<f64> {
    let value: serde_json::Value = serde_json::from_slice(&std::fs::read(path).ok()?).ok()?;
    value["authored"][0]["rough_smooth"].as_f64()
}

/// Waits at most one minute until `found` returns a value, and returns it with the elapsed time.
#[track_caller]
fn wait_until<T>(what: &str, found: impl Fn() -> Option<T>) -> (T, Duration) {
    let start = Instant::now();
    loop {
        if let Some(found) = found() {
            return (found, start.elapsed());
        }
        assert!(start.elapsed() < Duration::from_mins(1), "timed out: {what}");
        std::thread::sleep(Duration::from_millis(50));
    }
}

/// Adds a texture to the project at `path`, far from the first.
fn author_another(path: &Path) {
    let mut project: serde_json::Value = serde_json::from_slice(&std::fs::read(path).unwrap()).unwrap();
    let mut other = project["authored"][0].clone();
    (other["key"], other["name"]) = (9.into(), "Other".into());
    (other["rough_smooth"], other["hard_soft"]) = (15.into(), 85.into());
    project["authored"].as_array_mut().unwrap().push(other);
    std::fs::write(path, project.to_string()).unwrap();
}

/// Returns the part of the screenshot that lists the neighbors.
fn neighbors(shot: &RgbImage) -> RgbImage {
    image::imageops::crop_imm(shot, 1000, 300, 270, 170).to_image()
}

/// Open, drag, compare, save, drag again, kill and reopen the program: the second drag is recovered.
#[test]
fn a_killed_program_gives_back_what_was_not_saved() {
    if !have(&["Xvfb", "xdotool", "import"]) {
        return;
    }
    let display = Display::new();
    let path = display.runtime.path().join("Woods.shagreen");
    let program = env!("CARGO_BIN_EXE_shagreen");
    let made = Command::new(program).args(["project", "new", "-o"]).arg(&path).output().unwrap();
    assert!(made.status.success());
    author_another(&path);
    let open = || {
        let mut command = display.command(program);
        Guard(command.args(["--output", "null"]).arg(&path).stderr(Stdio::null()).spawn().unwrap())
    };
    let mut window = open();
    let opened = display.wait_for("project-opened", "the window", |shot| point(shot).is_some());
    let from = point(&opened).unwrap();
    let near = |to: (u32, u32)| {
        move |shot: &RgbImage| {
            point(shot).is_some_and(|at| at.0.abs_diff(to.0) < 12 && at.1.abs_diff(to.1) < 12)
        }
    };
    let saved_at = (from.0 - 120, from.1 - 40);
    display.drag(from, saved_at);
    let dragged = display.wait_for("project-dragged", "the point follows", near(saved_at));
    let of_first = neighbors(&dragged);
    display.key("2");
    display.wait_for("project-compared", "B has other neighbors", |shot| neighbors(shot) != of_first);
    display.key("2");
    display.wait_for("project-chosen", "the selected one again", |shot| neighbors(shot) == of_first);
    display.key("ctrl+s");
    let (saved, _) = wait_until("it is saved", || place_in(&path).filter(|at| (at - 50.0).abs() > 5.0));

    let last = (from.0 + 120, from.1 - 20);
    display.drag(saved_at, last);
    let recovery = display.runtime.path().join("state/shagreen/recovery");
    let kept = || {
        let entries = std::fs::read_dir(&recovery).ok()?.filter_map(|entry| Some(entry.ok()?.path()));
        let mut projects = entries.filter(|path| path.extension().is_some_and(|e| e == "shagreen"));
        projects.find_map(|path| place_in(&path)).filter(|at| *at > saved + 5.0)
    };
    let begun = Instant::now();
    let (mut last_kept, mut took) = wait_until("the recovery file is written", kept);
    // That can be in the middle of the drag: the state that stays for longer than the program's interval is the last.
    while begun.elapsed() < took + Duration::from_secs(6) {
        if let Some(at) = kept().filter(|at| *at != last_kept) {
            (last_kept, took) = (at, begun.elapsed());
        }
        std::thread::sleep(Duration::from_millis(100));
    }
    let kept = last_kept;
    println!("the unsaved state was on disk {:.1} s after the drag", took.as_secs_f64());
    assert!(took < Duration::from_secs(10));
    window.0.kill().unwrap();
    window.0.wait().unwrap();
    assert_eq!(place_in(&path), Some(saved), "the file is as it was saved");

    let _window = open();
    // The recovery dialog covers the canvas; its first button has the focus.
    std::thread::sleep(Duration::from_secs(4));
    display.shot("project-recovery");
    display.key("Return");
    display.wait_for("project-recovered", "the point is where it was", near(last));
    display.key("ctrl+s");
    wait_until("it is saved", || place_in(&path).filter(|at| (at - kept).abs() < 1e-9));
}

#[test]
fn without_a_display_it_says_so_and_names_the_commands() {
    let output = Command::new(env!("CARGO_BIN_EXE_shagreen"))
        .env_remove("DISPLAY")
        .env_remove("WAYLAND_DISPLAY")
        .output()
        .unwrap();
    let message = String::from_utf8(output.stderr).unwrap();
    assert_eq!(output.status.code(), Some(1));
    assert!(message.contains("no display") && message.contains("--help"), "{message}");
    assert_eq!(message.trim().lines().count(), 1);
}
