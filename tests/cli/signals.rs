//! `shagreen quality`, `codec`, `evaluate codec` and `spatial`.

use crate::support::{Bench, rms};

const RATES: [&str; 5] = ["1.75", "2.15", "2.45", "2.75", "3.15"];

#[test]
fn a_signal_goes_through_the_codec_at_every_rate() {
    let bench = Bench::new();
    bench.json("render --texture cork --speed 100 --force 1 --seconds 1.6 --rate 8000 -o cork.wav");
    let level = rms(&bench.wav("cork.wav").0);
    let (mut snrs, mut d_primes) = (Vec::new(), Vec::new());
    for rate in RATES {
        let coded = bench.json(&format!("codec encode cork.wav -o cork.shgc --kbps {rate}"));
        let kbps: f64 = rate.parse().unwrap();
        assert_eq!((coded["kbps"].as_f64(), coded["frames"].as_u64()), (Some(kbps), Some(80)));
        assert_eq!(coded["bits"].as_f64(), Some((1600.0 * kbps).round()), "exactly the bits of 1.6 s");
        let decoded = bench.json("codec decode cork.shgc -o back.wav");
        assert_eq!((&decoded["frames"], &decoded["lost_frames"]), (&80.into(), &0.into()));
        assert!(decoded["peak"].as_f64().unwrap() <= decoded["limit"].as_f64().unwrap());
        let (back, rate_hz) = bench.wav("back.wav");
        assert_eq!((back.len(), rate_hz), (3200, 2000.0));
        assert!((rms(&back) / level - 1.0).abs() < 0.3);
        let quality = bench.json("quality cork.wav back.wav");
        let snr_db = coded["snr_db"].as_f64().unwrap();
        // The file has single precision.
        assert!((quality["snr_db"].as_f64().unwrap() - snr_db).abs() < 0.01);
        snrs.push(snr_db);
        d_primes.push(quality["dprime"].as_f64().unwrap());
        assert_eq!(quality["dprime_applies"], true, "a decoded signal: {quality}");
    }
    assert!(snrs.is_sorted() && snrs[0] > 5.0 && snrs[4] > 13.0, "{snrs:?}");
    // For one signal a few tenths are chance; over a library the means decrease (see below).
    assert!(d_primes.is_sorted_by(|a, b| a + 0.5 > *b) && d_primes[0] > 2.0 * d_primes[4], "{d_primes:?}");
}

#[test]
fn quality_names_every_feature_and_equal_signals_do_not_differ() {
    let bench = Bench::new();
    bench.json("render --texture felt --speed 100 --force 1 --seconds 1 --rate 2000 -o felt.wav");
    bench.json("render --texture brick --speed 100 --force 1 --seconds 2 --rate 4000 --seed 2 -o brick.wav");
    let same = bench.json("quality felt.wav felt.wav");
    bench.json("render --texture felt --speed 0 --force 1 --seconds 1 --rate 2000 -o silent.wav");
    bench.json("codec encode silent.wav -o silent.shgc");
    bench.json("codec decode silent.shgc -o silence.wav");
    assert_eq!(bench.json("quality silent.wav silence.wav")["dprime"], 0.0);
    let other = bench.json("quality felt.wav brick.wav");
    for feature in ["roughness", "brightness", "regularity", "asymmetry", "envelope"] {
        assert_eq!(same[feature]["distance"], 0.0, "{feature}");
        assert!(other[feature]["distance"].as_f64().unwrap() > 0.0, "{feature}");
    }
    for key in ["dprime", "d_power", "d_amplitude"] {
        assert_eq!(same[key], 0.0, "{key}");
        assert!(other[key].as_f64().unwrap() > 1.0, "{key}");
    }
    assert_eq!((&same["st_sim"], &same["spqi"]), (&1.0.into(), &1.0.into()));
    assert_eq!(other["seconds"], 0.8, "whole segments of one second");
    let text = bench.run("quality felt.wav brick.wav").stdout;
    assert!(text.contains("no d'") && text.contains("Not rated by people"), "{text}");
    // Two noises of one texture feel alike; the model, which compares waveforms, would give them a d' of 6.
    bench.json("render --texture felt --speed 100 --force 1 --seconds 8 --rate 2000 --seed 1 -o one.wav");
    bench.json("render --texture felt --speed 100 --force 1 --seconds 8 --rate 2000 --seed 2 -o two.wav");
    assert_eq!(bench.json("quality one.wav two.wav")["dprime_applies"], false);
    assert_eq!(bench.json("quality one.wav one.wav")["dprime_applies"], true);
    let text = bench.run("quality one.wav two.wav").stdout;
    assert!(text.contains("no d': different noise") && !text.contains("d' 6"), "{text}");
    bench.fails("quality felt.wav felt.json", 1, &["felt.json"]);
}

