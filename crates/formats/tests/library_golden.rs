//! Library files of every published version are read value by value, and unknown fields in them are kept.
//!
//! The files in `golden` never change: a new version gets a new file.

#![allow(clippy::unwrap_used, reason = "a test may panic on an unexpected result")]

#[path = "library_golden/refused.rs"]
mod refused;

use serde_json::{Value, json};
use shagreen_core::space::LabelSource;
use shagreen_core::space::texture_path::{Along, AtEnd};
use shagreen_core::texture::stick_slip::StickSlip;
use shagreen_core::texture::tap::Tap;
use shagreen_core::texture::{Grain, Interpolation, TextureModel};
use shagreen_core::units::{Hertz, MetersPerSecond, Newtons};
use shagreen_formats::library::{Library, Place, Provenance, TextureEntry, read_library, write_library};
use shagreen_formats::picture::{PictureFormat, decode};

const V1_0: &[u8] = include_bytes!("golden/library-1.0.json");
const V1_1: &[u8] = include_bytes!("golden/library-1.1.json");
const V1_2: &[u8] = include_bytes!("golden/library-1.2.json");
const V1_3: &[u8] = include_bytes!("golden/library-1.3.json");
const V1_4: &[u8] = include_bytes!("golden/library-1.4.json");
const V1_5: &[u8] = include_bytes!("golden/library-1.5.json");
const V1_6: &[u8] = include_bytes!("golden/library-1.6.json");
const V1_7: &[u8] = include_bytes!("golden/library-1.7.json");
const V1_8: &[u8] = include_bytes!("golden/library-1.8.json");
const V1_9: &[u8] = include_bytes!("golden/library-1.9.json");

/// Reads a library without warnings.
fn read(bytes: &[u8]) -> Library {
    let imported = read_library(bytes).unwrap();
    assert_eq!(imported.warnings, [""; 0]);
    imported.value
}

fn check_head(library: &Library, version: &str) {
    let texts = [&library.name, &library.origin, &library.license, &library.created_by].map(String::as_str);
    assert_eq!(texts, [&format!("Golden {version}"), "Made up.", "CC0-1.0", "nobody"]);
    assert_eq!(library.description, format!("Made up to hold every field of version {version}."));
    assert_eq!(library.seed, Some(7));
}

fn check_cork(texture: &TextureEntry) {
    assert_eq!((texture.id.as_str(), texture.name.as_str()), ("cork", "Cork"));
    assert_eq!(texture.tags, ["soft", "brown"]);
    assert_eq!(texture.license, "CC-BY-4.0");
    assert_eq!((texture.origin.as_str(), texture.description.as_str()), ("A board.", "Pressed."));
    assert_eq!(texture.provenance, Provenance::Free);
    let place = texture.place.unwrap();
    assert_eq!((place.at.x(), place.at.y()), (40.5, 71.25));
    assert_eq!(place.source, LabelSource::PhysicalLabels);
    let physical = texture.physical.unwrap();
    assert_eq!((physical.roughness_log10_mps2, physical.hardness_log10_n_per_m), (-0.5, 4.25));
    let model = &texture.model;
    assert_eq!((model.rate(), model.friction(), model.tap()), (Hertz(1000.0), Some(0.4), None));
    assert_eq!(model.interpolation(), Some(Interpolation::Barycentric));
    let nodes: Vec<_> =
        model.nodes().iter().map(|n| (n.speed.mm_per_s(), n.force.0, n.level_mps2, &n.lsf[..])).collect();
    let expected: [(f64, f64, f64, &[f64]); 2] =
        [(30.0, 0.15, 0.0625, &[0.5, 1.25, 3.0]), (70.0, 1.5, 0.75, &[0.123_457, 1.0, 2.0])];
    assert_eq!(nodes, expected);
    let picture = texture.picture.as_ref().unwrap();
    assert_eq!((picture.width, picture.height, picture.millimeters), (2, 1, 20.0));
    assert_eq!(picture.format, PictureFormat::Png);
    assert_eq!(decode(picture).unwrap().pixels, [200, 100, 50, 50, 100, 200]);
}

#[test]
fn version_1_0() {
    let library = read(V1_0);
    check_head(&library, "1.0");
    let [cork, bare] = &library.textures[..] else { panic!("{} textures", library.textures.len()) };
    check_cork(cork);
    assert_eq!((bare.id.as_str(), bare.model.rate(), bare.model.friction()), ("bare", Hertz(2000.0), None));
    assert!(bare.place.is_none() && bare.physical.is_none() && bare.picture.is_none());
}

