//! Real-time priority for threads with deadlines.

use thread_priority::ThreadPriority;

/// Requests real-time priority for the current thread. If the system refuses, the thread keeps its normal priority; a
/// busy machine then causes dropouts, which are counted.
pub(crate) fn run_before_others() {
    request();
}

/// Whether the system grants real-time priority to threads of this program: a short thread asks for it.
pub fn is_granted() -> bool {
    // A system that starts no thread grants no priority either, and the panic of a thread would be printed.
    let asked = std::thread::Builder::new().name("priority".to_owned()).spawn(request);
    asked.ok().and_then(|thread| thread.join().ok()).unwrap_or(false)
}

/// Requests the priority for the current thread. Returns whether it was granted.
fn request() -> bool {
    #[cfg(target_os = "linux")]
    {
        use thread_priority::unix::{
            RealtimeThreadSchedulePolicy, ThreadSchedulePolicy, set_thread_priority_and_policy,
            thread_native_id,
        };
        let policy = ThreadSchedulePolicy::Realtime(RealtimeThreadSchedulePolicy::RoundRobin);
        // The priority is below that of the sound server and the drivers, which this thread waits for.
        set_thread_priority_and_policy(thread_native_id(), ThreadPriority::Min, policy).is_ok()
    }
    #[cfg(not(target_os = "linux"))]
    ThreadPriority::Max.set_for_current().is_ok()
}

#[cfg(test)]
mod tests {
    #[test]
    fn the_answer_is_the_same_when_asked_again() {
        assert_eq!(super::is_granted(), super::is_granted());
    }
}
