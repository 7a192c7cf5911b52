//! Compares weights and mixtures with the reference script (`vectors/g_interp`).
//!
//! Two parts of the vector file are not compared directly: inverse-distance weights with exponent 2, and the
//! script's Sibson weights. The former are recomputed here together with exponent 1, which checks the file itself. The
//! latter are compared in the property that they share with barycentric weights: both reproduce the query point.
#![allow(clippy::unwrap_used, reason = "a test may panic on unexpected data")]

use std::collections::BTreeSet;

use serde_json::Value;
use shagreen_core::dsp::ar::power_gain;
use shagreen_core::dsp::lsf::{ar_from_lsf, lsf_from_ar};
use shagreen_core::maths::rng::Random;
use shagreen_core::maths::triangulation::Triangulation;
use shagreen_core::space::authoring::Authoring;
use shagreen_core::space::{Space, SpacePoint};
use shagreen_core::texture::blend::{Mode, mixture_psd};
use shagreen_core::texture::plane::Plane;
use shagreen_core::texture::{GrainNode, TextureModel};
use shagreen_core::units::{Contact, Hertz, MetersPerSecond, Newtons};

fn vectors() -> Value {
    serde_json::from_str(include_str!("../../../vectors/g_interp/weights_vectors.json")).unwrap()
}

fn numbers(value: &Value) -> Vec<f64> {
    value.as_array().unwrap().iter().map(|v| v.as_f64().unwrap()).collect()
}

/// A point of the vector file, whose axes run from 0 to 1.
fn point(xy: &[f64]) -> SpacePoint {
    SpacePoint::new(100.0 * xy[0], 100.0 * xy[1]).unwrap()
}

fn sites() -> (Vec<Vec<f64>>, Space) {
    let sites: Vec<Vec<f64>> = vectors()["sites"].as_array().unwrap().iter().map(numbers).collect();
    let space = Space::new(&sites.iter().map(|s| Some(point(s))).collect::<Vec<_>>()).unwrap();
    (sites, space)
}

fn weights(space: &Space, at: SpacePoint, mode: Mode, n: usize) -> Vec<f64> {
    let mut weights = vec![0.0; n];
    for (texture, weight) in Authoring::new(space.clone()).author(at, &mode.into()).unwrap().parents {
        weights[texture] = weight;
    }
    weights
}

fn inverse_distance(corners: &[Vec<f64>], q: &[f64], exponent: f64) -> Vec<f64> {
    let distance = |c: &Vec<f64>| (c[0] - q[0]).hypot(c[1] - q[1]);
    if let Some(at) = corners.iter().position(|c| distance(c) < 1e-9) {
        return (0..corners.len()).map(|i| f64::from(u8::from(i == at))).collect();
    }
    let raw: Vec<f64> = corners.iter().map(|c| distance(c).powf(-exponent)).collect();
    raw.iter().map(|r| r / raw.iter().sum::<f64>()).collect()
}

#[track_caller]
fn close(value: f64, golden: &Value, tolerance: f64) {
    let golden = golden.as_f64().unwrap();
    assert!((value - golden).abs() <= tolerance, "{value} differs from {golden}");
}

