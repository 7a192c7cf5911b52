use std::fmt::Write as _;
use std::path::Path;

use shagreen_core::recording::{RawMotion, RawTrack, Recording};
use shagreen_core::units::{MetersPerSecond, Newtons};

use super::{StrokeBytes, StrokeFolderError, StrokeName, find_strokes, read_stroke, unused_others};

/// Acceleration in g at 6 kHz for half a second, with gravity along z.
fn acceleration() -> String {
    let mut text = String::from("time,X,Y,Z\n");
    for i in 0..3000 {
        let t = f64::from(i) / 6000.0;
        let wave = 0.05 * (1200.0 * t).sin() + 0.02 * (0.37 * f64::from(i * i % 977)).sin();
        writeln!(text, "{t:.6},{wave:.5},{:.5},{:.5}", 0.5 * wave, 1.0 + 0.3 * wave).unwrap();
    }
    text
}

/// Table at 100 Hz of a function of the time, for half a second and some rows more.
fn slow(header: &str, row: impl Fn(f64) -> String) -> String {
    (0..53).map(|i| 0.01 * f64::from(i)).fold(format!("{header}\n"), |text, t| text + &row(t) + "\n")
}

fn name() -> StrokeName {
    StrokeName {
        texture: "cork".to_owned(),
        direction: "45".to_owned(),
        speed: MetersPerSecond(0.02),
        force: Newtons(0.2),
        repeat: 1,
    }
}

fn bytes<'a>(acceleration: &'a str, force: Option<&'a str>, position: Option<&'a str>) -> StrokeBytes<'a> {
    let [force, position] = [force, position].map(|text| text.map(str::as_bytes));
    StrokeBytes { acceleration: acceleration.as_bytes(), force, position }
}

#[test]
fn three_files_are_one_recording() {
    let force = slow("time,force", |t| format!("{t:.2},0.21"));
    let position = slow("time,X,Y", |t| format!("{t:.2},{:.4},{:.4}", 14.142 * t, 14.142 * t));
    let acceleration = acceleration();
    let stroke = read_stroke(&name(), &bytes(&acceleration, Some(&force), Some(&position))).unwrap();
    assert_eq!(stroke.warnings, [""; 0]);
    assert!((stroke.direction_rad.unwrap().to_degrees() - 45.0).abs() < 0.1);
    let (recording, _) = Recording::from_raw(stroke.raw).unwrap();
    // The times are rounded to a microsecond.
    assert!((recording.rate.0 - 6000.0).abs() < 0.1, "{}", recording.rate);
    let middle = recording.acceleration_mps2.len() / 2;
    assert!((recording.speed_mps[middle] - 0.02).abs() < 2e-5, "{}", recording.speed_mps[middle]);
    assert!((recording.force_n[middle] - 0.21).abs() < 1e-9);
    // Gravity in m/s².
    let mean = recording.acceleration_mps2.iter().sum::<f64>() / recording.acceleration_mps2.len() as f64;
    assert!((mean - 9.81).abs() < 0.05, "{mean}");
}

#[test]
fn what_is_missing_is_that_of_the_name() {
    let acceleration = acceleration();
    let stroke = read_stroke(&name(), &bytes(&acceleration, None, None)).unwrap();
    assert_eq!(stroke.warnings.len(), 2, "{:?}", stroke.warnings);
    assert!(
        stroke.warnings.iter().any(|w| w == "there is no force file; the force of the file name is used")
    );
    assert_eq!(stroke.raw.motion, RawMotion::Speed(RawTrack::Constant(0.02)));
    assert_eq!((stroke.raw.force_n, stroke.direction_rad), (RawTrack::Constant(0.2), None));
    // A file of another time is no better than none.
    let late = slow("time,force", |t| format!("{:.2},0.2", t + 100.0));
    let stroke = read_stroke(&name(), &bytes(&acceleration, Some(&late), None)).unwrap();
    assert_eq!(stroke.raw.force_n, RawTrack::Constant(0.2));
    assert!(stroke.warnings[0].contains("do not cover"), "{:?}", stroke.warnings);
}

#[test]
fn only_common_times_are_used() {
    let acceleration = acceleration();
    let force = slow("time,force", |t| format!("{:.2},0.2", t + 0.1));
    let stroke = read_stroke(&name(), &bytes(&acceleration, Some(&force), None)).unwrap();
    let RawTrack::Column(force_n) = &stroke.raw.force_n else { panic!("{:?}", stroke.raw.force_n) };
    // 0.1 s to 0.5 s at 6 kHz.
    assert_eq!((force_n.len(), stroke.raw.acceleration_mps2[0].len()), (2400, 2400));
    assert!(force_n.iter().all(|force| (force - 0.2).abs() < 1e-9));
}

