//! Witness threads, one per processor, that only wake up and record when the machine delayed them.

use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};
use std::thread::JoinHandle;
use std::time::{Duration, Instant};

use rustix::thread::{CpuSet, sched_getaffinity, sched_setaffinity};
use thread_priority::unix::{
    RealtimeThreadSchedulePolicy, ThreadSchedulePolicy, set_thread_priority_and_policy, thread_native_id,
};
use thread_priority::{ThreadPriority, ThreadPriorityValue};

/// Interval between wake-ups.
const PERIOD: Duration = Duration::from_millis(1);
/// Priority above that of every audio thread.
const PRIORITY: u8 = 60;

/// Interval during which a processor did not run the witness on time.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Stall {
    pub(crate) from: Instant,
    pub(crate) to: Instant,
    /// Part of the interval by which the witness was late.
    pub(crate) late: Duration,
}

/// Monitors every processor until [`Witness::stalls`] is called.
pub(crate) struct Witness {
    ends: Arc<AtomicBool>,
    threads: Vec<JoinHandle<Vec<Stall>>>,
}

impl Witness {
    /// Starts to record each wake-up that is later than `late`.
    pub(crate) fn new(late: Duration) -> Self {
        let ends = Arc::new(AtomicBool::new(false));
        let allowed = sched_getaffinity(None).unwrap();
        let threads = (0..CpuSet::MAX_CPU)
            .filter(|cpu| allowed.is_set(*cpu))
            .map(|cpu| {
                let ends = Arc::clone(&ends);
                std::thread::spawn(move || watch(cpu, late, &ends))
            })
            .collect();
        Self { ends, threads }
    }

    /// Stops and returns the recorded stalls.
    pub(crate) fn stalls(self) -> Vec<Stall> {
        self.ends.store(true, Ordering::Relaxed);
        self.threads.into_iter().flat_map(|thread| thread.join().unwrap()).collect()
    }
}

fn watch(cpu: usize, late: Duration, ends: &AtomicBool) -> Vec<Stall> {
    let mut here = CpuSet::new();
    here.set(cpu);
    sched_setaffinity(None, &here).unwrap();
    // Without the permission for real-time priority, the witness runs at normal priority, like the threads that it
    // watches for.
    let first = ThreadPriority::Crossplatform(ThreadPriorityValue::try_from(PRIORITY).unwrap());
    let policy = ThreadSchedulePolicy::Realtime(RealtimeThreadSchedulePolicy::Fifo);
    set_thread_priority_and_policy(thread_native_id(), first, policy).ok();
    let mut stalls = Vec::new();
    let mut from = Instant::now();
    while !ends.load(Ordering::Relaxed) {
        std::thread::sleep(PERIOD);
        let to = Instant::now();
        let away = to.duration_since(from).saturating_sub(PERIOD);
        if away > late {
            stalls.push(Stall { from, to, late: away });
        }
        from = to;
    }
    stalls
}
