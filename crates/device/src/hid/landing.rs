//! Estimation of the impact speed of a pen's taps. No pen measures it, so the value is an estimate.
//!
//! If a pen reports its height, the speed comes from the last heights before the contact. Otherwise it comes from the
//! rise of the force: at the start of a contact of stiffness `k`, a tip with impact speed `v` presses with
//! `dF/dt = k v`. The stiffness of grip, pen tip and pad in series is unknown for the actual pen, so
//! [`STIFFNESS_N_PER_M`] is used for all. A pen also reports only every 4 to 8 ms, so short taps are underestimated.
//! The estimate ranks taps by speed; its scale is nominal.
//!
//! A tap transient cannot wait for three reports of the force: it would be late. It uses
//! [`ImpactSpeedEstimator::first_estimate_mps`].

use std::collections::VecDeque;

use shagreen_synth::tap::REFERENCE_IMPACT_MPS;

/// Assumed stiffness of the contact of a pen with a pad, in N/m: 0.4 mm of deflection under 4 N.
pub const STIFFNESS_N_PER_M: f64 = 1e4;
/// Highest impact speed that is returned, in m/s; hands are slower.
const MAX_LANDING_MPS: f64 = 3.0;

/// Number of reports of a contact that the force-based estimate uses.
const N_RISING: u32 = 3;
/// Longest gap between heights or forces that an estimate uses, in s.
const MAX_GAP_SECS: f64 = 0.050;

/// Contact onset of the tip with its impact speed.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Landing {
    /// Time of the first report with contact, in s on the clock of the reports.
    pub time_secs: f64,
    /// Impact speed in m/s, estimated as the module describes.
    pub speed_mps: f32,
    /// Whether the estimate is based on heights; otherwise on the force.
    pub is_from_height: bool,
}

/// State of the impact speed estimate between reports.
#[derive(Clone, Debug, Default)]
pub struct ImpactSpeedEstimator {
    /// Times and heights of the last reports without contact.
    heights: VecDeque<(f64, f64)>,
    last_in_air_secs: Option<f64>,
    contact: Option<Contact>,
}

#[derive(Clone, Copy, Debug)]
struct Contact {
    time_secs: f64,
    last_secs: f64,
    last_n: f64,
    rise_nps: f64,
    n_reports: u32,
    is_told: bool,
    /// Speed by the heights before the contact.
    height_mps: Option<f32>,
}

impl ImpactSpeedEstimator {
    /// Processes a report. Returns a contact onset once its speed is known; with force only, this takes three reports.
    pub fn report(
        &mut self,
        time_secs: f64,
        height_m: Option<f64>,
        force_n: f64,
        touching: bool,
    ) -> Option<Landing> {
        if !touching {
            let landing = self.contact.take().and_then(Contact::tell_by_force);
            self.last_in_air_secs = Some(time_secs);
            if let Some(height_m) = height_m {
                self.heights.push_back((time_secs, height_m));
                if self.heights.len() > 3 {
                    self.heights.pop_front();
                }
            }
            return landing;
        }
        let Some(contact) = &mut self.contact else { return self.land(time_secs, force_n) };
        let step_secs = time_secs - contact.last_secs;
        if step_secs > 0.0 && step_secs <= MAX_GAP_SECS {
            contact.rise_nps = contact.rise_nps.max((force_n - contact.last_n) / step_secs);
        }
        (contact.last_secs, contact.last_n) = (time_secs, force_n);
        contact.n_reports += 1;
        if contact.n_reports < N_RISING || contact.is_told {
            return None;
        }
        let landing = contact.tell_by_force();
        contact.is_told = true;
        landing
    }

    /// Returns the impact speed in m/s as far as the first report of a contact states it, after that report only: from the
    /// heights, or else from the force that it states.
    ///
    /// The tip landed at an unknown time since the report before, on average half-way, so the force has risen twice as
    /// fast as the interval says. One force says little: the result is the mean of this speed and of
    /// [`REFERENCE_IMPACT_MPS`], at which a tap of unknown speed is played.
    pub fn first_estimate_mps(&self) -> Option<f32> {
        let contact = self.contact.filter(|contact| contact.n_reports == 1)?;
        contact.height_mps.or_else(|| {
            let by_force_mps = (2.0 * contact.rise_nps / STIFFNESS_N_PER_M).min(MAX_LANDING_MPS);
            (by_force_mps > 0.0).then_some((0.5 * (REFERENCE_IMPACT_MPS + by_force_mps)) as f32)
        })
    }

    /// Clears the state, for a device that was unplugged or another pen.
    pub fn forget(&mut self) {
        *self = Self::default();
    }

    /// Processes the first report of a contact.
    fn land(&mut self, time_secs: f64, force_n: f64) -> Option<Landing> {
        let recent = |(time, _): &&(f64, f64)| time_secs - time <= MAX_GAP_SECS;
        let (first, last) = (self.heights.iter().find(recent), self.heights.back());
        let by_height = first.zip(last).and_then(|((t0, h0), (t1, h1))| {
            (t1 > t0 && h0 > h1).then(|| Landing {
                time_secs,
                speed_mps: ((h0 - h1) / (t1 - t0)).min(MAX_LANDING_MPS) as f32,
                is_from_height: true,
            })
        });
        // Without contact the force is zero. If the last report without contact is too old, the rise is unknown.
        let gap_secs = self.last_in_air_secs.map(|last| time_secs - last);
        let rise_nps =
            gap_secs.filter(|gap| (1e-4..=MAX_GAP_SECS).contains(gap)).map_or(0.0, |gap| force_n / gap);
        self.heights.clear();
        self.contact = Some(Contact {
            time_secs,
            last_secs: time_secs,
            last_n: force_n,
            rise_nps,
            n_reports: 1,
            is_told: by_height.is_some(),
            height_mps: by_height.map(|landing| landing.speed_mps),
        });
        by_height
    }
}

