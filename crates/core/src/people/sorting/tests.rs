use serde_json::Value;

use super::{Finding, Grouped, Similarity, Sort, SortingError, similarity};
use crate::maths::rng::lcg_noise;

fn names(n: usize) -> Vec<String> {
    (0..n).map(|i| format!("texture {i}")).collect()
}

/// A sort with one label per texture; `.` marks a texture that was not sorted.
fn sort(participant: &str, trial: &str, n_groups: impl Into<Option<usize>>, labels: &str) -> Sort {
    let placed = labels.chars().zip(names(labels.len())).filter(|(label, _)| *label != '.');
    Sort {
        participant: participant.to_owned(),
        trial: trial.to_owned(),
        n_groups: n_groups.into(),
        placements: placed.map(|(label, texture)| Grouped { texture, group: label.to_string() }).collect(),
    }
}

fn of(n: usize, sorts: &[Sort]) -> Similarity {
    similarity(&names(n), sorts).unwrap()
}

#[test]
fn scores_by_hand() {
    let found = of(4, &[sort("a", "1", 2, "xxyy"), sort("a", "2", 3, "xxyz"), sort("b", "1", 2, "xyy.")]);
    // Pair (0, 1) scores 2 + 3 of 2 + 3 + 2; pair (2, 3) scores 2 of 2 + 3, because b did not sort texture 3.
    let score = |i: usize, j: usize| found.scores[i][j].unwrap();
    for (i, j, expected) in
        [(0, 1, 500.0 / 7.0), (1, 2, 200.0 / 7.0), (2, 3, 40.0), (0, 3, 0.0), (1, 1, 100.0)]
    {
        assert_eq!((score(i, j), score(j, i)), (expected, expected));
    }
    assert_eq!(found.n_participants, [[2, 2, 2, 1], [2, 2, 2, 1], [2, 2, 2, 1], [1, 1, 1, 1]]);
    let dissimilarities = found.dissimilarities().unwrap();
    assert_eq!(dissimilarities.between(3, 2), Some(60.0));
    assert!(found.findings.is_empty(), "{:?}", found.findings);
}

#[test]
fn labels_mean_nothing_across_sorts_and_free_sorts_count_their_groups() {
    let found = of(3, &[sort("a", "1", 2, "xxy"), sort("b", "1", None, "yxx")]);
    let free = of(3, &[sort("a", "1", None, "ppq"), sort("b", "1", 2, "qrr")]);
    assert_eq!(found.scores, free.scores);
    assert_eq!(found.scores[0][1], Some(50.0));
}

/// Sorts noisy copies of positions by Lloyd's algorithm, as the script of the golden vectors does.
fn simulated(places: &[f64], k: usize, seed: u64) -> Vec<usize> {
    let points: Vec<&[f64]> = places.chunks_exact(2).collect();
    let noise = lcg_noise(4000, seed);
    let mut order: Vec<usize> = (0..points.len()).collect();
    order.sort_by(|a, b| noise[*a].total_cmp(&noise[*b]));
    let mut centers: Vec<[f64; 2]> = order[..k].iter().map(|i| [points[*i][0], points[*i][1]]).collect();
    let mut labels = Vec::new();
    for _ in 0..50 {
        let square = |p: &[f64], c: &[f64; 2]| (p[0] - c[0]).powi(2) + (p[1] - c[1]).powi(2);
        let nearest = |p: &&[f64]| {
            (0..k).min_by(|a, b| square(p, &centers[*a]).total_cmp(&square(p, &centers[*b]))).unwrap()
        };
        labels = points.iter().map(nearest).collect();
        for (label, center) in centers.iter_mut().enumerate() {
            let own: Vec<_> =
                points.iter().zip(&labels).filter(|(_, l)| **l == label).map(|(p, _)| p).collect();
            if !own.is_empty() {
                *center = [0, 1].map(|axis| own.iter().map(|p| p[axis]).sum::<f64>() / own.len() as f64);
            }
        }
    }
    labels
}

/// Sorts of the golden vectors: ten simulated participants, 25 textures, 3, 6 and 9 groups.
fn golden_sorts(truth: &[f64]) -> Vec<Sort> {
    let mut sorts = Vec::new();
    for participant in 0..10_u64 {
        for (trial, n_groups) in (0..3).zip([3, 6, 9]) {
            let noise = lcg_noise(50, 100 + 10 * participant + trial);
            let felt: Vec<f64> = truth.iter().zip(noise).map(|(t, e)| t + 0.25 * e).collect();
            let labels = simulated(&felt, n_groups, 1000 + 10 * participant + trial);
            let labels: String = labels.iter().map(|l| char::from(b'a' + *l as u8)).collect();
            sorts.push(sort(&participant.to_string(), &trial.to_string(), n_groups, &labels));
        }
    }
    sorts
}

