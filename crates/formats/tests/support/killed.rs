//! A test program that starts itself, with one of its tests as another process, to kill it.

use std::env;
use std::process::{Child, Command, Stdio};
use std::thread;
use std::time::Duration;

/// This program with one test alone. Its output is read by the caller.
pub(crate) fn itself(test: &str) -> Command {
    let mut command = Command::new(env::current_exe().unwrap());
    command.args([test, "--exact", "--nocapture"]).stdout(Stdio::piped()).stderr(Stdio::null());
    command
}

/// Kills a process after `micros` microseconds. SIGKILL stops it at once.
pub(crate) fn kill_after(mut child: Child, micros: u64) {
    thread::sleep(Duration::from_micros(micros));
    child.kill().unwrap();
    child.wait().unwrap();
}
