use super::{Contact, PenSample, Touch, Track, TrackError, TrackLanding};
use crate::kinematics::{SpeedEstimator, SpeedFilter, held_speed};
use proptest::prelude::{prop_assert, proptest};

fn sample(time_secs: f64, x_m: f64) -> PenSample {
    PenSample { time_secs, x_m, force_n: 0.5, touching: true, ..PenSample::default() }
}

fn close(a: f32, b: f64) {
    assert!((f64::from(a) - b).abs() < 1e-6, "{a} for {b}");
}

#[test]
fn replays_reports_at_their_times_and_lines_between() {
    let samples: Vec<_> =
        (0..50).map(|i| sample(10.0 + 0.008 * f64::from(i), 1e-4 * f64::from(i * i))).collect();
    let track = Track::new(&samples).unwrap();
    close(track.duration_secs() as f32, 0.392);
    let mut estimator = SpeedEstimator::new(SpeedFilter::KALMAN);
    let speeds: Vec<f64> = samples.iter().map(|s| estimator.report(s.time_secs, s.x_m, s.y_m)).collect();
    for (i, speed) in speeds.iter().enumerate() {
        let touch = track.touch_at((0.008 * i as f64).min(track.duration_secs()));
        close(touch.x_m, samples[i].x_m);
        close(touch.contact.speed_mps, *speed);
        close(touch.contact.force_n, 0.5);
        if i + 1 < speeds.len() {
            let middle = track.touch_at(0.008 * i as f64 + 0.004);
            close(middle.contact.speed_mps, 0.5 * (speed + speeds[i + 1]));
            close(middle.x_m, 0.5 * (samples[i].x_m + samples[i + 1].x_m));
        }
    }
}

#[test]
fn lifted_outside_and_for_nonsense() {
    let track = Track::new(&[sample(0.0, 0.01), sample(0.01, 0.02)]).unwrap();
    for time_secs in [-1.0, 0.011, 1e9, f64::INFINITY, f64::NAN] {
        assert_eq!(track.touch_at(time_secs).contact, Contact::LIFTED, "at {time_secs}");
    }
    close(track.touch_at(5.0).x_m, 0.02);
    close(track.touch_at(-5.0).x_m, 0.01);
    let point = Track::new(&[sample(3.0, 0.01)]).unwrap();
    assert_eq!(point.duration_secs(), 0.0);
    close(point.touch_at(0.0).contact.force_n, 0.5);
}

#[test]
fn a_lift_is_force_zero_at_its_report() {
    let lift = PenSample { touching: false, force_n: 9.0, ..sample(0.020, 0.003) };
    let track = Track::new(&[sample(0.0, 0.0), sample(0.010, 0.002), lift, sample(0.030, 0.003)]).unwrap();
    let before = track.touch_at(0.019);
    close(before.contact.force_n, 0.5);
    assert!(before.contact.speed_mps > 0.05);
    assert_eq!(track.touch_at(0.020).contact, Contact::LIFTED);
    assert_eq!(track.touch_at(0.029).contact, Contact::LIFTED);
    // The next stroke starts at rest, wherever the last one ended.
    assert_eq!(track.touch_at(0.030).contact, Contact { speed_mps: 0.0, force_n: 0.5 });
}

#[test]
fn each_contact_has_the_impact_speed_that_is_stated_around_its_onset() {
    let at = |time_secs: f64, touching: bool, impact_mps: Option<f64>| PenSample {
        touching,
        impact_mps,
        ..sample(time_secs, 0.0)
    };
    let track = Track::new(&[
        at(3.000, true, Some(0.05)),
        // Within a contact, the speed is not that of an impact.
        at(3.010, true, Some(9.0)),
        at(3.020, false, Some(0.2)),
        at(3.030, true, Some(0.0)),
        at(3.040, false, None),
        at(3.050, true, None),
        // A gap, after which the tip lands again.
        at(3.950, true, Some(0.3)),
    ])
    .unwrap();
    for (time_secs, impact_mps) in [
        (0.0, Some(0.05)),
        (0.015, Some(0.05)),
        // A contact begins on the grid up to a millisecond before its report.
        (0.0291, Some(0.2)),
        (0.035, Some(0.2)),
        (0.051, None),
        (0.94, None),
        (0.950, Some(0.3)),
    ] {
        assert_eq!(track.impact_mps_at(time_secs), impact_mps, "{time_secs} s");
    }
    assert_eq!(track.impact_mps_at(-1.0), None);
    let endless = PenSample { impact_mps: Some(f64::INFINITY), ..sample(0.0, 0.0) };
    assert_eq!(Track::new(&[endless]), Err(TrackError::NotFinite { index: 0 }));
}

