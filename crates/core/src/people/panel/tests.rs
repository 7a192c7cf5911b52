use super::{PanelConfig, PanelError, simulated_ratings, simulated_sorts};
use crate::maths::rng::Random;
use crate::people::ratings::{AdjectivePair, RatingTable, agreement, averages, rater_fits};
use crate::people::sorting::Sort;

const PANEL: PanelConfig =
    PanelConfig { n_participants: 10, noise_points: 8.0, bias_points: 6.0, scale_log_spread: 0.2, seed: 5 };

fn labels(n: usize, seed: u64) -> Vec<Vec<f64>> {
    let mut random = Random::new(seed);
    (0..n).map(|_| vec![20.0 + 60.0 * random.uniform(), 20.0 + 60.0 * random.uniform()]).collect()
}

fn pairs() -> [AdjectivePair; 2] {
    [("rough", "smooth"), ("hard", "soft")]
        .map(|(low, high)| AdjectivePair { low: low.into(), high: high.into() })
}

fn names(n: usize) -> Vec<String> {
    (0..n).map(|t| format!("texture {t}")).collect()
}

/// Group of each texture, from 0.
fn groups(sort: &Sort) -> Vec<usize> {
    sort.placements.iter().map(|p| p.group.parse::<usize>().unwrap() - 1).collect()
}

#[test]
fn averages_of_a_panel_are_the_labels() {
    let labels = labels(25, 1);
    let ratings = simulated_ratings(&names(25), &labels, &pairs(), &PANEL).unwrap();
    let table = RatingTable::new(&ratings).unwrap();
    assert_eq!(table.participants()[0], "simulated-01");
    assert_eq!((table.participants().len(), table.n_missing()), (10, 0));
    for pair in 0..2 {
        // Biases of 6 and noise of 8 average to 3.2 points over ten raters; the scale factor adds 20 % of 30 over √10.
        let averages = averages(&table, pair);
        let worst = labels.iter().zip(&averages).map(|(l, a)| (l[pair] - a.mean.unwrap()).abs());
        assert!(worst.fold(0.0, f64::max) < 16.0);
        assert!(agreement(&table, pair).unwrap().average.value > 0.9);
    }
    assert!(rater_fits(&table).iter().all(|fit| !fit.outlying));
}

#[test]
fn a_panel_without_noise_says_the_labels_and_sorts_what_is_apart() {
    let exact = PanelConfig { noise_points: 0.0, bias_points: 0.0, scale_log_spread: 0.0, ..PANEL };
    let labels = labels(9, 2);
    for rating in simulated_ratings(&names(9), &labels, &pairs(), &exact).unwrap() {
        let texture: usize = rating.texture[8..].parse().unwrap();
        let label = labels[texture][usize::from(rating.pair.low == "hard")];
        assert!((rating.value.unwrap() - label).abs() < 1e-12);
    }
    let apart: Vec<Vec<f64>> = [3.0, 50.0, 96.0, 4.0, 52.0, 97.0, 49.0].map(|v| vec![v, 10.0]).to_vec();
    for sort in simulated_sorts(&names(7), &apart, &[3], &exact).unwrap() {
        assert_eq!(groups(&sort), [0, 1, 2, 0, 1, 2, 1]);
    }
}

#[test]
fn every_group_has_a_texture_and_near_ones_meet_more_often() {
    let labels = labels(25, 3);
    let sorts = simulated_sorts(&names(25), &labels, &[3, 6, 9], &PANEL).unwrap();
    assert_eq!(sorts.len(), 30);
    let (mut near, mut far) = ((0.0, 0.0), (0.0, 0.0));
    for sort in &sorts {
        let (n_groups, groups) = (sort.n_groups.unwrap(), groups(sort));
        assert!((0..n_groups).all(|g| groups.contains(&g)));
        assert!(groups.iter().all(|g| *g < n_groups));
        for i in 0..25 {
            for j in 0..i {
                let distance = super::squared_distance(&labels[i], &labels[j]).sqrt();
                let count = if distance < 15.0 { &mut near } else { &mut far };
                count.0 += f64::from(u8::from(groups[i] == groups[j]));
                count.1 += 1.0;
            }
        }
    }
    assert!(near.0 / near.1 > 2.0 * far.0 / far.1, "{near:?} {far:?}");
    // Identical textures leave empty groups that must be filled.
    let equal = simulated_sorts(
        &names(6),
        &vec![vec![50.0]; 6],
        &[4, 6],
        &PanelConfig { noise_points: 0.0, ..PANEL },
    );
    for sort in equal.unwrap() {
        assert!((0..sort.n_groups.unwrap()).all(|g| groups(&sort).contains(&g)), "{sort:?}");
    }
}

#[test]
fn the_same_seed_is_the_same_panel() {
    let labels = labels(12, 4);
    let sorts = |seed| simulated_sorts(&names(12), &labels, &[3], &PanelConfig { seed, ..PANEL }).unwrap();
    assert_eq!(sorts(1), sorts(1));
    assert_ne!(sorts(1), sorts(2));
}

#[test]
fn panels_without_a_meaning_are_refused_by_name() {
    let labels = labels(5, 6);
    let refused = |labels: &[Vec<f64>], groups: usize, config: PanelConfig, words: &str| {
        let error =
            simulated_sorts(&names(labels.len()), labels, &[groups], &config).unwrap_err().to_string();
        assert!(error.contains(words), "{error}");
    };
    refused(&labels, 6, PANEL, "5 textures cannot be sorted into 6");
    refused(&labels, 0, PANEL, "into 0 non-empty groups");
    refused(&labels, 3, PanelConfig { noise_points: -1.0, ..PANEL }, "the noise is -1");
    refused(&labels, 3, PanelConfig { n_participants: 0, ..PANEL }, "at least one");
    refused(&[vec![5.0], vec![101.0]], 1, PANEL, "label 0 of texture 1 is 101");
    refused(&[vec![5.0], vec![5.0, 6.0]], 1, PANEL, "texture 1 has 2 labels");
    let unnamed = simulated_ratings(&names(4), &labels, &pairs(), &PANEL);
    assert_eq!(unnamed, Err(PanelError::Names { n_names: 4, n_labels: 5 }));
}
