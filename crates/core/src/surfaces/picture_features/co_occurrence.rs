//! Gray-level co-occurrence features (R. Haralick, K. Shanmugam and I. Dinstein, "Textural features for image
//! classification", 1973).

/// Number of quantized gray levels.
const N_GRAY: usize = 32;
/// Number of features per distance: contrast, correlation, homogeneity, uniformity, entropy.
pub(super) const N_OF_DISTANCE: usize = 5;

/// Returns the co-occurrence features of pixel pairs at a distance, symmetric, over four directions.
///
/// Contrast is `Σ p (i-j)²` relative to the squared number of levels, homogeneity `Σ p / (1 + |i-j|)`, uniformity
/// `Σ p²`, and entropy in bits.
pub(super) fn co_occurrence(gray: &[f64], side: usize, distance: usize) -> [f64; N_OF_DISTANCE] {
    let level = |x: &f64| ((x * N_GRAY as f64) as usize).min(N_GRAY - 1);
    let levels: Vec<usize> = gray.iter().map(level).collect();
    let mut counts = vec![0_u32; N_GRAY * N_GRAY];
    let mut count = |a: usize, b: usize| {
        counts[levels[a] * N_GRAY + levels[b]] += 1;
        counts[levels[b] * N_GRAY + levels[a]] += 1;
    };
    for y in 0..side {
        for x in 0..side {
            let here = y * side + x;
            if x + distance < side {
                count(here, here + distance);
            }
            if y + distance < side {
                count(here, here + distance * side);
                if x + distance < side {
                    count(here, here + distance * side + distance);
                }
                if x >= distance {
                    count(here, here + distance * side - distance);
                }
            }
        }
    }
    let n = f64::from(counts.iter().sum::<u32>());
    let shares =
        || counts.iter().enumerate().map(|(i, count)| (i / N_GRAY, i % N_GRAY, f64::from(*count) / n));
    // The matrix is symmetric, so row and column moments are equal.
    let mean: f64 = shares().map(|(i, _, p)| p * i as f64).sum();
    let variance: f64 = shares().map(|(i, _, p)| p * (i as f64 - mean).powi(2)).sum();
    let covariance: f64 = shares().map(|(i, j, p)| p * (i as f64 - mean) * (j as f64 - mean)).sum();
    let range = (N_GRAY * N_GRAY) as f64;
    [
        shares().map(|(i, j, p)| p * (i.abs_diff(j) as f64).powi(2)).sum::<f64>() / range,
        // A picture of one gray level has correlation 1.
        if variance > 1e-9 { covariance / variance } else { 1.0 },
        shares().map(|(i, j, p)| p / (1.0 + i.abs_diff(j) as f64)).sum(),
        shares().map(|(_, _, p)| p * p).sum(),
        shares().filter(|(_, _, p)| *p > 0.0).map(|(_, _, p)| -p * p.log2()).sum(),
    ]
}
