//! `shagreen library relief` with a whole picture: height maps, felt in two dimensions.

use std::f64::consts::TAU;

use tiff::encoder::TiffEncoder;
use tiff::encoder::colortype::Gray32Float;

use crate::support::{Bench, rms};

/// A 16-bit PNG of ridges along y: eight of them on the width.
fn ridges() -> Vec<u8> {
    let level = |x: u32| (32_767.5 * (1.0 + (TAU * f64::from(x) / 32.0).cos())).round() as u16;
    let map = image::ImageBuffer::from_fn(256, 256, |x, _| image::Luma([level(x)]));
    let mut png = std::io::Cursor::new(Vec::new());
    map.write_to(&mut png, image::ImageFormat::Png).unwrap();
    png.into_inner()
}

/// A stroke table of 2 s at a speed along x and along y, in mm/s.
fn stroke(x_mm_per_s: f64, y_mm_per_s: f64) -> String {
    let report = |i: u32| {
        let t = 0.002 * f64::from(i);
        format!("{t},{},{},1\n", x_mm_per_s * t, y_mm_per_s * t)
    };
    format!("t,x,y,force\n{}", (0..=1000).map(report).collect::<String>())
}

/// Ridges of 5 mm: a stroke across them has the frequency of the speed over 5 mm, a stroke along them has nothing.
#[test]
fn a_picture_of_ridges_is_felt_across_them_and_not_along_them() {
    let bench = Bench::new();
    bench.write("ridges.png", ridges());
    let made =
        bench.json("library relief ridges.png --side-mm 40 --height-um 200 --texture glass -o ridged.json");
    assert_eq!(
        (&made["heights"], &made["seamless"], &made["assumed"]),
        (&256.into(), &true.into(), &false.into())
    );
    let close = |key: &str, wanted: f64| (made[key].as_f64().unwrap() - wanted).abs() < 0.01;
    assert!(close("side_mm", 40.0) && close("low_um", -100.0) && close("high_um", 100.0), "{made}");
    let said = bench.run("texture psd --library ridged.json --texture glass --speed 100 --force 1");
    assert!(said.stderr.contains("has a height map, which depends on position"), "{}", said.stderr);
    let felt = |x_mm_per_s: f64, y_mm_per_s: f64| -> Vec<f64> {
        bench.write("stroke.csv", stroke(x_mm_per_s, y_mm_per_s));
        bench
            .json("render --library ridged.json --texture glass --stroke stroke.csv --rate 1000 -o with.wav");
        bench.json("render --texture glass --stroke stroke.csv --rate 1000 -o without.wav");
        let ((with, _), (without, _)) = (bench.wav("with.wav"), bench.wav("without.wav"));
        with.iter().zip(&without).map(|(a, b)| a - b).skip(900).take(1000).collect()
    };
    let size = |signal: &[f64], hz: f64| {
        let turn = |i: usize| TAU * hz * i as f64 / 1000.0;
        let part =
            |of: fn(f64) -> f64| -> f64 { signal.iter().enumerate().map(|(i, x)| of(turn(i)) * x).sum() };
        2.0 * part(f64::cos).hypot(part(f64::sin)) / signal.len() as f64
    };
    for (mm_per_s, hz) in [(100.0, 20.0), (150.0, 30.0), (-100.0, 20.0)] {
        let across = felt(mm_per_s, 0.0);
        // A height of 100 µm, and the high-pass of first order at 10 Hz.
        let expected = (TAU * hz).powi(2) * 1e-4 / 1.0_f64.hypot(10.0 / hz);
        let found = size(&across, hz);
        assert!((found / expected - 1.0).abs() < 0.05, "{found} is not {expected} at {hz} Hz");
        assert!(size(&across, 0.8 * hz) < 0.3 * found && size(&across, 1.25 * hz) < 0.3 * found);
        let along = felt(0.0, mm_per_s);
        assert!(rms(&along) < 0.01 * rms(&across), "{} along, {} across", rms(&along), rms(&across));
    }
}

/// A TIFF of numbers of single precision.
fn float_tiff(side: u32, number: impl Fn(u32, u32) -> f32) -> Vec<u8> {
    let numbers: Vec<f32> = (0..side * side).map(|i| number(i % side, i / side)).collect();
    let mut bytes = std::io::Cursor::new(Vec::new());
    let mut encoder = TiffEncoder::new(&mut bytes).unwrap();
    encoder.write_image::<Gray32Float>(side, side, &numbers).unwrap();
    bytes.into_inner()
}

