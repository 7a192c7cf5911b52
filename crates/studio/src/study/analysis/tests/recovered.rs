//! What is hidden in the world of simulated participants, computed without them, lies in the intervals of the results.

use std::f64::consts::TAU;

use serde_json::Value;
use shagreen_core::maths::rng::Random;
use shagreen_core::maths::statistics::correlation;
use shagreen_core::people::study::same_different::{Correction, Counts, d_prime};
use shagreen_core::people::study::simulated::{Observers, World};

use super::{analyzed, fair, study, write};
use crate::study::plans::StudyPlan;
use crate::study::simulation::Simulation;

/// Results of all parts of a simulated built-in plan, the plan, and what was hidden.
fn recovered(id: &str, simulation: &Simulation) -> (Value, StudyPlan, World) {
    let folder = tempfile::tempdir().unwrap();
    let study = study(id);
    let world = write(&study, simulation, folder.path());
    (analyzed(folder.path()).json["results"].clone(), study, world)
}

/// Participants who neither guess nor stretch a scale.
fn attentive(n_participants: usize, seed: u64) -> Simulation {
    Simulation { observers: fair(), ..Simulation::usual(n_participants, seed) }
}

/// Hidden distance of the two stimuli of a pair, in points.
fn distance(world: &World, one: &str, other: &str) -> f64 {
    let (one, other) = (&world.positions[one], &world.positions[other]);
    one.iter().zip(other).map(|(a, b)| (a - b) * (a - b)).sum::<f64>().sqrt()
}

/// Hidden distance of a pair that is named after its two stimuli.
fn distance_of(world: &World, pair: &str) -> f64 {
    let (one, other) = pair.split_once('|').unwrap();
    distance(world, one, other)
}

/// Mean of a function of the perceived distance of two stimuli that lie `distance` points apart on two dimensions: the integral
/// over the plane of their perceived difference, whose noise is that of both.
fn expected(distance: f64, of: impl Fn(f64) -> f64) -> f64 {
    const N_RADII: usize = 1000;
    const N_ANGLES: usize = 64;
    let variance = 2.0 * fair().noise_points.powi(2);
    let radius_step = (distance + 8.0 * variance.sqrt()) / N_RADII as f64;
    let angle_step = TAU / N_ANGLES as f64;
    let cosines: Vec<f64> = (0..N_ANGLES).map(|index| (angle_step * index as f64).cos()).collect();
    let of_ring = |index: usize| {
        let radius = radius_step * (index as f64 + 0.5);
        let density = |cosine: &f64| {
            let squared = radius * radius - 2.0 * radius * distance * cosine + distance * distance;
            (-0.5 * squared / variance).exp()
        };
        of(radius) * radius * cosines.iter().map(density).sum::<f64>()
    };
    (0..N_RADII).map(of_ring).sum::<f64>() * radius_step * angle_step / (TAU * variance)
}

/// Difference that participants see in a perceived distance: 0 up to their criterion, 1 from 50 points above it.
fn share(distance: f64) -> f64 {
    ((distance - fair().criterion_points) / 50.0).clamp(0.0, 1.0)
}

/// Whether the interval of a mean contains a value; `None` if it has no interval.
fn contains(mean: &Value, value: f64) -> Option<bool> {
    let half_width = mean["half_width_95"].as_f64()?;
    Some((mean["mean"].as_f64()? - value).abs() <= half_width)
}

/// Asserts that at least 90 % of the intervals contain their value; 95 % do on average.
fn assert_nearly_all(inside: &[bool], n: usize) {
    let n_inside = inside.iter().filter(|is_inside| **is_inside).count();
    assert_eq!(inside.len(), n);
    assert!(n_inside as f64 >= 0.9 * n as f64, "{n_inside} of {n}");
}

#[test]
fn the_integral_has_its_closed_forms() {
    let deviation = fair().noise_points * std::f64::consts::SQRT_2;
    for distance in [0.0, 6.0, 90.0] {
        assert!((expected(distance, |_| 1.0) - 1.0).abs() < 1e-5, "{distance}");
        let squared = expected(distance, |felt| felt * felt);
        assert!((squared - distance * distance - 2.0 * deviation * deviation).abs() < 1e-3 * squared);
    }
    // Rayleigh's distribution.
    let mean = deviation * (TAU / 4.0).sqrt();
    assert!((expected(0.0, |felt| felt) - mean).abs() < 1e-3 * mean);
}