impl Contact {
    fn tell_by_force(self) -> Option<Landing> {
        let speed_mps = (self.rise_nps / STIFFNESS_N_PER_M).min(MAX_LANDING_MPS) as f32;
        (!self.is_told && speed_mps > 0.0).then_some(Landing {
            time_secs: self.time_secs,
            speed_mps,
            is_from_height: false,
        })
    }
}

#[cfg(test)]
mod tests {
    use super::{ImpactSpeedEstimator, Landing, STIFFNESS_N_PER_M};

    /// Contact onsets of a pen that descends at `speed_mps` from 1 cm, reports every `step_secs`, and stays for 50 ms.
    fn landings(speed_mps: f64, step_secs: f64, tells_height: bool) -> Vec<Landing> {
        let mut estimator = ImpactSpeedEstimator::default();
        let contact_secs = 0.01 / speed_mps;
        let n = ((contact_secs + 0.05) / step_secs) as u32;
        (0..n)
            .filter_map(|i| {
                let time = f64::from(i) * step_secs;
                let depth_m = (time - contact_secs) * speed_mps;
                // The tip deflects for 20 ms and is then held.
                let force_n = STIFFNESS_N_PER_M * depth_m.clamp(0.0, 0.02 * speed_mps);
                let height_m = tells_height.then_some((-depth_m).max(0.0));
                estimator.report(time, height_m, force_n, depth_m > 0.0)
            })
            .collect()
    }

    #[test]
    fn heights_tell_the_speed() {
        for speed_mps in [0.02, 0.1, 0.5] {
            let found = landings(speed_mps, 0.004, true);
            assert_eq!(found.len(), 1);
            assert!(
                found[0].is_from_height && (f64::from(found[0].speed_mps) / speed_mps - 1.0).abs() < 1e-6
            );
            assert!((found[0].time_secs - 0.01 / speed_mps).abs() < 0.004 + 1e-9);
        }
    }

    #[test]
    fn a_force_that_rises_tells_the_speed_by_the_nominal_stiffness() {
        for speed_mps in [0.02, 0.1, 0.5] {
            for step_secs in [0.001, 0.004, 0.008] {
                let found = landings(speed_mps, step_secs, false);
                assert_eq!(found.len(), 1);
                let share = f64::from(found[0].speed_mps) / speed_mps;
                // At least one whole step lies within the rise.
                assert!(!found[0].is_from_height && (share - 1.0).abs() < 1e-5, "{share}");
            }
        }
    }

    /// Estimate after the first report of a contact, and whether the next report has one.
    fn first_estimate(speed_mps: f64, tells_height: bool) -> (Option<f32>, bool) {
        let mut estimator = ImpactSpeedEstimator::default();
        // The tip lands half-way between two reports.
        for depth_m in [-1.5, -0.5].map(|steps| steps * 0.004 * speed_mps) {
            estimator.report(depth_m / speed_mps, tells_height.then_some(-depth_m), 0.0, false);
            assert_eq!(estimator.first_estimate_mps(), None, "in the air");
        }
        estimator.report(0.002, Some(0.0), STIFFNESS_N_PER_M * 0.002 * speed_mps, true);
        let first = estimator.first_estimate_mps();
        estimator.report(0.006, Some(0.0), STIFFNESS_N_PER_M * 0.006 * speed_mps, true);
        (first, estimator.first_estimate_mps().is_some())
    }

    #[test]
    fn the_first_report_has_an_estimate_between_the_reference_and_the_speed() {
        for speed_mps in [0.02, 0.1, 0.5] {
            let (first, second) = first_estimate(speed_mps, true);
            assert!((f64::from(first.unwrap()) / speed_mps - 1.0).abs() < 1e-6 && !second);
            let (first, second) = first_estimate(speed_mps, false);
            assert!((f64::from(first.unwrap()) - 0.5 * (0.1 + speed_mps)).abs() < 1e-6 && !second);
        }
        assert_eq!(ImpactSpeedEstimator::default().first_estimate_mps(), None);
    }

    #[test]
    fn a_tap_that_ends_early_is_told_when_it_ends() {
        let mut estimator = ImpactSpeedEstimator::default();
        assert_eq!(estimator.report(0.0, None, 0.0, false), None);
        assert_eq!(estimator.report(0.005, None, 1.0, true), None);
        let landing = estimator.report(0.010, None, 0.0, false).unwrap();
        assert!((landing.time_secs - 0.005).abs() < 1e-12 && (landing.speed_mps - 0.02).abs() < 1e-7);
    }

    #[test]
    fn nothing_is_told_of_a_contact_whose_beginning_was_not_seen() {
        let mut estimator = ImpactSpeedEstimator::default();
        for i in 0..20 {
            assert_eq!(estimator.report(f64::from(i) * 0.005, None, 1.0, true), None);
        }
        estimator.forget();
        assert_eq!(estimator.report(0.2, None, 0.0, false), None);
        // After a long silence, the pen is already pressed.
        for i in 0..20 {
            assert_eq!(estimator.report(5.0 + f64::from(i) * 0.005, None, 2.0, true), None);
        }
    }
}
