mod degenerate;
mod rated;

use std::sync::Mutex;
use std::sync::atomic::{AtomicUsize, Ordering};

use super::{
    FeatureKind, PlacedBy, SpaceBuild, SpaceBuildError, SpaceData, SpaceOptions, Step, TRUSTED_NESTED_R,
    build_space,
};
use crate::maths::statistics::correlation;
use crate::people::mds::{Mds, Transform};
use crate::people::panel::{PanelConfig, simulated_ratings, simulated_sorts};
use crate::people::ratings::{AdjectivePair, Rating, RelevanceVote};
use crate::people::sorting::{Grouped, Sort};
use crate::space::LabelSource;
use crate::space::features::NamedTexture;
use crate::space::space_build::warnings::of_scaling;
use crate::space::space_build::{few_judges, validation_summary};
use crate::texture::{GrainNode, TextureModel};
use crate::units::{Hertz, MetersPerSecond, Newtons};

const N: usize = 14;

/// Labels of synthetic textures, spread over the square.
fn labels() -> Vec<Vec<f64>> {
    let place = |i: usize| vec![(i * 37 % N) as f64 * 100.0 / (N - 1) as f64, (i * 53 % 100) as f64];
    (0..N).map(place).collect()
}

/// Textures whose level falls with the first label and whose resonance falls with the second.
fn models() -> Vec<(String, TextureModel)> {
    let model = |label: &Vec<f64>| {
        let frequency = 2.0 * (1.0 - 0.008 * label[1]);
        let node = |speed_mps: f64, force_n: f64| GrainNode {
            speed: MetersPerSecond(speed_mps),
            force: Newtons(force_n),
            lsf: vec![frequency - 0.1, frequency + 0.1],
            level_mps2: (2.0 - 0.03 * label[0]).exp() * (speed_mps / 0.1) * force_n.powf(0.3),
        };
        let nodes = vec![node(0.03, 0.1), node(0.25, 0.1), node(0.03, 0.5), node(0.25, 0.5)];
        TextureModel::new(Hertz(1000.0), nodes, Some(0.3)).unwrap()
    };
    labels().iter().enumerate().map(|(i, label)| (format!("t{i:02}"), model(label))).collect()
}

fn pair(name: &str) -> AdjectivePair {
    name.parse().unwrap()
}

fn panel() -> PanelConfig {
    PanelConfig { n_participants: 8, noise_points: 8.0, bias_points: 5.0, scale_log_spread: 0.1, seed: 3 }
}

/// Judgments of a simulated panel on the labels, with ratings on `pairs`; pairs after the second are rated at random.
fn judgments(pairs: &[&str]) -> (Vec<Sort>, Vec<Rating>) {
    let config = panel();
    let names: Vec<String> = models().into_iter().map(|(name, _)| name).collect();
    let sorts = simulated_sorts(&names, &labels(), &[3, 5, 7], &config).unwrap();
    let mut values = labels();
    for (i, row) in values.iter_mut().enumerate() {
        row.extend((2..pairs.len()).map(|p| (i * 29 * p % 101) as f64));
    }
    let pairs: Vec<AdjectivePair> = pairs.iter().map(|name| pair(name)).collect();
    (sorts, simulated_ratings(&names, &values, &pairs, &config).unwrap())
}

fn quick() -> SpaceOptions {
    SpaceOptions { n_permutations: 19, ..SpaceOptions::usual(1) }
}

fn build(
    (sorts, ratings): (Vec<Sort>, Vec<Rating>),
    options: &SpaceOptions,
) -> Result<SpaceBuild, SpaceBuildError> {
    build_with_votes(sorts, ratings, Vec::new(), options)
}

fn build_with_votes(
    sorts: Vec<Sort>,
    ratings: Vec<Rating>,
    votes: Vec<RelevanceVote>,
    options: &SpaceOptions,
) -> Result<SpaceBuild, SpaceBuildError> {
    let models = models();
    let textures = models.iter().map(|(name, model)| NamedTexture { name, model }).collect();
    let data = SpaceData { textures, sorts, ratings, votes, source: LabelSource::SimulatedRaters };
    build_space(&data, options, &|_| true)
}

