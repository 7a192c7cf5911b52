use std::path::Path;
use std::sync::Arc;

use shagreen_core::texture::blend::Mode;
use shagreen_core::texture::height_map::{HeightMap, HeightMapOptions};
use shagreen_core::texture::plane::Plane;
use shagreen_core::texture::tap::Tap;
use shagreen_core::units::{Contact, Hertz};
use shagreen_device::track::{PenSample, Track};
use shagreen_formats::starter::starter_library;
use shagreen_formats::wav::SidecarV1;
use shagreen_studio::export::{FORMATS, model_paths, signal_format};

use super::{
    AudibleTexture, Format, Job, Outcome, Saved, SignalFile, SignalOptions, Sounding, What, strings,
};

#[test]
fn a_file_is_replaced_by_its_like_only_and_only_when_that_was_said() {
    let folder = tempfile::tempdir().unwrap();
    let mut entry = starter_library().unwrap().textures.swap_remove(0);
    // Formats of maps need heights.
    let heights_m = (0..256).map(|index| 1e-6 * f64::from(index % 3)).collect();
    let map = HeightMap::new(heights_m, 0.008, HeightMapOptions::HARD_PLASTIC).unwrap();
    entry.model = entry.model.with_height_map(Some(Arc::new(map)));
    let texture = entry.clone();
    let audible = Arc::new(AudibleTexture {
        name: entry.name.clone(),
        signal: Err("no signal".to_owned()),
        entry: Ok(entry),
        has_path: true,
    });
    for format in FORMATS {
        let path = folder.path().join("mine").with_extension(format.ending());
        let job = |path: &Path| Job {
            what: What::Audible(Arc::clone(&audible)),
            format: Format::Model(format),
            path: path.to_owned(),
        };
        assert!(matches!(job(&path).run(false), Outcome::Saved(saved) if saved.paths == [path.clone()]));
        assert!(matches!(job(&path).run(false), Outcome::Exists(paths) if paths == [path.clone()]));
        assert!(matches!(job(&path).run(true), Outcome::Saved(_)));
        let mut lost = vec![strings::PATH_LOST.to_owned()];
        lost.extend(format.lost(&texture));
        assert_eq!(job(&path).summary().unwrap().lost, lost);
        std::fs::write(&path, "my notes").unwrap();
        for replaces in [false, true] {
            assert!(matches!(job(&path).run(replaces), Outcome::Failed(_)), "{replaces}");
            assert!(matches!(job(folder.path()).run(replaces), Outcome::Failed(_)), "{replaces}");
        }
        assert_eq!(std::fs::read(&path).unwrap(), b"my notes");
        // Files of a format with several are not taken for own ones without the first of them.
        std::fs::remove_file(&path).unwrap();
        let beside: Vec<_> = model_paths(format, &path).into_iter().skip(1).collect();
        assert_eq!(matches!(job(&path).run(true), Outcome::Failed(_)), !beside.is_empty());
        beside.iter().chain([&path]).for_each(|path| drop(std::fs::remove_file(path)));
    }
}

/// Options of a short signal.
fn short() -> SignalOptions {
    SignalOptions { seconds: 0.2, rate_hz: 8000, ..SignalOptions::default() }
}

/// A starter texture in contact, without a tap transient.
fn steady() -> SignalFile {
    let entry = starter_library().unwrap().textures.swap_remove(0);
    SignalFile {
        sounding: Sounding::Mix(vec![(Arc::new(Plane::new(&entry.model)), 1.0)], Mode::default()),
        contact: Contact::from_mm_per_s_and_n(100.0, 1.0),
        stroke: None,
        tap: None,
        model_rate: entry.model.rate(),
        sidecar: SidecarV1::new(8000, 0.2, 1, "test"),
        restricted: Vec::new(),
    }
}

/// The same along a stroke, with a tap transient of this amplitude where it lands.
fn landing(amplitude_mps2: f64) -> SignalFile {
    // In the air for 0.2 s, then on the surface.
    let sample = |i: u32| {
        let (time_secs, touching) = (0.01 * f64::from(i), i >= 20);
        PenSample { time_secs, x_m: 0.1 * time_secs, force_n: 1.0, touching, ..PenSample::default() }
    };
    let samples: Vec<PenSample> = (0..60).map(sample).collect();
    let tap = Tap { frequency: Hertz(180.0), decay_per_sec: 90.0, amplitude_mps2 };
    SignalFile { stroke: Some(Arc::new(Track::new(&samples).unwrap())), tap: Some(tap), ..steady() }
}

/// Writes a signal in a format, in place of one that is there, and returns the warnings.
fn warnings_of(signal: SignalFile, format: &str, options: SignalOptions, folder: &Path) -> Vec<String> {
    let entry = Err("no texture".to_owned());
    let audible = AudibleTexture { name: "Mine".to_owned(), signal: Ok(signal), entry, has_path: false };
    let format = signal_format(format).unwrap();
    let job = Job {
        what: What::Audible(Arc::new(audible)),
        format: Format::Signal(format, options),
        path: folder.join("mine").with_extension(format.ending()),
    };
    let Outcome::Saved(Saved { paths, warnings }) = job.run(true) else { panic!("nothing was written") };
    assert!(paths[0].is_file());
    warnings
}

#[test]
fn silence_is_warned_of_with_its_reason() {
    let folder = tempfile::tempdir().unwrap();
    assert!(warnings_of(steady(), "wav", short(), folder.path()).is_empty());
    for (speed, force, words) in [(0.0, 1.0, "the speed is 0"), (100.0, 0.0, "the force is 0")] {
        let contact = Contact::from_mm_per_s_and_n(speed, force);
        let silent = SignalFile { contact, ..steady() };
        let warnings = warnings_of(silent, "wav", short(), folder.path());
        let [warning] = &*warnings else { panic!("{warnings:?}") };
        assert!(warning.contains("silent") && warning.contains(words), "{warning}");
    }
}

#[test]
fn a_tap_that_is_limited_and_a_file_that_is_left_are_warned_of() {
    let folder = tempfile::tempdir().unwrap();
    let along = SignalOptions { follows_stroke: true, ..short() };
    let warnings = warnings_of(landing(200.0), "ahap", along.clone(), folder.path());
    assert!(warnings.len() == 1 && warnings[0].contains("the strongest tap"), "{warnings:?}");
    // The short events of the first export belong to no file of a steady motion.
    assert!(folder.path().join("mine.transients.ahap").is_file());
    let warnings = warnings_of(steady(), "ahap", short(), folder.path());
    assert!(warnings.len() == 1 && warnings[0].contains("mine.transients.ahap"), "{warnings:?}");
    // A sound without a tap transient has none that is limited.
    assert!(warnings_of(landing(0.0), "haptic", along, folder.path()).is_empty());
}
