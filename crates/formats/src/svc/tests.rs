use super::{PenFlavor, PenMapping, SvcError, pen_samples, read_svc};
use proptest::prelude::{any, prop, proptest};

const RAW: &str = "3\n4034 7509 354642400 1 1190 720 10852\n4034 7709 354642408 1 1180 700 32767\n4150 7582 354642416 0 1170 690 0\n";
const NORMALIZED: &str =
    "2\r\n52.81 81.31 0.000000 1 510.0 520.0 0.0\r\n52.83 81.31 0.007000 1 510.0 520.0 0.5\r\n";

#[track_caller]
fn check_error(text: &str, expected: &SvcError, words: &str) {
    let error = read_svc(text.as_bytes()).unwrap_err();
    assert_eq!(&error, expected);
    assert!(error.to_string().contains(words), "{error}");
}

#[test]
fn raw_counts_become_si() {
    let recording = read_svc(RAW.as_bytes()).unwrap();
    assert!(recording.warnings.is_empty());
    assert_eq!((recording.value.flavor, recording.value.n_samples()), (PenFlavor::Raw, 3));
    let samples = pen_samples(&recording.value, &PenMapping::RAW).unwrap().value;
    assert_eq!((samples[0].time_secs, samples[1].time_secs), (0.0, 0.008));
    assert!((samples[1].y_m - samples[0].y_m - 1e-3).abs() < 1e-12);
    assert_eq!((samples[1].press, samples[1].touching, samples[2].touching), (1.0, true, false));
}

#[test]
fn normalized_values_are_mm_and_seconds() {
    let recording = read_svc(NORMALIZED.as_bytes()).unwrap().value;
    assert_eq!(recording.flavor, PenFlavor::Normalized);
    let samples = pen_samples(&recording, &PenMapping::of(recording.flavor)).unwrap().value;
    assert!((samples[1].x_m - 0.05283).abs() < 1e-12);
    assert_eq!((samples[1].time_secs, samples[1].press), (0.007, 0.5));
}

#[test]
fn damage_is_named_with_its_line() {
    let first_two: String = RAW.lines().take(3).flat_map(|l| [l, "\n"]).collect();
    check_error(&first_two, &SvcError::Missing { announced: 3, found: 2 }, "damaged");
    check_error("", &SvcError::Count { found: String::new() }, "first line");
    check_error("0\n", &SvcError::Missing { announced: 0, found: 0 }, "damaged");
    let cut = &RAW[..RAW.len() - 12];
    assert!(matches!(read_svc(cut.as_bytes()), Err(SvcError::Columns { line: 4, .. })));
    let nan = RAW.replace("7709", "NaN");
    check_error(&nan, &SvcError::Number { line: 3, column: "y", found: "NaN".into() }, "y in line 3");
    let back = RAW.replace("354642416", "354642407");
    let expected = SvcError::TimeGoesBack { line: 4, before: 354_642_408.0, time: 354_642_407.0 };
    check_error(&back, &expected, "line 4");
    let headless: String = RAW.lines().skip(1).flat_map(|l| [l, "\n"]).collect();
    assert!(matches!(read_svc(headless.as_bytes()), Err(SvcError::Count { .. })));
}

#[test]
fn more_samples_than_announced_are_used_with_a_warning() {
    let recording = read_svc(RAW.replacen('3', "2", 1).as_bytes()).unwrap();
    assert_eq!(recording.value.n_samples(), 3);
    assert!(recording.warnings[0].contains("first line states 2"));
}

#[test]
fn pressures_must_fit_the_full_scale() {
    let recording = read_svc(RAW.as_bytes()).unwrap().value;
    let small = PenMapping { pressure_full_scale: 8191.0, ..PenMapping::RAW };
    let error = pen_samples(&recording, &small).unwrap_err();
    assert_eq!(error, SvcError::Pressure { line: 2, pressure: 10852.0, full_scale: 8191.0 });
    let none = PenMapping { mm_per_unit: 0.0, ..PenMapping::RAW };
    assert!(matches!(pen_samples(&recording, &none), Err(SvcError::Mapping { .. })));
    let faint = read_svc(RAW.replace("10852", "1023").replace("32767", "900").as_bytes()).unwrap().value;
    assert!(pen_samples(&faint, &PenMapping::RAW).unwrap().warnings[0].contains("1023"));
}

proptest! {
    #[test]
    fn mutated_bytes_never_panic(edits in prop::collection::vec((any::<prop::sample::Index>(), any::<u8>()), 1..20)) {
        for text in [RAW, NORMALIZED] {
            let mut bytes = text.as_bytes().to_vec();
            for (at, byte) in &edits {
                let at = at.index(bytes.len());
                bytes[at] = *byte;
            }
            if let Ok(read) = read_svc(&bytes) {
                // Samples that were read are in order, and the mapping accepts or rejects them.
                let _ = pen_samples(&read.value, &PenMapping::of(read.value.flavor));
            }
        }
    }
}
