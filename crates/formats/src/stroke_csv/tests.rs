use super::{StrokeCsvError, is_stroke_table, read_stroke_csv, stroke_csv};
use crate::stroke::{PenSample, PressUnit, Stroke, TimedContact};
use proptest::prelude::{any, prop, proptest};

fn contacts(text: &str) -> Vec<TimedContact> {
    match read_stroke_csv(text.as_bytes()).unwrap().value {
        Stroke::Contacts(contacts) => contacts,
        Stroke::Pen { .. } => panic!("a pen stroke, not contacts"),
    }
}

#[track_caller]
fn check_error(text: &str, words: &str) {
    let message = read_stroke_csv(text.as_bytes()).unwrap_err().to_string();
    assert!(message.contains(words), "{message}");
}

#[test]
fn the_same_stroke_in_every_dialect() {
    let expected = contacts("t_s,speed,force\n0,50,0.5\n0.5,100,1\n");
    let second = TimedContact { time_secs: 0.5, speed_mps: 0.1, force_n: 1.0, impact_mps: None };
    assert_eq!(expected[1], second);
    for text in [
        "0,50,0.5\n0.5,100,1",
        "\u{feff}Time (ms); Speed (mm/s); Force (N)\r\n0;50;0,5\r\n500;100;1\r\n",
        "sep=|\r\nt_s|speed|force\r\n0|50|0,5\r\n0,5|100|1\r\n",
        "t_s,speed,force\n0,50,\"0,5\"\n\"0,5\",100,1\n",
        "t\tforce_n\tspeed_mm_per_s\n10\t0.5\t50\n10.5\t1\t100\n\n",
        "v,f,t_ms,note_touching\n".replace("note_touching", "touching").as_str(),
    ] {
        if text.starts_with("v,") {
            let with_rows = format!("{text}50,0.5,0,1\n100,1,500,1\n");
            assert_eq!(contacts(&with_rows), expected);
        } else {
            assert_eq!(contacts(text), expected, "{text}");
        }
    }
}

#[test]
fn strokes_of_unicode_text_are_read() {
    let wide: Vec<u8> =
        "\u{feff}t_s\tspeed\tforce\r\n0\t50\t0,5\r\n".encode_utf16().flat_map(u16::to_le_bytes).collect();
    let expected = read_stroke_csv(b"t_s,speed,force\n0,50,0.5\n").unwrap();
    assert_eq!(read_stroke_csv(&wide).unwrap(), expected);
    let error = read_stroke_csv(b"t_s,speed,force\n0,50,\xff\n").unwrap_err().to_string();
    assert!(error.contains("line 2 is not valid UTF-8"), "{error}");
}

#[test]
fn pen_positions_with_pressure_or_force() {
    let pen = |text: &str| match read_stroke_csv(text.as_bytes()).unwrap().value {
        Stroke::Pen { samples, press_unit } => (samples, press_unit),
        Stroke::Contacts(_) => panic!("contacts, not a pen stroke"),
    };
    let (samples, unit) = pen("t_ms,x,y,pressure\n0,10,20,0.5\n8,11,20,0\n");
    assert_eq!(unit, PressUnit::FullScale);
    assert_eq!((samples[1].time_secs, samples[1].x_m, samples[1].touching), (0.008, 0.011, false));
    let (samples, unit) = pen("0,10,20,1.5\n0.008,11,20,2\n");
    assert_eq!((unit, samples[0].press, samples[0].touching), (PressUnit::Newtons, 1.5, true));
    let (samples, _) = pen("t_s,x_mm,y_mm,force,touching\n0,10,20,1.5,0\n");
    assert!(!samples[0].touching);
}

#[test]
fn impact_speeds_are_read_where_they_are_stated() {
    for header in ["t_s,speed,force,speed_normal", "t_s,v_mm_s,f_n,Velocity normal (mm/s)"] {
        let impacts = |rows: &str| -> Vec<Option<f64>> {
            contacts(&format!("{header}\n{rows}")).iter().map(|contact| contact.impact_mps).collect()
        };
        assert_eq!(impacts("0,0,0,200\n0.1,0,1,\n0.2,50,1,0\n"), [Some(0.2), None, Some(0.0)], "{header}");
    }
    let Stroke::Pen { samples, .. } =
        read_stroke_csv(b"t_s,x,y,force,speed_normal\n0,1,2,0,\n0.01,1,2,1,50\n").unwrap().value
    else {
        panic!("not a pen stroke")
    };
    assert_eq!((samples[0].impact_mps, samples[1].impact_mps), (None, Some(0.05)));
}

