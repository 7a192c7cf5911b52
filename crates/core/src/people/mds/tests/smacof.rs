//! Slow oracle: SMACOF as published, on full matrices, with the same steps as the script of the golden vectors.

use crate::maths::isotonic::isotonic;
use crate::people::mds::Transform;

/// Disparities of the distances, pair by pair.
fn disparities(dissimilarities: &[f64], distances: &[f64], ties: Transform) -> Vec<f64> {
    let mut order: Vec<usize> = (0..distances.len()).collect();
    order.sort_by(|a, b| {
        let within = distances[*a].total_cmp(&distances[*b]);
        dissimilarities[*a].total_cmp(&dissimilarities[*b]).then(within)
    });
    let sorted: Vec<f64> = order.iter().map(|k| distances[*k]).collect();
    let fitted = match ties {
        Transform::PrimaryTies => isotonic(&sorted),
        // Each value of a tied run is replaced by the mean of the run; isotonic regression keeps adjacent equal values
        // equal.
        Transform::SecondaryTies => {
            let mut means = Vec::new();
            for run in order.chunk_by(|a, b| dissimilarities[*a] == dissimilarities[*b]) {
                let mean = run.iter().map(|k| distances[*k]).sum::<f64>() / run.len() as f64;
                means.extend(std::iter::repeat_n(mean, run.len()));
            }
            isotonic(&means)
        }
        Transform::Interval => {
            let n = order.len() as f64;
            let lowest = dissimilarities[order[0]];
            let values: Vec<f64> = order.iter().map(|k| dissimilarities[*k] - lowest).collect();
            let dot = |a: &[f64], b: &[f64]| a.iter().zip(b).map(|(a, b)| a * b).sum::<f64>();
            let [sum, total] = [&values, &sorted].map(|of| of.iter().sum::<f64>());
            let (squares, product) = (dot(&values, &values), dot(&values, &sorted));
            // The best of all feasible lines: the free one, the constant, and the one through the origin.
            let determinant = n * squares - sum * sum;
            let free =
                [(total * squares - sum * product) / determinant, (n * product - sum * total) / determinant];
            let misfit = |line: &[f64; 2]| -> f64 {
                values.iter().zip(&sorted).map(|(v, d)| (d - line[0] - line[1] * v).powi(2)).sum()
            };
            let lines = [free, [total / n, 0.0], [0.0, product / squares]];
            let feasible = lines.into_iter().filter(|line| line.iter().all(|part| *part >= 0.0));
            let [start, slope] =
                feasible.min_by(|a, b| misfit(a).total_cmp(&misfit(b))).expect("the constant is feasible");
            values.iter().map(|v| start + slope * v).collect()
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
    ties: Transform,
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
