//! Spaces from ratings alone.

use std::sync::Mutex;

use super::{N, build, build_with_votes, judgments, labels, models, pair, quick};
use crate::maths::rng::Random;
use crate::maths::statistics::correlation;
use crate::people::panel::{PanelConfig, simulated_ratings};
use crate::people::ratings::{AdjectivePair, Rating, RelevanceVote};
use crate::space::LabelSource;
use crate::space::features::NamedTexture;
use crate::space::space_build::{
    FeatureKind, PlacedBy, SpaceBuild, SpaceBuildError, SpaceData, SpaceOptions, Step, build_space,
    position_errors, stress_in_words, stress_of_random_data, validation_summary,
};

/// Ratings of the simulated panel on these pairs.
fn ratings(pairs: &[&str]) -> Vec<Rating> {
    judgments(pairs).1
}

/// Fast options, without a permutation test.
fn fast() -> SpaceOptions {
    SpaceOptions { features: FeatureKind::Physical, n_permutations: 0, ..quick() }
}

fn rated(ratings: Vec<Rating>, options: &SpaceOptions) -> Result<SpaceBuild, SpaceBuildError> {
    build((Vec::new(), ratings), options)
}

/// Mean rating of a texture on a pair, computed beside the program.
fn mean_of(ratings: &[Rating], texture: &str, pair: &AdjectivePair) -> f64 {
    let of = ratings.iter().filter(|rating| rating.texture == texture && rating.pair == *pair);
    let values: Vec<f64> = of.filter_map(|rating| rating.value).collect();
    values.iter().sum::<f64>() / values.len() as f64
}

#[test]
fn positions_are_mean_ratings_and_features_predict_them() {
    let ratings = ratings(&["rough-smooth", "hard-soft"]);
    let built = rated(ratings.clone(), &quick()).unwrap();
    assert_eq!(
        (built.textures.len(), built.perceptual.is_none(), built.stability.is_none()),
        (N, true, true)
    );
    for (axis, name) in built.axes.iter().zip(["rough-smooth", "hard-soft"]) {
        assert_eq!((axis.pair.name().as_str(), axis.placed_by), (name, PlacedBy::Felt));
        assert!(axis.direction.is_none());
        for (texture, felt) in built.textures.iter().zip(&axis.felt) {
            assert!((felt - mean_of(&ratings, texture, &axis.pair)).abs() < 1e-9, "{texture}: {felt}");
        }
        // The features contain the labels that the panel rates with noise.
        let v = &axis.prediction.as_ref().unwrap().validation;
        assert!(v.nested_cv_r > 0.7 && v.permutation_p == Some(0.05), "{name}: {v:?}");
        let alpha = built.adjectives[axis.adjective].agreement.as_ref().unwrap().alpha;
        assert!(alpha.value > 0.9 && alpha.low < alpha.value, "{alpha:?}");
    }
    assert_eq!(built.positions[4].y(), built.axes[1].felt[4]);
    // The panel has eight raters with noise of 8 and a bias of 5 points.
    let errors = position_errors(&built).unwrap();
    assert!(errors.iter().all(|error| (1.5..6.0).contains(error)), "{errors:?}");
    assert_eq!((stress_in_words(&built), stress_of_random_data(&built)), (None, None));
    let said = validation_summary(&built).join("\n");
    for words in [
        "Built from ratings alone, by 8 participants",
        "the report lacks stress, adjective directions and their angle",
        "correlate with r = ",
        "The principal components of the mean ratings (2 adjective pairs, 14 textures) explain",
        "Cronbach's alpha over 8 raters and 14 textures",
        "nested correlation",
        "Standard errors of the mean ratings",
        "simulated raters; no person felt the textures",
        "rough\u{2013}smooth: mean ratings.",
    ] {
        assert!(said.contains(words), "\"{words}\" is missing in: {said}");
    }
}