#[test]
fn what_was_assumed_is_said() {
    let warnings = |text: &str| read_stroke_csv(text.as_bytes()).unwrap().warnings;
    assert!(warnings("t_s,speed_mm/s,force_N\n0,50,1\n").is_empty());
    assert!(warnings("t_s,x_mm,y_mm,pressure\n0,50,1,1\n").is_empty());
    assert!(warnings("t_s,speed,force\n0,50,1\n")[0].contains("assumed: speed in mm/s, force in N"));
    assert!(warnings("t_s,x,y,force_n\n0,50,1,1\n")[0].contains("assumed: x in mm, y in mm ("));
    assert!(warnings("t_s,x_mm,y_mm,force_n,speed_normal\n0,50,1,1,\n").is_empty());
    let said = warnings("t_s,speed,force_n,speed_normal\n0,50,1,\n");
    assert!(said[0].contains("assumed: speed in mm/s, speed_normal in mm/s ("), "{said:?}");
    assert!(warnings("t_s,speed_m/s,force_n,speed_normal\n0,0.05,1,\n").is_empty());
    let guessed = warnings("0,50,1\n1,50,1\n");
    assert!(guessed[0].contains("time, speed in mm/s, force in N") && guessed[1].contains("seconds"));
    assert!(warnings("t,speed,force\n0,50,1\n1000,50,1\n")[0].contains("milliseconds"));
}

#[test]
fn units_of_the_header_are_those_of_recordings() {
    let expected = contacts("t_s,speed_mm/s,force_N,speed_normal_mm/s\n0,50,0.5,200\n0.5,100,1,\n");
    assert_eq!((expected[0].speed_mps, expected[0].impact_mps), (0.05, Some(0.2)));
    for (header, rows) in [
        ("t_ms,speed_m/s,force_mN,speed_normal (m/s)", "0,0.05,500,0.2\n500,0.1,1000,\n"),
        ("Time [us];v_mps;f_n;v_normal_cm/s", "0;0.05;0.5;20\n500000;0.1;1;\n"),
        // Without a unit, this speed has that of the other one.
        ("t_s,velocity (cm/s),force,speed_normal", "0,5,0.5,20\n0.5,10,1,\n"),
    ] {
        for (got, expected) in contacts(&format!("{header}\n{rows}")).iter().zip(&expected) {
            let numbers =
                |of: &TimedContact| [of.time_secs, of.speed_mps, of.force_n, of.impact_mps.unwrap_or(9.0)];
            // Two decimal units of one value differ by a rounding error.
            let is_equal = numbers(got).iter().zip(numbers(expected)).all(|(a, b)| (a - b).abs() < 1e-12);
            assert!(is_equal, "{header}: {got:?} for {expected:?}");
        }
    }
    let Stroke::Pen { samples, .. } = read_stroke_csv(b"t_s,x_m,y_um,force\n0,0.01,500,1\n").unwrap().value
    else {
        panic!("not a pen stroke")
    };
    assert!((samples[0].x_m - 0.01).abs() < 1e-15 && (samples[0].y_m - 5e-4).abs() < 1e-15);
    check_error("t,speed_km/h,force\n0,1,1\n", "speed_km/h");
}

#[test]
fn speeds_that_look_like_meters_per_second_are_asked_for() {
    let warnings = |text: &str| read_stroke_csv(text.as_bytes()).unwrap().warnings.join("; ");
    let asked = "did you mean 0.100 m/s? Then name the column speed_m/s";
    for text in ["time,v,f\n0,0.1,1\n4,0.1,1\n", "0,0.1,1\n4,0.1,1\n", "t_s,v,f\n0,0,1\n1,0.1,1\n2,90,0\n"] {
        assert!(warnings(text).contains(asked), "{text}: {}", warnings(text));
    }
    for text in
        ["t_s,v,f\n0,10,1\n1,20,1\n", "t_s,v_mm/s,f\n0,0.1,1\n", "t_s,v_m/s,f\n0,0.1,1\n", "t_s,v,f\n0,0,1\n"]
    {
        assert!(!warnings(text).contains("did you mean"), "{text}: {}", warnings(text));
    }
}

#[test]
fn rows_of_positions_that_are_far_apart_are_said() {
    let warnings = |interval_ms: u32| {
        let rows = (0..5).fold("t_ms,x_mm,y_mm,force_n\n".to_owned(), |text, i| {
            text + &format!("{},{i},0,1\n", i * interval_ms)
        });
        read_stroke_csv(rows.as_bytes()).unwrap().warnings
    };
    assert!(warnings(40).is_empty());
    assert!(warnings(1000)[0].starts_with("the rows are 1.000 s apart"), "{:?}", warnings(1000));
}

