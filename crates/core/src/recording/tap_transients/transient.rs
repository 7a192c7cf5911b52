//! Detection of tap transients in a recording.

use crate::dsp::spectrum::rms;
use crate::recording::Recording;
use crate::recording::segment::MIN_FORCE;
use crate::units::Hertz;

/// Minimum time without contact before a tap, in seconds.
const AIR_SECS: f64 = 0.05;

/// Minimum contact time after a tap, in seconds.
const CONTACT_SECS: f64 = 0.05;

/// Duration of a tap transient in seconds; the slowest common decays end within it.
pub(super) const TRANSIENT_SECS: f64 = 0.08;

/// Latest start of the transient after the force threshold, in seconds; the sensors can have different latencies.
const SEARCH_SECS: f64 = 0.03;

/// Earliest start of the transient before the force threshold, in seconds. Force sensors are slow and filtered. A
/// gentle contact at 0.5 N/s also takes a tenth of a second to reach [`MIN_FORCE`].
const SEARCH_BACK_SECS: f64 = 0.12;

/// Minimum ratio of the transient's peak to the noise before it. Noise alone can exceed a ratio of four in the search
/// interval, because its level is estimated from about fifty samples.
const MIN_RISE: f64 = 6.0;

/// Tap transient of one contact.
pub(super) struct Transient {
    pub(super) rate: Hertz,
    /// Acceleration in m/s² from the start of the contact.
    pub(super) signal: Vec<f64>,
}

/// Tap transients of all contacts in a recording.
pub(super) fn landings(recording: &Recording) -> Vec<Transient> {
    let rate = recording.rate;
    let samples = |secs: f64| (secs * rate.0).round() as usize;
    let (n_air, n_contact) = (samples(AIR_SECS), samples(CONTACT_SECS));
    let (n_search, n_transient) = (samples(SEARCH_SECS), samples(TRANSIENT_SECS));
    let n_back = samples(SEARCH_BACK_SECS);
    let mut found = Vec::new();
    for usable in &recording.usable {
        if usable.len() < n_air + n_back + n_search + n_transient {
            continue;
        }
        let force = &recording.force_n[usable.clone()];
        let signal = &recording.acceleration_mps2[usable.clone()];
        let (mut n_lifted, mut i) = (0, 0);
        while i < force.len() {
            if force[i] < MIN_FORCE.0 {
                n_lifted += 1;
            } else {
                let stays =
                    force.get(i..i + n_contact).is_some_and(|next| next.iter().all(|f| *f >= MIN_FORCE.0));
                // The whole interval before the earliest start must be without contact.
                if n_lifted >= n_air + n_back && stays && i > n_air + n_back {
                    // Subtracts gravity and hand motion, estimated just before the contact. A high-pass filter would
                    // ring as slowly as rubber does.
                    let air = &signal[i - n_air - n_back..i - n_back];
                    let rest = air.iter().sum::<f64>() / air.len() as f64;
                    let end = (i + n_search + n_transient).min(signal.len());
                    let around: Vec<f64> = signal[i - n_air - n_back..end].iter().map(|x| x - rest).collect();
                    found.extend(onset(&around, n_air, n_back + n_search).and_then(|start| {
                        let signal = around.get(start..start + n_transient)?.to_vec();
                        Some(Transient { rate, signal })
                    }));
                }
                // Noise on a slowly rising force can cross the threshold several times before it stays above.
                n_lifted = if stays { 0 } else { n_lifted + 1 };
            }
            i += 1;
        }
    }
    found
}

/// Index of the sample at which a transient starts, if one exceeds the noise. `signal` starts with `n_air` samples
/// without contact, and the transient must start within the next `n_search` samples.
fn onset(signal: &[f64], n_air: usize, n_search: usize) -> Option<usize> {
    let (air, rest) = signal.split_at_checked(n_air)?;
    let noise = rms(air);
    let near = &rest[..n_search.min(rest.len())];
    let peak = near.iter().fold(0.0_f64, |m, x| m.max(x.abs()));
    if peak < MIN_RISE * noise || peak == 0.0 {
        return None;
    }
    // First sample above a fifth of the peak and above the noise, then back to where the signal left zero.
    let threshold = (0.2 * peak).max(MIN_RISE * noise);
    let first = near.iter().position(|x| x.abs() >= threshold)?;
    let sign = near[first].signum();
    let back = near[..first].iter().rev().take_while(|x| **x * sign > noise).count();
    Some((n_air + first - back).saturating_sub(1))
}
