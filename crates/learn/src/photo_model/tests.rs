use super::made_up::{card, config, drawn_heads, photo_model};
use super::{PhotoModel, drawn_roughness};
use crate::photo_folds::LeftOut;
use crate::photo_set::made_up::photo_set;
use crate::photo_set::{PhotoFeatures, SeenPhoto};
use crate::picture_model::PictureModelError;
use shagreen_core::surfaces::picture_doubts::{Detail, PictureDoubt};
use shagreen_core::surfaces::picture_features::N_VIEWS;

/// Features as a prediction has them: without variations.
fn views(photo: &SeenPhoto) -> PhotoFeatures {
    PhotoFeatures { late: photo.features.late[..N_VIEWS].to_vec(), ..photo.features.clone() }
}

#[test]
fn photos_are_predicted_with_materials_and_doubts() {
    let (set, others) = (photo_set(60, 1), photo_set(12, 9));
    let model = photo_model(&set);
    for photo in &others.photos {
        let predicted = model.predict(&views(photo)).unwrap();
        let class = &set.classes[photo.class];
        assert_eq!(predicted.materials[0].name, class.name);
        assert!(predicted.materials.iter().map(|of| of.probability).sum::<f64>() <= 1.0 + 1e-9);
        let [rough, hard] = predicted.attributes[..] else { panic!("two attributes") };
        assert!((hard.mean - class.hard_soft).abs() < 25.0, "{hard:?}");
        // Not below the standard deviations of the labels.
        assert!(hard.deviation > 5.9 && rough.deviation > 11.9, "{predicted:?}");
        assert!(predicted.doubts.is_empty(), "{predicted:?}");
    }
    let usual = views(&others.photos[0]);
    let before = model.predict(&usual).unwrap();
    let gray = PhotoFeatures { detail: Detail { rms: 0.001, sharpness_db: 0.0 }, ..usual.clone() };
    let of_gray = model.predict(&gray).unwrap();
    assert_eq!(of_gray.doubts, [PictureDoubt::NoDetail]);
    assert!(of_gray.attributes[1].deviation > before.attributes[1].deviation + 5.0);
    assert_eq!(of_gray.attributes[1].mean, before.attributes[1].mean);
    let strange = PhotoFeatures { late: vec![vec![60.0, -70.0, 80.0, -60.0]; N_VIEWS], ..usual };
    let of_strange = model.predict(&strange).unwrap();
    assert!(of_strange.doubts.contains(&PictureDoubt::UnlikeTraining), "{of_strange:?}");
    assert!(of_strange.attributes[1].deviation > before.attributes[1].deviation);
}

#[test]
fn a_model_comes_back_from_its_file_with_its_card() {
    let set = photo_set(48, 2);
    let model = photo_model(&set);
    let bytes = model.to_bytes().unwrap();
    assert_eq!(bytes, photo_model(&set).to_bytes().unwrap(), "the same seed");
    let read = PhotoModel::from_bytes(&bytes).unwrap();
    for photo in &set.photos {
        assert_eq!(read.predict(&views(photo)).unwrap(), model.predict(&views(photo)).unwrap());
    }
    assert_eq!(read.card(), model.card());
    assert_eq!((read.card().n_photos, read.card().n_classes), (48, 3));
    assert!(read.learned_from().contains("48 photos") && read.learned_from().contains("drawn materials"));
    assert_eq!(read.attributes(), ["rough-smooth", "hard-soft"]);
    for left_out in LeftOut::ALL {
        let figures = read.card().figures.iter().filter(|of| of.left_out == left_out);
        let ratios: Vec<Option<f64>> =
            figures.filter(|of| of.predictor == "the model").map(|of| of.error_over_deviation).collect();
        assert!(ratios.len() == 2 && ratios.iter().all(Option::is_some), "{ratios:?}");
    }
}

#[test]
fn damage_and_impossible_numbers_are_refused() {
    let bytes = photo_model(&photo_set(24, 2)).to_bytes().unwrap();
    for n in [0, 100, bytes.len() / 2, bytes.len() - 1] {
        assert!(PhotoModel::from_bytes(&bytes[..n]).is_err(), "{n}");
    }
    let replaced = |from: &str, to: &str| {
        let at = bytes.windows(from.len()).position(|window| window == from.as_bytes()).unwrap();
        let mut changed = bytes.clone();
        changed[at..at + to.len()].copy_from_slice(to.as_bytes());
        PhotoModel::from_bytes(&changed).unwrap_err().to_string()
    };
    let fewer = replaced(r#"\"n_features\":4"#, r#"\"n_features\":5"#);
    assert!(fewer.contains("do not fit"), "{fewer}");
    assert!(replaced(r#"\"n_features\":4"#, r#"\"n_features\":0"#).contains("settings of the heads"));
    assert!(replaced(r#"\"hard_soft\":10.0"#, r#"\"hard_soft\":-9.0"#).contains("settings are invalid"));
}

#[test]
fn the_roughness_of_a_small_photo_is_that_of_its_materials() {
    let model = photo_model(&photo_set(48, 2));
    let sized = |side_px, first| {
        let of = views(&photo_set(6, 7).photos[1]);
        let early = vec![first, of.early[1]];
        model.predict(&PhotoFeatures { early, side_px, ..of }).unwrap().attributes
    };
    // Early features change the roughness of a large photo only, and never the hardness.
    assert_ne!(sized(224, 0.0)[0].mean, sized(223, 0.0)[0].mean);
    assert_eq!(sized(223, 0.0), sized(223, 3.0));
    assert_eq!(sized(224, 0.0)[1], sized(128, 0.0)[1]);
}

#[test]
fn what_nothing_can_be_learned_from_is_refused() {
    let set = photo_set(12, 2);
    let refused = |set| PhotoModel::learn(set, drawn_heads(2), &[], &config(), card()).unwrap_err();
    assert!(matches!(refused(&set), PictureModelError::Unjudged));
    let early = |early: &[f32]| PhotoFeatures { early: early.to_vec(), ..views(&set.photos[0]) };
    assert!(drawn_roughness(&drawn_heads(2), &early(&[1.0, 2.0])).unwrap().unwrap().deviation > 0.0);
    let short = drawn_roughness(&drawn_heads(2), &early(&[1.0]));
    assert!(matches!(short, Err(PictureModelError::Picture { .. })));
    let model = photo_model(&photo_set(24, 2));
    let short = PhotoFeatures { late: vec![vec![0.0; 3]; N_VIEWS], ..views(&set.photos[0]) };
    assert!(matches!(model.predict(&short), Err(PictureModelError::Photos(_))));
}
