//! Real-time priority for threads with deadlines.

use thread_priority::ThreadPriority;

/// Requests real-time priority for the current thread. If the system refuses, the thread keeps its normal priority; a
/// busy machine then causes dropouts, which are counted.
pub(crate) fn run_before_others() {
    #[cfg(target_os = "linux")]
    {
        use thread_priority::unix::{
            RealtimeThreadSchedulePolicy, ThreadSchedulePolicy, set_thread_priority_and_policy,
            thread_native_id,
        };
        let policy = ThreadSchedulePolicy::Realtime(RealtimeThreadSchedulePolicy::RoundRobin);
        // The priority is below that of the sound server and the drivers, which this thread waits for.
        set_thread_priority_and_policy(thread_native_id(), ThreadPriority::Min, policy).ok(); // If permitted.
    }
    #[cfg(not(target_os = "linux"))]
    ThreadPriority::Max.set_for_current().ok(); // If permitted.
}
