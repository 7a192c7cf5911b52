//! Where the tip lands.

use crate::recording::Recording;
use crate::segment::MIN_FORCE;
use crate::spectrum::rms;
use crate::units::Hertz;

/// How long the tip has been in the air before a landing, in seconds.
const AIR_SECS: f64 = 0.05;

/// How long it stays down after one, in seconds.
const CONTACT_SECS: f64 = 0.05;

/// Length of a landing's transient, in seconds: the slowest everyday decay is over.
pub(super) const TRANSIENT_SECS: f64 = 0.08;

/// How far after the force says so a transient may begin, in seconds: sensors are late against each other.
const SEARCH_SECS: f64 = 0.03;

/// How far before the force says so a transient may begin, in seconds: force sensors are slow and filtered, and a hand
/// that lands gently, at half a newton a second, takes a tenth of a second to [`MIN_FORCE`].
const SEARCH_BACK_SECS: f64 = 0.12;

/// How much stronger than the noise in the air before it a transient is, as a ratio of amplitudes.
/// Over what is searched, noise alone rises above four times, the more so as its level is that of fifty samples.
const MIN_RISE: f64 = 6.0;

/// The transient of one landing.
pub(super) struct Transient {
    pub(super) rate: Hertz,
    /// Acceleration in m/s² from the moment of landing.
    pub(super) signal: Vec<f64>,
}

/// The transients of all landings of a recording.
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
                // Wholly in the air is what was felt before, however far back it is looked for.
                if n_lifted >= n_air + n_back && stays && i > n_air + n_back {
                    // Gravity, and the hand: what was felt in the air just before. A high-pass filter that takes it out
                    // would ring as slowly as rubber does.
                    let air = &signal[i - n_air - n_back..i - n_back];
                    let rest = air.iter().sum::<f64>() / air.len() as f64;
                    let end = (i + n_search + n_transient).min(signal.len());
                    let around: Vec<f64> = signal[i - n_air - n_back..end].iter().map(|x| x - rest).collect();
                    found.extend(onset(&around, n_air, n_back + n_search).and_then(|start| {
                        let signal = around.get(start..start + n_transient)?.to_vec();
                        Some(Transient { rate, signal })
                    }));
                }
                // Noise on a force that rises slowly crosses more than once before it stays.
                n_lifted = if stays { 0 } else { n_lifted + 1 };
            }
            i += 1;
        }
    }
    found
}

/// The sample at which a transient begins, where one sticks out of the noise: `signal` starts with `n_air` samples of air,
/// and what begins in the `n_search` after these counts.
fn onset(signal: &[f64], n_air: usize, n_search: usize) -> Option<usize> {
    let (air, rest) = signal.split_at_checked(n_air)?;
    let noise = rms(air);
    let near = &rest[..n_search.min(rest.len())];
    let peak = near.iter().fold(0.0_f64, |m, x| m.max(x.abs()));
    if peak < MIN_RISE * noise || peak == 0.0 {
        return None;
    }
    // The first sample above a fifth of the peak and the noise, and back to where it left zero.
    let threshold = (0.2 * peak).max(MIN_RISE * noise);
    let first = near.iter().position(|x| x.abs() >= threshold)?;
    let sign = near[first].signum();
    let back = near[..first].iter().rev().take_while(|x| **x * sign > noise).count();
    Some((n_air + first - back).saturating_sub(1))
}
