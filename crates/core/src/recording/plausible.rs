//! Plausibility checks of tip speed, force and acceleration, which reveal wrong units.

use crate::dsp::spectrum::{median, rms};
use crate::recording::bounds::SPEED;
use crate::recording::{Fault, Finding, Recording};

/// Fraction of the highest speed below which the tip rests or reverses.
const MOVING_SHARE: f64 = 0.05;
/// Range of plausible median tip speeds, in m/s.
const SLOWEST_MPS: f64 = 5e-4;
const FASTEST_MPS: f64 = 5.0;
/// Highest plausible force on a stylus in N, with a wide margin.
const STRONGEST_N: f64 = 100.0;

/// Range of plausible vibration levels in m/s² rms: measured textures have about 0.05 to 20 m/s². The margin is wide
/// below, where a light stroke over a smooth surface is possible, but not above: a strong texture whose numbers in m/s²
/// are read as g has about 40 m/s².
const WEAKEST_MPS2: f64 = 1e-3;
const HEAVIEST_MPS2: f64 = 30.0;

/// Reports implausible motion and vibration as findings, and returns a fault if the motion is impossible.
pub(super) fn check_plausible(recording: &Recording, findings: &mut Vec<Finding>) -> Option<Fault> {
    let inside = |values: &[f64]| -> Vec<f64> {
        recording.usable.iter().flat_map(|range| values[range.clone()].iter().copied()).collect()
    };
    let speeds_mps = inside(&recording.speed_mps);
    let most_mps = speeds_mps.iter().copied().fold(0.0, f64::max);
    if most_mps > SPEED.most {
        return Some(Fault::ImpossibleSpeed { most_mps });
    }
    let moving = speeds_mps.into_iter().filter(|speed| *speed > MOVING_SHARE * most_mps);
    let median_mps = median(moving.collect());
    // A tip that never moves has no median speed; such a recording has no strokes.
    if median_mps.is_finite() && !(SLOWEST_MPS..=FASTEST_MPS).contains(&median_mps) {
        findings.push(Finding::ImplausibleSpeed { median_mps });
    }
    let most_n = inside(&recording.force_n).into_iter().fold(0.0, f64::max);
    if most_n > STRONGEST_N {
        findings.push(Finding::ImplausibleForce { most_n });
    }
    let level_mps2 = level_mps2(recording);
    // A recording without any vibration has its own messages.
    if level_mps2 > 0.0 && !(WEAKEST_MPS2..=HEAVIEST_MPS2).contains(&level_mps2) {
        findings.push(Finding::ImplausibleAcceleration { level_mps2 });
    }
    None
}

/// Root mean square of the acceleration without its mean in each usable range, which is gravity or an offset.
fn level_mps2(recording: &Recording) -> f64 {
    let mut vibration = Vec::new();
    for range in &recording.usable {
        let part = &recording.acceleration_mps2[range.clone()];
        let mean = part.iter().sum::<f64>() / part.len().max(1) as f64;
        vibration.extend(part.iter().map(|x| x - mean));
    }
    rms(&vibration)
}

#[cfg(test)]
mod tests {
    use crate::maths::rng::lcg_noise;
    use crate::recording::{Fault, RawClock, RawMotion, RawRecording, RawTrack, Recording};
    use crate::units::Hertz;

    const N_ROWS: usize = 2000;

    fn raw(motion: RawMotion, force_n: RawTrack) -> RawRecording {
        RawRecording {
            clock: RawClock::Rate(Hertz(1000.0)),
            acceleration_mps2: vec![lcg_noise(N_ROWS, 7)],
            motion,
            force_n,
            full_scale_mps2: None,
        }
    }

    /// Messages about a motion and a force, without those about constants.
    fn sentences(motion: RawMotion, force_n: RawTrack) -> Vec<String> {
        let (_, findings) = Recording::from_raw(raw(motion, force_n)).expect("a recording");
        findings.iter().map(ToString::to_string).filter(|text| !text.starts_with("constant")).collect()
    }

    fn swing(highest: f64) -> RawTrack {
        RawTrack::Column((0..N_ROWS).map(|row| highest * (row as f64 * 0.01).sin().abs()).collect())
    }

    #[test]
    fn speeds_and_forces_of_hands_are_plausible() {
        for (speed_mps, force_n) in [(0.005, 0.1), (0.1, 1.0), (2.0, 90.0)] {
            assert_eq!(sentences(RawMotion::Speed(swing(speed_mps)), swing(force_n)), [""; 0]);
        }
        let constant = RawMotion::Speed(RawTrack::Constant(0.0005));
        assert_eq!(sentences(constant, RawTrack::Constant(100.0)), [""; 0]);
    }