#[test]
fn an_odd_force_is_said() {
    let acceleration = acceleration();
    let said = |force: &str| {
        let stroke = read_stroke(&name(), &bytes(&acceleration, Some(force), None)).unwrap();
        (stroke.warnings.join("; "), stroke.raw.force_n)
    };
    let (warning, force_n) = said(&slow("time,force", |t| format!("{t:.2},-0.2")));
    assert!(warning.contains("sign was changed"), "{warning}");
    assert!(matches!(force_n, RawTrack::Column(values) if values[100] > 0.0));
    let (warning, _) = said(&slow("time,force", |t| format!("{t:.2},200")));
    assert!(warning.contains("more than twice"), "{warning}");
    let (warning, force_n) = said(&slow("time,force", |t| format!("{t:.2},{:.3}", (60.0 * t).sin())));
    assert!(warning.contains("part of the time"), "{warning}");
    assert_eq!(force_n, RawTrack::Constant(0.2));
}

#[test]
fn a_damaged_file_says_which_and_where() {
    let acceleration = acceleration();
    let force = "time,force\n0,0.2\n0.1,oops\n";
    let error = read_stroke(&name(), &bytes(&acceleration, Some(force), None)).unwrap_err();
    assert_eq!(error.quantity, super::Quantity::Force);
    assert!(error.to_string().contains("line 3"), "{error}");
    let error = read_stroke(&name(), &bytes("", None, None)).unwrap_err();
    assert_eq!(error.quantity, super::Quantity::Acceleration);
}

fn write(folder: &Path, name: &str) {
    let path = folder.join(name);
    std::fs::create_dir_all(path.parent().unwrap()).unwrap();
    std::fs::write(path, "").unwrap();
}

#[test]
fn files_of_a_folder_are_grouped_by_stroke_and_texture() {
    let folder = tempfile::tempdir().unwrap();
    for stroke in ["cork_0_20_200_1", "cork_90_20_200_1", "oak_wood_0_20_200_1"] {
        for quantity in ["acceleration", "force", "position"] {
            write(folder.path(), &format!("{quantity}/{stroke}.csv"));
        }
    }
    // The same stroke again, a file without acceleration, and files of other things.
    for name in [
        "copy/acc/cork_0_20_200_1.csv",
        "force/felt_0_20_200_1.csv",
        "acceleration/notes.txt",
        "cork_0_20_200_2.csv",
        "photo.jpg",
        "cork_90_40_200_1_acc.csv",
    ] {
        write(folder.path(), name);
    }
    let found = find_strokes(folder.path()).unwrap();
    let names: Vec<&str> = found.textures.iter().map(|texture| texture.texture.as_str()).collect();
    assert_eq!(names, ["cork", "oak_wood"]);
    let cork = &found.textures[0];
    assert_eq!(cork.directions().into_iter().collect::<Vec<_>>(), ["0", "90"]);
    assert_eq!(cork.strokes.len(), 3);
    assert!(cork.strokes[0].force.is_some() && cork.strokes[0].position.is_some());
    assert_eq!(cork.strokes[0].paths().count(), 3);
    assert!(cork.strokes[2].force.is_none() && (cork.strokes[2].name.speed.0 - 0.04).abs() < 1e-12);
    let warnings = found.warnings.join("\n");
    for words in ["1 table not used: another file", "felt"] {
        assert!(warnings.contains(words), "{warnings}");
    }
    let others = ["acceleration/notes.txt", "cork_0_20_200_2.csv"].map(|name| folder.path().join(name));
    assert_eq!(found.others, others);
    let warning = unused_others(&found.others).unwrap();
    assert!(warning.starts_with("2 tables not used: the name and the folders"), "{warning}");
    let is_other = |name: &str| found.is_other(&folder.path().join(name));
    assert!(is_other("photo.jpg") && is_other("cork_0_20_200_2.csv"));
    assert!(!is_other("cork_90_40_200_1_acc.csv") && !is_other("force/felt_0_20_200_1.csv"));
}

#[test]
fn a_folder_without_strokes_says_how_to_name_them() {
    let folder = tempfile::tempdir().unwrap();
    write(folder.path(), "force/cork_0_20_200_1.csv");
    let error = find_strokes(folder.path()).unwrap_err();
    assert!(matches!(error, StrokeFolderError::NoStrokes { n_tables: 1 }), "{error}");
    assert!(error.to_string().contains("cork_45_20_200_1.csv"), "{error}");
    let error = find_strokes(&folder.path().join("none")).unwrap_err();
    assert!(error.to_string().contains("cannot list the folder"), "{error}");
}
