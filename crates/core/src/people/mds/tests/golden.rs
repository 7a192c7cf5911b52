//! Compares every number of `vectors/d_mds/mds_vectors.json`.

use serde_json::Value;

use super::smacof::smacof;
use crate::maths::isotonic::isotonic;
use crate::maths::procrustes::procrustes;
use crate::maths::rng::lcg_noise;
use crate::people::dissimilarities::Dissimilarities;
use crate::people::mds::axes::settle;
use crate::people::mds::start::Classical;
use crate::people::mds::{ByDimension, MdsOptions, Transform, nonmetric, nonmetric_from};

fn vectors() -> Value {
    serde_json::from_str(include_str!("../../../../../../vectors/d_mds/mds_vectors.json")).unwrap()
}

fn number(value: &Value) -> f64 {
    value.as_f64().unwrap()
}

fn floats(value: &Value) -> Vec<f64> {
    value.as_array().unwrap().iter().map(number).collect()
}

fn rows(value: &Value) -> Vec<Vec<f64>> {
    value.as_array().unwrap().iter().map(floats).collect()
}

#[track_caller]
fn check(actual: &[f64], expected: &[f64], tolerance: f64) {
    assert_eq!(actual.len(), expected.len());
    for (i, (a, e)) in actual.iter().zip(expected).enumerate() {
        assert!((a - e).abs() < tolerance, "[{i}] {a} for {e}");
    }
}

/// Dissimilarities `100 - s` of 25 textures that ten simulated participants sorted.
fn sorted_textures() -> Dissimilarities {
    let dissimilar = |(i, row): (usize, Vec<f64>)| -> Vec<f64> {
        row.iter().enumerate().map(|(j, s)| if i == j { 0.0 } else { 100.0 - s }).collect()
    };
    let matrix: Vec<Vec<f64>> = rows(&vectors()["S"]).into_iter().enumerate().map(dissimilar).collect();
    Dissimilarities::from_matrix(&matrix).unwrap()
}

fn four_items() -> Dissimilarities {
    Dissimilarities::from_matrix(&rows(&vectors()["demo4"]["delta"])).unwrap()
}

fn condensed(dissimilarities: &Dissimilarities) -> Vec<f64> {
    dissimilarities.pairs().map(|(_, _, value)| value).collect()
}

/// SMACOF from the classical start, as the reference script runs it.
fn by_smacof(dissimilarities: &Dissimilarities, dims: usize, ties: Transform) -> (Vec<Vec<f64>>, Vec<f64>) {
    let mut points = Classical::new(dissimilarities).in_dims(dims, 0);
    let history = smacof(&condensed(dissimilarities), dims, ties, &mut points, 1e-9);
    (settle(&points, dims, 1.0), history)
}

#[test]
fn pools() {
    let v = &vectors()["pava_demo"];
    check(&isotonic(&floats(&v["y"])), &floats(&v["out"]), 1e-15);
}

#[test]
fn the_oracle_is_the_script() {
    let (v, textures) = (vectors(), sorted_textures());
    for (name, ties) in [("primary", Transform::PrimaryTies), ("secondary", Transform::SecondaryTies)] {
        for (dims, golden) in (1..=10).zip(floats(&v["stress1_dims1_10"][name])) {
            let (_, history) = by_smacof(&textures, dims, ties);
            // The steps are the same. Sums of 300 pairs round differently by 1e-14, and the steps converge rather than
            // diverge.
            check(&[*history.last().unwrap()], &[golden], 1e-12);
        }
    }
    let (points, history) = by_smacof(&textures, 2, Transform::PrimaryTies);
    assert_eq!(history.len() as u64, v["iters"].as_u64().unwrap());
    for (point, golden) in points.iter().zip(rows(&v["X2_primary"])) {
        // Coordinates are up to 50, and stress is flat along some directions.
        check(point, &golden, 1e-9);
    }
    let aligned = procrustes(&points, &rows(&v["truth"])).unwrap();
    check(&[aligned.r_squared], &[number(&v["procrustes_R2"])], 1e-12);
    check(&[*history.last().unwrap()], &[number(&v["random_starts"]["classical"])], 1e-12);
}

