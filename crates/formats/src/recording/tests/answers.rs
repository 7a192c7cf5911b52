//! Questions and guesses.

use super::{map, open, read};
use crate::recording::{AccelerationUnit, Ask, ColumnMap, TimeUnit, read_recording};
use shagreen_core::recording::RawTrack;

#[test]
fn what_is_not_said_is_asked() {
    let answers = [(Ask::Speed, "100 mm/s"), (Ask::Force, "1 N")];
    assert_eq!(open(b"t_s,ax\n0,1\n0.001,2\n", &[]), [Ask::AccelerationUnit, Ask::Speed, Ask::Force]);
    assert_eq!(open(b"t_s,x,y,z\n0,1,2,3\n0.001,1,2,4\n", &[])[0], Ask::Acceleration);
    assert_eq!(open(b"ax [g]\n1\n2\n", &answers), [Ask::RateHz]);
    assert_eq!(open(b"1,2\n1,3\n", &answers), [Ask::RateHz, Ask::Acceleration]);
    assert_eq!(open(b"t_s,ax [g],x,y\n0,1,2,3\n0.001,1,2,4\n", &[(Ask::Force, "1 N")]), [Ask::PositionUnit]);
    let error = read_recording("a.csv", b"t,ax\n0,1\n0.01,2\n", None, &ColumnMap::default()).unwrap_err();
    let message = error.to_string();
    for words in ["acceleration_unit", "speed", "force", "rate too low: 100 Hz"] {
        assert!(message.contains(words) && !message.contains('\n'), "{message}");
    }
}

#[test]
fn guesses_are_said_and_physics_decides_them() {
    let row = |row: i32| format!("{row},{},0.01,0.99,{},-1.5", 0.02 * f64::from(row % 2), 100 + row % 3);
    let text = format!("time,ax,ay,az,v,fz\n{}\n", (0..100).map(row).collect::<Vec<_>>().join("\n"));
    let read_file = read(&text, &[]);
    let guessed: Vec<(Ask, &str)> =
        read_file.questions.iter().map(|q| (q.what, q.guess.as_deref().unwrap())).collect();
    assert_eq!(
        guessed,
        [
            (Ask::TimeUnit, "ms"),
            (Ask::AccelerationUnit, "g"),
            (Ask::SpeedUnit, "mm/s"),
            (Ask::Force, "6"),
            (Ask::ForceUnit, "N"),
            (Ask::PressingIsNegative, "yes")
        ]
    );
    assert_eq!(read_file.map.acceleration_unit, Some(AccelerationUnit::StandardGravity));
    assert_eq!(read_file.raw.force_n, RawTrack::Column(vec![1.5; 100]));
    // Reading again with the resulting map gives the same result without questions.
    let again = read_recording("a.csv", text.as_bytes(), None, &read_file.map).unwrap();
    assert_eq!((again.raw, again.questions.len()), (read_file.raw, 0));
}

#[test]
fn the_later_of_a_constant_and_a_column_counts() {
    let both = map(&[(Ask::Speed, "100 mm/s"), (Ask::Speed, "v"), (Ask::Force, "f"), (Ask::Force, "1 N")]);
    assert!(both.constant_speed.is_none() && both.speed.is_some());
    assert!(both.constant_force.is_some() && both.force.is_none());
    assert!(map(&[(Ask::Speed, "1 m/s"), (Ask::Positions, "x")]).constant_speed.is_none());
}

#[test]
fn a_table_without_a_time_column_names_the_columns_that_it_may_be() {
    let text =
        "Zeit (ms),acc [g],note,speed (mm/s),force (N)\n0,1,7,100,1\n1,2,7,100,1\n2,1,7,100,1\n3,2,7,100,1\n";
    let message =
        read_recording("eu.csv", text.as_bytes(), None, &ColumnMap::default()).unwrap_err().to_string();
    assert!(message.contains("there is no time column") && message.contains("state it in Hz"), "{message}");
    assert!(
        message.contains("time=\"Zeit (ms)\" (columns of unknown meaning: \"Zeit (ms)\", \"note\")"),
        "{message}"
    );
    // Its unit is in its name, so it is not guessed.
    let file = read(text, &[(Ask::Time, "Zeit (ms)")]);
    assert!(file.questions.is_empty(), "{:?}", file.questions);
    assert_eq!(file.map.time_unit, Some(TimeUnit::Milliseconds));
    // A table whose columns all have a meaning has no other candidates.
    let text = "acc [g],speed (mm/s),force (N)\n1,100,1\n2,100,1\n";
    let message =
        read_recording("a.csv", text.as_bytes(), None, &ColumnMap::default()).unwrap_err().to_string();
    assert!(message.contains("state it in Hz") && !message.contains("unknown meaning"), "{message}");
}

#[test]
fn a_file_without_rows_is_called_empty() {
    for (text, words) in [
        ("", "the file is empty"),
        ("\n  \n", "the file is empty"),
        ("t_s,acc_g,speed_mm/s,force_N\n", "the table has a header, but no rows of numbers"),
    ] {
        let error = read_recording("a.csv", text.as_bytes(), None, &ColumnMap::default()).unwrap_err();
        assert!(error.to_string().starts_with(words), "{error}");
    }
}
