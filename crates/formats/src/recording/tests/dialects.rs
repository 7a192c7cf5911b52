//! Tables in the dialects of various programs.

use super::{map, read};
use crate::recording::{Ask, Column, ColumnMap, read_recording};
use proptest::prelude::{any, prop, prop_assert_eq, proptest};
use shagreen_core::recording::{RawClock, RawMotion, RawTrack};
use shagreen_core::units::Hertz;

#[test]
fn the_same_recording_in_every_dialect() {
    let expected = read("t_s,a [m/s^2],v [mm/s],F [N]\n0,1.5,100,1\n0.001,-2.5,50,0.5\n", &[]);
    assert_eq!(expected.raw.clock, RawClock::Times(vec![0.0, 0.001]));
    assert_eq!(expected.raw.acceleration_mps2, [vec![1.5, -2.5]]);
    assert_eq!(expected.raw.motion, RawMotion::Speed(RawTrack::Column(vec![0.1, 0.05])));
    assert_eq!(expected.raw.force_n, RawTrack::Column(vec![1.0, 0.5]));
    assert!(expected.questions.is_empty() && expected.warnings.is_empty());
    let wide: Vec<u8> = "\u{feff}t_s;a [m/s²];v [mm/s];F [N]\n0;1,5;100;1\n0,001;-2,5;50;0,5\n"
        .encode_utf16()
        .flat_map(u16::to_le_bytes)
        .collect();
    assert_eq!(read_recording("a.csv", &wide, None, &ColumnMap::default()).unwrap().raw, expected.raw);
    for text in [
        "\u{feff}Time (ms); Acc (m/s²); Speed (cm/s); Force (mN)\r\n0;1,5;10;1000\r\n\r\n1;-2,5;5;500\r\n",
        "sep=;\r\nTime (ms); Acc (m/s²); Speed (cm/s); Force (mN)\r\n0;1,5;10;1000\r\n1;-2,5;5;500\r\n",
        "# a logger\ntime_us\tforce_n\tacc_mps2\tspeed_mps\t\n5\t1\t1.5\t0.1\t\n1005\t0.5\t-2.5\t0.05\t\n",
        "\"t\",\"a\",\"v\",\"F\"\ns,m/s2,m/s,N\n0,1.5,0.1,1\n0.001,-2.5,0.05,0.5\n",
        "t[s]   a[m/s2]  v[m/s] F[N]\n  0 1,5 0,1 1\n  0,001   -2,5 0,05 0,5\n",
    ] {
        let mut raw = read(text, &[]).raw;
        if let RawClock::Times(times) = &mut raw.clock {
            for time in times {
                *time = (*time * 1e9).round() * 1e-9;
            }
        }
        let near = |a: &[f64], b: &[f64]| a.iter().zip(b).all(|(a, b)| (a - b).abs() < 1e-12);
        assert!(near(&raw.acceleration_mps2[0], &[1.5, -2.5]), "{text}");
        let RawMotion::Speed(RawTrack::Column(speed)) = &raw.motion else { panic!("{text}") };
        let RawTrack::Column(force) = &raw.force_n else { panic!("{text}") };
        let RawClock::Times(times) = &raw.clock else { panic!("{text}") };
        assert!(
            near(speed, &[0.1, 0.05]) && near(force, &[1.0, 0.5]) && near(times, &[0.0, 0.001]),
            "{text}"
        );
    }
    let headless = [
        (Ask::RateHz, "1000"),
        (Ask::Acceleration, "1"),
        (Ask::AccelerationUnit, "g"),
        (Ask::Speed, "100 mm/s"),
        (Ask::Force, "2"),
        (Ask::ForceUnit, "N"),
    ];
    let raw = read("1 0.5\n2 0.25\n", &headless).raw;
    assert_eq!(
        (raw.clock, raw.acceleration_mps2),
        (RawClock::Rate(Hertz(1000.0)), vec![vec![9.80665, 19.6133]])
    );
}

