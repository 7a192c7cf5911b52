//! Claims on outputs: at most one Shagreen plays on an output, across all processes of a user.
//!
//! The limiter bounds what one engine sends. Two engines on one output would add up to twice its ceiling.
//!
//! A claim is an advisory lock on a file named after the output. The system releases the lock when the process ends in
//! any way. A process that takes the output over writes a request file next to the lock file. The owner then goes
//! silent and releases the lock.

use std::fs::{self, File, OpenOptions, TryLockError};
use std::io;
use std::path::PathBuf;
use std::sync::Arc;
use std::sync::mpsc::{RecvTimeoutError, Sender, channel};
use std::thread::JoinHandle;
use std::time::{Duration, Instant};

use crate::error::{DeviceError, DeviceErrorKind};
use crate::link::Shared;

/// Interval at which the owner checks for a request, and the other process for the release of the lock.
const POLL: Duration = Duration::from_millis(50);
/// Time that an owner has to close the device after it was silenced.
const PATIENCE_WITH_OWNER: Duration = Duration::from_secs(3);
/// Time that an owner has to release the output.
const PATIENCE: Duration = Duration::from_secs(5);

/// Exclusive right to an output.
#[derive(Debug)]
pub(crate) struct Claim {
    lock: File,
    request: PathBuf,
}

impl Claim {
    /// Claims output `id`. With `take_over`, an owner is asked to release it first.
    ///
    /// `None` if this system has no place for the lock, for example because its temporary folder is read-only.
    ///
    /// # Errors
    /// [`DeviceErrorKind::Claimed`] if another Shagreen plays on the output, or does not release it.
    pub(crate) fn new(id: &str, take_over: bool) -> Result<Option<Self>, DeviceError> {
        Self::in_folder(&folder(), id, take_over)
    }

    fn in_folder(folder: &std::path::Path, id: &str, take_over: bool) -> Result<Option<Self>, DeviceError> {
        let name = file_stem(id);
        let [lock, request, owner] =
            ["lock", "request", "owner"].map(|kind| folder.join(format!("{name}.{kind}")));
        let Ok(file) = open_in(folder, &lock) else { return Ok(None) };
        let claimed = || {
            let process = fs::read_to_string(&owner).ok().and_then(|text| text.trim().parse::<u32>().ok());
            let process = process.map_or_else(String::new, |process| format!(" (process {process})"));
            let message = if take_over {
                format!("the other Shagreen{process} does not release the output `{id}`; close that Shagreen")
            } else {
                format!(
                    "another Shagreen{process} plays on the output `{id}`; close that Shagreen, or take the output over"
                )
            };
            DeviceError::new(DeviceErrorKind::Claimed, message)
        };
        let begun = Instant::now();
        loop {
            match file.try_lock() {
                Ok(()) => break,
                Err(TryLockError::WouldBlock) if take_over && begun.elapsed() < PATIENCE => {
                    // Written until the lock is released, and then removed.
                    if fs::write(&request, "").is_err() {
                        return Err(claimed());
                    }
                    std::thread::sleep(POLL);
                }
                Err(TryLockError::WouldBlock) => {
                    fs::remove_file(&request).ok(); // There may be none.
                    return Err(claimed());
                }
                Err(TryLockError::Error(_)) => return Ok(None),
            }
        }
        fs::remove_file(&request).ok(); // There may be none.
        fs::write(&owner, std::process::id().to_string()).ok(); // It only completes a message.
        Ok(Some(Self { lock: file, request }))
    }

    /// Keeps the claim until the guard is dropped or another process takes the output over, which marks the output as
    /// lost.
    ///
    /// # Errors
    /// The system cannot start a thread.
    pub(crate) fn guard(self, shared: Arc<Shared>) -> io::Result<ClaimGuard> {
        let (stop, stopped) = channel();
        let watch = move || {
            let Self { lock, request } = self;
            while let Err(RecvTimeoutError::Timeout) = stopped.recv_timeout(POLL) {
                if request.exists() {
                    shared.give_up();
                    // The device is closed before the lock is released, because some can be opened only once. An owner
                    // that does not close it is silent from now on.
                    stopped.recv_timeout(PATIENCE_WITH_OWNER).ok();
                    break;
                }
            }
            drop(lock);
        };
        let thread = std::thread::Builder::new().name("output claim".to_owned()).spawn(watch)?;
        Ok(ClaimGuard { stop: Some(stop), thread: Some(thread) })
    }
}

/// Holds a claim until it is dropped.
#[derive(Debug)]
pub(crate) struct ClaimGuard {
    stop: Option<Sender<()>>,
    thread: Option<JoinHandle<()>>,
}