#[test]
fn a_stroke_that_starts_in_contact_lands_only_if_its_first_sample_states_an_impact() {
    let at = |time_secs: f64, touching: bool, impact_mps: Option<f64>| PenSample {
        touching,
        impact_mps,
        ..sample(time_secs, 0.0)
    };
    // A lift, a gap without samples, and the first contact with each impact speed.
    let landings = |impact_mps: Option<f64>| {
        let track = Track::new(&[
            at(0.0, true, impact_mps),
            at(0.01, true, Some(0.4)),
            at(0.02, false, None),
            at(0.03, true, None),
            at(0.90, true, None),
        ])
        .unwrap();
        track.landings().iter().map(|landing| landing.time_secs).collect::<Vec<_>>()
    };
    assert_eq!(landings(None), [0.03, 0.9]);
    assert_eq!(landings(Some(0.0)), [0.03, 0.9]);
    assert_eq!(landings(Some(0.2)), [0.0, 0.03, 0.9]);
    let pressed = Track::new(&[at(0.0, true, None), at(0.01, true, None)]).unwrap();
    assert_eq!((pressed.landing_at(0.0), pressed.landing_at(0.01)), (None, None));
    // In the air first, it lands like any other.
    let landed = Track::new(&[at(0.0, false, None), at(0.01, true, None)]).unwrap();
    assert_eq!(landed.landing_at(0.01), Some(TrackLanding { time_secs: 0.01, impact_mps: None }));
}

#[test]
fn a_long_gap_is_held_decays_and_lifts() {
    let mut samples: Vec<_> = (0..20).map(|i| sample(0.01 * f64::from(i), 0.001 * f64::from(i))).collect();
    samples.push(sample(0.5, 0.3));
    let track = Track::new(&samples).unwrap();
    let last = f64::from(track.touch_at(0.19).contact.speed_mps);
    assert!(last > 0.09);
    for age in [0.005, 0.020, 0.030, 0.045, 0.049] {
        let touch = track.touch_at(0.19 + age);
        close(touch.contact.speed_mps, held_speed(last, age));
        close(touch.contact.force_n, 0.5);
    }
    for time_secs in [0.241, 0.3, 0.499] {
        assert_eq!(track.touch_at(time_secs).contact, Contact::LIFTED, "at {time_secs}");
    }
    // The jump across the gap causes no speed.
    assert_eq!(track.touch_at(0.5).contact.speed_mps, 0.0);
}

/// A table with long intervals is a stroke like any other.
#[test]
fn a_slow_recording_is_one_stroke_and_a_longer_gap_in_it_lifts() {
    for interval_secs in [0.04, 0.06, 0.1, 1.0] {
        let at = |i: u32| sample(interval_secs * f64::from(i), 0.08 * interval_secs * f64::from(i));
        let mut samples: Vec<_> = (0..40).map(at).collect();
        let after = (43..60).map(at);
        samples.extend(after);
        let track = Track::new(&samples).unwrap();
        for step in 10..380 {
            let touch = track.touch_at(0.1 * interval_secs * f64::from(step));
            // The filter settles within ten reports; before that the speed rises.
            assert!(
                step < 100 || (touch.contact.speed_mps - 0.08).abs() < 0.004,
                "{touch:?} of {interval_secs}"
            );
            close(touch.contact.force_n, 0.5);
        }
        let gap = track.touch_at(42.9 * interval_secs);
        assert_eq!(gap.contact, Contact::LIFTED, "{interval_secs}");
    }
}

