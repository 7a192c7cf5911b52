//! Who watches the machine: threads that do nothing but wake, one to a processor, and note when the machine let them not.

use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};
use std::thread::JoinHandle;
use std::time::{Duration, Instant};

use rustix::thread::{CpuSet, sched_getaffinity, sched_setaffinity};
use thread_priority::unix::{
    RealtimeThreadSchedulePolicy, ThreadSchedulePolicy, set_thread_priority_and_policy, thread_native_id,
};
use thread_priority::{ThreadPriority, ThreadPriorityValue};

/// How often a witness wakes.
const PERIOD: Duration = Duration::from_millis(1);
/// Above every thread that plays.
const PRIORITY: u8 = 60;

/// A time in which a processor ran nothing that should have run.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Stall {
    pub(crate) from: Instant,
    pub(crate) to: Instant,
    /// How much of it the processor was away.
    pub(crate) late: Duration,
}

/// Watches every processor until it is asked what it saw.
pub(crate) struct Witness {
    ends: Arc<AtomicBool>,
    threads: Vec<JoinHandle<Vec<Stall>>>,
}

impl Witness {
    /// Notes each time that a processor came later than this.
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

    /// The stalls so far.
    pub(crate) fn stalls(self) -> Vec<Stall> {
        self.ends.store(true, Ordering::Relaxed);
        self.threads.into_iter().flat_map(|thread| thread.join().unwrap()).collect()
    }
}

fn watch(cpu: usize, late: Duration, ends: &AtomicBool) -> Vec<Stall> {
    let mut here = CpuSet::new();
    here.set(cpu);
    sched_setaffinity(None, &here).unwrap();
    // Where it may not be first, it waits in line as those do that it watches for.
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
