//! What a photo seems to show: likely materials that can be taken, doubts, and words that are given with a photo.

use std::path::Path;

use egui::Key;
use egui_kittest::kittest::Queryable as _;
use serde_json::json;
use shagreen_app::Begin;
use shagreen_app::author::prompt::PositionEstimate;
use shagreen_app::state::files::StoragePaths;
use shagreen_app::strings;
use shagreen_app::strings::{prompt as words, relief};
use shagreen_core::maths::gaussian_process::Estimate;
use shagreen_core::maths::rng::lcg_noise;
use shagreen_core::space::SpacePoint;
use shagreen_core::surfaces::generated::{Witness, agree};
use shagreen_core::surfaces::picture_doubts::PictureDoubt;
use shagreen_core::surfaces::prompt::interpret;
use shagreen_core::surfaces::shading::Picture;
use shagreen_formats::lexicon_toml::built_in_lexicon;
use shagreen_formats::photo_networks::{ImageNetwork, PhotoNetworks};
use shagreen_formats::picture::{Rgb, encode_png};
use shagreen_formats::project::AuthoredTexture;
use shagreen_learn::photo_card::PhotoCard;
use shagreen_learn::photo_config::{PhotoConfig, SmallNetworkConfig};
use shagreen_learn::photo_folds::{LeftOut, folds};
use shagreen_learn::photo_model::{PhotoModel, drawn_roughness};
use shagreen_learn::photo_set::{MaterialClass, PhotoFeatures, PhotoSet, SeenPhoto};
use shagreen_learn::photo_validation::judge;
use shagreen_learn::picture_model::{FeatureExtractor, PictureConfig, PictureModel, TrainingMetadata};
use shagreen_learn::picture_predictor::see_photo;
use shagreen_learn::picture_set::Seen;
use shagreen_studio::project::new_project;
use shagreen_studio::seen_materials::doubt_with_advice;

use crate::support::{
    Author, author, author_of, begin, click, drop_files, says, unnamed_controls, wait, window, write_into,
};

/// Classes with their softness and the size of the grain in their pictures, in pixels.
const CLASSES: [(&str, f64, usize); 3] = [("brick", 9.0, 1), ("carpet", 85.0, 3), ("cork", 57.0, 12)];
const CARPET: usize = 1;
/// Pixels along each side of a picture.
const SIDE: usize = 120;

/// Noise of the grain of a class.
fn picture(class: usize, seed: u64) -> Picture {
    let grain = CLASSES[class].2;
    let noise = lcg_noise(3 * SIDE * SIDE, seed);
    let pixel = |i: usize| -> [u8; 3] {
        let (x, y) = (i % SIDE / grain * grain, i / SIDE / grain * grain);
        [0, 1, 2].map(|c| (128.0 + 40.0 * noise[3 * (y * SIDE + x) + c]).clamp(0.0, 255.0) as u8)
    };
    Picture { width: SIDE, height: SIDE, rgb: (0..SIDE * SIDE).flat_map(pixel).collect(), millimeters: 20.0 }
}

fn photo_set() -> PhotoSet {
    let photo = |index: usize| {
        let class = index % CLASSES.len();
        let mut features: PhotoFeatures = see_photo(None, &picture(class, index as u64 + 1)).unwrap();
        // One variation, the same as the photo.
        features.late.push(features.late[0].clone());
        let (file, sha256) = (format!("{index}.png"), format!("{index:064}"));
        SeenPhoto { file, sha256, class, source: index / CLASSES.len() % 4, features }
    };
    let class = |(name, hard_soft, _): (&str, f64, usize)| MaterialClass {
        name: name.to_owned(),
        hard_soft,
        hard_soft_sd: 7.0,
        rough_smooth: 40.0,
        rough_smooth_sd: 12.0,
    };
    PhotoSet {
        made_by: "test".to_owned(),
        classes: CLASSES.map(class).to_vec(),
        sources: ["a", "b", "c", "d"].map(str::to_owned).to_vec(),
        photos: (0..24).map(photo).collect(),
    }
}