#[test]
fn version_1_1() {
    let library = read(V1_1);
    check_head(&library, "1.1");
    let [cork, published, radial] = &library.textures[..] else { panic!("{}", library.textures.len()) };
    check_cork(cork);

    assert_eq!(published.provenance, Provenance::Restricted);
    assert_eq!(library.restricted().map(|t| t.id.as_str()).collect::<Vec<_>>(), ["published"]);
    let Grain::Published { nodes } = published.model.grain() else { panic!("{:?}", published.model) };
    let places: Vec<_> = nodes.iter().map(|n| (n.speed.mm_per_s(), n.force.0, n.variance, n.gain)).collect();
    let expected = [
        (0.0, 0.0, 0.0, 2.0),
        (200.0, 0.0, 0.0, 2.0),
        (0.0, 3.0, 0.0, 2.0),
        (200.0, 3.0, 0.02, 3.0),
        (90.0, 1.25, 0.0125, 8.5),
    ];
    assert_eq!(places, expected);
    assert_eq!((&nodes[3].ar_lsf[..], &nodes[3].ma_lsf[..]), (&[0.6, 1.1, 2.1, 2.6][..], &[1.1, 2.1][..]));

    assert_eq!(radial.model.interpolation(), Some(Interpolation::RadialBasis));
    let tap = Tap { frequency: Hertz(180.0), decay_per_sec: 90.5, amplitude_mps2: 4.0 };
    assert_eq!(radial.model.tap(), Some(tap));
    assert_eq!(radial.model.nodes().len(), 2);
}

#[test]
fn version_1_2() {
    let library = read(V1_2);
    check_head(&library, "1.2");
    check_cork(&library.textures[0]);
    let report = library.space_report.as_ref().unwrap();
    assert_eq!((&report["stress"][0]["stress"], &report["note"]), (&json!(0.05), &json!("made up")));
    let attributes = library.textures[0].attributes.as_ref().unwrap();
    assert_eq!(attributes.source, LabelSource::SimulatedRaters);
    let values: Vec<_> = attributes.values.iter().map(|a| (a.name.as_str(), a.value)).collect();
    assert_eq!(values, [("rough-smooth", 40.5), ("flat-bumpy", 12.25), ("warm", 100.0)]);
    assert_eq!((attributes.get("flat-bumpy"), attributes.get("bumpy-flat")), (Some(12.25), None));
    assert!(library.textures[1..].iter().all(|texture| texture.attributes.is_none()));
}

#[test]
fn version_1_3() {
    let library = read(V1_3);
    check_head(&library, "1.3");
    check_cork(&library.textures[0]);
    assert_eq!(library.axis_names(), ["warm-cold", "flat-bumpy"]);
    assert_eq!(read(V1_2).axis_names(), ["rough-smooth", "hard-soft"]);
    assert_eq!(library.textures[0].attributes, read(V1_2).textures[0].attributes);
}

#[test]
fn version_1_4() {
    let library = read(V1_4);
    check_head(&library, "1.4");
    check_cork(&library.textures[0]);
    let path = library.textures[0].path.as_ref().unwrap();
    assert_eq!((path.along(), path.at_end(), path.length()), (Along::Distance, AtEnd::Turn, 0.04));
    let keys: Vec<_> = path
        .keys()
        .iter()
        .map(|key| {
            let model = &key.model;
            let level = model.nodes()[0].level_mps2;
            (key.stop.at.x(), key.stop.along, key.is_stop, model.friction(), level)
        })
        .collect();
    let expected = [
        (30.0, 0.0, true, Some(0.4), 0.0625),
        (35.0, 0.0125, false, None, 0.125),
        (40.0, 0.04, true, Some(0.25), 0.25),
    ];
    assert_eq!(keys, expected);
    let tap = Tap { frequency: Hertz(180.0), decay_per_sec: 90.0, amplitude_mps2: 4.0 };
    assert_eq!(path.keys()[1].model.tap(), Some(tap));
}