#[test]
fn axes_follow_the_labels_of_the_panel_and_features_predict_them() {
    let built = build(judgments(&["rough-smooth", "hard-soft", "sticky-slippery"]), &quick()).unwrap();
    assert_eq!(built.textures.len(), N);
    let space = built.perceptual.as_ref().unwrap();
    assert!(space.configuration.stress < 0.15 && space.stress.windows(2).all(|w| w[1] <= w[0] + 1e-9));
    for (axis, name) in built.axes.iter().zip(["rough-smooth", "hard-soft"]) {
        assert_eq!(axis.pair.name(), name);
        let index = usize::from(name == "hard-soft");
        let truth: Vec<f64> = labels().iter().map(|label| label[index]).collect();
        assert!(correlation(&axis.felt, &truth).unwrap() > 0.9, "{name}: {:?}", axis.felt);
        // The features contain the label. The unbiased figure is reported together with the published one.
        let prediction = axis.prediction.as_ref().unwrap();
        assert!(prediction.validation.nested_cv_r > 0.7, "{name}: {:?}", prediction.validation);
        assert_eq!(prediction.validation.permutation_p, Some(0.05), "{name}");
        assert!(!prediction.features.is_empty());
        assert!(prediction.predicted.iter().all(|p| (0.0..=100.0).contains(p)));
    }
    assert!((60.0..120.0).contains(&space.angle_degrees), "{}", space.angle_degrees);
    // Random ratings have a poor fit.
    let random = built.adjectives[2].line.as_ref().unwrap();
    assert!(random.r_squared < 0.5 && built.adjectives[0].line.as_ref().unwrap().r_squared > 0.8);
    let said = validation_summary(&built).join("\n");
    for words in
        ["simulated raters; no person felt the textures", "nested cross-validation", "19 permutations", "ICC"]
    {
        assert!(said.contains(words), "\"{words}\" is missing in: {said}");
    }
}

#[test]
fn positions_are_predicted_if_the_nested_correlation_reaches_the_limit() {
    let (sorts, ratings) = judgments(&["rough-smooth", "hard-soft"]);
    let built = |placement: Option<PlacedBy>, step: usize| {
        let models = models();
        // Vibrations of other textures carry no information.
        let textures = (0..N).map(|i| NamedTexture { name: &models[i].0, model: &models[(i * step) % N].1 });
        let textures = textures.collect();
        let data = SpaceData {
            textures,
            sorts: sorts.clone(),
            ratings: ratings.clone(),
            votes: Vec::new(),
            source: LabelSource::SimulatedRaters,
        };
        build_space(&data, &SpaceOptions { placement, ..quick() }, &|_| true).unwrap()
    };
    let (own, others) = (built(None, 1), built(None, 5));
    for (built, placed_by, words) in [
        (
            &own,
            PlacedBy::Predicted,
            "predicted from features, by models trained on the same textures, because",
        ),
        (&others, PlacedBy::Felt, "perceived positions, computed from the judgments, because the nested"),
    ] {
        for axis in &built.axes {
            let nested_r = axis.prediction.as_ref().unwrap().validation.nested_cv_r;
            assert_eq!(nested_r >= TRUSTED_NESTED_R, placed_by == PlacedBy::Predicted, "{nested_r}");
            assert_eq!(axis.placed_by, placed_by);
        }
        assert!(validation_summary(built).join("\n").contains(words), "{:?}", validation_summary(built));
    }
    assert_eq!(own.positions[3].y(), own.axes[1].prediction.as_ref().unwrap().predicted[3]);
    assert_eq!(others.positions[3].y(), others.axes[1].felt[3]);
    // An explicit placement is used whatever the nested correlation.
    let [felt, predicted] = [built(Some(PlacedBy::Felt), 1), built(Some(PlacedBy::Predicted), 5)];
    assert_eq!(felt.positions[3].x(), felt.axes[0].felt[3]);
    assert_eq!(predicted.positions[3].x(), predicted.axes[0].prediction.as_ref().unwrap().predicted[3]);
}

#[test]
fn a_pair_rated_with_exchanged_poles_becomes_a_reversed_axis() {
    let turned = build(judgments(&["smooth-rough", "hard-soft"]), &quick()).unwrap();
    // The panel rates by the labels, so the pole "rough" is now at 100, and the axis is reversed to put it at 0.
    let straight = build(judgments(&["rough-smooth", "hard-soft"]), &quick()).unwrap();
    assert_eq!(turned.axes[0].pair, pair("rough-smooth"));
    for (a, b) in turned.axes[0].felt.iter().zip(&straight.axes[0].felt) {
        assert!((a - (100.0 - b)).abs() < 1e-9, "{a} and {b}");
    }
    let options = SpaceOptions { axes: Some([pair("hard-soft"), pair("rough-smooth")]), ..quick() };
    let swapped = build(judgments(&["rough-smooth", "hard-soft"]), &options).unwrap();
    assert_eq!(swapped.axes[0].felt, straight.axes[1].felt);
}