#[test]
fn damage_is_named_with_its_place() {
    for (text, words) in [
        ("", "the file is empty"),
        ("t,a\n", "no rows"),
        ("t,a\n0,1\n1,2,3\n", "3 values where the table has 2 columns in line 3"),
        ("t,Fx,Fy,Fz,Ft\n0,1,2,3,4\n0.1,1,2,3,4\n", "no acceleration: the columns are \"t\", \"Fx\""),
        ("\0\0", "neither"),
    ] {
        let message =
            read_recording("a.csv", text.as_bytes(), None, &ColumnMap::default()).unwrap_err().to_string();
        assert!(message.contains(words), "{message}");
    }
    let error = read_recording("a.csv", b"t,a\n0,1\n", None, &map(&[(Ask::Speed, "w")])).unwrap_err();
    assert!(error.to_string().contains("no column \"w\""), "{error}");
    let twice = map(&[(Ask::Speed, "a"), (Ask::SpeedUnit, "m/s"), (Ask::AccelerationUnit, "g")]);
    let error = read_recording("a.csv", b"t_s,a\n0,1\n1,2\n", None, &twice).unwrap_err();
    assert!(error.to_string().contains("\"a\" cannot hold two quantities"), "{error}");
    // Two columns of the same name stay separate.
    let axes = read("t_s,a [g],a [g],v [m/s],f [N]\n0,1,2,1,1\n1,3,4,1,1\n", &[]);
    let again =
        [axes.map.acceleration.clone().unwrap(), vec![Column::Name("a [g]".into()), Column::Number(3)]];
    assert_eq!((axes.raw.acceleration_mps2.len(), &again[0]), (2, &again[1]));
    let lacking = format!("{}\n{}", ["c"; 900].join(","), "1\n".repeat(900));
    let error = read_recording("a.csv", lacking.as_bytes(), None, &ColumnMap::default()).unwrap_err();
    assert!(error.to_string().contains("too many lines have fewer values"), "{error}");
    let odd = "t_s,a [g],note,v [m/s],f [N]\n0,1,x,1,1\n0.001,bad,x,1,1\n0.002,1\n";
    let warnings = read(odd, &[]).warnings.join("; ");
    for words in ["1 lines have fewer", "1 cells of \"a [g]\"", "not used: \"note\""] {
        assert!(warnings.contains(words), "{warnings}");
    }
}

#[test]
fn a_table_without_numbers_is_refused_at_once() {
    // Appending every line to the names would take minutes here.
    let text = "t;a\n".to_owned() + &"0.1;2.5\n".repeat(200_000);
    let error = read_recording("a.csv", text.as_bytes(), None, &map(&[(Ask::Separator, "tab")])).unwrap_err();
    let message = error.to_string();
    assert!(
        message.contains("no rows of numbers") && message.contains("with the separator tab"),
        "{message}"
    );
}

proptest! {
    #[test]
    fn tables_in_any_dialect_give_their_numbers_back(
        rows in prop::collection::vec((-50.0..50.0_f64, 0.0..400.0_f64, 0.0..9.0_f64), 2..40),
        dialect in 0_usize..5,
        header in any::<bool>(),
    ) {
        let (separator, comma) = [(",", false), (";", false), (";", true), ("\t", true), ("  ", false)][dialect];
        let mut text = if header { ["t", "a", "v", "f"].join(separator) + "\n" } else { String::new() };
        for (row, (a, v, f)) in rows.iter().enumerate() {
            let fields = [row as f64 + 0.5, *a, *v, *f].map(|value| {
                let written = format!("{value:?}");
                if comma { written.replace('.', ",") } else { written }
            });
            text += &(fields.join(separator) + "\n");
        }
        let file = read(&text, &[(Ask::Time, "1"), (Ask::TimeUnit, "ms"), (Ask::Acceleration, "2"),
            (Ask::AccelerationUnit, "m/s^2"), (Ask::Speed, "3"), (Ask::SpeedUnit, "m/s"), (Ask::Force, "4"),
            (Ask::ForceUnit, "N"), (Ask::PressingIsNegative, "no")]);
        let column = |pick: fn(&(f64, f64, f64)) -> f64| rows.iter().map(pick).collect::<Vec<f64>>();
        prop_assert_eq!(&file.raw.acceleration_mps2[0], &column(|row| row.0));
        prop_assert_eq!(file.raw.motion, RawMotion::Speed(RawTrack::Column(column(|row| row.1))));
        prop_assert_eq!(file.raw.force_n, RawTrack::Column(column(|row| row.2)));
    }
}