#[test]
fn version_1_5() {
    let library = read(V1_5);
    check_head(&library, "1.5");
    check_cork(&library.textures[0]);
    let facts = |model: &TextureModel| {
        let relief = model.relief()?;
        let profile = relief.profile();
        Some((1e3 * profile.step_m(), relief.force().0, profile.values().to_vec()))
    };
    let expected = (0.0125, 1.5, vec![0.5, -1.25, 0.0, 123.456, -0.015_625]);
    assert_eq!(facts(&library.textures[0].model), Some(expected));
    let keys = library.textures[0].path.as_ref().unwrap().keys();
    assert_eq!(facts(&keys[1].model), Some((0.05, 1.0, vec![1.0, -1.0])));
    assert_eq!(facts(&keys[0].model), None);
    for (change, names) in [
        (json!({"step_mm": 0.0}), "step"),
        (json!({"mps2": [1.0]}), "at least two values"),
        (json!({"mps2": [1e7, 0.0]}), "value 0 of the relief"),
        (json!({"force_n": -1.0}), "force of a relief"),
    ] {
        let mut value: Value = serde_json::from_slice(V1_5).unwrap();
        let relief = value["textures"][0]["relief"].as_object_mut().unwrap();
        relief.extend(change.as_object().unwrap().clone());
        let error = read_library(&serde_json::to_vec(&value).unwrap()).unwrap_err().to_string();
        assert!(error.contains("\"cork\"") && error.contains(names), "{error}");
    }
}

#[test]
fn version_1_6() {
    let mut library = read(V1_6);
    check_head(&library, "1.6");
    check_cork(&library.textures[0]);
    assert_eq!(library.textures[0].attributes.as_ref().unwrap().source, LabelSource::Estimated);
    let place = library.textures[0].place.as_mut().unwrap();
    place.source = LabelSource::Estimated;
    assert_eq!(read(&write_library(&library)), library);
}

#[test]
fn version_1_7() {
    let library = read(V1_7);
    check_head(&library, "1.7");
    check_cork(&library.textures[0]);
    let model = &library.textures[0].model;
    let along: Vec<_> = model
        .along()
        .unwrap()
        .iter()
        .map(|n| (n.speed.mm_per_s(), n.force.0, n.level_mps2, n.lsf[0]))
        .collect();
    assert_eq!(along, [(30.0, 0.15, 0.015_625, 0.5), (70.0, 1.5, 0.25, 0.25)]);
    let stick_slip = StickSlip { static_ratio: 1.6, stribeck_speed: MetersPerSecond::from_mm_per_s(20.0) };
    assert_eq!(model.stick_slip(), Some(stick_slip));
    assert!((model.turn_rad() - std::f64::consts::FRAC_PI_6).abs() < 1e-15);
    let map = model.height_map().unwrap();
    assert_eq!((map.n(), map.side_m()), (16, 1e-3 * 8.0));
    let options = map.options();
    assert_eq!((options.force, options.speed_exponent), (Newtons(1.5), 1.75));
    assert_eq!(options.patch_radius_m, 1e-3 * 0.25);
    // Row 0 is a cosine over the side, and row 1 has half of its height and the opposite sign.
    for (index, steps) in [(0, 32_767.0), (1, 30_273.0), (8, -32_767.0), (16, -16_384.0), (17, -15_136.0)] {
        let height_m = map.heights_m()[index];
        assert!((height_m - 1e-9 * steps).abs() < 1e-15, "{height_m:e} at {index}");
    }
    let key = &library.textures[0].path.as_ref().unwrap().keys()[1].model;
    assert_eq!(key.along().unwrap()[0].level_mps2, 0.0625);
    assert_eq!(key.stick_slip().unwrap().static_ratio, 1.25);
    assert!((key.turn_rad() + std::f64::consts::FRAC_PI_4).abs() < 1e-15);
    assert_eq!(key.height_map().unwrap().side_m(), 1e-3 * 4.0);
    assert!(library.textures[1..].iter().all(|texture| texture.model.along().is_none()));
}

#[test]
fn version_1_8() {
    let library = read(V1_8);
    check_head(&library, "1.8");
    check_cork(&library.textures[0]);
    assert_eq!(library.axis_names(), ["warm-cold", "flat-bumpy", "sticky-slippery", "centroid"]);
    let cork = library.textures[0].at().unwrap();
    assert_eq!(cork.coordinates(), [40.5, 71.25, 12.25, 66.5]);
    let last = library.textures[2].place.unwrap();
    assert_eq!((last.at.coordinates(), last.deviation), (&[1.5, 2.0, 3.25, 4.0][..], Some([5.0, 6.5])));
    let keys = library.textures[0].path.as_ref().unwrap().keys();
    let points: Vec<&[f64]> = keys.iter().map(|key| key.stop.at.coordinates()).collect();
    assert_eq!(points, [[30.0, 70.25, 10.0, 20.5], [35.0, 60.0, 15.0, 25.5], [40.0, 50.0, 100.0, 0.0]]);
    // All else is as in version 1.7.
    assert_eq!(library.textures[0].model, read(V1_7).textures[0].model);
    assert_eq!(read(&write_library(&library)), library);
}