#[test]
fn the_axes_are_the_least_correlated_pairs_with_reliable_ratings() {
    // The second pair follows the first label mostly, and the fourth is noise that differs from rater to rater.
    let names: Vec<String> = models().into_iter().map(|(name, _)| name).collect();
    let values: Vec<Vec<f64>> =
        labels().into_iter().map(|label| vec![label[0], 0.7 * label[0] + 0.3 * label[1], label[1]]).collect();
    let pairs = ["even-uneven", "flat-bumpy", "soft-hard"].map(pair);
    let config = PanelConfig { noise_points: 6.0, bias_points: 3.0, ..super::panel() };
    let mut ratings = simulated_ratings(&names, &values, &pairs, &config).unwrap();
    let mut random = Random::new(9);
    let noise: Vec<Rating> = ratings
        .iter()
        .filter(|rating| rating.pair == pairs[0])
        .map(|rating| Rating {
            pair: pair("one-two"),
            value: Some(100.0 * random.uniform()),
            ..rating.clone()
        })
        .collect();
    ratings.extend(noise);
    let built = rated(ratings.clone(), &fast()).unwrap();
    // Rated as soft-hard, the pair becomes the second axis, with "hard" at 0.
    assert_eq!(built.axes.each_ref().map(|axis| axis.pair.name()), ["even-uneven", "hard-soft"]);
    for (texture, felt) in built.textures.iter().zip(&built.axes[1].felt) {
        assert!((felt - (100.0 - mean_of(&ratings, texture, &pairs[2]))).abs() < 1e-9, "{texture}: {felt}");
    }
    let felt = built.axes.each_ref().map(|axis| axis.felt.clone());
    let r = correlation(&felt[0], &felt[1]).unwrap();
    assert!((built.axis_correlation.unwrap() - r).abs() < 1e-12, "{r}: {:?}", built.axis_correlation);
    let components = built.components.as_ref().unwrap();
    assert_eq!((components.pairs.len(), components.n_textures), (4, N));

    // Stated axes are used whatever their reliability, and the finding says how unreliable they are.
    let options = SpaceOptions { axes: Some([pair("one-two"), pair("uneven-even")]), ..fast() };
    let stated = rated(ratings, &options).unwrap();
    assert_eq!(stated.axes.each_ref().map(|axis| axis.pair.name()), ["one-two", "uneven-even"]);
    let said = stated.findings.join("\n");
    assert!(said.contains("one\u{2013}two: the mean ratings are unreliable"), "{said}");
    let options = SpaceOptions { axes: Some([pair("even-uneven"), pair("flat-bumpy")]), ..options };
    let built = rated(ratings_of(&names, &values, &pairs, &config), &options).unwrap();
    assert!(built.findings.join("\n").contains("they measure nearly the same"), "{:?}", built.findings);
}

fn ratings_of(
    names: &[String],
    values: &[Vec<f64>],
    pairs: &[AdjectivePair],
    config: &PanelConfig,
) -> Vec<Rating> {
    simulated_ratings(names, values, pairs, config).unwrap()
}

/// Neither the order of the participants nor that of the textures changes the space.
#[test]
fn the_order_of_raters_and_textures_does_not_matter() {
    let plain = ratings(&["rough-smooth", "hard-soft", "sticky-slippery"]);
    let expected = rated(plain.clone(), &fast()).unwrap();
    let mut random = Random::new(3);
    for _ in 0..5 {
        // The ratings of one participant on one texture stay together, as in a table with a column for each pair.
        let groups: Vec<&[Rating]> = plain.chunks(3).collect();
        let order = random.shuffled(groups.len());
        let shuffled: Vec<Rating> = order.iter().flat_map(|group| groups[*group].to_vec()).collect();
        let built = rated(shuffled, &fast()).unwrap();
        assert_eq!(built.textures, expected.textures, "the order of the library");
        for (axis, other) in built.axes.iter().zip(&expected.axes) {
            assert_eq!(axis.pair, other.pair);
            for (a, b) in axis.felt.iter().zip(&other.felt) {
                // Sums of eight numbers in another order.
                assert!((a - b).abs() < 1e-10, "{a} and {b}");
            }
        }
        let dims = |built: &SpaceBuild| built.components.as_ref().unwrap().n_dims;
        assert_eq!(dims(&built), dims(&expected));
    }
}

#[test]
fn ratings_missing_at_random_hardly_move_the_positions() {
    let plain = ratings(&["rough-smooth", "hard-soft"]);
    let expected = rated(plain.clone(), &fast()).unwrap();
    let mut random = Random::new(4);
    let mut holes = plain;
    for rating in &mut holes {
        if random.uniform() < 0.1 {
            rating.value = None;
        }
    }
    let built = rated(holes, &fast()).unwrap();
    assert!(
        built.n_missing_ratings > 10 && built.textures == expected.textures,
        "{}",
        built.n_missing_ratings
    );
    for (axis, other) in built.axes.iter().zip(&expected.axes) {
        let squares = axis.felt.iter().zip(&other.felt).map(|(a, b)| (a - b) * (a - b));
        let rms = (squares.sum::<f64>() / N as f64).sqrt();
        // A rating deviates by about 12 points from its mean (noise, bias and scale). Without one of ten from eight
        // raters, the mean moves by about 12 √(0.1 / 8) = 1.3 points.
        assert!(rms < 3.0, "{rms}");
    }
    assert!(built.findings.iter().any(|finding| finding.contains("averages use only the ratings given")));
}

