//! Threads that must not wait for the window.

use thread_priority::ThreadPriority;

/// Asks the system to run this thread before all others that have no deadline. Where it may not, the thread runs as any
/// other: then a busy machine makes itself heard as dropouts, which are counted.
pub(crate) fn run_before_others() {
    #[cfg(target_os = "linux")]
    {
        use thread_priority::unix::{
            RealtimeThreadSchedulePolicy, ThreadSchedulePolicy, set_thread_priority_and_policy,
            thread_native_id,
        };
        let policy = ThreadSchedulePolicy::Realtime(RealtimeThreadSchedulePolicy::RoundRobin);
        // Below the sound server and the drivers, which this thread waits for.
        set_thread_priority_and_policy(thread_native_id(), ThreadPriority::Min, policy).ok(); // As far as allowed.
    }
    #[cfg(not(target_os = "linux"))]
    ThreadPriority::Max.set_for_current().ok(); // As far as allowed.
}