#[test]
fn version_1_9() {
    let library = read(V1_9);
    check_head(&library, "1.9");
    check_cork(&library.textures[0]);
    let radial = &library.textures[2].model;
    assert_eq!(radial.order(), 40);
    let [first, second] = [0, 1].map(|index| &radial.nodes()[index].lsf);
    assert_eq!((first[0], first[39], second[0]), (0.093_454, 3.079_871, 0.056_624));
    // All else is as in version 1.8.
    let before = read(V1_8);
    assert_eq!(library.textures[..2], before.textures[..2]);
    let speeds = |model: &TextureModel| model.nodes().iter().map(|node| node.speed).collect::<Vec<_>>();
    assert_eq!(speeds(radial), speeds(&before.textures[2].model));
    // A file states the lowest version that has all of its features.
    let version = |library: &Library| {
        let value: Value = serde_json::from_slice(&write_library(library)).unwrap();
        value["version"].clone()
    };
    assert_eq!((version(&library), version(&before)), (json!("1.9"), json!("1.8")));
    assert_eq!(read(&write_library(&library)), library);
}

/// Heights have steps of a 32,767th of the largest one; all else is read as it was.
#[test]
fn a_written_texture_is_read_with_all_its_layers() {
    let library = read(V1_7);
    let again = read(&write_library(&library));
    assert_eq!(again, library);
    let mut turned = library.clone();
    for degrees in [180.0, -180.0, 0.1, 359.0_f64] {
        let model = turned.textures[0].model.clone();
        turned.textures[0].model = model.with_turn_rad(degrees.to_radians());
        let bytes = write_library(&turned);
        assert_eq!(write_library(&read(&bytes)), bytes);
        let found = read(&bytes).textures[0].model.turn_rad();
        assert!((found - turned.textures[0].model.turn_rad()).abs() < 1e-11, "{degrees}: {found}");
    }
}

#[test]
fn what_is_not_known_is_written_back() {
    for golden in [V1_0, V1_1, V1_2, V1_3, V1_4, V1_5, V1_6, V1_7, V1_8] {
        let before: Value = serde_json::from_slice(golden).unwrap();
        let after: Value = serde_json::from_slice(&write_library(&read(golden))).unwrap();
        assert_eq!(after, before);
    }
}

#[test]
fn a_library_says_the_lowest_version_that_has_what_it_uses() {
    let version = |library: &Library| {
        let value: Value = serde_json::from_slice(&write_library(library)).unwrap();
        value["version"].as_str().unwrap().to_owned()
    };
    let mut library = read(V1_8);
    library.axes = read(V1_7).axes;
    for texture in &mut library.textures {
        texture.place = texture.place.map(|place| Place { at: place.at.on(2), ..place });
    }
    assert_eq!(version(&library), "1.8", "the keys of a path have four coordinates");
    library.textures[0].path = read(V1_7).textures[0].path.clone();
    assert_eq!(version(&library), "1.7");
    let mut library = read(V1_7);
    let model = library.textures[0].model.clone();
    let path = library.textures[0].path.take();
    assert_eq!(version(&library), "1.7");
    let bare = |model: TextureModel| {
        model.with_along(None).unwrap().with_height_map(None).with_stick_slip(None).with_turn_rad(0.0)
    };
    for layer in [
        bare(model.clone()).with_along(model.along().map(<[_]>::to_vec)).unwrap(),
        bare(model.clone()).with_height_map(model.height_map().cloned()),
        bare(model.clone()).with_stick_slip(model.stick_slip()),
        bare(model.clone()).with_turn_rad(model.turn_rad()),
    ] {
        library.textures[0].model = layer;
        assert_eq!(version(&library), "1.7");
    }
    library.textures[0].model = bare(model);
    assert_eq!(version(&library), "1.6");
    library.textures[0].path = path;
    assert_eq!(version(&library), "1.7", "a key of the path has layers");
    let mut library = read(V1_4);
    assert_eq!(version(&library), "1.4");
    library.textures[0].path = None;
    assert_eq!(version(&library), "1.3");
    library.axes = None;
    assert_eq!(version(&library), "1.2");
    library.space_report = None;
    assert_eq!(version(&library), "1.2");
    library.textures[0].attributes = None;
    assert_eq!(version(&library), "1.1");
    library.textures.truncate(1);
    assert_eq!(version(&library), "1.0");
    library.textures[0].provenance = Provenance::Restricted;
    assert_eq!(version(&library), "1.1");
}