#[test]
fn weights_in_a_triangle() {
    let v = vectors();
    let corners: Vec<Vec<f64>> = v["triangle"].as_array().unwrap().iter().map(numbers).collect();
    let space = Space::new(&corners.iter().map(|c| Some(point(c))).collect::<Vec<_>>()).unwrap();
    for case in v["weights"].as_array().unwrap() {
        let q = numbers(&case["q"]);
        let barycentric = weights(&space, point(&q), Mode::Power, 3);
        let paper = weights(&space, point(&q), Mode::Paper, 3);
        let [first, second] = [1.0, 2.0].map(|exponent| inverse_distance(&corners, &q, exponent));
        for corner in 0..3 {
            close(barycentric[corner], &case["bary"][corner], 1e-12);
            close(first[corner], &case["idw1"][corner], 1e-12);
            close(second[corner], &case["idw2"][corner], 1e-12);
            // On an edge, the program mixes only the two ends. With the third corner, the weights would depend on which
            // of the two triangles the edge is assigned to.
            if barycentric.iter().all(|w| *w > 1e-12) || corner == 2 && paper[2] > 0.0 {
                close(paper[corner], &case["idw1"][corner], 1e-12);
            }
        }
    }
    let height = 100.0 * 0.75_f64.sqrt();
    let equal = [(0.0, 0.0), (100.0, 0.0), (50.0, height)].map(|(x, y)| SpacePoint::new(x, y).ok());
    let space = Space::new(&equal).unwrap();
    // As close to the edge as a point still counts as inside.
    let at = SpacePoint::new(50.0, 1e-7).unwrap();
    for (weight, golden) in
        weights(&space, at, Mode::Paper, 3).iter().zip(numbers(&v["equilateral_mid_edge"]["idw1"]))
    {
        assert!((weight - golden).abs() < 1e-8, "{weight} differs from {golden}");
    }
    let flat = [vec![0.0, 0.0], vec![1.0, 0.0], vec![0.5, 0.75_f64.sqrt()]];
    for (i, weight) in inverse_distance(&flat, &[0.5, 0.0], 2.0).iter().enumerate() {
        close(*weight, &v["equilateral_mid_edge"]["idw2"][i], 1e-12);
    }
}

#[test]
fn triangles_of_the_sites() {
    let v = vectors();
    let (_, space) = sites();
    let sorted = |mut t: [usize; 3]| {
        t.sort_unstable();
        t
    };
    let golden = v["tri"].as_array().unwrap().iter().map(numbers);
    let golden: BTreeSet<[usize; 3]> =
        golden.map(|t| sorted([t[0] as usize, t[1] as usize, t[2] as usize])).collect();
    assert_eq!(space.triangles().map(sorted).collect::<BTreeSet<_>>(), golden);
}

#[test]
fn weights_between_the_sites() {
    let golden = &vectors()["sibson_q"];
    let (sites, space) = sites();
    let q = numbers(&golden["q"]);
    let barycentric = weights(&space, point(&q), Mode::Power, 25);
    let paper = weights(&space, point(&q), Mode::Paper, 25);
    for (corner, texture) in numbers(&golden["simplex"]).iter().enumerate() {
        close(barycentric[*texture as usize], &golden["bary"][corner], 1e-12);
        close(paper[*texture as usize], &golden["idw1"][corner], 1e-12);
    }
    for axis in 0..2 {
        let sibson = golden["w"].as_object().unwrap().iter();
        let place: f64 =
            sibson.map(|(i, w)| w.as_f64().unwrap() * sites[i.parse::<usize>().unwrap()][axis]).sum();
        let ours: f64 = barycentric.iter().zip(&sites).map(|(w, s)| w * s[axis]).sum();
        // The file omits weights below 1e-9.
        assert!((place - q[axis]).abs() < 1e-8 && (ours - q[axis]).abs() < 1e-14);
    }
}

/// Uses our own random points: means of 4,000 points against 400 in the script, with a standard error of 0.02 / √400 =
/// 0.001.
#[test]
fn the_point_that_weights_reproduce() {
    let golden = &vectors()["position_error_mean"];
    let (sites, space) = sites();
    let mut random = Random::new(6);
    let (mut error, mut n, mut losses) = ([0.0; 2], 0.0, Vec::new());
    while n < 4000.0 {
        let at = SpacePoint::new(100.0 * random.uniform(), 100.0 * random.uniform()).unwrap();
        if space.locate(at).unwrap().clamped {
            continue;
        }
        for (error, mode) in error.iter_mut().zip([Mode::Power, Mode::Paper]) {
            let weights = weights(&space, at, mode, 25);
            let place = |axis: usize| -> f64 { weights.iter().zip(&sites).map(|(w, s)| w * s[axis]).sum() };
            *error += (place(0) - at.x() / 100.0).hypot(place(1) - at.y() / 100.0);
        }
        let power: f64 = weights(&space, at, Mode::Power, 25).iter().map(|w| w * w).sum();
        losses.push(10.0 * power.log10());
        n += 1.0;
    }
    assert!(error[0] / n < 1e-14);
    close(error[1] / n, &golden["idw1"], 0.004);
    // Losses have a standard deviation of 1.1 dB; with the script's 5,000 points and these, the standard error is 0.025
    // dB.
    let golden = &vectors()["rms_loss_uniform_in_hull_dB"];
    losses.sort_by(f64::total_cmp);
    close(losses.iter().sum::<f64>() / n, &golden["mean"], 0.08);
    close(losses[200], &golden["p05"], 0.1);
    close(losses[3800], &golden["p95"], 0.15);
}

