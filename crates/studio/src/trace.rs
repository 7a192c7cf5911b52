//! Trace of a motion for the sidecar of a signal: speed and force of the tip over time.

use shagreen_core::units::Contact;
use shagreen_formats::wav::TraceV1;

/// Largest number of points of the trace of a stroke.
const MAX_POINTS: f64 = 20_000.0;
/// Usual interval between its points, in seconds.
const STEP_SECS: f64 = 0.01;

/// Returns the trace of a steady contact.
pub fn steady_trace(contact: Contact, seconds: f64) -> TraceV1 {
    trace_at(vec![0.0, seconds], |_| contact)
}

/// Returns the trace of a stroke, from its speed and force at a time in seconds.
pub fn stroke_trace(seconds: f64, contact_at: impl Fn(f64) -> Contact) -> TraceV1 {
    let step_secs = STEP_SECS.max(seconds / MAX_POINTS);
    trace_at((0..=(seconds / step_secs) as usize).map(|i| i as f64 * step_secs).collect(), contact_at)
}

fn trace_at(times: Vec<f64>, contact_at: impl Fn(f64) -> Contact) -> TraceV1 {
    let contacts: Vec<Contact> = times.iter().map(|secs| contact_at(*secs)).collect();
    TraceV1 {
        time_s: times.into_iter().map(short).collect(),
        speed_mm_per_s: contacts.iter().map(|contact| short(contact.speed.mm_per_s())).collect(),
        force_n: contacts.iter().map(|contact| short(contact.force.0)).collect(),
    }
}

/// Rounds to four decimals: 0.1 ms, 0.1 µm/s, 0.1 mN.
fn short(value: f64) -> f64 {
    (value * 1e4).round() / 1e4
}