#[test]
fn without_the_usual_pairs_the_best_pair_of_each_dimension_is_chosen_and_orthogonalized_on_request() {
    let options = SpaceOptions { is_orthogonal: true, placement: Some(PlacedBy::Predicted), ..quick() };
    let built = build(judgments(&["warm-cold", "dull-sharp", "one-two"]), &options).unwrap();
    let mut names = built.axes.each_ref().map(|axis| axis.pair.name());
    names.sort();
    assert_eq!(names, ["dull-sharp", "warm-cold"], "the third pair was rated at random");
    let [first, second] = built.axes.each_ref().map(|axis| axis.direction.as_ref().unwrap());
    let across: f64 = first.iter().zip(second).map(|(a, b)| a * b).sum();
    assert!(across.abs() < 1e-12);
    assert_eq!(built.positions[5].y(), built.axes[1].prediction.as_ref().unwrap().predicted[5]);
}

#[test]
fn missing_sorts_and_ratings_are_reported_and_tolerated() {
    let (mut sorts, mut ratings) = judgments(&["rough-smooth", "hard-soft"]);
    for sort in &mut sorts {
        sort.placements.retain(|placement| placement.texture != "t13");
    }
    ratings.retain(|rating| {
        rating.texture != "t00" && !(rating.participant == "simulated-02" && rating.texture == "t05")
    });
    ratings[0].value = None;
    let built = build((sorts, ratings), &quick()).unwrap();
    assert_eq!((built.not_placed, built.textures.len()), (vec!["t13".to_owned()], N - 1));
    assert!(built.adjectives[0].ratings[0].mean.is_none());
    assert!(built.n_missing_ratings >= 3);
    let findings = built.findings.join("\n");
    assert!(findings.contains("not rated, so positioned by sorting alone: t00"), "{findings}");
    assert!(findings.contains("rated but not sorted, so without a position: t13"), "{findings}");
    assert_eq!(findings.matches("without a position").count(), 1, "once: {findings}");
}

#[test]
fn few_textures_give_a_space_without_predictions() {
    let (mut sorts, ratings) = judgments(&["rough-smooth", "hard-soft"]);
    for sort in &mut sorts {
        sort.placements.retain(|placement| placement.texture.as_str() < "t05");
    }
    let built = build((sorts, ratings), &quick()).unwrap();
    assert_eq!(built.textures.len(), 5);
    assert!(built.axes.iter().all(|axis| axis.prediction.is_none() && axis.felt.len() == 5));
    assert!(built.findings.join("\n").contains("5 textures are too few to predict an axis from features"));
}

#[test]
fn a_collapsed_space_is_reported() {
    let said_by = |transform: Transform, points: Vec<Vec<f64>>| {
        let mds = Mds { points, stress: 0.0, converged: true, n_steps: 9, stress_by_start: vec![0.0] };
        let mut options = quick();
        options.mds.transform = transform;
        of_scaling(&mds, &options).join("\n")
    };
    let said = |points: Vec<Vec<f64>>| said_by(Transform::PrimaryTies, points);
    let scattered = |n: usize| labels().into_iter().take(n).collect::<Vec<_>>();
    let mut collapsed: Vec<Vec<f64>> =
        scattered(9).into_iter().map(|point| point.into_iter().map(|x| 1e-3 * x).collect()).collect();
    collapsed[8] = vec![160.0, 0.0];
    assert!(said(collapsed.clone()).contains("use interval scaling or more participants"));
    let by_interval = said_by(Transform::Interval, collapsed);
    assert!(by_interval.contains("has collapsed") && !by_interval.contains("interval"), "{by_interval}");
    assert_eq!(said(scattered(9)), "");
    assert!(said(scattered(8)).contains("8 textures are too few for 2 dimensions"));
}