#[test]
fn jumps_across_edges() {
    let golden = &vectors()["edge_jump"];
    let (sites, space) = sites();
    let mut triangles_of: std::collections::BTreeMap<[usize; 2], usize> = std::collections::BTreeMap::new();
    for t in space.triangles() {
        for (a, b) in [(t[0], t[1]), (t[1], t[2]), (t[2], t[0])] {
            *triangles_of.entry([a.min(b), a.max(b)]).or_default() += 1;
        }
    }
    let mut jumps = [Vec::new(), Vec::new()];
    for ([a, b], _) in triangles_of.iter().filter(|(_, n)| **n == 2) {
        let (a, b) = (&sites[*a], &sites[*b]);
        let length = (b[0] - a[0]).hypot(b[1] - a[1]);
        for u in [0.25, 0.5, 0.75] {
            // A small offset to either side of the edge.
            let side = |sign: f64| {
                let normal = [-(b[1] - a[1]) / length, (b[0] - a[0]) / length];
                point(&[0, 1].map(|k| a[k] * (1.0 - u) + b[k] * u + sign * 1e-9 * normal[k]))
            };
            for (jumps, mode) in jumps.iter_mut().zip([Mode::Power, Mode::Paper]) {
                let (left, right) =
                    (weights(&space, side(1.0), mode, 25), weights(&space, side(-1.0), mode, 25));
                jumps.push(0.5 * left.iter().zip(&right).map(|(l, r)| (l - r).abs()).sum::<f64>());
            }
        }
    }
    let mean = |v: &[f64]| v.iter().sum::<f64>() / v.len() as f64;
    let largest = |v: &[f64]| v.iter().copied().fold(0.0, f64::max);
    // The offset of 1e-9, divided by the height of the flattest triangle.
    assert!(largest(&jumps[0]) < 1e-6, "{}", largest(&jumps[0]));
    close(mean(&jumps[1]), &golden["idw1"]["mean"], 1e-6);
    close(largest(&jumps[1]), &golden["idw1"]["max"], 1e-6);
}

/// Predictor coefficients of two resonances, given as frequencies in Hz and pole radii, at 1 kHz.
fn predictor(resonances: [(f64, f64); 2]) -> Vec<f64> {
    let [(c, d), (e, f)] = resonances
        .map(|(hz, radius)| (-2.0 * radius * (std::f64::consts::TAU * hz / 1000.0).cos(), radius * radius));
    vec![c + e, d + f + c * e, c * f + d * e, d * f]
}