impl Drop for ClaimGuard {
    fn drop(&mut self) {
        self.stop = None;
        if let Some(thread) = self.thread.take() {
            thread.join().ok(); // It has released the lock in any case.
        }
    }
}

fn open_in(folder: &std::path::Path, lock: &std::path::Path) -> io::Result<File> {
    let mut builder = fs::DirBuilder::new();
    builder.recursive(true);
    #[cfg(unix)]
    std::os::unix::fs::DirBuilderExt::mode(&mut builder, 0o700);
    builder.create(folder)?;
    #[cfg(unix)]
    {
        // In a shared temporary folder, another user could have made it.
        use std::os::unix::fs::PermissionsExt as _;
        let metadata = fs::symlink_metadata(folder)?;
        if !metadata.is_dir() || metadata.permissions().mode() & 0o022 != 0 {
            return Err(io::ErrorKind::PermissionDenied.into());
        }
    }
    OpenOptions::new().create(true).truncate(false).write(true).open(lock)
}

/// Folder of the locks of this user.
fn folder() -> PathBuf {
    if let Some(runtime) = std::env::var_os("XDG_RUNTIME_DIR").filter(|folder| !folder.is_empty()) {
        return PathBuf::from(runtime).join("shagreen-outputs");
    }
    let user = std::env::var("USER").or_else(|_| std::env::var("USERNAME")).unwrap_or_default();
    std::env::temp_dir().join(format!("shagreen-outputs-{}", file_stem(&user)))
}

/// Readable and unique file name of an id: its letters and digits, and a hash (FNV-1a) of the whole id.
fn file_stem(id: &str) -> String {
    let hash = id.bytes().fold(0xcbf2_9ce4_8422_2325_u64, |hash, byte| {
        (hash ^ u64::from(byte)).wrapping_mul(0x0100_0000_01b3)
    });
    let readable: String = id.chars().filter(char::is_ascii_alphanumeric).take(40).collect();
    format!("{readable}-{hash:016x}")
}

#[cfg(test)]
mod tests {
    use super::{Claim, DeviceErrorKind, file_stem};
    use crate::link::link;
    use std::time::Duration;

    #[test]
    fn an_output_has_one_owner_at_a_time() {
        let folder = tempfile::tempdir().unwrap();
        let claim = |id, take_over| Claim::in_folder(folder.path(), id, take_over);
        let first = claim("pulse:a", false).unwrap().unwrap();
        let error = claim("pulse:a", false).unwrap_err();
        assert_eq!(error.kind(), DeviceErrorKind::Claimed);
        let text = error.to_string();
        assert!(
            text.contains(&format!("process {}", std::process::id()))
                && text.contains("take the output over"),
            "{text}"
        );
        // Another output is free.
        assert!(claim("pulse:b", false).unwrap().is_some());
        let (reporter, _monitor) = link();
        drop(first.guard(reporter.shared.clone()).unwrap());
        assert!(claim("pulse:a", false).unwrap().is_some());
        assert!(!reporter.shared.is_lost());
    }

    #[test]
    fn a_newcomer_takes_over_and_the_owner_goes_silent() {
        let folder = tempfile::tempdir().unwrap();
        let claim = |take_over| Claim::in_folder(folder.path(), "x", take_over);
        let (reporter, mut monitor) = link();
        let guard = claim(false).unwrap().unwrap().guard(reporter.shared.clone()).unwrap();
        let second = std::thread::scope(|scope| {
            let second = scope.spawn(|| claim(true).unwrap().unwrap());
            while !reporter.shared.is_lost() {
                std::thread::yield_now();
            }
            assert!(!second.is_finished(), "the owner has not closed its device yet");
            drop(guard);
            second.join().unwrap()
        });
        assert!(reporter.shared.is_lost());
        let loss = monitor.loss().unwrap().to_string();
        assert!(loss.contains("taken over"), "{loss}");
        // The request is gone, so the new owner keeps the output.
        let (reporter, _monitor) = link();
        let _second = second.guard(reporter.shared.clone()).unwrap();
        std::thread::sleep(Duration::from_millis(200));
        assert!(!reporter.shared.is_lost());
        assert!(claim(false).is_err());
    }

    #[test]
    fn names_are_unique_and_safe() {
        assert_ne!(file_stem("alsa:hw:0"), file_stem("alsa:hw0"));
        assert!(file_stem("a/../b\0ä").chars().all(|c| c.is_ascii_alphanumeric() || c == '-'));
        assert!(file_stem(&"x".repeat(9000)).len() < 100);
    }
}
