//! The strokes of recordings, as a network takes them.

use shagreen_core::filter::resample;
use shagreen_core::fit::Segment;
use shagreen_core::patterns::PAPER_RATE;
use shagreen_core::recording::Recording;
use shagreen_learn::stroke_set::Stroke;

/// Segments that lie closer together than this are one stroke, in seconds.
const LARGEST_GAP_SECS: f64 = 1e-3;

/// What of the recordings lies within these segments, where the tip was on the surface and moved: at the rate of the
/// network's strokes, and in one piece where segments follow each other.
pub(crate) fn recorded_strokes(recordings: &[Recording], segments: &[Segment]) -> Vec<Stroke> {
    let mut strokes = Vec::new();
    for (index, recording) in recordings.iter().enumerate() {
        let stretches = stretches(segments, index);
        for usable in &recording.usable {
            // As a whole, so that only its ends are ends.
            let column = |values: &[f64]| resample(&values[usable.clone()], recording.rate, PAPER_RATE);
            let accel = column(&recording.acceleration_mps2);
            let (speed, force) = (column(&recording.speed_mps), column(&recording.force_n));
            let begin_secs = usable.start as f64 / recording.rate.0;
            let at =
                |secs: f64| (((secs - begin_secs) * PAPER_RATE.0).round().max(0.0) as usize).min(accel.len());
            for [from, to] in stretches.iter().map(|stretch| stretch.map(at)) {
                if from < to {
                    strokes.push(Stroke {
                        accel_mps2: accel[from..to].to_vec(),
                        speed_mps: speed[from..to].to_vec(),
                        force_n: force[from..to].to_vec(),
                    });
                }
            }
        }
    }
    strokes
}

/// Begin and end of what the segments of a recording cover without a gap, in seconds.
fn stretches(segments: &[Segment], recording: usize) -> Vec<[f64; 2]> {
    let of_it = segments.iter().filter(|segment| segment.recording == recording);
    let mut times: Vec<[f64; 2]> =
        of_it.map(|segment| [segment.start_secs, segment.start_secs + segment.seconds]).collect();
    times.sort_by(|a, b| a[0].total_cmp(&b[0]));
    let mut stretches: Vec<[f64; 2]> = Vec::new();
    for [begin, end] in times {
        match stretches.last_mut() {
            Some(last) if begin <= last[1] + LARGEST_GAP_SECS => last[1] = last[1].max(end),
            _ => stretches.push([begin, end]),
        }
    }
    stretches
}

#[cfg(test)]
mod tests {
    use super::recorded_strokes;
    use shagreen_core::fit::{Comparison, Segment};
    use shagreen_core::recording::Recording;
    use shagreen_core::units::{Hertz, MetersPerSecond, Newtons};

    fn segment(start_secs: f64, seconds: f64) -> Segment {
        Segment {
            recording: 0,
            start_secs,
            seconds,
            speed: MetersPerSecond(0.1),
            force: Newtons(1.0),
            level_mps2: 1.0,
            comparison: Comparison {
                measured_psd: Vec::new(),
                model_psd: Vec::new(),
                gfc: 1.0,
                level_error_db: 0.0,
            },
        }
    }

    #[test]
    fn segments_that_follow_each_other_are_one_stroke_at_another_rate() {
        let n = 4000;
        let mut recording = Recording {
            rate: Hertz(2000.0),
            acceleration_mps2: (0..n).map(|i| (f64::from(i) * 0.05).sin()).collect(),
            speed_mps: (0..n).map(|i| f64::from(i) * 1e-4).collect(),
            force_n: vec![0.5; n as usize],
            usable: vec![0..1000, 1100..4000],
        };
        for i in 1000..1100 {
            recording.acceleration_mps2[i] = f64::NAN;
        }
        let segments = [segment(0.1, 0.2), segment(0.3, 0.15), segment(0.8, 0.3), segment(1.9, 0.2)];
        let strokes = recorded_strokes(&[recording], &segments);
        let lengths: Vec<usize> = strokes.iter().map(|stroke| stroke.accel_mps2.len()).collect();
        // What would go beyond the end is cut.
        assert_eq!(lengths, [350, 300, 100]);
        for stroke in &strokes {
            assert!(stroke.accel_mps2.iter().all(|x| x.is_finite()));
            assert_eq!([stroke.speed_mps.len(), stroke.force_n.len()], [stroke.accel_mps2.len(); 2]);
        }
        // The sample at 0.9 s, as it was.
        assert!((strokes[1].speed_mps[100] - 0.18).abs() < 1e-6);
        assert!((strokes[1].accel_mps2[100] - (1800.0_f64 * 0.05).sin()).abs() < 1e-2);
    }
}
