use super::{
    AdjectivePair, AgreementError, Rating, RatingTable, RatingsError, RelevanceVote, VoteError, agreement,
    averages, rater_fits, relevances,
};
use crate::maths::rng::Random;
use crate::maths::statistics::{correlation, standard_deviation};

fn pair(low: &str, high: &str) -> AdjectivePair {
    AdjectivePair { low: low.into(), high: high.into() }
}

fn rating(participant: &str, texture: &str, pair: &AdjectivePair, value: impl Into<Option<f64>>) -> Rating {
    Rating {
        participant: participant.into(),
        texture: texture.into(),
        pair: pair.clone(),
        value: value.into(),
    }
}

/// A table from rows of textures and columns of raters on one pair; NaN marks a missing rating.
fn table(rows: &[&[f64]]) -> RatingTable {
    let rough = pair("rough", "smooth");
    let mut ratings = Vec::new();
    for (t, row) in rows.iter().enumerate() {
        for (p, value) in row.iter().enumerate() {
            let value = (!value.is_nan()).then_some(*value);
            ratings.push(rating(&format!("p{p}"), &format!("t{t}"), &rough, value));
        }
    }
    RatingTable::new(&ratings).unwrap()
}

/// Example of Shrout and Fleiss (1979), table 2: six targets, four judges.
const SHROUT_FLEISS: [&[f64]; 6] = [
    &[9.0, 2.0, 5.0, 8.0],
    &[6.0, 1.0, 3.0, 2.0],
    &[8.0, 4.0, 6.0, 8.0],
    &[7.0, 1.0, 2.0, 6.0],
    &[10.0, 5.0, 6.0, 9.0],
    &[6.0, 2.0, 4.0, 7.0],
];

#[test]
fn agreement_is_that_of_the_published_example() {
    let got = agreement(&table(&SHROUT_FLEISS), 0).unwrap();
    // Printed to two or three decimals by Shrout and Fleiss, and reproduced by common statistics packages.
    let close =
        |value: f64, printed: f64| assert!((value - printed).abs() < 0.006, "{value} differs from {printed}");
    close(got.single.value, 0.29);
    close(got.single.low, 0.02);
    close(got.single.high, 0.76);
    close(got.average.value, 0.62);
    close(got.average.low, 0.07);
    close(got.average.high, 0.93);
    // ICC(3,4) of the paper, which is Cronbach's alpha, and the interval of common statistics packages.
    close(got.alpha.value, 0.91);
    close(got.alpha.low, 0.68);
    close(got.alpha.high, 0.99);
    assert!(
        (got.f - 11.03).abs() < 0.01 && got.dof == [5, 15] && (got.p_value - 1.35e-4).abs() < 5e-7,
        "{got:?}"
    );
}

#[test]
fn a_bias_lowers_absolute_agreement_and_exact_agreement_is_one() {
    let same = agreement(&table(&[&[1.0, 1.0], &[50.0, 50.0], &[90.0, 90.0]]), 0).unwrap();
    assert_eq!((same.single.value, same.average.low, same.f, same.p_value), (1.0, 1.0, f64::INFINITY, 0.0));
    let biased = agreement(&table(&[&[1.0, 11.0], &[50.0, 60.0], &[80.0, 90.0]]), 0).unwrap();
    assert!(biased.single.value < 0.98 && biased.f > 1e20);
    let flat = agreement(&table(&[&[1.0, 11.0], &[1.0, 11.0], &[1.0, 11.0]]), 0);
    assert_eq!(flat, Err(AgreementError::Constant));
}

/// Cronbach's alpha from its definition: `k / (k - 1) (1 - Σ variance of a rater / variance of the sums)`.
fn alpha_by_definition(rows: &[&[f64]]) -> f64 {
    let variance = |values: &[f64]| standard_deviation(values).powi(2);
    let k = rows[0].len();
    let raters: f64 =
        (0..k).map(|rater| variance(&rows.iter().map(|row| row[rater]).collect::<Vec<f64>>())).sum();
    let sums: Vec<f64> = rows.iter().map(|row| row.iter().sum()).collect();
    k as f64 / (k as f64 - 1.0) * (1.0 - raters / variance(&sums))
}

