//! Bounded write queue of a serial line.

use std::io;
use std::time::Duration;

use crate::serial::frame::MAX_WIRE;

/// Capacity in bytes.
const SIZE: usize = 1024;
/// Age at which unwritten bytes are dropped.
const LONGEST: Duration = Duration::from_millis(20);

/// Frames that wait to be written.
#[derive(Debug)]
pub(super) struct WriteQueue {
    bytes: [u8; SIZE],
    len: usize,
    /// Time since which bytes wait.
    since: Option<Duration>,
    /// Whether the last frame may be incomplete; the next one then starts with a zero byte.
    is_cut: bool,
}

impl WriteQueue {
    /// An empty queue. Its first frame starts with a zero byte, because another program may have left half a frame.
    pub(super) fn new() -> Self {
        Self { bytes: [0; SIZE], len: 0, since: None, is_cut: true }
    }

    /// Whether a frame of any length fits.
    pub(super) fn has_room(&self) -> bool {
        self.len + 1 + MAX_WIRE <= SIZE
    }

    /// Queues a frame if it fits. Returns whether it does.
    pub(super) fn push(&mut self, frame: &[u8]) -> bool {
        if self.len + 1 + frame.len() > SIZE {
            return false;
        }
        if std::mem::take(&mut self.is_cut) {
            self.bytes[self.len] = 0;
            self.len += 1;
        }
        self.bytes[self.len..self.len + frame.len()].copy_from_slice(frame);
        self.len += frame.len();
        true
    }

    /// Discards all queued bytes.
    pub(super) fn clear(&mut self) {
        self.is_cut |= self.len > 0;
        (self.len, self.since) = (0, None);
    }

    /// Writes as many bytes as the line accepts, and discards bytes that have waited too long.
    ///
    /// # Errors
    /// Errors of the line, except that it accepts no bytes now.
    pub(super) fn flush(
        &mut self,
        now: Duration,
        write: &mut dyn FnMut(&[u8]) -> io::Result<usize>,
    ) -> io::Result<()> {
        while self.len > 0 {
            let n = match write(&self.bytes[..self.len]) {
                Ok(n) => n.min(self.len),
                Err(error) if is_no_room(&error) => 0,
                Err(error) => return Err(error),
            };
            if n == 0 {
                break;
            }
            self.bytes.copy_within(n..self.len, 0);
            self.len -= n;
        }
        if self.len == 0 {
            self.since = None;
        } else if now.saturating_sub(*self.since.get_or_insert(now)) > LONGEST {
            self.clear();
        }
        Ok(())
    }
}

/// Whether an I/O error only means that the operation would block.
pub(super) fn is_no_room(error: &io::Error) -> bool {
    use io::ErrorKind::{Interrupted, TimedOut, WouldBlock};
    matches!(error.kind(), Interrupted | TimedOut | WouldBlock)
}

#[cfg(test)]
mod tests {
    use super::{Duration, SIZE, WriteQueue};
    use std::io;

    fn all(outbox: &mut WriteQueue, now_ms: u64, mut n: usize) -> Vec<u8> {
        let mut taken = Vec::new();
        let mut write = |bytes: &[u8]| {
            let now = n.min(bytes.len());
            if now == 0 {
                return Err(io::ErrorKind::WouldBlock.into());
            }
            taken.extend(&bytes[..now]);
            n -= now;
            Ok(now)
        };
        outbox.flush(Duration::from_millis(now_ms), &mut write).unwrap();
        taken
    }

    #[test]
    fn what_is_not_taken_in_time_is_dropped_and_its_rest_is_no_frame() {
        let mut outbox = WriteQueue::new();
        outbox.push(&[1, 2, 3, 0]);
        assert_eq!(all(&mut outbox, 0, 3), [0, 1, 2]);
        outbox.push(&[4, 5, 0]);
        assert!(all(&mut outbox, 10, 0).is_empty());
        assert!(all(&mut outbox, 31, 0).is_empty());
        outbox.push(&[6, 0]);
        assert_eq!(all(&mut outbox, 32, 99), [0, 6, 0]);
        outbox.push(&[7, 0]);
        assert_eq!(all(&mut outbox, 99, 99), [7, 0]);
    }

    #[test]
    fn it_is_bounded_and_errors_are_passed_on() {
        let mut outbox = WriteQueue::new();
        while outbox.push(&[1; 100]) {}
        assert!(outbox.len <= SIZE && !outbox.has_room());
        let mut gone = |_: &[u8]| Err(io::ErrorKind::BrokenPipe.into());
        assert_eq!(outbox.flush(Duration::ZERO, &mut gone).unwrap_err().kind(), io::ErrorKind::BrokenPipe);
    }
}