#[test]
fn damaged_streams_are_filled_in_or_refused() {
    let bench = Bench::new();
    bench.json("render --texture cork --speed 100 --force 1 --seconds 1.6 --rate 2000 -o cork.wav");
    bench.json("codec encode cork.wav -o cork.shgc");
    let bytes = std::fs::read(bench.path("cork.shgc")).unwrap();
    let mut damaged = bytes.clone();
    damaged[24 + 65 + 3] ^= 1;
    bench.write("damaged.shgc", &damaged);
    let decoded = bench.json("codec decode damaged.shgc -o back.wav");
    assert_eq!((&decoded["frames"], &decoded["lost_frames"]), (&80.into(), &8.into()));
    bench.write("cut.shgc", &bytes[..200]);
    assert_eq!(bench.json("codec decode cut.shgc -o back.wav")["frames"], 16);
    for (name, bytes) in [("head.shgc", &bytes[..10]), ("other.shgc", b"RIFF")] {
        bench.write(name, bytes);
        bench.fails(&format!("codec decode {name} -o back.wav"), 1, &[name]);
    }
    // Neither the signal nor an unrelated file is replaced.
    bench.fails("codec encode cork.wav -o cork.wav", 1, &["overwrite an input file"]);
    bench.fails("codec encode cork.wav -o cork.json", 1, &["a file of another kind"]);
    bench.fails("codec encode cork.wav -o x.shgc --kbps 2", 2, &["1.75, 2.15"]);
    // A signal is not replaced by an empty one either.
    bench.write("empty.shgc", &bytes[..24]);
    bench.fails("codec decode empty.shgc -o back.wav", 1, &["contains no samples", "empty.shgc"]);
}

#[test]
fn every_texture_of_a_library_is_told_at_every_rate() {
    let bench = Bench::new();
    let told = bench.json("evaluate codec --seconds 0.8");
    let textures = told["textures"].as_array().unwrap();
    assert_eq!((textures.len(), &told["n"]), (25, &25.into()));
    let held_out = textures.iter().filter(|texture| texture["held_out"] == true).count();
    assert_eq!(held_out, 8);
    let numbers = |key: &str| -> Vec<f64> {
        told[key].as_array().unwrap().iter().map(|x| x.as_f64().unwrap()).collect()
    };
    let (snr, d_prime) = (numbers("snr_db_mean"), numbers("dprime_mean"));
    assert!(snr.is_sorted() && snr[0] > 5.0, "{snr:?}");
    // What is lost lowers the level: by about 2 dB at the lowest rate, and by less at each higher one.
    let level = numbers("level_db_mean");
    assert!(level.is_sorted() && level[0] > -3.0 && level[0] < -1.0 && level[4] < 0.0, "{level:?}");
    assert!(d_prime.is_sorted_by(|a, b| a > b), "{d_prime:?}");
    // A part has the rows of the whole.
    let part = bench.json("evaluate codec --seconds 0.8 --shard 2/13");
    assert_eq!(part["textures"], serde_json::json!([textures[1], textures[14]]));
    bench.fails("evaluate codec --shard 30/30", 1, &["the part 30/30 has none of the 25 textures"]);
}