#[test]
fn alpha_is_that_of_its_definition_and_ignores_a_bias() {
    let biased: [&[f64]; 3] = [&[1.0, 11.0], &[50.0, 60.0], &[80.0, 90.0]];
    let got = agreement(&table(&biased), 0).unwrap();
    assert_eq!((got.alpha.value, got.alpha.low, got.alpha.high), (1.0, 1.0, 1.0));
    assert!(got.average.value < 1.0);
    let mut random = Random::new(12);
    for case in 0..100 {
        let (n, k) = (3 + case % 9, 2 + case % 5);
        let rows: Vec<Vec<f64>> = (0..n)
            .map(|i| (0..k).map(|j| 5.0 * f64::from(i + j) + 20.0 * random.uniform()).collect())
            .collect();
        let rows: Vec<&[f64]> = rows.iter().map(Vec::as_slice).collect();
        let Ok(found) = agreement(&table(&rows), 0) else { continue };
        let alpha = found.alpha;
        // Variances of two-digit numbers, without cancellation.
        assert!(
            (alpha.value - alpha_by_definition(&rows)).abs() < 1e-9 * (1.0 + alpha.value.abs()),
            "{alpha:?}"
        );
        assert!(alpha.low <= alpha.value && alpha.value <= alpha.high && alpha.high <= 1.0, "{alpha:?}");
    }
}

#[test]
fn agreement_of_simulated_raters_is_the_ratio_of_variances() {
    // Standard deviations: textures 20, raters 10, noise 10 points. ICC(2,1) = 400 / (400 + 100 + 100) = 2/3.
    let mut random = Random::new(3);
    let mut mean = 0.0;
    for _ in 0..40 {
        let bias: Vec<f64> = (0..20).map(|_| 10.0 * random.normal()).collect();
        let mut row = || {
            let texture = 50.0 + 20.0 * random.normal();
            bias.iter().map(|b| (texture + b + 10.0 * random.normal()) / 4.0 + 30.0).collect::<Vec<f64>>()
        };
        let rows: Vec<Vec<f64>> = (0..40).map(|_| row()).collect();
        let rows: Vec<&[f64]> = rows.iter().map(Vec::as_slice).collect();
        mean += agreement(&table(&rows), 0).unwrap().single.value / 40.0;
    }
    // One such correlation has a standard deviation of 0.06, the mean of forty 0.01; the small-sample bias is smaller.
    assert!((mean - 2.0 / 3.0).abs() < 0.03, "{mean}");
}

#[test]
fn missing_ratings_leave_out_as_little_as_they_can() {
    const NONE: f64 = f64::NAN;
    // Excludes the participant who skipped three of six textures, and the texture that one person skipped.
    let mut rows: Vec<Vec<f64>> = SHROUT_FLEISS.iter().map(|row| row.to_vec()).collect();
    for row in &mut rows[..3] {
        row[1] = NONE;
    }
    rows[5][3] = NONE;
    let rows: Vec<&[f64]> = rows.iter().map(Vec::as_slice).collect();
    let table = table(&rows);
    let got = agreement(&table, 0).unwrap();
    assert_eq!((got.participants, got.textures), (vec![0, 2, 3], vec![0, 1, 2, 3, 4]));
    let averages = averages(&table, 0);
    assert_eq!((averages[0].n_raters, averages[0].mean), (3, Some(22.0 / 3.0)));
    assert_eq!(table.n_missing(), 4);
    let nobody = agreement(&self::table(&[&[1.0, NONE], &[NONE, 2.0]]), 0).unwrap_err();
    assert!(nobody.to_string().contains("needs 2 participants"), "{nobody}");
}

#[test]
fn averages_have_the_interval_of_students_t() {
    let table = table(&[&[10.0, 20.0, 30.0], &[f64::NAN, 70.0, f64::NAN], &[f64::NAN; 3]]);
    let averages = averages(&table, 0);
    // 4.303 · 10 / √3: the 97.5 % quantile of t with two degrees of freedom is 4.30265.
    assert_eq!(averages[0].mean, Some(20.0));
    assert!((averages[0].half_width.unwrap() - 4.302_652_7 * 10.0 / 3.0_f64.sqrt()).abs() < 1e-5);
    assert!((averages[0].standard_error.unwrap() - 10.0 / 3.0_f64.sqrt()).abs() < 1e-12);
    assert_eq!((averages[1].n_raters, averages[1].mean, averages[1].half_width), (1, Some(70.0), None));
    assert_eq!(averages[1].standard_error, None);
    assert_eq!((averages[2].n_raters, averages[2].mean), (0, None));
}

