//! Faults of the disk, injected by the kernel: a filter of system calls lets a step of writing a file fail or kill.

use seccompiler::SeccompCmpArgLen::{Dword, Qword};
use seccompiler::SeccompCmpOp::{Gt, MaskedEq};
use seccompiler::{BpfProgram, SeccompAction, SeccompCondition, SeccompFilter, SeccompRule, apply_filter};

/// Error number of an input or output error.
pub(crate) const EIO: u32 = 5;
/// Error number of a full disk.
pub(crate) const ENOSPC: u32 = 28;
/// Flag of opening that creates a file.
const O_CREAT: u64 = 0o100;
/// Largest write, in bytes, that is not one of file content: wake-ups between threads.
const WAKE_UP_BYTES: u64 = 8;

/// Step of writing a file.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Step {
    Create,
    Write,
    Sync,
    Rename,
}

pub(crate) const STEPS: [Step; 4] = [Step::Create, Step::Write, Step::Sync, Step::Rename];

/// What the kernel does at a step.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[allow(dead_code, reason = "each test program uses a part of this module")]
pub(crate) enum Act {
    /// The step returns this error number.
    Fail(u32),
    /// The program ends.
    Kill,
}

/// From now on, this thread and all that it starts meet the fault at the step. There is no way back.
pub(crate) fn inject(step: Step, act: Act) {
    let condition = |argument, length, operation, value| {
        SeccompCondition::new(argument, length, operation, value).unwrap()
    };
    let when = |conditions| vec![SeccompRule::new(conditions).unwrap()];
    let always = Vec::new;
    // System calls of x86-64.
    let rules = match step {
        Step::Create => vec![(257, when(vec![condition(2, Dword, MaskedEq(O_CREAT), O_CREAT)]))],
        // Standard output and error are 1 and 2.
        Step::Write => {
            vec![(1, when(vec![condition(0, Dword, Gt, 2), condition(2, Qword, Gt, WAKE_UP_BYTES)]))]
        }
        Step::Sync => vec![(74, always()), (75, always())],
        Step::Rename => vec![(82, always()), (264, always()), (316, always())],
    };
    let action = match act {
        Act::Fail(errno) => SeccompAction::Errno(errno),
        Act::Kill => SeccompAction::KillProcess,
    };
    let arch = std::env::consts::ARCH.try_into().unwrap();
    let filter = SeccompFilter::new(rules.into_iter().collect(), SeccompAction::Allow, action, arch).unwrap();
    let program: BpfProgram = filter.try_into().unwrap();
    apply_filter(&program).unwrap();
}
