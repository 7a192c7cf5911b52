//! Helpers of the end-to-end tests: child processes that do not outlive their test, and tools that may be absent.

use std::process::{Child, Command, Stdio};

/// A child process, ended when the test is.
pub(crate) struct Guard(pub Child);

impl Drop for Guard {
    fn drop(&mut self) {
        // It may have ended by itself.
        let _ = self.0.kill();
        let _ = self.0.wait();
    }
}

/// Whether every tool is there. On a machine that lacks one the test says so and skips, but for `./test`, which has
/// installed them and sets `SHAGREEN_TEST_ALL`.
pub(crate) fn have(tools: &[&str]) -> bool {
    let is_there = |tool: &&&str| {
        Command::new("sh")
            .args(["-c", &format!("command -v {tool}")])
            .stdout(Stdio::null())
            .status()
            .is_ok_and(|s| s.success())
    };
    let missing: Vec<_> = tools.iter().filter(|t| !is_there(t)).collect();
    if missing.is_empty() {
        return true;
    }
    assert!(
        std::env::var_os("SHAGREEN_TEST_ALL").is_none(),
        "missing: {missing:?}; scripts/linux-packages test"
    );
    println!("skipped: {missing:?} not found");
    false
}