#[test]
fn levels_of_mixtures() {
    let v = vectors();
    let golden = &v["mix_demo"];
    let (levels, shares) = (numbers(&golden["sigma"]), numbers(&golden["w"]));
    let predictors =
        [[(60.0, 0.9), (180.0, 0.8)], [(110.0, 0.92), (260.0, 0.85)], [(150.0, 0.85), (320.0, 0.9)]]
            .map(predictor);
    let contact = Contact { speed: MetersPerSecond(0.1), force: Newtons(1.0) };
    let plane = |ar: &Vec<f64>, level: f64| {
        let lsf = lsf_from_ar(ar).unwrap();
        let node = GrainNode { speed: contact.speed, force: contact.force, lsf, level_mps2: level };
        Plane::new(&TextureModel::new(Hertz(1000.0), vec![node], None).unwrap())
    };
    let planes: Vec<Plane> = predictors.iter().zip(&levels).map(|(ar, level)| plane(ar, *level)).collect();
    let parents: Vec<(&Plane, f64)> = planes.iter().zip(shares.iter().copied()).collect();
    // For poles this far inside the unit circle, the mean over bin centers equals the integral up to rounding.
    let frequencies: Vec<Hertz> = (0..4096).map(|k| Hertz((f64::from(k) + 0.5) * 500.0 / 4096.0)).collect();
    let level = |parents: &[(&Plane, f64)], mode: Mode| {
        let density = mixture_psd(parents, mode, contact, &frequencies);
        (density.iter().sum::<f64>() * 500.0 / 4096.0).sqrt()
    };
    let [paper, power, shared] = [Mode::Paper, Mode::Power, Mode::Shared].map(|mode| level(&parents, mode));
    // The script sums mixtures from 0 Hz on. That differs from the integral by half a step's difference of the end
    // values, 1e-5. The independent mixture has a closed form.
    let squares: f64 = shares.iter().zip(&levels).map(|(w, l)| (w * l).powi(2)).sum();
    assert!((paper - squares.sqrt()).abs() < 1e-9, "{paper}");
    close(paper, &golden["rms_independent_sum"], 2e-5);
    close(power, &golden["linear_rms_target"], 1e-9);
    close(shared, &golden["rms_shared_noise_sum"], 1e-4);
    close(power / paper, &golden["comp_gain_for_linear_target"], 5e-5);
    let mean = |f: fn(f64) -> f64| shares.iter().zip(&levels).map(|(w, l)| w * f(*l)).sum::<f64>();
    close(mean(f64::ln).exp(), &golden["log_rms_target"], 1e-12);
    close(mean(|l| l * l).sqrt(), &golden["power_target"], 1e-12);
    // One interpolated spectrum, whose excitation variance is the weighted mean of the parents' excitation variances.
    let gain: f64 = predictors
        .iter()
        .zip(levels.iter().zip(&shares))
        .map(|(ar, (l, w))| w * l / power_gain(ar).sqrt())
        .sum();
    let gain_of_squares: f64 = predictors
        .iter()
        .zip(levels.iter().zip(&shares))
        .map(|(ar, (l, w))| w * l * l / power_gain(ar))
        .sum();
    let mut lsf = vec![0.0; 4];
    for (ar, share) in predictors.iter().zip(&shares) {
        for (sum, w) in lsf.iter_mut().zip(lsf_from_ar(ar).unwrap()) {
            *sum += share * w;
        }
    }
    let between = (power_gain(&ar_from_lsf(&lsf)) * gain_of_squares).sqrt();
    close(between, &golden["rms_lsf_with_linear_excitation_variance"], 1e-9);
    assert!(gain * gain < gain_of_squares);
    // At equal levels: the level loss of independent signals does not depend on their spectra.
    let third = 1.0 / 3.0;
    for (key, shares) in [
        ("(0.3333333333333333, 0.3333333333333333, 0.3333333333333333)", [third, third, third]),
        ("(0.5, 0.5, 0)", [0.5, 0.5, 0.0]),
        ("(0.6, 0.3, 0.1)", [0.6, 0.3, 0.1]),
        ("(0.8, 0.1, 0.1)", [0.8, 0.1, 0.1]),
    ] {
        let equal: Vec<Plane> = predictors.iter().map(|ar| plane(ar, 1.0)).collect();
        let parents: Vec<(&Plane, f64)> = equal.iter().zip(shares).collect();
        close(20.0 * level(&parents, Mode::Paper).log10(), &v["rms_loss_dB_equal_sigma"][key], 1e-8);
    }
}

#[test]
fn a_triangulation_is_the_same_in_points_and_in_hundredths() {
    let (sites, space) = sites();
    let direct = Triangulation::new(&sites.iter().map(|s| [s[0], s[1]]).collect::<Vec<_>>()).unwrap();
    assert_eq!(direct.triangles().len(), space.triangles().count());
}
