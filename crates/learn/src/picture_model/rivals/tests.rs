use super::{Layer, N_COLORS, N_PIXELS, Rival, pixels, pooled, rival_predictions, windows};
use crate::picture_model::{PictureConfig, PictureModelError};
use crate::picture_set::Seen;
use candle_core::{Device, Tensor};
use shagreen_core::maths::rng::Random;
use shagreen_core::surfaces::picture_features::{SIDE, Square};

#[test]
fn pixels_are_means_of_their_part_of_the_square() {
    let rgb = (0..SIDE * SIDE).flat_map(|i| {
        let (row, column) = (i / SIDE, i % SIDE);
        [row as f32 / 223.0, column as f32 / 223.0, 1.0]
    });
    let pixels = pixels(&Square { rgb: rgb.collect() });
    assert_eq!(pixels.len(), N_PIXELS * N_PIXELS * N_COLORS);
    // Rows 4 to 7 and columns 8 to 11.
    let at = (N_PIXELS + 2) * N_COLORS;
    for (color, expected) in [5.5 / 223.0 - 0.5, 9.5 / 223.0 - 0.5, 0.5].into_iter().enumerate() {
        assert!((pixels[at + color] - expected).abs() < 1e-5, "{color}: {}", pixels[at + color]);
    }
}

/// Against a slow oracle: the sums over the windows are those of a convolution with a kernel of ones.
#[test]
fn windows_hold_the_surroundings_and_pools_their_highest_value() {
    let (n_rows, n_columns) = (4, 5);
    let value = |row: usize, column: usize| ((7 * row + 3 * column) % 11) as f32;
    let values: Vec<f32> = (0..n_rows * n_columns).map(|i| value(i / n_columns, i % n_columns)).collect();
    let x = Tensor::from_vec(values, (1, n_rows, n_columns, 1), &Device::Cpu).unwrap();
    let sums = windows(&x, [3, 3]).unwrap().sum(3).unwrap().flatten_all().unwrap().to_vec1::<f32>().unwrap();
    for row in 0..n_rows {
        for column in 0..n_columns {
            let mut expected = 0.0;
            for r in row.saturating_sub(1)..(row + 2).min(n_rows) {
                for c in column.saturating_sub(1)..(column + 2).min(n_columns) {
                    expected += value(r, c);
                }
            }
            assert_eq!(sums[row * n_columns + column], expected, "{row} {column}");
        }
    }
    let highest = pooled(&x, [2, 2]).unwrap();
    assert_eq!(highest.dims(), [1, 2, 2, 1]);
    let highest = highest.flatten_all().unwrap().to_vec1::<f32>().unwrap();
    let most = |row: usize, column: usize| {
        [(0, 0), (0, 1), (1, 0), (1, 1)]
            .map(|(r, c)| value(row + r, column + c))
            .into_iter()
            .fold(0.0, f32::max)
    };
    assert_eq!(highest, [most(0, 0), most(0, 2), most(2, 0), most(2, 2)]);
}

/// Pictures of which the first label follows from the brightness, or from the first features.
fn pictures(rival: Rival, n: usize) -> Vec<Seen> {
    let mut random = Random::new(8);
    let n_features = if rival.reads_pixels() { N_PIXELS * N_PIXELS * N_COLORS } else { 16 };
    let of = |_| {
        let level = random.uniform();
        let noise = |random: &mut Random| 0.05 * random.normal();
        let features =
            (0..n_features).map(|_| (level - 0.5 + noise(&mut random)) as f32).collect::<Vec<f32>>();
        Seen { features, labels: vec![100.0 * level, 50.0] }
    };
    (0..n).map(of).collect()
}

#[test]
fn every_rival_learns_what_its_features_say_and_repeats() {
    for rival in Rival::ALL {
        // Pixels take long in an unoptimized build.
        let n = if rival.reads_pixels() { 12 } else { 60 };
        let all = pictures(rival, n);
        let references: Vec<&Seen> = all.iter().collect();
        let (asked, learned) = references.split_at(2);
        let n_epochs = if rival.reads_pixels() { 2 } else { 40 };
        let config =
            PictureConfig { n_batch: 8, learning_rate: 5e-3, ..PictureConfig::paper(n_epochs, 40, 1, 1) };
        let predicted = || rival_predictions(rival, learned, asked, &config, |_| true).unwrap();
        let found = predicted();
        assert_eq!((found.len(), found[0].len()), (2, 2), "{}", rival.name());
        assert!(found.iter().flatten().all(|x| (0.0..=100.0).contains(x)), "{found:?}");
        if !rival.reads_pixels() {
            for (found, seen) in found.iter().zip(asked) {
                assert!((found[0] - seen.labels[0]).abs() < 25.0, "{found:?} {:?}", seen.labels);
            }
            assert_eq!(predicted(), found);
        }
    }
}

#[test]
fn pictures_of_another_size_are_refused() {
    let all = pictures(Rival::OneDimensional, 12);
    let references: Vec<&Seen> = all.iter().collect();
    let config = PictureConfig::paper(1, 1, 1, 1);
    let predict =
        |rival, learned: &[&Seen]| rival_predictions(rival, learned, &references[..1], &config, |_| true);
    assert!(matches!(predict(Rival::VisionNet, &references), Err(PictureModelError::Settings)));
    assert!(matches!(predict(Rival::OneDimensional, &[]), Err(PictureModelError::TooFew { .. })));
    let other = Seen { features: vec![0.0; 3], labels: vec![1.0, 2.0] };
    let error =
        rival_predictions(Rival::OneDimensional, &references, &[&other], &config, |_| true).unwrap_err();
    assert!(matches!(error, PictureModelError::Picture { index: 12, .. }), "{error}");
}

#[test]
fn each_rival_has_its_arrangement() {
    let n_kernels = |rival: Rival| -> usize {
        let of = |layer: &Layer| match layer {
            Layer::Convolution { kernels, .. } => kernels.len(),
            Layer::Pool(_) => 0,
        };
        rival.design(41).layers.iter().map(of).sum()
    };
    assert_eq!(Rival::ALL.map(n_kernels), [7, 5, 3]);
}