/// File of a model that tells the classes apart by statistics of the picture.
fn photo_model() -> Vec<u8> {
    let set = photo_set();
    let of = |photo: &SeenPhoto| Seen {
        features: photo.features.early.clone(),
        labels: vec![40.0, CLASSES[photo.class].1],
    };
    let pictures: Vec<Seen> = set.photos.iter().map(of).collect();
    let metadata = TrainingMetadata {
        eyes: FeatureExtractor::Statistics,
        attributes: vec!["rough-smooth".to_owned(), "hard-soft".to_owned()],
        learned_from: "noise".to_owned(),
    };
    let config = PictureConfig { hidden: vec![6], ..PictureConfig::paper(4, 2, 1, 1) };
    let drawn =
        PictureModel::learn(&pictures.iter().collect::<Vec<_>>(), metadata, &config, |_| true).unwrap();
    let usual = PhotoConfig::usual(1);
    let network = SmallNetworkConfig { n_hidden: 6, n_epochs: 4, n_networks: 1, ..usual.network };
    let config = PhotoConfig { network, ..usual };
    let rough: Vec<Option<Estimate>> =
        set.photos.iter().map(|photo| drawn_roughness(&drawn, &photo.features).unwrap()).collect();
    let mut judged = Vec::new();
    for kind in LeftOut::ALL {
        for numbered in folds(&set, kind, 4).iter().enumerate() {
            judged.extend(judge(&set, numbered, &rough, &config).unwrap());
        }
    }
    let card = PhotoCard {
        n_photos: 0,
        n_classes: 0,
        sources: Vec::new(),
        left_out: Vec::new(),
        labels: "noise".to_owned(),
        drawn_materials: "noise".to_owned(),
        n_variations: 1,
        settings: config.clone(),
        figures: Vec::new(),
        limits: Vec::new(),
    };
    PhotoModel::learn(&set, drawn, &judged, &config, card).unwrap().to_bytes().unwrap()
}

/// Window whose settings name the model that tells materials apart.
fn author_with_materials(folder: &Path) -> Author {
    let heads = folder.join("materials.safetensors");
    std::fs::write(&heads, photo_model()).unwrap();
    let networks = PhotoNetworks { network: ImageNetwork::Statistics, heads: Some(heads) };
    let settings = json!({"has_seen_tour": true, "photo_networks": networks.to_json()});
    let path = folder.join("settings.json");
    std::fs::write(&path, settings.to_string()).unwrap();
    let keeping = StoragePaths { settings: Some(path), ..StoragePaths::default() };
    author_of(Begin { keeping, ..begin(new_project()) }, [1280.0, 720.0])
}

/// Drops a photo and answers the question what it is for.
fn land(harness: &mut Author, picture: &Picture, answer: &str) {
    let n = window(harness).project().authored.len();
    drop_files(harness, &[("floor.png", &encode_png(&Rgb::from(picture)).unwrap())]);
    click(harness, answer);
    wait(harness, "it landed", |h| window(h).project().authored.len() == n + 1);
    harness.run_steps(4);
}

fn selected(harness: &Author) -> AuthoredTexture {
    window(harness).project().texture().clone()
}

fn estimate(harness: &Author) -> PositionEstimate {
    window(harness).prompts().guess_of(&selected(harness)).expect("it was estimated").clone()
}

/// Estimates of a material in the lexicon, along the usual axes.
fn in_lexicon(material: &str) -> Vec<Estimate> {
    let hints = built_in_lexicon().unwrap().material(material).unwrap().1;
    vec![hints[0].unwrap(), hints[1].unwrap()]
}

fn at(axes: &[Estimate]) -> SpacePoint {
    SpacePoint::plane(axes[0].mean, axes[1].mean)
}

#[test]
fn materials_are_named_and_a_click_takes_the_lexicon_entry_until_undo() {
    let folder = tempfile::tempdir().unwrap();
    let mut harness = author_with_materials(folder.path());
    land(&mut harness, &picture(CARPET, 500), relief::FIND_POINT);
    let (landed, seen) = (selected(&harness), estimate(&harness));
    let carpet = seen.materials[0].clone();
    assert_eq!((carpet.name.as_str(), carpet.axes), ("carpet", Some(in_lexicon("carpet"))));
    assert!(carpet.label.starts_with("carpet ") && carpet.label.ends_with(" %"), "{}", carpet.label);
    assert!(says(&harness, words::LOOKS_LIKE) && says(&harness, &carpet.label));
    assert_eq!(unnamed_controls(&harness), Vec::<String>::new());
    assert!(landed.notes.contains("from the photo floor.png"), "{}", landed.notes);

    click(&mut harness, &carpet.label);
    harness.run_steps(3);
    let (moved, taken) = (selected(&harness), estimate(&harness));
    // The point, the ellipse and the card.
    assert_eq!((moved.at, taken.axes), (at(&in_lexicon("carpet")), in_lexicon("carpet")));
    let hard_soft = in_lexicon("carpet")[1];
    assert!(says(&harness, &format!("soft {:.0} ± {:.0}", hard_soft.mean, hard_soft.deviation)));
    assert!(says(&harness, "carpet in the lexicon") && says(&harness, "nobody rated it"));
    assert!(moved.notes.contains("carpet in the lexicon") && moved.picture == landed.picture);
    assert_eq!((&moved.name, &moved.blend), (&landed.name, &landed.blend));

    click(&mut harness, strings::UNDO);
    harness.run_steps(3);
    assert_eq!(
        (selected(&harness), estimate(&harness)),
        (landed.clone(), seen.clone()),
        "as before the click"
    );
    click(&mut harness, strings::REDO);
    harness.run_steps(3);
    assert_eq!((selected(&harness).at, estimate(&harness).taken), (moved.at, Some("carpet".to_owned())));
    // A click on the taken material takes the estimate from the picture again. Notes of the user stay.
    click(&mut harness, &carpet.label);
    harness.run_steps(3);
    assert_eq!((selected(&harness).at, estimate(&harness)), (landed.at, seen));
    assert_eq!(selected(&harness).notes, landed.notes);
    for _ in 0..3 {
        click(&mut harness, strings::UNDO);
    }
    assert_eq!(window(&harness).project().authored.len(), 1);
}