#[test]
fn profiles_are_made_analysed_and_made_anew() {
    let bench = Bench::new();
    for what in ["A", "B", "C", "D", "gaps", "distractor"] {
        let made = bench.json(&format!("spatial make {what} --length 40 -o {what}.csv"));
        assert_eq!((&made["samples"], &made["what"]), (&4000.into(), &what.into()));
    }
    let found = bench.json("spatial analyse B.csv");
    let windows = found["windows"].as_array().unwrap();
    assert_eq!(windows.len(), 7);
    let narrow = &windows[6];
    assert_eq!(narrow["window_mm"], 0.2);
    assert!(narrow["waveform_r"].as_f64().unwrap() > 0.99 && narrow["envelope_r"].as_f64().unwrap() > 0.99);
    let paper = bench.json("spatial reconstruct D.csv --window 1 -o D1.csv");
    let refined = bench.json("spatial reconstruct D.csv --window 1 --refine 40 -o D2.csv");
    let off = |json: &serde_json::Value| json["spectral_convergence"].as_f64().unwrap();
    assert!(off(&refined) < 0.5 * off(&paper), "{paper} {refined}");
    bench.json("spatial analyse D1.csv --window 2 -o spectrogram.csv");
    let table = std::fs::read_to_string(bench.path("spectrogram.csv")).unwrap();
    assert!(table.starts_with("x_mm,per_mm,power\n"));
    // D is a square wave of 0.4 mm: at 13 mm, where its amplitude is not zero, the strongest frequency is 2.5 per mm.
    let rows = table
        .lines()
        .skip(1)
        .map(|line| -> Vec<f64> { line.split(',').map(|field| field.parse().unwrap()).collect() });
    let there = rows.filter(|row| row[0] == 13.0 && row[1] > 1.0);
    let strongest = there.max_by(|a, b| a[2].total_cmp(&b[2])).unwrap();
    assert_eq!(strongest[1], 2.5, "{strongest:?}");
    bench.fails("spatial analyse D1.csv --window 50", 1, &["does not fit", "D1.csv"]);
    bench.fails("spatial make A --gap 3 -o x.csv", 2, &["--gap"]);
    // A signal of a stroke becomes a profile with its speed.
    bench.json("render --texture cork --speed 100 --force 1 --seconds 0.5 --rate 2000 -o cork.wav");
    let stroke = bench.json("spatial analyse cork.wav --speed 100 --window 1");
    assert_eq!((&stroke["samples"], &stroke["step_mm"]), (&1000.into(), &0.05.into()));
    bench.fails("spatial analyse cork.wav", 2, &["--speed"]);
    bench.write("uneven.csv", "0,1\n1,1\n5,1\n6,1\n8,1\n");
    bench.fails("spatial analyse uneven.csv", 1, &["line 3", "uneven.csv"]);
}

/// A sine of amplitude 2 and mean 0: before, the table was that of the sine plus 2, with more power at 0 per mm than at
/// the frequency of the sine.
#[test]
fn the_table_is_the_spectrogram_of_a_profile_with_negative_values_as_it_is() {
    let bench = Bench::new();
    let sine = |i: u32| 2.0 * (std::f64::consts::TAU * f64::from(i) / 100.0).sin();
    let row = |i: u32| format!("{},{:.9}\n", f64::from(i) / 100.0, sine(i));
    bench.write("sine.csv", (0..4000).map(row).collect::<String>());
    let found = bench.json("spatial analyse sine.csv --window 5 -o s.csv");
    assert!((found["offset_for_reconstruction"].as_f64().unwrap() - 2.0).abs() < 1e-6, "{found}");
    let text = bench.run("spatial analyse sine.csv --window 5").stdout;
    assert!(text.contains("negative values") && text.contains("2.000000 was added"), "{text}");
    let table = std::fs::read_to_string(bench.path("s.csv")).unwrap();
    let rows = table
        .lines()
        .skip(1)
        .map(|line| -> Vec<f64> { line.split(',').map(|field| field.parse().unwrap()).collect() });
    for row in rows.filter(|row| row[0] == 20.0) {
        // A Hann window of N = 500 samples has the sum N / 2: the power is (a N / 4)² at the frequency of the sine, and a
        // quarter of it at its neighbors.
        let peak = 250.0_f64.powi(2);
        let expected = match (row[1] * 5.0).round() as i32 {
            5 => peak,
            4 | 6 => 0.25 * peak,
            _ => 0.0,
        };
        assert!((row[2] - expected).abs() < 1e-3 * peak, "{row:?}");
    }
    // Without negative values, nothing is added.
    bench.json("spatial make B --length 40 -o B.csv");
    assert_eq!(bench.json("spatial analyse B.csv --window 2")["offset_for_reconstruction"], 0.0);
}

