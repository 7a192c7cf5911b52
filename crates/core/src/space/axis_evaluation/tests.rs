use super::{AxisCandidate, AxisEvaluation, AxisEvaluationError, evaluate_axes};
use crate::maths::rng::Random;
use crate::space::leave_one_out::LeaveOneOutError;
use crate::texture::test_textures::two_resonances;
use crate::texture::{GrainNode, TextureModel};

/// Textures whose level, tilt and dependence on speed follow three hidden numbers, with candidates that show them.
fn world(n: usize) -> (Vec<TextureModel>, Vec<AxisCandidate>) {
    let mut random = Random::new(11);
    let hidden: Vec<[f64; 3]> =
        (0..n).map(|_| [random.uniform(), random.uniform(), random.uniform()]).collect();
    let model = |[level, tilt, power]: &[f64; 3]| {
        let base = two_resonances(&[0.03, 0.08, 0.16], &[0.2, 0.8, 1.5]);
        let nodes = base.nodes().iter().map(|node| GrainNode {
            lsf: node.lsf.iter().map(|w| w * (1.0 - 0.3 * tilt)).collect(),
            level_mps2: (3.0 * level).exp() * (node.speed.0 / 0.08).powf(2.0 * power),
            ..node.clone()
        });
        TextureModel::new(base.rate(), nodes.collect(), None).unwrap()
    };
    let models = hidden.iter().map(model).collect();
    let shown = |name: &str, of: &dyn Fn(&[f64; 3]) -> f64| AxisCandidate {
        name: name.to_owned(),
        values: hidden.iter().map(|hidden| Some(100.0 * of(hidden))).collect(),
    };
    let noise: Vec<Option<f64>> = (0..n).map(|_| Some(100.0 * random.uniform())).collect();
    let candidates = vec![
        AxisCandidate { name: "noise".to_owned(), values: noise },
        shown("level", &|hidden| hidden[0]),
        shown("tilt", &|hidden| hidden[1]),
        shown("power", &|hidden| hidden[2]),
    ];
    (models, candidates)
}

fn evaluated(
    models: &[TextureModel],
    candidates: &[AxisCandidate],
    first: &[usize],
) -> Result<AxisEvaluation, AxisEvaluationError> {
    evaluate_axes(&models.iter().collect::<Vec<_>>(), candidates, first, &mut |_, _| true)
}

#[test]
fn axes_that_say_something_come_first_and_noise_does_not_help() {
    let (models, candidates) = world(40);
    let found = evaluated(&models, &candidates, &[]).unwrap();
    let order: Vec<usize> = found.steps.iter().map(|step| step.added).collect();
    assert_eq!((order.len(), order[3]), (4, 0), "{order:?}");
    let [one, .., three, four] = &found.steps[..] else { unreachable!() };
    assert!(three.error_db_mean < 0.5 * one.error_db_mean, "{found:?}");
    assert!(three.error_db_mean < three.nearest_db_mean, "{found:?}");
    assert!(three.rank1 > 0.7 && three.rank1 > one.rank1, "{found:?}");
    assert_eq!((one.helps(), three.helps(), four.helps()), (None, Some(true), Some(false)));
    // The chosen axes stay first, even a useless one.
    let with_noise = evaluated(&models, &candidates, &[0, 1]).unwrap();
    assert_eq!((with_noise.steps[0].n_axes, with_noise.steps[0].added), (2, 1));
    assert!(with_noise.steps[2].error_db_mean < with_noise.steps[0].error_db_mean);
}

#[test]
fn missing_values_leave_out_a_candidate_or_a_texture() {
    let (models, mut candidates) = world(20);
    candidates[0].values[3] = None;
    candidates[2].values[..6].fill(None);
    let found = evaluated(&models, &candidates, &[]).unwrap();
    assert_eq!((found.textures.len(), found.left_out.as_slice()), (19, &[2][..]));
    assert!(found.steps.iter().all(|step| step.added != 2));
    // A chosen axis is not left out; then textures are.
    let found = evaluated(&models, &candidates, &[2]).unwrap();
    assert_eq!((found.textures.len(), found.left_out.len()), (14, 0));
}

#[test]
fn impossible_evaluations_say_why() {
    let (models, candidates) = world(12);
    for first in [vec![4], vec![1, 1], vec![0; 7]] {
        assert!(matches!(evaluated(&models, &candidates, &first), Err(AxisEvaluationError::First)));
    }
    let few = evaluated(&models[..9], &candidates, &[]).unwrap_err();
    assert!(few.to_string().contains("got 9"), "{few}");
    let lent: Vec<&TextureModel> = models.iter().collect();
    let stopped = evaluate_axes(&lent, &candidates, &[], &mut |done, _| done < 2).unwrap_err();
    assert!(matches!(stopped, AxisEvaluationError::Prediction(LeaveOneOutError::Stopped)));
}