#[test]
fn sorts_have_the_order_of_the_hidden_distances() {
    let (results, _, world) = recovered("cluster-sorting", &Simulation::usual(10, 1));
    let of = &results["sorting"];
    let textures: Vec<&str> =
        of["textures"].as_array().unwrap().iter().map(|name| name.as_str().unwrap()).collect();
    let (mut distances, mut similarities) = (Vec::new(), Vec::new());
    for (i, one) in textures.iter().enumerate() {
        for (j, other) in textures.iter().enumerate().skip(i + 1) {
            distances.push(distance(&world, one, other));
            similarities.push(of["similarity"][i][j].as_f64().unwrap());
        }
    }
    assert_eq!(distances.len(), 300);
    // Textures far apart share no group at all, so that the relation is no line.
    let r = correlation(&distances, &similarities).unwrap();
    assert!(r < -0.8, "{r}");
}

/// Each position is that of the nearest point of the line through both anchors.
#[test]
fn positions_between_anchors_contain_the_hidden_ones() {
    let mut inside = Vec::new();
    for seed in 1..=3 {
        let (results, study, world) = recovered("anchor-rating", &attentive(10, seed));
        let hidden = world.positions_between_anchors(&study.plan.parts[0]).unwrap();
        let (mut truths, mut found) = (Vec::new(), Vec::new());
        for mean in results["roughness"]["measures"]["position"]["means"].as_array().unwrap() {
            let truth = hidden[mean["condition"].as_str().unwrap()];
            inside.push(contains(mean, truth).unwrap());
            truths.push(truth);
            found.push(mean["mean"].as_f64().unwrap());
        }
        let r = correlation(&truths, &found).unwrap();
        assert!(r > 0.99, "seed {seed}: {r}");
    }
    assert_nearly_all(&inside, 24);
}

#[test]
fn the_realism_score_contains_that_of_the_hidden_distances() {
    let (results, _, world) = recovered("authored-dissimilarity", &attentive(10, 5));
    let of = &results["dissimilarity"];
    assert_eq!(of["nrs"].as_object().unwrap().len(), 6);
    assert_eq!(of["nrs_mean_by_normalization"].as_object().unwrap().len(), 3);
    // The authored versions lie 6 points from their originals, the references 90 points apart. Noise makes identical textures
    // differ.
    let [same, authored, different] =
        [0.0, 6.0, distance(&world, "brick", "felt")].map(|distance| expected(distance, |felt| felt));
    let hidden = 1.0 - (authored - same) / (different - same);
    let mean = of["nrs_mean"].as_f64().unwrap();
    let bound = |index: usize| of["nrs_mean_interval_95"][index].as_f64().unwrap();
    let (low, high) = (bound(0), bound(1));
    assert!(low <= mean && mean <= high && low < hidden && hidden < high, "{low} {mean} {high} {hidden}");
    // References near each other would leave nothing to divide by.
    assert!(high - low < 0.15, "{low} {high}");
    let means = of["measures"]["normalized dissimilarity"]["means"].as_array().unwrap();
    let distances: Vec<f64> =
        means.iter().map(|mean| distance_of(&world, mean["condition"].as_str().unwrap())).collect();
    let found: Vec<f64> = means.iter().map(|mean| mean["mean"].as_f64().unwrap()).collect();
    assert!(correlation(&distances, &found).unwrap() > 0.95);
}

#[test]
fn d_prime_contains_that_of_the_hidden_distances() {
    let (results, study, world) = recovered("same-different", &attentive(8, 3));
    let n_different_of = |distance: f64| {
        let share = expected(distance, |felt| f64::from(u8::from(felt > fair().criterion_points)));
        (1e6 * share).round() as u64
    };
    let (n_different, n_same) = (1_000_000, 1_000_000);
    let false_alarms = n_different_of(0.0);
    let mut inside = Vec::new();
    for part in &study.plan.parts {
        for (name, pair) in results[&part.id]["pairs"].as_object().unwrap() {
            // Eight participants, three segments, six repeats.
            assert_eq!((pair["n_different"].as_u64(), pair["n_same"].as_u64()), (Some(144), Some(144)));
            assert!(pair["dprime_differencing"].as_f64() > pair["dprime"].as_f64(), "{name}");
            let hits = n_different_of(distance_of(&world, name));
            let counts = Counts { hits, n_different, false_alarms, n_same };
            let hidden = d_prime(counts, Correction::Clipped).unwrap();
            let bound = |index: usize| pair["mean_dprime_interval_95"][index].as_f64().unwrap();
            inside.push(bound(0) <= hidden && hidden <= bound(1));
        }
    }
    assert_nearly_all(&inside, 25);
    let d_prime = |name: &str| results["steel"]["pairs"][name]["dprime"].as_f64().unwrap();
    assert!(d_prime("steel|steel-1.75") > d_prime("steel|steel-3.15"), "{results:#}");
}