#[test]
fn wrong_group_counts_and_disjoint_participants_are_reported() {
    let names: Vec<String> = models().into_iter().map(|(name, _)| name).take(7).collect();
    let sort = |participant: usize, odd: usize| Sort {
        participant: format!("p{participant}"),
        trial: "1".to_owned(),
        n_groups: Some(99_999),
        placements: names
            .iter()
            .enumerate()
            .map(|(i, texture)| Grouped { texture: texture.clone(), group: (i == 6 || i == odd).to_string() })
            .collect(),
    };
    let (_, ratings) = judgments(&["rough-smooth", "hard-soft"]);
    let sorts = (0..6).map(|p| sort(p, if p == 0 { 0 } else { 6 })).collect();
    let built = build((sorts, ratings), &quick()).unwrap();
    let said = built.findings.join("\n");
    assert!(said.contains("7 textures are too few for 2 dimensions"), "{said}");
    assert!(said.contains("group count: 3 more cases"), "{said}");
    assert!(said.contains("no participant both sorted and rated"), "{said}");
    assert!(validation_summary(&built).join("\n").contains("not meaningful with so few textures"));
}

#[test]
fn participants_who_only_sorted_or_only_rated_are_named() {
    let (mut sorts, mut ratings) = judgments(&["rough-smooth", "hard-soft"]);
    sorts.retain(|sort| sort.participant != "simulated-04");
    ratings.retain(|rating| rating.participant != "simulated-03");
    sorts[0].placements.truncate(10);
    let said = build((sorts, ratings), &quick()).unwrap().findings.join("\n");
    for words in [
        "sorted but did not rate: simulated-03",
        "rated but did not sort: simulated-04",
        "sorts that omit textures: 1 of 21; for example, the sort of simulated-01 (trial 3 groups) omits 4 textures",
    ] {
        assert!(said.contains(words), "\"{words}\" is missing in: {said}");
    }
}

#[test]
fn textures_that_nobody_separates_are_named() {
    let (mut sorts, ratings) = judgments(&["rough-smooth", "hard-soft"]);
    for sort in &mut sorts {
        let group = sort.placements[0].group.clone();
        sort.placements[1].group = group;
    }
    let transform = Some(Transform::SecondaryTies);
    let options = SpaceOptions { transform, placement: Some(PlacedBy::Felt), ..quick() };
    let built = build((sorts, ratings), &options).unwrap();
    let findings = built.findings.join("\n");
    assert!(findings.contains("t00 and t01 have nearly the same position"), "{findings}");
}

#[test]
fn more_participants_reduce_the_standard_deviation_of_positions() {
    let typical = |n_participants: usize| {
        let config = PanelConfig { n_participants, noise_points: 15.0, ..panel() };
        let names: Vec<String> = models().into_iter().map(|(name, _)| name).collect();
        let pairs = [pair("rough-smooth"), pair("hard-soft")];
        let sorts = simulated_sorts(&names, &labels(), &[3, 5, 7], &config).unwrap();
        let ratings = simulated_ratings(&names, &labels(), &pairs, &config).unwrap();
        let options = SpaceOptions { features: FeatureKind::Physical, n_permutations: 0, ..quick() };
        build((sorts, ratings), &options).unwrap().stability.unwrap()
    };
    let [few, many] = [4, 40].map(typical);
    assert_eq!((few.n_draws + few.n_failed, few.deviations.len()), (100, N));
    for axis in 0..2 {
        // For a mean, ten times the participants would give a third of the standard deviation.
        let ratio = few.typical[axis] / many.typical[axis];
        assert!((1.7..6.0).contains(&ratio), "{few:?} and {many:?}");
    }
    assert_eq!(typical(4), few, "the same seed gives the same bootstrap");
}

/// Sorts and ratings of a panel in which some participants only sorted and some only rated.
fn parted(n_sorters: usize, n_raters: usize) -> (Vec<Sort>, Vec<Rating>) {
    let (mut sorts, mut ratings) = judgments(&["rough-smooth", "hard-soft"]);
    let number = |name: &str| name.rsplit('-').next().unwrap().parse::<usize>().unwrap();
    sorts.retain(|sort| number(&sort.participant) <= n_sorters);
    ratings.retain(|rating| number(&rating.participant) > 8 - n_raters);
    (sorts, ratings)
}