#[test]
fn what_would_make_two_answers_of_one_is_refused_by_name() {
    let rough = pair("rough", "smooth");
    let refused = |ratings: &[Rating], words: &str| {
        let error = RatingTable::new(ratings).unwrap_err().to_string();
        assert!(error.contains(words), "{error}");
    };
    refused(
        &[rating("ann", "cork", &rough, 3.0), rating("ann", "cork", &rough, None)],
        "ann rated \"cork\" twice",
    );
    refused(&[rating("ann", "cork", &rough, 100.5)], "ann rated \"cork\" 100.5 on rough\u{2013}smooth");
    refused(&[rating("ann", "cork", &rough, -0.1)], "between 0 (rough) and 100 (smooth)");
    refused(&[rating("ann", "cork", &rough, f64::NAN)], "NaN");
    refused(&[rating("ann", "cork", &pair("rough", "Rough "), 3.0)], "not have two poles");
    refused(&[rating("ann", "cork", &pair("", "soft"), 3.0)], "not have two poles");
    for again in [pair("smooth", "rough"), pair("Rough", "smooth")] {
        refused(
            &[rating("ann", "cork", &rough, 3.0), rating("ann", "felt", &again, 3.0)],
            "the same adjectives",
        );
    }
    assert_eq!(RatingTable::new(&[]), Err(RatingsError::Empty));
}

#[test]
fn half_of_the_votes_keep_an_adjective() {
    let vote = |participant: &str, texture: Option<&str>, adjective: &str, relevant| RelevanceVote {
        participant: participant.into(),
        texture: texture.map(Into::into),
        adjective: adjective.into(),
        relevant,
    };
    let votes = [
        vote("ann", None, "rough", true),
        vote("bob", None, "rough", false),
        vote("ann", None, "sharp", false),
        vote("bob", None, "sharp", false),
        vote("cem", None, "sharp", true),
    ];
    let got = relevances(&votes).unwrap();
    assert!(got[0].kept && got[0].share == 0.5 && got[0].adjective == "rough");
    assert!(!got[1].kept && (got[1].n_votes, got[1].n_relevant) == (3, 1));
    let by_texture = [vote("ann", Some("cork"), "rough", true), vote("ann", Some("felt"), "rough", true)];
    assert_eq!(relevances(&by_texture).unwrap()[0].n_votes, 2);
    let twice = relevances(&[by_texture[0].clone(), by_texture[0].clone()]).unwrap_err();
    assert!(
        matches!(twice, VoteError::Twice { .. }) && twice.to_string().contains("for \"cork\""),
        "{twice}"
    );
}

#[test]
fn raters_who_rate_otherwise_are_reported() {
    let mut random = Random::new(8);
    let pairs = [pair("rough", "smooth"), pair("hard", "soft")];
    let mut ratings = Vec::new();
    for texture in 0..25 {
        for (k, pair) in pairs.iter().enumerate() {
            let truth = 20.0 + 60.0 * random.uniform();
            for participant in 0..8 {
                let noise = 5.0 * random.normal();
                let value = match participant {
                    6 => 100.0 * random.uniform(),
                    7 if k == 1 => 100.0 - truth + noise,
                    _ => truth + noise,
                };
                let texture = format!("t{texture}");
                ratings.push(rating(&format!("p{participant}"), &texture, pair, value.clamp(0.0, 100.0)));
            }
        }
    }
    let constant = pairs[0].clone();
    ratings.extend((0..25).map(|t| rating("always", &format!("t{t}"), &constant, 50.0)));
    let fits = rater_fits(&RatingTable::new(&ratings).unwrap());
    assert!(fits[..6].iter().all(|f| !f.outlying && f.correlation.unwrap() > 0.8), "{fits:?}");
    assert!(fits[6].outlying);
    assert!(fits[7].by_pair[0].unwrap() > 0.8 && fits[7].by_pair[1].unwrap() < -0.8 && fits[7].outlying);
    assert!(!fits[8].outlying && fits[8].correlation.is_none() && fits[8].n_ratings == 25);
    // Reversed poles and constant ratings are reported by pair.
    for (i, fit) in fits.iter().enumerate() {
        assert_eq!(fit.reversed_pairs, if i == 7 { vec![1] } else { Vec::new() }, "{fit:?}");
        assert_eq!(fit.constant_pairs, if i == 8 { vec![0] } else { Vec::new() }, "{fit:?}");
    }
}

