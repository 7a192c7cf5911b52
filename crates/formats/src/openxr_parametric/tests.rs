use proptest::prelude::{prop_assert_eq, proptest};

use super::{
    CallV1, FrameV1, MAX_POINTS, OpenXrParametricV1, PointV1, TransientV1, openxr_parametric,
    write_openxr_parametric,
};
use crate::clip_scale::ClipScale;
use crate::haptic_clip::{AmplitudePoint, Emphasis, FrequencyPoint, HapticClip};

fn point(time_secs: f64, amplitude: f64) -> AmplitudePoint {
    AmplitudePoint { time_secs, amplitude, emphasis: None }
}

fn of(clip: &HapticClip) -> OpenXrParametricV1 {
    openxr_parametric(clip, ClipScale::new(2.5, None), ("test", "a clip"))
}

/// Returns the rule of the extension that the calls break.
fn broken_rule(calls: &[CallV1]) -> Option<&'static str> {
    let ends = |call: &CallV1| call.amplitude.last().map(|point| point.time_ns);
    for (index, call) in calls.iter().enumerate() {
        let expected = match (calls.len(), index) {
            (1, _) => FrameV1::None,
            (_, 0) => FrameV1::First,
            (n, index) if index + 1 == n => FrameV1::Last,
            _ => FrameV1::Intermediate,
        };
        let counts = [call.amplitude.len(), call.frequency.len(), call.transients.len()];
        let least = if index == 0 { 2 } else { 1 };
        let starts = [call.amplitude.first(), call.frequency.first()];
        let times = call.frequency.iter().map(|point| point.time_ns);
        let mut times = times.chain(call.transients.iter().map(|transient| transient.time_ns));
        if call.frame != expected {
            return Some("the frames of a stream follow each other");
        }
        if counts.into_iter().any(|n| n > MAX_POINTS) || call.amplitude.len() < least {
            return Some("the number of points");
        }
        if index == 0 && !starts.into_iter().flatten().all(|point| point.time_ns == 0) {
            return Some("the first points are at 0");
        }
        if times.any(|time_ns| Some(time_ns) > ends(call)) {
            return Some("nothing is later than the last amplitude");
        }
    }
    let joined = |of: fn(&CallV1) -> Vec<(i64, f64)>| calls.iter().flat_map(of).collect::<Vec<_>>();
    let amplitude = joined(|call| call.amplitude.iter().map(|p| (p.time_ns, p.value)).collect());
    let frequency = joined(|call| call.frequency.iter().map(|p| (p.time_ns, p.value)).collect());
    let transients = joined(|call| call.transients.iter().map(|t| (t.time_ns, t.amplitude)).collect());
    let is_sorted = [&amplitude, &frequency].iter().all(|points| points.is_sorted_by(|a, b| a.0 <= b.0));
    if !is_sorted || !transients.is_sorted_by(|a, b| a.0 < b.0) {
        return Some("times ascend, also from call to call");
    }
    let in_range = |(_, value): &(i64, f64)| (0.0..=1.0).contains(value);
    let all = amplitude.iter().chain(&frequency).chain(&transients);
    if all.into_iter().all(in_range) { None } else { Some("values are from 0 to 1") }
}

#[test]
fn a_short_clip_is_one_call() {
    let emphasis = Some(Emphasis { amplitude: 0.75, frequency: 1.0 });
    let clip = HapticClip {
        amplitude: vec![point(0.5, 0.25), AmplitudePoint { emphasis, ..point(1.0, 0.5) }, point(2.0, 0.0)],
        frequency: vec![FrequencyPoint { time_secs: 1.0, frequency: 0.125 }],
        ..HapticClip::default()
    };
    let made = of(&clip);
    assert_eq!((made.min_frequency_hz, made.max_frequency_hz, made.head.seconds), (60.0, 300.0, 1.5));
    let [call] = &made.calls[..] else { panic!("{:?}", made.calls) };
    let second = 1_000_000_000;
    let at = |time_ns, value| PointV1 { time_ns, value };
    assert_eq!(call.amplitude, [at(0, 0.25), at(second / 2, 0.5), at(3 * second / 2, 0.0)]);
    assert_eq!(call.frequency, [at(0, 0.125), at(second / 2, 0.125)]);
    assert_eq!(call.transients, [TransientV1 { time_ns: second / 2, amplitude: 0.75, frequency: 1.0 }]);
    assert_eq!(broken_rule(&made.calls), None);
    let back: OpenXrParametricV1 = serde_json::from_slice(&write_openxr_parametric(&made)).unwrap();
    assert_eq!(back, made);
    let text = String::from_utf8(write_openxr_parametric(&made)).unwrap();
    assert!(text.contains("\"frame\": \"none\""), "{text}");
    // A clip without frequencies has the usual one.
    let bare = of(&HapticClip { frequency: Vec::new(), ..clip });
    assert_eq!(bare.calls[0].frequency, [at(0, 0.5)]);
}