/// Participants who agree completely do not tell how much others would differ.
#[test]
fn equal_d_primes_have_no_interval() {
    let simulation =
        Simulation { observers: Observers::exact(), effect_points: Some(60.0), ..Simulation::usual(2, 1) };
    let (results, _, _) = recovered("same-different", &simulation);
    let pair = &results["steel"]["pairs"]["steel|steel-1.75"];
    assert!(pair["mean_dprime"].as_f64().unwrap() > 3.0 && pair["mean_dprime_interval_95"].is_null());
}

#[test]
fn grades_of_similarity_contain_the_expected_ones() {
    let (results, _, world) = recovered("reconstruction-similarity", &attentive(10, 1));
    let means = results["similarity"]["measures"]["similarity"]["means"].as_array().unwrap();
    assert_eq!(means.len(), 28);
    let grade = |felt: f64| 1.0 + (4.0 * share(felt)).round();
    let is_inside =
        |mean: &Value| contains(mean, expected(distance_of(&world, mean["condition"].as_str()?), grade));
    let inside: Vec<bool> = means.iter().filter_map(is_inside).collect();
    // All participants gave both grades of one pair as 1. An interval of no width would miss the expected grade of 1.07.
    let without: Vec<&Value> = means.iter().filter(|mean| mean["half_width_95"].is_null()).collect();
    assert!(without.len() == 1 && without[0]["mean"].as_f64() == Some(1.0), "{without:?}");
    assert_nearly_all(&inside, 27);
    let of_window = |window: &str| {
        let of_pair = |mean: &&Value| mean["condition"].as_str().unwrap().ends_with(window);
        let grades = means.iter().filter(of_pair).map(|mean| mean["mean"].as_f64().unwrap());
        grades.sum::<f64>() / 4.0
    };
    assert!(of_window("-20") > of_window("-10") + 1.0 && of_window("-10") > of_window("-5") + 1.0);
}

/// Share of the trials in which the third of three perceptions is nearer to the one of its own stimulus, from many of them.
fn matched_share(distance: f64) -> f64 {
    const N: usize = 20_000;
    let (mut random, noise) = (Random::new(5), fair().noise_points);
    let mut felt = |x: f64| [x + noise * random.normal(), noise * random.normal()];
    let off = |one: [f64; 2], other: [f64; 2]| (one[0] - other[0]).hypot(one[1] - other[1]);
    let mut is_right = || {
        let [own, other, third] = [felt(0.0), felt(distance), felt(0.0)];
        off(third, own) <= off(third, other)
    };
    (0..N).filter(|_| is_right()).count() as f64 / N as f64
}

#[test]
fn right_matches_contain_the_expected_share() {
    let mut inside = Vec::new();
    for seed in 1..=3 {
        let (results, study, world) = recovered("abx", &attentive(10, seed));
        for (name, pair) in results[&study.plan.parts[0].id]["pairs"].as_object().unwrap() {
            let share = matched_share(distance_of(&world, name));
            let bound = |index: usize| pair["wilson_95"][index].as_f64().unwrap();
            inside.push(bound(0) <= share && share <= bound(1));
        }
    }
    assert_nearly_all(&inside, 12);
}

/// Of everyone: the other results leave out who rated the hidden reference low, so that its mean in them is not that of all
/// ratings.
#[test]
fn ratings_beside_a_reference_contain_the_expected_ones() {
    let (results, study, world) = recovered("mushra", &attentive(10, 1));
    let of = &results[&study.plan.parts[0].id];
    let score = |felt: f64| 100.0 * (1.0 - share(felt));
    let mut inside = Vec::new();
    for (name, measure) in of["measures_of_everyone"].as_object().unwrap() {
        let reference = name.strip_prefix("beside ").unwrap();
        for mean in measure["means"].as_array().unwrap() {
            let apart = distance(&world, reference, mean["condition"].as_str().unwrap());
            inside.push(contains(mean, expected(apart, score)).unwrap());
        }
    }
    assert_nearly_all(&inside, 14);
}