#[test]
fn too_few_sorters_or_raters_give_no_stability() {
    let options = SpaceOptions { features: FeatureKind::Physical, n_permutations: 0, ..quick() };
    for (n_sorters, n_raters) in [(1, 8), (2, 8), (8, 2)] {
        let built = build(parted(n_sorters, n_raters), &options).unwrap();
        assert_eq!(built.stability, None);
        let said = format!("{n_sorters} participants sorted and {n_raters} rated, but at least 3 of each");
        assert!(built.findings.iter().any(|finding| finding.contains(&said)), "{:?}", built.findings);
        let summary = validation_summary(&built).join("\n");
        let few = if n_sorters < 3 { format!("({n_sorters} sorted)") } else { format!("({n_raters} rated)") };
        assert!(summary.contains(&format!("Few participants {few}")), "{summary}");
    }
    assert!(build(parted(4, 4), &options).unwrap().stability.is_some());
    assert_eq!(few_judges(&build(parted(8, 8), &options).unwrap()), None);
    let none = SpaceOptions { n_draws: 0, ..options };
    let built = build(parted(1, 8), &none).unwrap();
    assert!(built.stability.is_none() && !built.findings.join(" ").contains("of each are needed"));
}

#[test]
fn positions_vary_between_bootstrap_samples_only_if_participants_disagree() {
    let options = SpaceOptions { features: FeatureKind::Physical, n_permutations: 0, ..quick() };
    let (sorts, ratings) = judgments(&["rough-smooth", "hard-soft"]);
    // All participants sort and rate like the first one, so every bootstrap sample is the same.
    let same_sorts: Vec<Sort> = sorts
        .iter()
        .map(|sort| {
            let of_first =
                sorts.iter().find(|s| s.participant == sorts[0].participant && s.trial == sort.trial);
            Sort { participant: sort.participant.clone(), ..of_first.unwrap().clone() }
        })
        .collect();
    let same_ratings: Vec<Rating> = ratings
        .iter()
        .map(|rating| {
            let of_first = ratings.iter().find(|r| {
                r.participant == ratings[0].participant
                    && r.texture == rating.texture
                    && r.pair == rating.pair
            });
            Rating { participant: rating.participant.clone(), ..of_first.unwrap().clone() }
        })
        .collect();
    let secondary = SpaceOptions { transform: Some(Transform::SecondaryTies), ..options };
    let typical = |sorts: &[Sort], ratings: &[Rating]| {
        let stability = build((sorts.to_vec(), ratings.to_vec()), &secondary).unwrap().stability.unwrap();
        (stability.typical, stability.angle_deviation_degrees)
    };
    let (still, angle) = typical(&same_sorts, &same_ratings);
    assert!(still.iter().all(|d| *d < 1e-9) && angle < 1e-9, "{still:?} {angle}");
    let built = build((same_sorts.clone(), ratings.clone()), &secondary).unwrap();
    assert!(built.findings.join(" ").contains("made identical sorts"), "{:?}", built.findings);
    // Different ratings alone rotate the lines and so move the positions.
    let (by_ratings, angle) = typical(&same_sorts, &ratings);
    assert!(by_ratings.iter().all(|d| *d > 0.3) && angle > 0.05, "{by_ratings:?} {angle}");
    let (by_sorts, _) = typical(&sorts, &same_ratings);
    assert!(by_sorts.iter().all(|d| *d > 0.3), "{by_sorts:?}");
}

#[test]
fn a_pair_that_too_few_votes_find_relevant_is_no_axis() {
    let (sorts, ratings) = judgments(&["rough-smooth", "hard-soft"]);
    let vote = |participant: &str, adjective: &str, relevant: bool| RelevanceVote {
        participant: participant.to_owned(),
        texture: None,
        adjective: adjective.to_owned(),
        relevant,
    };
    let votes = vec![
        vote("a", "hard", true),
        vote("b", "hard", false),
        vote("c", "hard", false),
        vote("a", "rough", true),
    ];
    let error = build_with_votes(sorts, ratings, votes, &quick()).unwrap_err();
    let SpaceBuildError::TooFewPairs { n_pairs: 1, reasons } = error else { panic!("{error}") };
    assert_eq!(reasons, "; hard–soft: too few votes find it relevant");
}

type Change = dyn Fn(&mut Vec<Sort>, &mut Vec<Rating>, &mut SpaceOptions);