#[test]
fn a_picture_that_is_made_from_words_names_no_materials_and_moves_nothing() {
    let folder = tempfile::tempdir().unwrap();
    let mut harness = author_with_materials(folder.path());
    for prompt in ["velvet", "the meaning of life"] {
        let n = window(&harness).project().authored.len();
        write_into(&mut harness, words::FIELD, prompt);
        harness.key_press(Key::Enter);
        wait(&mut harness, "it was made", |h| window(h).project().authored.len() > n);
        harness.run_steps(4);
        let made = estimate(&harness);
        let [rough_smooth, hard_soft, ..] = interpret(prompt, built_in_lexicon().unwrap()).attributes;
        assert_eq!(made.axes, [rough_smooth, hard_soft], "{prompt}");
        assert_eq!(selected(&harness).at, at(&[rough_smooth, hard_soft]), "{prompt}");
        assert!(made.materials.is_empty() && made.doubts.is_empty() && !made.is_disputed);
        assert!(!says(&harness, words::LOOKS_LIKE) && says(&harness, words::BY_WORDS));
    }
}

#[test]
fn a_doubtful_photo_says_so_and_what_to_do() {
    let mut harness = author();
    let card = Picture { rgb: vec![128; 3 * SIDE * SIDE], ..picture(CARPET, 1) };
    land(&mut harness, &card, relief::FIND_POINT);
    let doubt = words::doubt(&doubt_with_advice(PictureDoubt::NoDetail));
    assert!(estimate(&harness).doubts.contains(&doubt) && says(&harness, &doubt), "{doubt}");
    assert!(doubt.contains("almost no detail; light the surface from the side"), "{doubt}");
}

/// Words in the prompt box are evidence only if the user says so: they may belong to the last prompt.
#[test]
fn words_that_are_given_with_a_photo_count_as_independent_evidence() {
    let mut harness = author();
    let photo = picture(CARPET, 500);
    write_into(&mut harness, words::FIELD, "the meaning of life");
    land(&mut harness, &photo, relief::FIND_POINT);
    let of_photo = estimate(&harness).axes;
    write_into(&mut harness, words::FIELD, "velvet");
    land(&mut harness, &photo, relief::FIND_POINT);
    assert_eq!(estimate(&harness).axes, of_photo, "without the words");
    land(&mut harness, &photo, &relief::find_point_with("velvet"));
    let both = estimate(&harness);
    let of_words = interpret("velvet", built_in_lexicon().unwrap()).attributes;
    let expected = [0, 1].map(|axis| agree(of_words[axis], of_photo[axis], Witness::OnItsOwn).estimate);
    assert_eq!(both.axes, expected);
    assert!(says(&harness, "Understood: velvet.") && says(&harness, "from the words, and from the picture"));
    assert!(selected(&harness).notes.contains("floor.png and the words \"velvet\""));
    // Words that say nothing of touch are not offered.
    write_into(&mut harness, words::FIELD, "the meaning of life");
    drop_files(&mut harness, &[("floor.png", &encode_png(&Rgb::from(&photo)).unwrap())]);
    assert!(harness.query_by_label_contains(&relief::find_point_with("the meaning of life")).is_none());
    assert!(harness.query_by_label(relief::FIND_POINT).is_some());
}
