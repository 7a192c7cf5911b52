use super::{cases, check, number, numbers, vectors};
use crate::maths::hypothesis_tests::intervals::{Confidence, clopper_pearson_interval, wilson_interval};
use crate::maths::hypothesis_tests::studentized_range::{
    studentized_range_quantile_above, studentized_range_upper_tail,
};

#[test]
fn intervals_of_proportions_are_those_of_statsmodels() {
    let vectors = vectors();
    for case in cases(&vectors, "proportions") {
        let [n_right, n] = [0, 1].map(|i| case[i].as_u64().unwrap());
        let confidence = Confidence::new(number(&case[2])).unwrap();
        let wilson = wilson_interval(n_right, n, confidence).unwrap();
        let exact = clopper_pearson_interval(n_right, n, confidence).unwrap();
        for (got, i) in [wilson.low, wilson.high, exact.low, exact.high].into_iter().zip(3_usize..) {
            check(got, &case[i], &format!("{n_right} of {n}"));
        }
    }
}

#[test]
fn tails_of_the_studentized_range_are_those_of_scipy() {
    let vectors = vectors();
    for case in cases(&vectors, "studentized_range") {
        let (q, n_means) = (number(&case[0]), case[1].as_u64().unwrap() as usize);
        // null stands for an infinite number.
        let dof = case[2].as_f64().unwrap_or(f64::INFINITY);
        let (got, expected) = (studentized_range_upper_tail(q, n_means, dof), number(&case[3]));
        // The target of the quadrature, a hundred times stricter than the tolerance of other numbers.
        assert!((got - expected).abs() < 1e-8, "{q} {n_means} {dof}: got {got}, expected {expected}");
    }
}

#[test]
fn critical_values_of_the_studentized_range_are_those_of_scipy() {
    let vectors = vectors();
    for case in cases(&vectors, "critical").iter().map(numbers) {
        let &[probability, n_means, dof, expected] = case.as_slice() else {
            panic!("a case has four numbers, not {case:?}");
        };
        let got = studentized_range_quantile_above(probability, n_means as usize, dof);
        assert!((got / expected - 1.0).abs() < 1e-7, "{n_means} {dof}: got {got}, expected {expected}");
    }
}