#[test]
fn random_starts() {
    let (v, textures) = (vectors(), sorted_textures());
    let condensed = condensed(&textures);
    let mut found: Vec<f64> = (0..50)
        .map(|i| {
            let mut points: Vec<f64> = lcg_noise(50, 5000 + i).iter().map(|x| 30.0 * x).collect();
            *smacof(&condensed, 2, Transform::PrimaryTies, &mut points, 1e-9).last().unwrap()
        })
        .collect();
    found.sort_by(f64::total_cmp);
    let golden = &v["random_starts"];
    check(&[found[0], found[49]], &[number(&golden["min"]), number(&golden["max"])], 1e-12);
    check(&[0.5 * (found[24] + found[25])], &[number(&golden["median"])], 1e-12);
    // The descent reaches a minimum and a median stress at least as low as SMACOF from the same starts.
    let options = MdsOptions::usual(1);
    let mut here: Vec<f64> = (0..50)
        .map(|i| {
            let start: Vec<Vec<f64>> = lcg_noise(50, 5000 + i).chunks(2).map(<[f64]>::to_vec).collect();
            nonmetric_from(&textures, &start, &options).unwrap().stress
        })
        .collect();
    here.sort_by(f64::total_cmp);
    assert!(here[0] <= found[0] && here[25] <= found[25], "{here:?}");
}

#[test]
fn four_items_in_one_and_two_dimensions() {
    let (v, four) = (&vectors()["demo4"], four_items());
    for (dims, ties, name) in [
        (1, Transform::PrimaryTies, "stress_1d_primary"),
        (2, Transform::PrimaryTies, "stress_2d_primary"),
        (1, Transform::SecondaryTies, "stress_1d_secondary"),
    ] {
        let (_, history) = by_smacof(&four, dims, ties);
        // All are zero except for the residual at which SMACOF stopped, which depends on rounding.
        check(&[*history.last().unwrap()], &[number(&v[name])], 1e-15);
        let stress =
            nonmetric(&four, dims, &MdsOptions { transform: ties, ..MdsOptions::usual(1) }).unwrap().stress;
        assert!(stress < 1e-9, "{name}: {stress}");
    }
}

#[test]
fn stress_is_no_higher_than_by_smacof() {
    let (v, textures) = (vectors(), sorted_textures());
    for (name, ties) in [("primary", Transform::PrimaryTies), ("secondary", Transform::SecondaryTies)] {
        let golden = floats(&v["stress1_dims1_10"][name]);
        let options = MdsOptions { transform: ties, ..MdsOptions::usual(1) };
        let stress: Vec<f64> = ByDimension::new(&textures, &options)
            .unwrap()
            .best(1..=10, None, &|| true)
            .unwrap()
            .iter()
            .map(|m| m.stress)
            .collect();
        assert!(stress.iter().zip(&golden).all(|(s, g)| s <= g), "{name}: {stress:?} for {golden:?}");
        assert!(stress.is_sorted_by(|a, b| a >= b), "{stress:?}");
        // Without other starts the descent ends in the same local minimum as SMACOF, which stopped slightly above it.
        let alone = nonmetric(&textures, 2, &MdsOptions { n_random_starts: 0, ..options }).unwrap();
        assert!(alone.converged && alone.stress <= golden[1] && alone.stress > golden[1] - 1e-6);
    }
    let found = nonmetric(&textures, 2, &MdsOptions::usual(1)).unwrap();
    // The script stops when stress falls by less than 1e-9 a step. There, coordinates still differ in the third digit.
    let aligned = procrustes(&found.points, &rows(&v["X2_primary"])).unwrap();
    assert!(aligned.r_squared > 1.0 - 1e-6, "{}", aligned.r_squared);
    let truth = procrustes(&found.points, &rows(&v["truth"])).unwrap();
    check(&[truth.r_squared], &[number(&v["procrustes_R2"])], 1e-3);
}
