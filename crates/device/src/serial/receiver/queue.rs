//! Queue of samples by index, starting at the next one to play. Lost samples leave a gap; repeated ones are ignored.

use crate::serial::message::SampleBytes;

/// Next element of the queue.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Next {
    Sample(i16),
    /// A lost sample that is followed by later ones.
    Hole,
    Empty,
}

/// A queue of at most `N` samples.
#[derive(Clone, Debug)]
pub(super) struct Queue<const N: usize> {
    samples: [i16; N],
    is_there: [bool; N],
    /// Position of the next sample in the arrays.
    head: usize,
    /// Number of samples from the next to the last, including gaps.
    len: usize,
    /// Index of the next sample; `None` before the first one.
    base: Option<u16>,
}

impl<const N: usize> Queue<N> {
    pub(super) const fn new() -> Self {
        Self { samples: [0; N], is_there: [false; N], head: 0, len: 0, base: None }
    }

    /// Discards everything. The next samples define the first index.
    pub(super) fn clear(&mut self) {
        (self.len, self.base) = (0, None);
    }

    pub(super) fn len(&self) -> usize {
        self.len
    }

    /// Whether the first index is defined.
    pub(super) fn has_begun(&self) -> bool {
        self.base.is_some()
    }

    /// Index after the last sample.
    pub(super) fn end(&self) -> u16 {
        self.base.unwrap_or(0).wrapping_add(self.len as u16)
    }

    /// Adds samples that begin at index `seq`, up to `limit` queued samples. Returns how many were new.
    pub(super) fn put(&mut self, seq: u16, samples: SampleBytes<'_>, limit: usize) -> u16 {
        let base = *self.base.get_or_insert(seq);
        let limit = limit.min(N);
        let mut n_new = 0;
        for (i, sample) in samples.iter().enumerate() {
            // By the sign of the 16-bit difference, half of all indices are before `base` and half after.
            let ahead = seq.wrapping_add(i as u16).wrapping_sub(base).cast_signed();
            let Some(offset) = usize::try_from(ahead).ok().filter(|&offset| offset < limit) else { continue };
            while self.len <= offset {
                self.is_there[(self.head + self.len) % N] = false;
                self.len += 1;
            }
            let place = (self.head + offset) % N;
            if !self.is_there[place] {
                (self.samples[place], self.is_there[place]) = (sample, true);
                n_new += 1;
            }
        }
        n_new
    }

    /// Removes and returns the next element.
    pub(super) fn take(&mut self) -> Next {
        if self.len == 0 {
            return Next::Empty;
        }
        let place = self.head;
        self.head = (self.head + 1) % N;
        self.len -= 1;
        self.base = self.base.map(|base| base.wrapping_add(1));
        if self.is_there[place] { Next::Sample(self.samples[place]) } else { Next::Hole }
    }
}

#[cfg(test)]
mod tests {
    use super::{Next, Queue};
    use crate::serial::frame::Frame;
    use crate::serial::message::{HostMessage, from_host};

    fn put(queue: &mut Queue<8>, seq: u16, samples: &[i16], limit: usize) -> u16 {
        let mut payload = vec![0];
        for sample in samples {
            payload.extend(sample.to_le_bytes());
        }
        let frame = Frame { kind: 3, seq, payload: &payload };
        let Ok(Some(HostMessage::Samples { samples, .. })) = from_host(frame) else { panic!("samples") };
        queue.put(seq, samples, limit)
    }

    fn all(queue: &mut Queue<8>) -> Vec<Next> {
        std::iter::from_fn(|| Some(queue.take()).filter(|&next| next != Next::Empty)).collect()
    }

    #[test]
    fn order_and_repetition_do_not_matter() {
        for begin in [0, 100, 65_533] {
            let at = |i: u16| begin + i;
            let wrapped = |i: u16| begin.wrapping_add(i);
            let mut queue = Queue::new();
            assert_eq!(put(&mut queue, at(0), &[1, 2], 8), 2);
            assert_eq!(put(&mut queue, wrapped(4), &[5, 6], 8), 2);
            assert_eq!((queue.len(), queue.end()), (6, wrapped(6)));
            assert_eq!(put(&mut queue, wrapped(2), &[3, 4], 8), 2);
            assert_eq!(put(&mut queue, wrapped(2), &[3, 4], 8), 0);
            assert_eq!(all(&mut queue), [1, 2, 3, 4, 5, 6].map(Next::Sample));
            assert_eq!(put(&mut queue, wrapped(4), &[5, 6, 7], 8), 1, "two samples are late");
            assert_eq!(all(&mut queue), [Next::Sample(7)]);
        }
    }

    #[test]
    fn holes_are_holes_and_the_limit_holds() {
        let mut queue = Queue::new();
        put(&mut queue, 10, &[1], 8);
        assert_eq!(put(&mut queue, 13, &[4, 5, 6, 7], 6), 3);
        assert_eq!(queue.len(), 6);
        let expected =
            [Next::Sample(1), Next::Hole, Next::Hole, Next::Sample(4), Next::Sample(5), Next::Sample(6)];
        assert_eq!(all(&mut queue), expected);
        assert_eq!(put(&mut queue, 16 + 30_000, &[1], 8), 0);
        queue.clear();
        assert_eq!((put(&mut queue, 40_000, &[9], 8), queue.end()), (1, 40_001));
    }
}
