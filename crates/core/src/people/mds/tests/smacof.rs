//! Slow oracle: SMACOF as published, on full matrices, with the same steps as the script of the golden vectors.

use crate::maths::isotonic::isotonic;
use crate::people::mds::Ties;

/// Disparities of the distances, pair by pair.
fn disparities(dissimilarities: &[f64], distances: &[f64], ties: Ties) -> Vec<f64> {
    let mut order: Vec<usize> = (0..distances.len()).collect();
    order.sort_by(|a, b| {
        let within = distances[*a].total_cmp(&distances[*b]);
        dissimilarities[*a].total_cmp(&dissimilarities[*b]).then(within)
    });
    let sorted: Vec<f64> = order.iter().map(|k| distances[*k]).collect();
    let fitted = match ties {
        Ties::Primary => isotonic(&sorted),
        // Each value of a tied run is replaced by the mean of the run; isotonic regression keeps adjacent equal values
        // equal.
        Ties::Secondary => {
            let mut means = Vec::new();
            for run in order.chunk_by(|a, b| dissimilarities[*a] == dissimilarities[*b]) {
                let mean = run.iter().map(|k| distances[*k]).sum::<f64>() / run.len() as f64;
                means.extend(std::iter::repeat_n(mean, run.len()));
            }
            isotonic(&means)
        }
    };
    let mut out = vec![0.0; distances.len()];
    for (k, value) in order.iter().zip(fitted) {
        out[*k] = value;
    }
    out
}

/// Distances between all points, the upper triangle row by row.
fn distances(points: &[f64], dims: usize) -> Vec<f64> {
    let rows: Vec<&[f64]> = points.chunks_exact(dims).collect();
    let distance = |p: &[f64], q: &[f64]| p.iter().zip(q).map(|(a, b)| (a - b).powi(2)).sum::<f64>().sqrt();
    let pairs = (0..rows.len()).flat_map(|i| (i + 1..rows.len()).map(move |j| (i, j)));
    pairs.map(|(i, j)| distance(rows[i], rows[j])).collect()
}

/// Moves `points` until stress falls by less than `least`; returns the stress before each step.
pub(super) fn smacof(
    condensed: &[f64],
    dims: usize,
    ties: Ties,
    points: &mut Vec<f64>,
    least: f64,
) -> Vec<f64> {
    let n = points.len() / dims;
    let mut history: Vec<f64> = Vec::new();
    for _ in 0..1000 {
        let d = distances(points, dims);
        let fitted = disparities(condensed, &d, ties);
        let squares = |v: &[f64]| v.iter().map(|x| x * x).sum::<f64>();
        let misfit: Vec<f64> = d.iter().zip(&fitted).map(|(d, f)| d - f).collect();
        let stress = (squares(&misfit) / squares(&d)).sqrt();
        let fell = history.last().map_or(f64::INFINITY, |before| before - stress);
        history.push(stress);
        if fell < least {
            break;
        }
        let scale = (squares(&d) / squares(&fitted)).sqrt();
        let mut moved = vec![0.0; points.len()];
        let mut k = 0;
        for i in 0..n {
            for j in i + 1..n {
                let ratio = if d[k] > 1e-12 { scale * fitted[k] / d[k] } else { 0.0 };
                for axis in 0..dims {
                    let pull = ratio * (points[i * dims + axis] - points[j * dims + axis]) / n as f64;
                    moved[i * dims + axis] += pull;
                    moved[j * dims + axis] -= pull;
                }
                k += 1;
            }
        }
        *points = moved;
    }
    history
}