/// Two rows of a table, 20 s apart: before, the speed rose from 0 to 149 mm/s.
#[test]
fn two_rows_of_a_table_are_one_constant_speed() {
    let track = Track::new(&[sample(0.0, 0.0), sample(20.0, 2.0)]).unwrap();
    for i in 0..=200 {
        close(track.touch_at(0.1 * f64::from(i)).contact.speed_mps, 0.1);
    }
}

proptest! {
    /// A constant velocity has exactly its speed at any spacing above that of pens, regular or not, from the first row to
    /// the last; at the spacing of pens it has it after the filter has settled.
    #[test]
    fn constant_motion_is_constant_at_any_spacing(
        spacing_secs in 0.004_f64..2.0,
        jitter in 0.0_f64..0.3,
        speed_mps in 0.001_f64..0.5,
        angle_rad in 0.0_f64..6.3,
    ) {
        let at = |i: u32| {
            let time_secs = spacing_secs * (f64::from(i) + jitter * f64::from(i % 2));
            let x_m = speed_mps * time_secs;
            PenSample { y_m: x_m * angle_rad.sin(), ..sample(time_secs, x_m * angle_rad.cos()) }
        };
        let samples: Vec<_> = (0..60).map(at).collect();
        let track = Track::new(&samples).unwrap();
        // The usual interval can be the shorter or the longer of the two.
        let is_coarse = spacing_secs * (1.0 - jitter) > 0.025;
        let from_secs = if is_coarse { 0.0 } else { 0.5 * track.duration_secs() };
        for step in 0..=100 {
            let share = f64::from(step) / 100.0;
            let time_secs = from_secs + share * (track.duration_secs() - from_secs);
            let got = f64::from(track.touch_at(time_secs).contact.speed_mps);
            // The filter settles to a thousandth within 30 reports; differences of `f64` are exact to the last `f32` bits.
            let tolerance = if is_coarse { 1e-6 } else { 1e-3 };
            prop_assert!((got / speed_mps - 1.0).abs() < tolerance, "{got} for {speed_mps} at {time_secs} s");
        }
    }
}

#[test]
fn equal_times_keep_the_last() {
    let samples =
        [sample(0.0, 0.0), sample(0.01, 5.0), sample(0.01, 6.0), sample(0.01, 0.001), sample(0.02, 0.002)];
    let track = Track::new(&samples).unwrap();
    assert_eq!(track.warnings.n_equal_timestamps, 2);
    let clean = Track::new(&[samples[0], samples[3], samples[4]]).unwrap();
    assert_eq!(track.touches, clean.touches);
}

#[test]
fn bad_samples_are_named() {
    let good = sample(1.0, 0.0);
    let error = |samples: &[PenSample]| Track::new(samples).unwrap_err();
    assert_eq!(error(&[]), TrackError::Empty);
    assert_eq!(error(&[good, PenSample { x_m: f64::NAN, ..good }]), TrackError::NotFinite { index: 1 });
    assert_eq!(
        error(&[good, good, sample(0.5, 0.0)]),
        TrackError::TimeGoesBack { index: 2, time_secs: 0.5, previous_secs: 1.0 }
    );
    assert_eq!(
        error(&[PenSample { force_n: -0.1, ..good }]),
        TrackError::NegativeForce { index: 0, force_n: -0.1 }
    );
    // Milliseconds mistaken for seconds.
    assert_eq!(
        error(&[sample(0.0, 0.0), sample(8000.0, 0.0)]),
        TrackError::TooLong { duration_secs: 8000.0 }
    );
    assert!(error(&[good, sample(0.5, 0.0)]).to_string().contains("sample 1"));
}

#[test]
fn a_tip_that_never_touches_is_a_track_of_silence() {
    let off = PenSample { touching: false, ..sample(0.0, 0.0) };
    let track = Track::new(&[off, PenSample { time_secs: 0.1, x_m: 0.1, ..off }]).unwrap();
    for i in 0..=100 {
        let touch = track.touch_at(f64::from(i) * 1e-3);
        assert_eq!(touch, Touch { x_m: touch.x_m, ..Touch::default() });
    }
}
