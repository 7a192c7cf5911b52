use super::{N_GROUPS, PowerOptions, share, study_power};
use crate::study::plans::{StudyPlan, template, templates};

fn rating() -> StudyPlan {
    template("bipolar-rating").unwrap().study
}

fn options(effect_points: f64, numbers: &[usize], n_studies: usize) -> PowerOptions {
    PowerOptions { effect_points, numbers: numbers.to_vec(), n_studies, ..PowerOptions::usual(3) }
}

#[test]
fn groups_share_all_simulations() {
    for n in [0, 1, 19, 20, 21, 100, 133] {
        assert_eq!((0..N_GROUPS).map(|group| share(n, group)).sum::<usize>(), n);
    }
}

/// Without an effect, the decision holds in the share of studies that its level allows. The residuals of ratings that are cut
/// off at the ends of the scale are no worse.
#[test]
fn without_an_effect_the_decision_seldom_holds() {
    let report = study_power(&rating(), &options(0.0, &[6], 200), &|_, _| true).unwrap();
    let power = report.powers[0];
    assert_eq!((power.n_participants, power.n_studies), (6, 200));
    // 5 %, and four standard errors of 200 studies.
    assert!(power.share() < 0.05 + 4.0 * 0.0154, "{power:?}");
    assert_eq!(report.needed, None);
}

#[test]
fn power_grows_with_the_effect_and_the_number_of_participants() {
    let shares = |effect: f64| {
        let report = study_power(&rating(), &options(effect, &[8, 20], 40), &|_, _| true).unwrap();
        report.powers.iter().map(|power| power.share()).collect::<Vec<_>>()
    };
    let (weak, strong) = (shares(8.0), shares(40.0));
    assert!(strong.iter().all(|share| *share > 0.9), "{strong:?}");
    assert!(weak[0] < strong[0] && weak[0] < weak[1], "{weak:?} {strong:?}");
}

#[test]
fn the_same_seed_gives_the_same_power() {
    let once = || study_power(&rating(), &options(8.0, &[4, 6], 30), &|_, _| true).unwrap();
    assert_eq!(once(), once());
}

#[test]
fn every_built_in_plan_has_a_decision() {
    for template in templates().unwrap() {
        let report = study_power(&template.study, &options(30.0, &[3], 2), &|_, _| true).unwrap();
        assert_eq!(report.design, template.study.plan.parts[0].design.id());
        assert!(report.decision.ends_with('.') && report.powers.len() == 1, "{}", template.id);
    }
}

#[test]
fn wrong_options_and_an_end_are_explained() {
    let error = |options: &PowerOptions, goes_on: bool| {
        study_power(&rating(), options, &|_, _| goes_on).unwrap_err().to_string()
    };
    let usual = options(20.0, &[3], 2);
    assert!(error(&options(20.0, &[0], 2), true).contains("1 or more"));
    assert!(error(&options(20.0, &[], 2), true).contains("1 or more"));
    let other = PowerOptions { part: Some("none".to_owned()), ..usual.clone() };
    assert!(error(&other, true).contains("choose one of rating"));
    assert!(error(&usual, false).contains("ended"));
}