#[test]
fn few_raters_are_said_and_one_has_no_standard_error() {
    let of = |n: usize| -> Vec<Rating> {
        let mut kept = ratings(&["rough-smooth", "hard-soft"]);
        kept.retain(|rating| {
            let number = rating.participant.rsplit('-').next().unwrap().parse::<usize>().unwrap();
            number <= n
        });
        kept
    };
    let two = rated(of(2), &fast()).unwrap();
    assert!(two.findings.join("\n").contains("only 2 participants rated"), "{:?}", two.findings);
    assert!(two.axes.iter().all(|axis| two.adjectives[axis.adjective].agreement.is_ok()));
    let one = rated(of(1), &fast()).unwrap();
    let said = one.findings.join("\n");
    assert!(
        said.contains("only one participant rated") && said.contains("fewer than two adjective pairs"),
        "{said}"
    );
    assert_eq!(position_errors(&one), None);
    assert!(validation_summary(&one).join("\n").contains("inter-rater agreement is unknown"));
}

#[test]
fn raters_with_constant_or_reversed_ratings_are_named() {
    let mut kept = ratings(&["rough-smooth", "hard-soft"]);
    for rating in &mut kept {
        match (rating.participant.as_str(), rating.pair.low.as_str()) {
            ("simulated-02", _) => rating.value = Some(50.0),
            ("simulated-05", "hard") => rating.value = rating.value.map(|value| 100.0 - value),
            _ => {}
        }
    }
    let said = rated(kept, &fast()).unwrap().findings.join("\n");
    assert!(
        said.contains(
            "the same rating on a pair (not excluded): simulated-02 (rough\u{2013}smooth, hard\u{2013}soft)"
        ),
        "{said}"
    );
    assert!(said.contains("check the table): simulated-05 (hard\u{2013}soft)"), "{said}");
}

#[test]
fn textures_without_a_rating_on_both_axes_get_no_position() {
    let mut kept = ratings(&["rough-smooth", "hard-soft"]);
    kept.retain(|rating| rating.texture != "t03" && !(rating.texture == "t07" && rating.pair.low == "hard"));
    for rating in kept.iter_mut().filter(|rating| rating.texture == "t09") {
        rating.value = rating.value.filter(|_| rating.participant == "simulated-01");
    }
    let built = rated(kept, &fast()).unwrap();
    assert_eq!(built.not_placed, ["t03", "t07"]);
    assert_eq!(
        (built.textures.len(), built.positions.len(), built.axes[0].felt.len()),
        (N - 2, N - 2, N - 2)
    );
    assert!(built.adjectives.iter().all(|adjective| adjective.ratings.len() == N - 2));
    let said = built.findings.join("\n");
    assert!(said.contains("not rated on both axes, so without a position: t03, t07"), "{said}");
    assert!(said.contains("1 texture with a single rating"), "{said}");
}

/// An experiment with some textures of a library: the others are not listed, but those that lost their position are.
#[test]
fn textures_that_were_not_in_the_experiment_are_not_listed_if_they_are_most() {
    let mut kept = ratings(&["rough-smooth", "hard-soft"]);
    kept.retain(|rating| {
        rating.texture.as_str() < "t06" && !(rating.texture == "t02" && rating.pair.low == "hard")
    });
    let built = rated(kept, &quick()).unwrap();
    assert_eq!((built.textures.len(), built.not_placed.len()), (5, N - 5));
    let said = built.findings.join("\n");
    assert!(said.contains("not rated on both axes, so without a position: t02"), "{said}");
    assert_eq!(said.matches("without a position").count(), 1, "{said}");
    assert!(!said.contains("t10"), "{said}");
}

#[test]
fn few_textures_give_a_space_without_predictions() {
    let mut kept = ratings(&["rough-smooth", "hard-soft"]);
    kept.retain(|rating| rating.texture.as_str() < "t05");
    let built = rated(kept.clone(), &quick()).unwrap();
    assert!(built.axes.iter().all(|axis| axis.prediction.is_none() && axis.felt.len() == 5));
    assert!(built.findings.join("\n").contains("5 textures are too few to predict an axis from features"));
    kept.retain(|rating| rating.texture.as_str() < "t02");
    let error = rated(kept, &quick()).unwrap_err().to_string();
    assert!(error.contains("fewer than 3 textures were rated on it"), "{error}");
}