/// Returns the amplitude of a signal's component at a frequency.
fn amplitude(signal: &[f64], rate_hz: f64, hz: f64) -> f64 {
    let turn = |i: usize| std::f64::consts::TAU * hz * i as f64 / rate_hz;
    let part = |of: fn(f64) -> f64| -> f64 { signal.iter().enumerate().map(|(i, x)| of(turn(i)) * x).sum() };
    2.0 * part(f64::cos).hypot(part(f64::sin)) / signal.len() as f64
}

/// A 16-bit height map: in row 1 the heights differ by a few steps of 1/65535 between pixels; the other rows are flat.
#[test]
fn a_row_of_a_height_map_is_a_profile_and_a_relief() {
    let bench = Bench::new();
    let height = |x: u32, y: u32| image::Luma([if y == 1 { 30_000 + (x % 7) as u16 } else { 500 }]);
    let mut png = std::io::Cursor::new(Vec::new());
    image::ImageBuffer::from_fn(400, 4, height).write_to(&mut png, image::ImageFormat::Png).unwrap();
    bench.write("map.png", png.into_inner());
    let made = bench
        .json("library relief map.png --width 40 --row 1 --level 1.5 --texture cork --force 1 -o map.json");
    assert_eq!(made["values"], 400);
    assert!((made["level_mps2"].as_f64().unwrap() - 1.5).abs() < 1e-9);
    assert!((made["length_mm"].as_f64().unwrap() - 40.0).abs() < 1e-9);
    let analysed = bench.json("spatial analyse map.png --width 40 --row 1 --window 2");
    assert_eq!((&analysed["samples"], &analysed["step_mm"]), (&400.into(), &0.1.into()));
    // The middle row is another one, and flat.
    let flat = "library relief map.png --width 40 --level 1 --texture cork -o no.json";
    bench.fails(flat, 1, &["map.png", "the profile is constant"]);
    bench.fails("spatial analyse map.png --width 40", 1, &["map.png", "the profile is constant"]);
    bench.fails("spatial analyse map.png --width 40 --row 4", 1, &["rows 0 to 3"]);
    bench.fails("spatial analyse map.png", 2, &["--width"]);
    // A picture in another format is named, with the formats that are read.
    bench.write("bumps.ppm", "P6\n2 2\n255\n123456789012");
    for more in ["", "--width 40"] {
        let line = format!("library relief bumps.ppm {more} --level 1 --texture cork -o no.json");
        bench.fails(&line, 1, &["this is a PPM picture", "JPEG or PNG", "bumps.ppm"]);
    }
    // A table whose header begins as such a picture does.
    let row = |i: u32| format!("{},{}\n", f64::from(i) / 50.0, i % 7);
    bench.write("p.csv", format!("P1 (mm),height\n{}", (0..100).map(row).collect::<String>()));
    assert_eq!(bench.json("library relief p.csv --level 1 --texture cork -o p.json")["values"], 100);
}