#[test]
fn golden_similarity() {
    let v: Value =
        serde_json::from_str(include_str!("../../../../../vectors/d_mds/mds_vectors.json")).unwrap();
    let rows = |name: &str| -> Vec<f64> {
        let rows = v[name].as_array().unwrap().iter().flat_map(|row| row.as_array().unwrap());
        rows.map(|x| x.as_f64().unwrap()).collect()
    };
    let truth = lcg_noise(50, 1);
    // The same noise except for the last bit of logarithm, sine and cosine.
    assert!(truth.iter().zip(rows("truth")).all(|(a, b)| (a - b).abs() < 1e-14));
    let found = of(25, &golden_sorts(&truth));
    // Sums of integers and one division.
    for (score, golden) in found.scores.iter().flatten().zip(rows("S")) {
        assert!((score.unwrap() - golden).abs() < 1e-12, "{score:?} for {golden}");
    }
    let most: f64 = [3.0, 6.0, 9.0].iter().sum::<f64>() * 10.0;
    assert_eq!(most, v["max_score"].as_f64().unwrap());
    assert!(found.agreements.iter().all(|a| a.correlation.unwrap() > 0.5), "{:?}", found.agreements);
    assert!(!found.findings.iter().any(|f| f.name() == "outlying participant"), "{:?}", found.findings);
}

#[test]
fn who_sorts_by_chance_is_outlying() {
    let mut sorts = golden_sorts(&lcg_noise(50, 1));
    for sort in sorts.iter_mut().filter(|sort| sort.participant == "4") {
        // Each texture gets the label of another texture.
        let n = sort.placements.len();
        let labels: Vec<String> = (0..n).map(|i| sort.placements[(7 * i + 3) % n].group.clone()).collect();
        for (placement, label) in sort.placements.iter_mut().zip(labels) {
            placement.group = label;
        }
    }
    let found = of(25, &sorts);
    let outlying: Vec<&str> = found
        .agreements
        .iter()
        .filter(|a| a.outlying_from.is_some())
        .map(|a| a.participant.as_str())
        .collect();
    assert_eq!(outlying, ["4"]);
    let sentences: Vec<String> = found.findings.iter().map(ToString::to_string).collect();
    let said =
        sentences.iter().find(|s| s.starts_with("outlying participant: the sorts of participant \"4\""));
    let limit = found.agreements[0].limit.unwrap();
    let of_the_sorts = format!("below the limit of {limit:.2} for these sorts");
    assert!(said.is_some_and(|s| s.contains(&of_the_sorts)), "{sentences:?}");
}

#[test]
fn sorts_that_say_nothing_are_found() {
    let found = of(
        4,
        &[
            sort("a", "1", 3, "xxyz"),
            sort("b", "1", 3, "xxxx"),
            sort("c", "1", None, "wxyz"),
            sort("d", "1", 2, "..x."),
            sort("e", "1", 2, "xxyy"),
        ],
    );
    let who = |p: &str| (p.to_owned(), "1".to_owned());
    let ((b, t), (c, u), (d, v)) = (who("b"), who("c"), who("d"));
    let expected = [
        Finding::GroupCount { participant: b.clone(), trial: t.clone(), wanted: 3, made: 1 },
        Finding::OneGroup { participant: b, trial: t },
        Finding::AllAlone { participant: c, trial: u },
        Finding::NoPair { participant: d, trial: v },
    ];
    assert_eq!(found.findings, expected);
    // Sorts without information have no correlation.
    let known: Vec<bool> = found.agreements.iter().map(|a| a.correlation.is_some()).collect();
    assert_eq!(known, [true, false, false, false, true]);
}

#[test]
fn pairs_that_nobody_sorted_together_are_named() {
    let found = of(4, &[sort("a", "1", 2, "xx.y"), sort("b", "1", 2, ".xxy")]);
    let pair = Finding::NeverTogether { pairs: vec![["texture 0".to_owned(), "texture 2".to_owned()]] };
    assert_eq!(found.findings, [pair]);
    assert_eq!((found.scores[0][2], found.n_participants[0][2]), (None, 0));
    assert_eq!(found.dissimilarities().unwrap().between(0, 2), None);
}

#[test]
fn broken_sorts_are_named() {
    let error = |n: usize, sorts: &[Sort]| similarity(&names(n), sorts).unwrap_err();
    let good = sort("a", "1", 2, "xxy");
    let (participant, trial) = ("a".to_owned(), "1".to_owned());
    assert_eq!(error(2, &[sort("a", "1", 2, "xy")]), SortingError::TooFewTextures { n_textures: 2 });
    assert_eq!(error(3, &[]), SortingError::NoSorts);
    let twice = SortingError::RepeatedTrial { participant: participant.clone(), trial: trial.clone() };
    assert_eq!(error(3, &[good.clone(), good.clone()]), twice);
    let zero = SortingError::NoGroups { participant: participant.clone(), trial: trial.clone() };
    assert_eq!(error(3, &[sort("a", "1", 0, "xxy")]), zero);
    let mut repeated = good.clone();
    repeated.placements.push(Grouped { texture: "texture 1".to_owned(), group: "y".to_owned() });
    let sentence = "participant \"a\", trial \"1\": \"texture 1\" is in the groups \"x\" and \"y\"; assign each texture to one group";
    assert_eq!(error(3, &[repeated]).to_string(), sentence);
    let texture = "texture 3".to_owned();
    let unknown = SortingError::UnknownTexture { participant, trial, texture };
    assert_eq!(error(3, &[sort("a", "1", 2, "xxyy")]), unknown);
    let same = vec!["felt".to_owned(), "cork".to_owned(), "felt".to_owned()];
    let repeated = SortingError::RepeatedName { texture: "felt".to_owned() };
    assert_eq!(similarity(&same, &[good]), Err(repeated));
}