/// Measured heights in any unit: the lowest and the highest number have the stated difference.
#[test]
fn a_tiff_of_measured_heights_becomes_a_height_map() {
    let bench = Bench::new();
    let wave = |x: u32, _: u32| 0.25 + 0.002 * (std::f32::consts::TAU * x as f32 / 32.0).cos();
    bench.write("measured.tif", float_tiff(128, wave));
    let said = bench
        .run("library relief measured.tif --side-mm 20 --height-um 80 --texture cork -o made.json --json");
    assert_eq!(said.code, 0, "{}", said.stderr);
    assert!(said.stderr.contains("0 µm (lowest) to 80 µm (highest)"), "{}", said.stderr);
    let made: serde_json::Value = serde_json::from_str(&said.stdout).unwrap();
    let close = |key: &str, wanted: f64| (made[key].as_f64().unwrap() - wanted).abs() < 0.01;
    assert!(close("low_um", -40.0) && close("high_um", 40.0), "{made}");
    assert_eq!((&made["seamless"], &made["assumed"]), (&true.into(), &false.into()));
    bench.write("gaps.tif", float_tiff(32, |x, y| if x == y { f32::NAN } else { x as f32 }));
    let line = "library relief gaps.tif --side-mm 20 --height-um 80 --texture cork -o no.json";
    bench.fails(line, 1, &["no measurements", "fill these gaps", "gaps.tif"]);
}

/// What a picture does not say is asked for, and what is assumed of a photo is said.
#[test]
fn size_and_height_are_asked_for_and_assumptions_are_said() {
    let bench = Bench::new();
    bench.write("ridges.png", ridges());
    let relief = "library relief ridges.png --texture cork -o no.json";
    bench.fails(&format!("{relief} --side-mm 40"), 2, &["--height-um"]);
    bench.fails(&format!("{relief} --height-um 40"), 2, &["--side-mm"]);
    bench.fails(&format!("{relief} --side-mm 40 --height-um 40 --level 1"), 2, &["--level"]);
    bench.fails(&format!("{relief} --side-mm 40 --height-um 40 --width 40"), 2, &["--width"]);
    let photo = image::RgbImage::from_fn(300, 200, |x, y| image::Rgb([(x / 2) as u8, (y % 40) as u8, 90]));
    let mut png = std::io::Cursor::new(Vec::new());
    photo.write_to(&mut png, image::ImageFormat::Png).unwrap();
    bench.write("photo.png", png.into_inner());
    let said = bench.run("library relief photo.png --side-mm 30 --height-um 50 --texture cork -o photo.json");
    assert_eq!(said.code, 0, "{}", said.stderr);
    let words = ["assumed, not measured", "0 µm (black) to 50 µm (white)", "borders were faded"];
    assert!(words.iter().all(|words| said.stderr.contains(words)), "{}", said.stderr);
    // 8/9 of 30 mm, as the edges do not fit together.
    assert!(said.stdout.contains("26.67 mm x 26.67 mm with 128 x 128 heights"), "{}", said.stdout);
    let again =
        "library relief photo.png --side-mm 30 --height-um 50 --texture cork --library photo.json -o 2.json";
    assert!(bench.run(again).stderr.contains("already has a height map, which is replaced"));
}

/// A size out of range is named by its option, with its value and the range; one that is possible for no tip is a note.
#[test]
fn impossible_sizes_are_named_and_steep_heights_are_noted() {
    let bench = Bench::new();
    bench.write("ridges.png", ridges());
    let relief = "library relief ridges.png --texture cork -o no.json";
    let words = ["4000", "--side-mm", "1.2 to 1000 mm"];
    bench.fails(&format!("{relief} --side-mm 4000 --height-um 40"), 2, &words);
    bench.fails(&format!("{relief} --side-mm 0 --height-um 40"), 2, &["--side-mm", "1.2 to 1000 mm"]);
    let words = ["15000", "--height-um", "0.01 to 10000 µm"];
    bench.fails(&format!("{relief} --side-mm 2 --height-um 15000"), 2, &words);
    // White beside black in each sample.
    let checks =
        image::GrayImage::from_fn(256, 256, |x, y| image::Luma([if (x + y) % 2 == 0 { 0 } else { 255 }]));
    checks.save(bench.path("checks.png")).unwrap();
    let steep = "library relief checks.png --side-mm 2 --height-um 9000 --texture cork -o no.json";
    let words = ["--height-um 9000", "--side-mm 2", "use at most", "checks.png"];
    bench.fails(steep, 1, &words);

    let of = |height_um: &str| {
        bench.run(&format!(
            "library relief ridges.png --side-mm 10 --height-um {height_um} --texture cork -o made.json --json"
        ))
    };
    // Cosine ridges with a period of 1.25 mm: the steepest slope of 2 mm is atan(π 2 / 1.25) = 79°.
    let said = of("2000");
    let note = said.stderr.lines().find(|line| line.contains("slopes of 79°"));
    assert!(
        note.is_some_and(|line| line.starts_with("note: ") && line.contains("larger side")),
        "{}",
        said.stderr
    );
    let made: serde_json::Value = serde_json::from_str(&said.stdout).unwrap();
    assert!(made["impossible"].as_str().unwrap().contains("79°"), "{made}");
    let said = of("50");
    assert!(!said.stderr.contains("slopes") && said.stdout.contains("\"impossible\":null"), "{said:?}");
}