#[test]
fn a_relief_lies_at_its_places() {
    let bench = Bench::new();
    // A wave of 1 mm: at 100 mm/s its frequency is 100 Hz. Its mirrored continuation has no jump.
    let wave = |mm: f64| (mm * std::f64::consts::TAU).cos();
    let row = |i: u32| format!("{},{}\n", f64::from(i) / 50.0, wave((f64::from(i) + 0.5) / 50.0));
    bench.write("wave.csv", (0..500).map(row).collect::<String>());
    let made = bench.json("library relief wave.csv --texture cork --level 2 --force 0.5 -o wavy.json");
    assert_eq!(
        (&made["values"], &made["texture"], &made["force_n"]),
        (&500.into(), &"cork".into(), &0.5.into())
    );
    assert!((made["level_mps2"].as_f64().unwrap() - 2.0).abs() < 1e-9);
    let wavy = |speed: f64, force: f64| {
        bench.json(&format!("render --library wavy.json --texture cork --speed {speed} --force {force} --seconds 2 -o wave.wav"));
        let (signal, rate_hz) = bench.wav("wave.wav");
        amplitude(&signal, rate_hz, speed)
    };
    for (speed, force, wanted) in [(100.0, 0.5, 2.0), (50.0, 0.5, 2.0), (100.0, 1.0, 4.0)] {
        let found = wavy(speed, force) / std::f64::consts::SQRT_2;
        assert!((found / wanted - 1.0).abs() < 0.1, "{found} at {speed} mm/s and {force} N");
    }
    // A stroke back plays the relief in reverse.
    let x_mm = |i: u32| 2.0 + 0.2 * (250.0 - (f64::from(i) - 250.0).abs());
    let report = |i: u32| format!("{},{},0,1\n", 0.002 * f64::from(i), x_mm(i));
    let reports: String = (0..=500).map(report).collect();
    bench.write("turn.csv", format!("t,x,y,force\n{reports}"));
    bench.json("render --library wavy.json --texture cork --stroke turn.csv -o turn.wav");
    bench.json("render --texture cork --stroke turn.csv -o noise.wav");
    let (with, _) = bench.wav("turn.wav");
    let (without, _) = bench.wav("noise.wav");
    let relief: Vec<f64> = with.iter().zip(&without).map(|(a, b)| a - b).collect();
    let (forth, back): (Vec<f64>, Vec<f64>) =
        (100..480).map(|i| (relief[i], relief[relief.len() - 2 - i])).unzip();
    let same: f64 = forth.iter().zip(&back).map(|(a, b)| a * b).sum();
    assert!(same > 0.8 * rms(&forth) * rms(&back) * forth.len() as f64, "{same}");
    // A recording with its speed becomes a relief too.
    bench.json("render --texture brick --speed 100 --force 1 --seconds 1 -o brick.wav");
    let brick =
        bench.json("library relief brick.wav --speed 100 --texture felt --library wavy.json -o both.json");
    assert!((brick["length_mm"].as_f64().unwrap() - 100.0).abs() < 1e-6);
    // Any sample rate works: the perceptible part of three seconds at 48 kHz fits.
    bench.json("render --texture brick --speed 100 --force 1 --seconds 3 --rate 48000 -o fast.wav");
    let fast = bench.json("library relief fast.wav --speed 100 --texture felt -o fast_felt.json");
    assert_eq!((&fast["values"], &fast["step_mm"]), (&12_000.into(), &0.025.into()));
    let listed = bench.json("library list --library both.json");
    let relief_of = |id: &str| {
        let textures = listed["textures"].as_array().unwrap();
        textures.iter().find(|texture| texture["id"] == id).unwrap()["relief"]["length_mm"].as_f64()
    };
    assert!(relief_of("cork") == Some(10.0) && relief_of("felt").is_some() && relief_of("glass").is_none());
    bench.fails("library relief wave.csv --texture cork -o no.json", 2, &["--level"]);
    bench.fails("library relief wave.csv --texture corc --level 1 -o no.json", 1, &["corc", "cork"]);
    bench.write("flat.csv", "0,1\n1,1\n2,1\n");
    bench.fails(
        "library relief flat.csv --texture cork --level 1 -o no.json",
        1,
        &["flat.csv", "the profile is constant"],
    );
}