#[test]
fn damage_is_named_with_its_line() {
    check_error("", "no rows");
    check_error("t,speed,force\n", "no rows");
    check_error("t,speed\n0,1\n", "no column");
    check_error("t,banana,force\n0,1,1\n", "banana");
    check_error("1,2\n", "2 columns");
    check_error("t,speed,force\n0,50,1\n1,50\n", "line 3 has 2 values");
    check_error("t,speed,force\n0,50,1\n1,NaN,1\n", "speed in line 3 is \"NaN\"");
    check_error("NaN,50,1\n", "time in line 1 is \"NaN\"");
    check_error("t,speed,force\n0,50,inf\n", "force in line 2");
    check_error("t,speed,force\n0,-50,1\n", "speed in line 2 is -50");
    check_error("t,speed,force,speed_normal\n0,50,1,-1\n", "speed_normal in line 2 is -1");
    check_error("t,speed,force,speed_normal\n0,50,1,fast\n", "speed_normal in line 2 is \"fast\"");
    check_error("t,speed_tangential,force\n0,50,1\n", "speed_tangential");
    check_error("t,x,y,pressure\n0,1,1,512\n", "must be 0 to 1");
    check_error("t,speed,force\n1,50,1\n1,50,1\n", "line 3");
    let back = read_stroke_csv(b"t,speed,force\n1,50,1\n0,50,1\n").unwrap_err();
    assert_eq!(back, StrokeCsvError::TimeGoesBack { line: 3, before: 1.0, time: 0.0 });
}

proptest! {
    #[test]
    fn mutated_bytes_never_panic(edits in prop::collection::vec((any::<prop::sample::Index>(), any::<u8>()), 1..20)) {
        for text in ["t_ms,x,y,pressure\n0,10,20,0.5\n8,11,20,0\n", "0;50;0,5\r\n500;100;1\r\n"] {
            let mut bytes = text.as_bytes().to_vec();
            for (at, byte) in &edits {
                let at = at.index(bytes.len());
                bytes[at] = *byte;
            }
            let _ = read_stroke_csv(&bytes);
        }
    }
}

#[test]
fn what_is_written_is_read_again() {
    for press_unit in [PressUnit::FullScale, PressUnit::Newtons] {
        let samples: Vec<PenSample> = (0..200)
            .map(|i| PenSample {
                time_secs: f64::from(i) / 133.0,
                x_m: 0.03 * (f64::from(i) * 0.1).sin(),
                y_m: -0.001 * f64::from(i),
                press: if i % 50 < 5 { 0.0 } else { 0.5 + 0.002 * f64::from(i % 100) },
                touching: i % 50 >= 5,
                impact_mps: (i % 50 == 5).then_some(0.125),
            })
            .collect();
        let read = read_stroke_csv(stroke_csv(&samples, press_unit).as_bytes()).unwrap();
        let Stroke::Pen { samples: again, press_unit: again_unit } = read.value else {
            panic!("not a pen stroke")
        };
        assert_eq!((again_unit, again.len(), read.warnings.len()), (press_unit, 200, 0));
        for (a, b) in samples.iter().zip(&again) {
            // The conversion multiplies by 1e3 and by 1e-3.
            assert!((a.x_m - b.x_m).abs() < 1e-16 && (a.y_m - b.y_m).abs() < 1e-16);
            assert_eq!((a.time_secs, a.press, a.touching), (b.time_secs, b.press, b.touching));
            assert_eq!(a.impact_mps, b.impact_mps);
        }
    }
}

#[test]
fn of_samples_at_one_time_the_last_is_written() {
    let sample =
        |time_secs, x_m| PenSample { time_secs, x_m, y_m: 0.0, press: 1.0, touching: true, impact_mps: None };
    let text = stroke_csv(&[sample(5.0, 0.001), sample(5.0, 0.002), sample(5.5, 0.003)], PressUnit::Newtons);
    assert_eq!(text, "t_s,x_mm,y_mm,force_n,touching\n0,2,0,1,1\n0.5,3,0,1,1\n");
}

#[test]
fn a_stroke_is_told_by_its_header_where_no_recording_has_the_same() {
    for stroke in [
        "t_s,x_mm,y_mm,force_n,touching\n0,0,0,1,1\n",
        "t_s,x_mm,y_mm,force_n\n",
        "\u{feff}Time (ms);x;y;pressure\r\n0;1;2;0,5",
        "sep=;\nt;speed;force\n",
        "t,v,f",
        "t,x,y,force,touching",
        "t,x,y,force,speed_normal",
    ] {
        assert!(is_stroke_table(stroke.as_bytes()), "{stroke}");
    }
    for other in [
        "t,x,y,force\n0,0,0,1\n",
        "t,x,y,speed,force\n",
        "time_s,acc,speed_mm/s,force_N\n",
        "t,x,y,z\n",
        "0,50,0.5\n",
        "participant,texture,group\n",
        "",
        "\n\n",
        "\u{0}\u{1}",
    ] {
        assert!(!is_stroke_table(other.as_bytes()), "{other}");
    }
    let sample =
        PenSample { time_secs: 0.0, x_m: 0.0, y_m: 0.0, press: 0.5, touching: true, impact_mps: None };
    for unit in [PressUnit::Newtons, PressUnit::FullScale] {
        assert!(is_stroke_table(stroke_csv(&[sample], unit).as_bytes()));
    }
}
