use shagreen_core::maths::rng::Random;
use shagreen_core::surfaces::picture_doubts::Detail;
use shagreen_core::surfaces::picture_features::N_VIEWS;

use super::{MaterialClass, PhotoFeatures, PhotoSet, SeenPhoto};

/// Corners of a plane around which the late features of three classes scatter.
const CORNERS: [[f64; 2]; 3] = [[0.0, 0.0], [5.0, 0.0], [1.0, 5.0]];

/// Returns photos of three classes in turn, from four sources, each with two variations. The hardness of the classes is 10,
/// 50 and 80. Early features are two numbers.
pub(crate) fn photo_set(n: usize, seed: u64) -> PhotoSet {
    let mut random = Random::new(seed);
    let class = |(name, hard_soft): (&str, f64)| MaterialClass {
        name: name.to_owned(),
        hard_soft,
        hard_soft_sd: 6.0,
        rough_smooth: 90.0 - hard_soft,
        rough_smooth_sd: 12.0,
    };
    let mut photo = |index: usize| {
        let class = index % 3;
        let mut late = |_| -> Vec<f32> {
            let [x, y] = CORNERS[class];
            [x, y, 0.0, 0.0].iter().map(|center| (center + 0.8 * random.normal()) as f32).collect()
        };
        let features = PhotoFeatures {
            late: (0..N_VIEWS + 2).map(&mut late).collect(),
            early: vec![class as f32, index as f32],
            detail: Detail { rms: 0.1, sharpness_db: -4.0 },
            side_px: 512,
        };
        let (file, sha256) = (format!("{index}.jpg"), format!("{index:064}"));
        SeenPhoto { file, sha256, class, source: index / 3 % 4, features }
    };
    PhotoSet {
        made_by: "drawn numbers".to_owned(),
        classes: [("brick", 10.0), ("cork", 50.0), ("carpet", 80.0)].map(class).to_vec(),
        sources: ["a", "b", "c", "d"].map(str::to_owned).to_vec(),
        photos: (0..n).map(&mut photo).collect(),
    }
}
