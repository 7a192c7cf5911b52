use super::{HeadParts, KernelSize, PhotoHeads, PhotoHeadsError, class_weights};
use crate::model_file::Numbers;
use crate::photo_config::{HeadWeights, PhotoConfig};
use crate::photo_model::made_up::fast;
use crate::photo_set::PhotoSet;
use crate::photo_set::made_up::photo_set;

/// Fast settings with all heads.
fn with_kernel(seed: u64) -> PhotoConfig {
    let fast = fast(seed);
    PhotoConfig { hardness: HeadWeights { kernel: 1.0, ..fast.hardness }, ..fast }
}

fn learn(set: &PhotoSet, seed: u64) -> PhotoHeads {
    let all: Vec<usize> = (0..set.photos.len()).collect();
    PhotoHeads::learn(set, &all, &with_kernel(seed)).unwrap()
}

#[test]
fn classes_and_hardness_of_new_photos_are_predicted() {
    let (set, others) = (photo_set(60, 1), photo_set(30, 2));
    let heads = learn(&set, 1);
    let (mut n_right, mut off) = (0, [0.0; 3]);
    for photo in &others.photos {
        let looked = heads.look(&photo.features.late[..3]).unwrap();
        let of_class = |class: usize| looked.probabilities.iter().map(|of| of[class]).sum::<f64>();
        let best = (0..3).max_by(|a, b| of_class(*a).total_cmp(&of_class(*b))).unwrap();
        n_right += usize::from(best == photo.class);
        let label = others.classes[photo.class].hard_soft;
        let mean = |values: &[f64]| values.iter().sum::<f64>() / values.len() as f64;
        off[0] += (mean(&looked.ridge.unwrap()) - label).abs() / 30.0;
        off[2] += (mean(&looked.kernel.unwrap()) - label).abs() / 30.0;
        let of_networks: Vec<f64> = looked.networks.iter().map(|of| mean(of)).collect();
        off[1] += (mean(&of_networks) - label).abs() / 30.0;
        assert!(looked.distances.iter().all(|distance| *distance < 3.0), "{:?}", looked.distances);
    }
    // The labels are 10, 50 and 80, and the classes hardly overlap.
    assert!(n_right >= 28, "{n_right}");
    assert!(off.iter().all(|off| *off < 10.0), "{off:?}");
    let strange = heads.look(&[vec![90.0, -80.0, 70.0, -90.0]]).unwrap();
    assert!(strange.distances[0] > 3.0, "{strange:?}");
}

#[test]
fn a_class_without_photos_has_no_probability() {
    let set = photo_set(60, 1);
    let known: Vec<usize> = (0..60).filter(|index| set.photos[*index].class != 1).collect();
    let heads = PhotoHeads::learn(&set, &known, &fast(1)).unwrap();
    let looked = heads.look(&set.photos[1].features.late[..1]).unwrap();
    assert_eq!((looked.probabilities[0].len(), looked.probabilities[0][1]), (3, 0.0));
    assert!((looked.probabilities[0].iter().sum::<f64>() - 1.0).abs() < 1e-9);
}

#[test]
fn heads_come_back_from_a_file_and_a_seed_gives_the_same() {
    let set = photo_set(45, 3);
    let heads = learn(&set, 5);
    let looked = |heads: &PhotoHeads| heads.look(&set.photos[7].features.late).unwrap();
    assert_eq!(looked(&heads), looked(&learn(&set, 5)));
    assert_ne!(looked(&heads).networks, looked(&learn(&set, 6)).networks);
    let mut numbers = Numbers::new();
    heads.add_to(&mut numbers, "photo.").unwrap();
    let sizes = [heads.n_features(), 3];
    let read = PhotoHeads::read(&numbers, "photo.", &fast(5), sizes, heads.parts()).unwrap();
    assert_eq!(looked(&read), looked(&heads));
    let wrong = PhotoHeads::read(&numbers, "photo.", &fast(5), [heads.n_features(), 4], heads.parts());
    assert!(matches!(wrong, Err(PhotoHeadsError::File(_))));
    let n_components = heads.parts().kernel.unwrap().n_components;
    for n_examples in [0, 44, usize::MAX] {
        let kernel = Some(KernelSize { n_examples, n_components });
        let parts = HeadParts { kernel, ..heads.parts() };
        assert!(PhotoHeads::read(&numbers, "photo.", &fast(5), sizes, parts).is_err(), "{n_examples}");
    }
    let missing = PhotoHeads::read(&numbers, "other.", &fast(5), sizes, heads.parts());
    assert!(matches!(missing, Err(PhotoHeadsError::File(_))));
}

#[test]
fn heads_without_weight_are_not_trained() {
    let set = photo_set(30, 3);
    let hardness = HeadWeights { ridge: 0.0, classes: 1.0, network: 0.0, kernel: 0.0 };
    let all: Vec<usize> = (0..30).collect();
    let heads = PhotoHeads::learn(&set, &all, &PhotoConfig { hardness, ..fast(1) }).unwrap();
    assert_eq!(heads.parts(), HeadParts { has_ridge: false, kernel: None, n_networks: 0 });
    let looked = heads.look(&set.photos[0].features.late).unwrap();
    assert!(looked.ridge.is_none() && looked.kernel.is_none() && looked.networks.is_empty());
}

#[test]
fn photos_of_large_classes_count_less() {
    let weights = class_weights([0, 1, 1, 1, 1].into_iter(), 2, -0.5);
    assert_eq!(weights, [1.0, 0.5, 0.5, 0.5, 0.5]);
    assert_eq!(class_weights([0, 1, 1].into_iter(), 3, 0.0), [1.0; 3]);
}

#[test]
fn impossible_input_is_refused() {
    let set = photo_set(30, 3);
    let all: Vec<usize> = (0..30).collect();
    let refused = |set: &PhotoSet, photos: &[usize]| PhotoHeads::learn(set, photos, &fast(1)).unwrap_err();
    assert!(matches!(refused(&set, &[]), PhotoHeadsError::TooFew { n_photos: 0, .. }));
    assert!(matches!(refused(&set, &[0, 3, 6]), PhotoHeadsError::TooFew { n_photos: 3, n_classes: 1 }));
    let mut broken = set.clone();
    broken.photos[4].features.late[2][0] = f32::NAN;
    assert!(matches!(refused(&broken, &all), PhotoHeadsError::Features { index: 4 }));
    let wrong = PhotoConfig { class_penalty: 0.0, ..fast(1) };
    assert!(matches!(PhotoHeads::learn(&set, &all, &wrong), Err(PhotoHeadsError::Settings)));
    let heads = learn(&set, 1);
    assert!(matches!(heads.look(&[vec![0.0; 4], vec![0.0; 3]]), Err(PhotoHeadsError::Features { index: 1 })));
    assert!(heads.look(&[]).is_err());
}