/// Negative controls of [`broken_rule`].
#[test]
fn broken_rules_are_found() {
    let clip = HapticClip { amplitude: vec![point(0.0, 0.5), point(1.0, 0.5)], ..HapticClip::default() };
    let call = of(&clip).calls.remove(0);
    let with = |change: fn(&mut CallV1)| {
        let mut call = call.clone();
        change(&mut call);
        broken_rule(&[call])
    };
    assert_eq!(with(|_| ()), None);
    assert!(with(|call| call.frame = FrameV1::First).is_some());
    assert!(with(|call| call.amplitude.truncate(1)).is_some());
    assert!(with(|call| call.amplitude[0].time_ns = 1).is_some());
    assert!(with(|call| call.amplitude[1].value = 1.5).is_some());
    assert!(with(|call| call.frequency[0].time_ns = 2_000_000_000).is_some());
    assert!(with(|call| call.amplitude.swap(0, 1)).is_some());
}

/// A clip with this many points of each kind, and some emphases.
fn clip(n_amplitude: usize, n_frequency: usize, emphasis_every: usize) -> HapticClip {
    let end_secs = 20.0;
    let secs = |i: usize, n: usize| end_secs * i as f64 / (n - 1) as f64;
    let amplitude = (0..n_amplitude).map(|i| {
        let amplitude = 0.5 * (i % 11) as f64 / 11.0;
        let emphasis = Emphasis { amplitude: 1.0, frequency: 0.5 };
        let emphasis = i.is_multiple_of(emphasis_every).then_some(emphasis);
        AmplitudePoint { emphasis, ..point(secs(i, n_amplitude), amplitude) }
    });
    let frequency = (0..n_frequency)
        .map(|i| FrequencyPoint { time_secs: secs(i, n_frequency), frequency: (i % 7) as f64 / 7.0 });
    HapticClip { amplitude: amplitude.collect(), frequency: frequency.collect(), ..HapticClip::default() }
}

#[test]
fn what_fits_into_a_call_stays_in_it() {
    for (n_amplitude, n_frequency, n_calls) in
        [(500, 500, 1), (501, 2, 2), (2, 501, 2), (998, 2, 2), (999, 2, 3), (1400, 1700, 4)]
    {
        let made = of(&clip(n_amplitude, n_frequency, usize::MAX));
        assert_eq!(made.calls.len(), n_calls, "{n_amplitude} and {n_frequency} points");
        assert_eq!(broken_rule(&made.calls), None);
    }
}

proptest! {
    /// The calls keep the rules, and contain all points of the clip and only points of its lines.
    #[test]
    fn calls_are_the_clip(n_amplitude in 2..1200_usize, n_frequency in 2..1200_usize, every in 1..4_usize) {
        let clip = clip(n_amplitude, n_frequency, every);
        let made = of(&clip);
        prop_assert_eq!(broken_rule(&made.calls), None);
        let amplitude: Vec<PointV1> = made.calls.iter().flat_map(|call| call.amplitude.clone()).collect();
        let n_more = made.calls.len() - 1;
        assert!((clip.amplitude.len()..=clip.amplitude.len() + n_more).contains(&amplitude.len()));
        for original in &clip.amplitude {
            let time_ns = (1e9 * original.time_secs).round() as i64;
            let found = amplitude.binary_search_by_key(&time_ns, |point| point.time_ns);
            prop_assert_eq!(found.map(|index| amplitude[index].value), Ok(original.amplitude));
        }
        let n_frequency_made: usize = made.calls.iter().map(|call| call.frequency.len()).sum();
        prop_assert_eq!(n_frequency_made, clip.frequency.len());
        let n_emphases = clip.amplitude.iter().filter(|point| point.emphasis.is_some()).count();
        prop_assert_eq!(made.calls.iter().map(|call| call.transients.len()).sum::<usize>(), n_emphases);
    }
}