#[test]
fn invalid_judgments_and_options_are_refused_with_the_reason() {
    let good = || judgments(&["rough-smooth", "hard-soft"]);
    let check = |change: &Change, words: &str| {
        let ((mut sorts, mut ratings), mut options) = (good(), quick());
        change(&mut sorts, &mut ratings, &mut options);
        let message = build((sorts, ratings), &options).unwrap_err().to_string();
        assert!(message.contains(words), "{message}");
    };
    check(&|_, _, options| options.n_dims = 1, "2 to 10");
    check(&|sorts, _, _| sorts[0].placements[0].texture = "corkk".to_owned(), "\"corkk\" was sorted");
    check(&|_, ratings, _| ratings[0].texture = "corkk".to_owned(), "\"corkk\" was rated");
    let apart = |sorts: &mut Vec<Sort>, _: &mut Vec<Rating>, _: &mut SpaceOptions| {
        for (i, sort) in sorts.iter_mut().enumerate() {
            sort.placements.retain(|p| (p.texture.as_str() < "t07") == (i % 2 == 0));
        }
    };
    check(&apart, "one with \"t00\" and one with \"t07\"");
    check(&|sorts, _, _| sorts.push(sorts[0].clone()), "has trial \"3 groups\" twice");
    check(&|_, ratings, _| ratings.push(ratings[0].clone()), "twice on rough");
    check(&|_, ratings, _| ratings[4].value = Some(140.0), "140");
    check(&|_, ratings, _| ratings.retain(|r| r.pair.low == "rough"), "two are needed");
    check(&|_, _, options| options.axes = Some([pair("warm-cold"), pair("hard-soft")]), "it was not rated");
    check(
        &|_, _, options| options.axes = Some([pair("hard-soft"), pair("soft-hard")]),
        "already the other axis",
    );
    let keep = |n: usize| {
        move |sorts: &mut Vec<Sort>, _: &mut Vec<Rating>, _: &mut SpaceOptions| {
            for sort in sorts {
                sort.placements.truncate(n);
            }
        }
    };
    check(&keep(3), "only 3 textures were sorted; adjective directions in 2 dimensions need at least 4");
    let predicted_of_few = |sorts: &mut Vec<Sort>, _: &mut Vec<Rating>, options: &mut SpaceOptions| {
        for sort in sorts {
            sort.placements.truncate(6);
        }
        options.placement = Some(PlacedBy::Predicted);
    };
    check(&predicted_of_few, "too few to predict");
    let same = |_: &mut Vec<Sort>, ratings: &mut Vec<Rating>, _: &mut SpaceOptions| {
        for rating in ratings.iter_mut().filter(|r| r.pair.low == "rough") {
            rating.pair = pair("hard-Hard");
        }
    };
    check(&same, "not have two poles");
}

#[test]
fn steps_are_reported_in_order_and_can_be_stopped() {
    let (sorts, ratings) = judgments(&["rough-smooth", "hard-soft"]);
    let models = models();
    let textures = models.iter().map(|(name, model)| NamedTexture { name, model }).collect();
    let data =
        SpaceData { textures, sorts, ratings, votes: Vec::new(), source: LabelSource::SimulatedRaters };
    let options = SpaceOptions { features: FeatureKind::Physical, ..quick() };
    let told = Mutex::new(Vec::new());
    build_space(&data, &options, &|step| {
        told.lock().unwrap().push(step.index());
        true
    })
    .unwrap();
    let mut told = told.into_inner().unwrap();
    assert!(told.is_sorted());
    // Long steps call back often, so that they can be stopped midway.
    let n_times = |step: Step| told.iter().filter(|index| **index == step.index()).count();
    assert!(n_times(Step::Scaling) > 100 && n_times(Step::Axis(1)) > options.n_permutations);
    assert!(n_times(Step::Stability) > options.n_draws);
    told.dedup();
    assert_eq!(told, (0..Step::COUNT).collect::<Vec<_>>());
    for step in [Step::Sorting, Step::Scaling, Step::Features, Step::Axis(0), Step::Axis(1), Step::Stability]
    {
        let n_calls = AtomicUsize::new(0);
        let stopped =
            build_space(&data, &options, &|now| now != step || n_calls.fetch_add(1, Ordering::Relaxed) == 0);
        // The sorting calls back once. Physical features do too, but more dimensions may be scaled beside them.
        let n_calls = n_calls.into_inner();
        assert_eq!(stopped.is_ok(), n_calls == 1, "{step:?}: {n_calls} calls");
        assert!(stopped.is_ok() || stopped == Err(SpaceBuildError::Stopped), "{step:?}");
        assert!(n_calls > 1 || matches!(step, Step::Sorting | Step::Features), "{step:?}");
    }
}