    #[test]
    fn others_are_said() {
        let steady = || RawTrack::Constant(1.0);
        for (speed, words) in [
            (swing(0.0004), "moving tip is 0.2"),
            (swing(30.0), "moving tip is 21"),
            (RawTrack::Constant(0.0001), "moving tip is 0.100 mm/s"),
            (RawTrack::Constant(6.0), "moving tip is 6000.000 mm/s"),
        ] {
            let said = sentences(RawMotion::Speed(speed), steady());
            assert!(
                said.len() == 1 && said[0].starts_with("implausible speed: ") && said[0].contains(words),
                "{said:?}"
            );
        }
        let said = sentences(RawMotion::Speed(RawTrack::Constant(0.1)), swing(980.0));
        assert!(
            said.len() == 1 && said[0].starts_with("implausible force: the force reaches 980 N"),
            "{said:?}"
        );
    }

    /// Noise of a uniform distribution in -1..1 has a root mean square of 0.577, whatever its offset is.
    #[test]
    fn accelerations_in_a_wrong_unit_are_said() {
        for (times, words) in [
            (1.0, None),
            (50.0, None),
            // Numbers of 4.4 m/s² under a header in g.
            (75.0, Some("43 m/s² rms")),
            (1000.0, Some("577 m/s² rms")),
            (0.002, None),
            (1e-4, Some("0.000058 m/s² rms")),
        ] {
            let mut scaled = raw(RawMotion::Speed(swing(0.1)), RawTrack::Constant(1.0));
            let noise = lcg_noise(N_ROWS, 7);
            let to_rms = times * 3.0_f64.sqrt().recip() / crate::dsp::spectrum::rms(&noise);
            scaled.acceleration_mps2 = vec![noise.iter().map(|x| 9.81 + to_rms * x).collect()];
            let (_, findings) = Recording::from_raw(scaled).expect("a recording");
            let said: Vec<String> = findings.iter().map(ToString::to_string).collect();
            let found = said.iter().find(|text| text.starts_with("implausible acceleration: "));
            match words {
                Some(words) => assert!(found.is_some_and(|text| text.contains(words)), "{said:?}"),
                None => assert_eq!(found, None, "{times}"),
            }
        }
    }

    #[test]
    fn what_cannot_be_is_an_error_that_names_the_unit() {
        let faults = |motion, force_n| {
            let error = Recording::from_raw(raw(motion, force_n)).expect_err("no recording");
            assert!(!error.to_string().contains("node"), "{error}");
            error
        };
        let error = faults(RawMotion::Speed(RawTrack::Constant(200.0)), RawTrack::Constant(1.0));
        assert_eq!(
            error.to_string(),
            "bad constant: speed in mm/s is 200000; it must lie between 0 and 100000"
        );
        let error = faults(RawMotion::Speed(RawTrack::Column(vec![200.0; N_ROWS])), RawTrack::Constant(1.0));
        assert_eq!(error.faults[0].name(), "nothing usable");
        let said = error.findings[0].to_string();
        assert!(said.contains("speed exceeds 100 m/s, 2000 of 2000 rows") && said.contains("unit"), "{said}");
        let positions = (0..N_ROWS).map(|row| 0.2 * row as f64).collect();
        let error = faults(RawMotion::Positions(vec![positions]), RawTrack::Constant(1.0));
        assert!(matches!(error.faults[..], [Fault::ImpossibleSpeed { .. }]), "{error}");
        assert!(error.to_string().contains("reaches 200 m/s"), "{error}");
    }

    #[test]
    fn forces_below_zero_are_said() {
        let force = |least: f64| {
            RawTrack::Column((0..N_ROWS).map(|row| if row % 4 == 0 { least } else { 1.0 }).collect())
        };
        let speed = || RawMotion::Speed(RawTrack::Constant(0.1));
        let said = sentences(speed(), force(-0.5));
        assert!(
            said.len() == 1 && said[0].starts_with("signed force: negative in 500 of 2000 rows"),
            "{said:?}"
        );
        // The zero of a sensor drifts by this much.
        assert_eq!(sentences(speed(), force(-0.04)), [""; 0]);
    }

    #[test]
    fn an_error_says_what_is_wrong_and_not_all_that_was_found() {
        let mut silent = raw(RawMotion::Speed(RawTrack::Constant(0.1)), RawTrack::Missing);
        silent.acceleration_mps2[0].fill(0.0);
        let error = Recording::from_raw(silent).expect_err("silence");
        let message = error.to_string();
        assert!(message.starts_with("no signal: acceleration is 0 in every row"), "{message}");
        assert_eq!(error.faults.iter().map(Fault::name).collect::<Vec<_>>(), ["no signal", "no force"]);
        assert!(!error.findings.is_empty() && !message.contains("dead axis"), "{message}");
    }

    #[test]
    fn a_constant_speed_is_said_as_people_say_it() {
        let constants = raw(RawMotion::Speed(RawTrack::Constant(0.07)), RawTrack::Constant(1.5));
        let (_, findings) = Recording::from_raw(constants).expect("a recording");
        let said: Vec<String> = findings.iter().map(ToString::to_string).collect();
        assert_eq!(
            said,
            [
                "constant: speed in mm/s was set to 70 for the whole recording",
                "constant: force in N was set to 1.5 for the whole recording"
            ]
        );
    }
}
