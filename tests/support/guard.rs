//! Helpers of the end-to-end tests: child processes that end with their test, and tools that may be missing.

use std::process::{Child, Command, Stdio};

/// Child process that is killed when dropped.
pub(crate) struct Guard(pub Child);

impl Drop for Guard {
    fn drop(&mut self) {
        // The process may already have ended.
        let _ = self.0.kill();
        let _ = self.0.wait();
    }
}

/// Returns whether every tool is installed. If one is missing, the test prints this and is skipped. `./test` installs
/// the tools and sets `SHAGREEN_TEST_ALL`; a missing tool is then a failure.
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
        "missing: {missing:?}; install with `scripts/linux-packages test`"
    );
    println!("skipped: {missing:?} not found");
    false
}