#[test]
fn predicted_positions_are_used_only_on_request() {
    let ratings = ratings(&["rough-smooth", "hard-soft"]);
    let options = SpaceOptions { placement: Some(PlacedBy::Predicted), ..fast() };
    let built = rated(ratings, &options).unwrap();
    let prediction = built.axes[0].prediction.as_ref().unwrap();
    assert_eq!(built.positions[3].x(), prediction.predicted[3]);
    assert!(validation_summary(&built).join("\n").contains("positions predicted from features"));
}

#[test]
fn ratings_that_make_no_space_say_why() {
    let check = |change: &dyn Fn(&mut Vec<Rating>, &mut SpaceOptions), words: &str| {
        let (mut kept, mut options) = (ratings(&["rough-smooth", "hard-soft"]), fast());
        change(&mut kept, &mut options);
        let message = rated(kept, &options).unwrap_err().to_string();
        assert!(message.contains(words), "{message}");
    };
    check(&|kept, _| kept.clear(), "there are no ratings");
    check(&|kept, _| kept.iter_mut().for_each(|rating| rating.value = None), "no rating is filled in");
    check(
        &|kept, _| kept.retain(|r| r.pair.low == "rough"),
        "1 adjective pair can be an axis, but two are needed",
    );
    let constant = |kept: &mut Vec<Rating>, _: &mut SpaceOptions| {
        kept.iter_mut().filter(|r| r.pair.low == "hard").for_each(|r| r.value = Some(30.0));
    };
    check(&constant, "hard\u{2013}soft: all textures have the same mean rating on it");
    let apart = |kept: &mut Vec<Rating>, _: &mut SpaceOptions| {
        kept.retain(|r| (r.texture.as_str() < "t07") == (r.pair.low == "hard"));
    };
    check(&apart, "no two adjective pairs were rated on the same 3 textures");
    let stated = |kept: &mut Vec<Rating>, options: &mut SpaceOptions| {
        apart(kept, options);
        options.axes = Some([pair("rough-smooth"), pair("hard-soft")]);
    };
    check(&stated, "only 0 textures are rated on both axes (rough-smooth and hard-soft)");
    check(&|_, options| options.axes = Some([pair("warm-cold"), pair("hard-soft")]), "it was not rated");
    check(&|kept, _| kept[0].texture = "corkk".to_owned(), "\"corkk\" was rated");
}

/// The published selection: only pairs whose adjectives at least half of the votes find relevant can be axes.
#[test]
fn relevance_votes_exclude_pairs() {
    let ratings = ratings(&["rough-smooth", "hard-soft", "sticky-slippery"]);
    let vote = |participant: &str, adjective: &str, relevant: bool| RelevanceVote {
        participant: participant.to_owned(),
        texture: Some("t01".to_owned()),
        adjective: adjective.to_owned(),
        relevant,
    };
    let votes = vec![vote("a", "Rough", false), vote("b", "Rough", false), vote("a", "hard", true)];
    let built = build_with_votes(Vec::new(), ratings, votes, &fast()).unwrap();
    assert!(!built.adjectives[0].is_relevant);
    let names = built.axes.each_ref().map(|axis| axis.pair.name());
    assert_eq!(names, ["sticky-slippery", "hard-soft"], "hard-soft is the second axis if it is one");
    assert_eq!(built.components.unwrap().pairs, [1, 2]);
}

#[test]
fn steps_of_ratings_alone_begin_with_the_adjectives_and_can_be_stopped() {
    let models = models();
    let textures = models.iter().map(|(name, model)| NamedTexture { name, model }).collect();
    let ratings = ratings(&["rough-smooth", "hard-soft"]);
    let data = SpaceData {
        textures,
        sorts: Vec::new(),
        ratings,
        votes: Vec::new(),
        source: LabelSource::SimulatedRaters,
    };
    let told = Mutex::new(Vec::new());
    build_space(&data, &fast(), &|step| {
        told.lock().unwrap().push(step.index());
        true
    })
    .unwrap();
    let mut told = told.into_inner().unwrap();
    told.dedup();
    let expected = [Step::Adjectives, Step::Features, Step::Axis(0), Step::Axis(1)].map(Step::index);
    assert_eq!(told, expected);
    for step in [Step::Adjectives, Step::Features, Step::Axis(1)] {
        let stopped = build_space(&data, &fast(), &|now| now != step);
        assert_eq!(stopped, Err(SpaceBuildError::Stopped), "{step:?}");
    }
}
