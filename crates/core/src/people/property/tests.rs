use super::{
    PropertyError, ZeroAt, angle_degrees, axis_positions, column, correlation_table, fit_property,
    orthogonal_to, project,
};
use crate::maths::rng::lcg_noise;
use crate::maths::statistics::dot;
use serde_json::Value;

fn numbers(value: &Value) -> Vec<f64> {
    value.as_array().unwrap().iter().map(|v| v.as_f64().unwrap()).collect()
}

#[test]
fn golden_property_fit() {
    let v: Value =
        serde_json::from_str(include_str!("../../../../../vectors/d_mds/mds_vectors.json")).unwrap();
    let places: Vec<Vec<f64>> = v["X2_primary"].as_array().unwrap().iter().map(numbers).collect();
    let golden = &v["propfit"];
    let ratings = numbers(&golden["y"]);
    let line = fit_property(&places, &ratings).unwrap();
    // Both sides are least-squares fits of 25 rows in double precision.
    let close = |a: f64, b: f64| assert!((a - b).abs() < 1e-10 * (1.0 + b.abs()), "{a} differs from {b}");
    close(line.r_squared, golden["R2"].as_f64().unwrap());
    let b = numbers(&golden["b"]);
    close(line.intercept, b[0]);
    close(line.slope, b[1].hypot(b[2]));
    for (a, b) in line.direction.iter().zip(numbers(&golden["dir"])) {
        close(*a, b);
    }
    for (a, b) in project(&places, &line.direction).iter().zip(numbers(&golden["proj"])) {
        close(*a, b);
    }
    for (a, b) in line.correlations.iter().zip(numbers(&golden["corr_dims"])) {
        close(a.unwrap(), b);
    }
    let table = correlation_table(&[ratings], &[column(&places, 0), column(&places, 1)]);
    assert_eq!(table[0], line.correlations);
    // Closed form of the tail probability for two regressors: P(F > f) = (1 + 2 f / d)^(-d/2) = (1 - R²)^(d/2).
    close(line.p_value / (1.0 - line.r_squared).powf(11.0), 1.0);
}

#[test]
fn an_exact_plane_is_found_exactly() {
    let places: Vec<Vec<f64>> = lcg_noise(36, 3).chunks(3).map(<[f64]>::to_vec).collect();
    let ratings: Vec<f64> = places.iter().map(|p| 50.0 + 2.0 * p[0] - 6.0 * p[1] + 3.0 * p[2]).collect();
    let line = fit_property(&places, &ratings).unwrap();
    for (a, b) in line.direction.iter().zip([2.0 / 7.0, -6.0 / 7.0, 3.0 / 7.0]) {
        assert!((a - b).abs() < 1e-13);
    }
    assert!((line.slope - 7.0).abs() < 1e-12 && (line.r_squared - 1.0).abs() < 1e-14 && line.p_value < 1e-50);
    let along = project(&places, &line.direction);
    for (t, rating) in along.iter().zip(&ratings) {
        assert!((50.0 + 7.0 * t - rating).abs() < 1e-12);
    }
}

#[test]
fn axes_run_from_the_pole_that_is_asked_for() {
    let up = axis_positions(&[2.0, 4.0, 3.0], ZeroAt::LowRatings).unwrap();
    assert_eq!(up, [0.0, 100.0, 50.0]);
    assert_eq!(axis_positions(&[2.0, 4.0, 3.0], ZeroAt::HighRatings).unwrap(), [100.0, 0.0, 50.0]);
    assert_eq!(axis_positions(&[2.0, 2.0], ZeroAt::LowRatings), None);
    assert_eq!(axis_positions(&[], ZeroAt::LowRatings), None);
}

#[test]
fn angles_are_real_and_made_right_only_on_request() {
    let at = |degrees: f64| vec![degrees.to_radians().cos(), degrees.to_radians().sin()];
    for degrees in [0.0, 1e-7, 45.0, 90.01, 101.8, 180.0] {
        assert!((angle_degrees(&at(0.0), &at(degrees)) - degrees).abs() < 1e-10, "{degrees}");
    }
    let made = orthogonal_to(&at(70.0), &[at(0.0)]).unwrap();
    assert!((made[0].abs() < 1e-12) && (made[1] - 1.0).abs() < 1e-12);
    let third =
        orthogonal_to(&[1.0, 1.0, 1.0], &[vec![1.0, 0.0, 0.0], vec![2.0, 0.0, 0.0], vec![1.0, 1.0, 0.0]]);
    assert!((dot(&third.unwrap(), &[0.0, 0.0, 1.0]) - 1.0).abs() < 1e-12);
    assert_eq!(orthogonal_to(&at(10.0), &[at(190.0)]), Err(PropertyError::Parallel));
}

#[test]
fn ratings_without_a_meaning_are_refused_by_name() {
    let places: Vec<Vec<f64>> = lcg_noise(12, 4).chunks(2).map(<[f64]>::to_vec).collect();
    let ratings = [1.0, 2.0, 4.0, 1.0, 5.0, 2.0];
    let refused = |places: &[Vec<f64>], ratings: &[f64], words: &str| {
        let error = fit_property(places, ratings).unwrap_err().to_string();
        assert!(error.contains(words), "{error}");
    };
    refused(&places, &ratings[..5], "6 textures have a position but 5 have a rating");
    refused(&places[..3], &ratings[..3], "3 textures in 2 dimensions");
    refused(&places, &[3.0; 6], "same rating");
    refused(&places, &[1.0, 2.0, f64::NAN, 1.0, 5.0, 2.0], "rating of texture 2");
    let with = |texture: usize, point: Vec<f64>| {
        let mut changed = places.clone();
        changed[texture] = point;
        changed
    };
    refused(&with(1, vec![0.0, f64::INFINITY]), &ratings, "position of texture 1");
    refused(&with(4, vec![0.0]), &ratings, "texture 4 has 1 coordinates");
    let flat: Vec<Vec<f64>> = places.iter().map(|p| vec![p[0], 0.5]).collect();
    refused(&flat, &ratings, "dimension 1");
}