#[test]
fn a_rater_is_compared_with_the_others_alone() {
    let rows: [&[f64]; 4] =
        [&[10.0, 30.0, 20.0], &[40.0, 20.0, 60.0], &[90.0, 50.0, 60.0], &[70.0, 95.0, 50.0]];
    let fits = rater_fits(&table(&rows));
    for (rater, fit) in fits.iter().enumerate() {
        let own: Vec<f64> = rows.iter().map(|row| row[rater]).collect();
        let others: Vec<f64> = rows.iter().map(|row| (row.iter().sum::<f64>() - row[rater]) / 2.0).collect();
        let expected = correlation(&own, &others).unwrap();
        assert!((fit.correlation.unwrap() - expected).abs() < 1e-12, "{fit:?} differs from {expected}");
        assert!((fit.by_pair[0].unwrap() - expected).abs() < 1e-12);
    }
}

#[test]
fn raters_who_contradict_each_other_have_no_agreement_and_no_impossible_one() {
    // One of two raters uses swapped poles: the raters share no variance, and the ICC is undefined.
    let mirrored: [&[&[f64]]; 3] = [
        &[&[20.0, 80.0], &[80.0, 20.0]],
        &[&[20.0, 80.0], &[50.0, 50.0], &[80.0, 20.0]],
        &[
            &[1.0, 99.0],
            &[9.0, 80.0],
            &[20.0, 85.0],
            &[40.0, 55.0],
            &[55.0, 50.0],
            &[70.0, 25.0],
            &[85.0, 18.0],
            &[97.0, 2.0],
        ],
    ];
    for rows in mirrored {
        assert_eq!(agreement(&table(rows), 0), Err(AgreementError::Contradictory), "{rows:?}");
    }
    // For random ratings, the ICC is at most 1 and lies within its interval.
    let mut random = Random::new(11);
    for case in 0..300 {
        let (n, k) = (2 + case % 7, 2 + case % 4);
        let rows: Vec<Vec<f64>> = (0..n)
            .map(|_| (0..k).map(|_| (20.0 * (5.0 * random.uniform()).floor()).min(100.0)).collect())
            .collect();
        let rows: Vec<&[f64]> = rows.iter().map(Vec::as_slice).collect();
        let Ok(found) = agreement(&table(&rows), 0) else { continue };
        for icc in [found.single, found.average] {
            assert!(
                icc.value <= 1.0 + 1e-12 && icc.low <= icc.value + 1e-9 && icc.value <= icc.high + 1e-9,
                "{rows:?}: {icc:?}"
            );
        }
    }
}

#[test]
fn tables_of_something_else_are_refused_before_they_take_memory() {
    let rough = pair("rough", "smooth");
    let wide: Vec<Rating> =
        (0..4000).map(|i| rating(&format!("p{i}"), &format!("t{i}"), &rough, 5.0)).collect();
    let message = RatingTable::new(&wide).unwrap_err().to_string();
    assert!(message.contains("4000 participants, 4000 textures"), "{message}");
    let pairs: Vec<Rating> =
        (0..2000).map(|i| rating("p", "t", &pair(&format!("a{i}"), &format!("b{i}")), 5.0)).collect();
    assert_eq!(RatingTable::new(&pairs), Err(RatingsError::TooManyPairs { n_pairs: 2000 }));
}

#[test]
fn votes_do_not_mind_case() {
    let vote = |participant: &str, adjective: &str, relevant| RelevanceVote {
        participant: participant.into(),
        texture: None,
        adjective: adjective.into(),
        relevant,
    };
    let found = relevances(&[vote("a", "Rough", true), vote("b", "rough ", false), vote("c", "ROUGH", true)])
        .unwrap();
    assert_eq!((found.len(), found[0].n_votes, found[0].n_relevant), (1, 3, 2));
    assert!(relevances(&[vote("a", "Rough", true), vote("a", "rough", true)]).is_err());
}
