use std::sync::Arc;

use crate::maths::rng::Random;
use crate::maths::shard::Shard;
use crate::maths::statistics::mean;
use crate::space::SpacePoint;
use crate::space::authoring::{Authoring, Blending, BlendingError, Layers, Models, Weights};
use crate::space::fidelity::{Channels, Profile, error_db, shape_error_db};
use crate::space::leave_one_out::rest::{Made, Placed, Rests, is_inside};
use crate::space::leave_one_out::{
    LeaveOneOut, LeaveOneOutError, LeaveOneOutPart, Method, PartsError, Plan, SignalPlan, join_parts,
    leave_one_out, leave_one_out_part, measure, rest_of,
};
use crate::texture::blend::Mode;
use crate::texture::plane::Plane;
use crate::texture::test_textures::{arma, two_resonances};
use crate::texture::{GrainNode, TextureModel};
use crate::units::Hertz;

fn point(rs: f64, hs: f64) -> SpacePoint {
    SpacePoint::new(rs, hs).unwrap()
}

/// A texture whose level falls along the first axis and whose resonances fall along the second.
fn truth(at: SpacePoint, noise_db: f64) -> TextureModel {
    let base = two_resonances(&[0.03, 0.08, 0.16], &[0.2, 0.8, 1.5]);
    let nodes = base.nodes().iter().map(|n| GrainNode {
        lsf: n.lsf.iter().map(|w| w * (1.0 - 0.004 * at.y())).collect(),
        level_mps2: n.level_mps2 * (noise_db / 8.686 - 0.03 * at.x()).exp(),
        ..n.clone()
    });
    TextureModel::new(base.rate(), nodes.collect(), Some(0.4)).unwrap()
}

/// Four corner textures and `n` textures between them.
fn world(n: usize, noise_db: f64) -> Vec<(TextureModel, Option<SpacePoint>)> {
    let mut random = Random::new(7);
    let corners = [[0.0, 0.0], [100.0, 0.0], [0.0, 100.0], [100.0, 100.0]];
    let mut places = corners.map(|[rs, hs]| point(rs, hs)).to_vec();
    places.extend((0..n).map(|_| point(5.0 + 90.0 * random.uniform(), 5.0 + 90.0 * random.uniform())));
    places.into_iter().map(|at| (truth(at, noise_db * random.normal()), Some(at))).collect()
}

fn lent(world: &[(TextureModel, Option<SpacePoint>)]) -> Vec<(&TextureModel, Option<SpacePoint>)> {
    world.iter().map(|(model, at)| (model, *at)).collect()
}

fn all_modes() -> Plan {
    Plan { blendings: Mode::ALL.map(Blending::from).to_vec(), signals: None }
}

fn run(world: &[(TextureModel, Option<SpacePoint>)], plan: &Plan) -> Result<LeaveOneOut, LeaveOneOutError> {
    leave_one_out(&lent(world), plan, &mut |_, _| true)
}

/// A method that copies the original gets perfect figures; one that copies the most distant texture gets none right.
#[test]
fn an_oracle_is_right_and_its_opposite_wrong() {
    let world = world(8, 3.0);
    let textures = lent(&world);
    let placed = Placed::all(&textures).unwrap();
    let profile = |placed: &Placed| placed.original().profile(&Channels::of_models());
    let mut author = |left_out: &Placed, _: &Placed| {
        let own = profile(left_out);
        let distance = |other: &&Placed| error_db(&profile(other), &own);
        let farthest = placed.iter().max_by(|a, b| distance(a).total_cmp(&distance(b))).unwrap();
        Ok(vec![left_out.original(), farthest.original()])
    };
    // Only the number of methods matters here, not which they are.
    let methods = vec![Method::Nearest, Method::Nearest];
    let part = measure(&textures, (None, Shard::WHOLE), &mut author, &mut |_, _| true).unwrap();
    let measured = part.alone(methods, None);
    assert_eq!((measured.textures.len(), measured.on_hull.as_slice()), (8, &[0, 1, 2, 3][..]));
    let [right, wrong] = measured.methods.as_slice() else { unreachable!() };
    assert_eq!((right.error_db_mean, right.level_error_db_mean, right.shape_error_db_mean), (0.0, 0.0, 0.0));
    assert_eq!((right.rank1, right.top5, right.nrs_mean), (1.0, 1.0, Some(1.0)));
    assert_eq!((wrong.rank1, wrong.top5), (0.0, 0.0));
}

/// Textures that differ only by their level: the copy of the nearest texture has a level error and no shape error.
#[test]
fn a_pure_level_difference_has_no_shape_error() {
    let at = [[0.0, 0.0], [100.0, 0.0], [0.0, 100.0], [100.0, 100.0], [30.0, 50.0]].map(|[r, h]| point(r, h));
    // One hardness for all spectra; the level follows from the roughness alone.
    let world: Vec<_> = at.into_iter().map(|at| (truth(point(at.x(), 50.0), 0.0), Some(at))).collect();
    let measured = run(&world, &Plan { blendings: Vec::new(), signals: None }).unwrap();
    let nearest = measured.methods[0].clone();
    assert!(nearest.error_db_mean > 1.0 && nearest.level_error_db_mean > 1.0, "{nearest:?}");
    assert!(nearest.shape_error_db_mean < 1e-9, "{nearest:?}");
    let profile = |index: usize| {
        let plane = Plane::new(&world[index].0);
        Channels::of_models().profile(&[(&plane, 1.0)], Mode::Shared)
    };
    let of = &measured.textures[0];
    let want = shape_error_db(&profile(of.nearest), &profile(of.texture));
    assert!((of.outcomes[0].shape_error_db - want).abs() < 1e-12);
}

/// The predictions do not depend on the removed texture, however much it changes.
#[test]
fn nothing_leaks_from_what_is_left_out() {
    let mut world = world(8, 2.0);
    let left_out = 6;
    let at = world[left_out].1.unwrap();
    let channels = Channels::of_models();
    let profiles = |world: &[(TextureModel, Option<SpacePoint>)]| -> Vec<Profile> {
        let textures = lent(world);
        let placed = Placed::all(&textures).unwrap();
        let left_out = placed.iter().find(|placed| placed.texture == left_out).unwrap();
        let made = Rests::new(&textures).made_without(left_out, &all_modes().blendings).unwrap();
        made.iter().map(|made| made.profile(&channels)).collect()
    };
    let leaking = |world: &[(TextureModel, Option<SpacePoint>)]| {
        let planes: Vec<Plane> = world.iter().map(|(model, _)| Plane::new(model)).collect();
        let layers: Vec<_> =
            world.iter().zip(&planes).map(|((model, _), plane)| Some(Layers::of(model, plane))).collect();
        // Models of the whole space, including the texture: the leaking control.
        let space = rest_of(&lent(world), usize::MAX).unwrap();
        let models = Arc::new(Models::new(&space, &layers).unwrap());
        let authored = Authoring::new(space).with_models(models).author(at, &Mode::Field.into()).unwrap();
        let plane = Plane::new(&authored.model.unwrap());
        channels.profile(&[(&plane, 1.0)], Mode::Shared)
    };
    let (before, leaked_before) = (profiles(&world), leaking(&world));
    // Another order, a hundredfold level, other speeds and forces.
    let wild = two_resonances(&[0.01, 0.9], &[0.05, 9.0]);
    let nodes = wild.nodes().iter().map(|n| GrainNode { level_mps2: 100.0 * n.level_mps2, ..n.clone() });
    world[left_out].0 = TextureModel::new(wild.rate(), nodes.collect(), Some(1.4)).unwrap();
    let leaked = error_db(&leaked_before, &leaking(&world));
    assert!(leaked > 1.0, "the leaking control changes by only {leaked} dB");
    assert_eq!(profiles(&world), before);
    // The sample rate of the removed texture has no effect either, although the others would be converted to it.
    let converted = crate::texture::rate::at_rate(&world[left_out].0, Hertz(2000.0)).unwrap();
    world[left_out].0 = converted.model;
    assert_eq!(profiles(&world), before);
    world[left_out].0 = arma(14, 4);
    assert_eq!(profiles(&world), before);
}

/// If textures depend on their positions, interpolation beats a copy; summaries agree with the single outcomes.
#[test]
fn figures_sum_up_the_textures() {
    let measured = run(&world(20, 1.0), &all_modes()).unwrap();
    let of = |method: &Method| measured.methods.iter().find(|s| s.method == *method).unwrap();
    let nearest = of(&Method::Nearest);
    let field = of(&Method::Blended(Mode::Field.into()));
    let paper = of(&Method::Blended(Mode::Paper.into()));
    assert!(field.error_db_mean < 0.7 * nearest.error_db_mean, "{field:?} and {nearest:?}");
    assert!(field.error_db_mean < 0.6 * paper.error_db_mean && field.rank1 > paper.rank1, "{paper:?}");
    assert_eq!(nearest.rank1, 0.0, "the copy of the nearest texture is closest to that texture itself");
    for (index, summary) in measured.methods.iter().enumerate() {
        let outcomes: Vec<_> = measured.textures.iter().map(|left| left.outcomes[index]).collect();
        let n = outcomes.len();
        assert_eq!(summary.n, n);
        let mut errors: Vec<f64> = outcomes.iter().map(|o| o.error_db).collect();
        assert!((errors.iter().sum::<f64>() / n as f64 - summary.error_db_mean).abs() < 1e-12);
        errors.sort_by(f64::total_cmp);
        assert_eq!(summary.error_db_median, 0.5 * (errors[(n - 1) / 2] + errors[n / 2]));
        let share = |rank: usize| outcomes.iter().filter(|o| o.rank <= rank).count() as f64 / n as f64;
        assert_eq!((summary.rank1, summary.top5), (share(1), share(5)));
        let nrs = outcomes.iter().map(|o| 1.0 - o.error_db / measured.reach_db).sum::<f64>() / n as f64;
        assert!((summary.nrs_mean.unwrap() - nrs).abs() < 1e-12 && summary.signals.is_none());
    }
    let world = world(20, 1.0);
    for left in &measured.textures {
        let distance = |texture: &usize| world[*texture].1.unwrap().distance(left.at);
        let others = (0..world.len()).filter(|texture| *texture != left.texture);
        assert_eq!(others.min_by(|a, b| distance(a).total_cmp(&distance(b))), Some(left.nearest));
        assert_eq!(left.outcomes[0].signal_error_db, None);
    }
}

/// The reach is the distance between the roughest and the smoothest texture.
#[test]
fn the_reach_is_along_the_first_axis() {
    let at = [[10.0, 50.0], [90.0, 40.0], [40.0, 0.0], [45.0, 100.0], [50.0, 50.0]].map(|[r, h]| point(r, h));
    let world: Vec<_> = at.into_iter().map(|at| (truth(at, 0.0), Some(at))).collect();
    let measured = run(&world, &Plan { blendings: Vec::new(), signals: None }).unwrap();
    let profile = |model: &TextureModel| {
        let plane = Plane::new(model);
        Channels::of_models().profile(&[(&plane, 1.0)], Mode::Shared)
    };
    assert!((measured.reach_db - error_db(&profile(&world[0].0), &profile(&world[1].0))).abs() < 1e-12);
    assert_eq!((measured.methods.len(), measured.textures.len()), (1, 1));
}

/// Distances of signals agree with those of models in every mixing mode, and a wrong mixing mode is detected.
#[test]
fn signals_agree_with_models() {
    let signals = Some(SignalPlan { n_textures: 2, seconds: 8.0, seed: 3 });
    let measured = run(&world(6, 2.0), &Plan { signals, ..all_modes() }).unwrap();
    for summary in &measured.methods {
        let check = summary.signals.unwrap();
        assert!(check.n == 2 && check.mean_difference_db < 0.3, "{summary:?}");
        let between = (check.error_db_mean - check.model_error_db_mean).abs();
        assert!(between <= check.mean_difference_db + 1e-12, "{summary:?}");
        // Twice the random error, because spectra are not constant within a channel.
        assert!(check.from_model_db < 2.0 * check.chance_db, "{summary:?}");
    }
    for (index, summary) in measured.methods.iter().enumerate() {
        let errors: Vec<f64> =
            measured.textures.iter().filter_map(|left| left.outcomes[index].signal_error_db).collect();
        let check = summary.signals.unwrap();
        assert!(errors.len() == check.n && (mean(&errors) - check.error_db_mean).abs() < 1e-12);
    }
    let world = world(6, 2.0);
    let textures = lent(&world);
    let placed = Placed::all(&textures).unwrap();
    let parts = vec![(placed[0].plane.clone(), 0.5); 2];
    let made = vec![Made { parts, mixing: Mode::Paper }];
    let plan = SignalPlan { n_textures: 1, seconds: 2.0, seed: 3 };
    let shared = Made { mixing: Mode::Shared, ..made[0].clone() }.profile(&Channels::of_models());
    let original = placed[4].original().profile(&Channels::of_models());
    let rendered = super::signals::compare(&plan, &placed[4], &original, &made, &[shared]).unwrap();
    assert!(super::signals::check(&plan, &rendered).unwrap().from_model_db > 2.0, "{rendered:?}");
}

#[test]
fn only_what_lies_strictly_between_is_left_out() {
    let square = [[0.0, 0.0], [100.0, 0.0], [0.0, 100.0], [100.0, 100.0], [50.0, 0.0]];
    let world: Vec<_> = square.map(|[rs, hs]| point(rs, hs)).map(|at| (truth(at, 0.0), Some(at))).to_vec();
    let textures = lent(&world);
    let space = rest_of(&textures, 4).unwrap();
    assert!(!is_inside(&space, point(50.0, 0.0)) && !is_inside(&space, point(50.0, 1e-9)));
    // On a diagonal, which is an edge of triangles but not of the hull.
    assert!(is_inside(&space, point(50.0, 50.0)) && is_inside(&space, point(50.0, 1.0)));
    let error = run(&world, &all_modes()).unwrap_err();
    assert_eq!(error, LeaveOneOutError::NoneInside { n: 5 });
    assert_eq!(run(&world[..3], &all_modes()).unwrap_err(), LeaveOneOutError::TooFew { n: 3 });
    let line: Vec<_> = (0..5).map(|i| point(20.0 * f64::from(i), 30.0)).collect();
    let line: Vec<_> = line.into_iter().map(|at| (truth(at, 0.0), Some(at))).collect();
    assert_eq!(run(&line, &all_modes()).unwrap_err(), LeaveOneOutError::NoneInside { n: 5 });
}

/// On one axis, the hull of the others is a part of the axis, and the textures at its ends are not left out.
#[test]
fn on_one_axis_all_but_the_ends_are_left_out() {
    let on_line = |coordinates: &[f64]| -> Vec<(TextureModel, Option<SpacePoint>)> {
        let places = coordinates.iter().map(|x| SpacePoint::of(&[*x]).unwrap());
        places.map(|at| (truth(at, 0.0), Some(at))).collect()
    };
    let measured = run(&on_line(&[60.0, 0.0, 100.0, 20.0, 40.0, 80.0]), &all_modes()).unwrap();
    let inside: Vec<usize> = measured.textures.iter().map(|left| left.texture).collect();
    assert_eq!((inside.as_slice(), measured.on_hull.as_slice()), (&[0, 3, 4, 5][..], &[1, 2][..]));
    let error_db = |method: &Method| {
        measured.methods.iter().find(|summary| summary.method == *method).unwrap().error_db_mean
    };
    // The level is linear in the coordinate, so that only a copy of the nearest texture has a large error.
    let (field, nearest) = (error_db(&Method::Blended(Mode::Field.into())), error_db(&Method::Nearest));
    assert!(field < 0.3 * nearest, "{field} and {nearest} dB");
    // Equal positions: neither lies between others.
    let error = run(&on_line(&[0.0, 100.0, 0.0, 100.0]), &all_modes()).unwrap_err();
    assert_eq!(error, LeaveOneOutError::NoneBetween { n: 4 });
}

#[test]
fn nonsense_is_refused_and_a_caller_can_stop() {
    let world = world(3, 0.0);
    let natural = Blending { weights: Weights::Natural, ..Mode::Paper.into() };
    let plan = Plan { blendings: vec![natural], signals: None };
    assert_eq!(run(&world, &plan).unwrap_err(), LeaveOneOutError::Blending(BlendingError::Natural));
    let mut seen = Vec::new();
    let stopped = leave_one_out(&lent(&world), &all_modes(), &mut |done, of| {
        seen.push((done, of));
        done < 1
    });
    assert_eq!((stopped.unwrap_err(), seen), (LeaveOneOutError::Stopped, vec![(0, 3), (1, 3)]));
    // A texture without a position is ignored and keeps its index.
    let mut more = world;
    more.insert(0, (two_resonances(&[0.1], &[1.0]), None));
    let measured = run(&more, &all_modes()).unwrap();
    assert_eq!(measured.textures.iter().map(|left| left.texture).collect::<Vec<_>>(), [5, 6, 7]);
}

/// To the bit, with rendered signals, and in any order of the parts.
#[test]
fn the_parts_of_an_evaluation_are_the_whole() {
    let world = world(7, 3.0);
    let signals = Some(SignalPlan { n_textures: 2, seconds: 4.0, seed: 3 });
    let plan = Plan { blendings: vec![Mode::Field.into(), Mode::Power.into()], signals };
    let part = |number: usize, of: usize| {
        let shard = Shard::new(number, of).unwrap();
        leave_one_out_part(&lent(&world), &plan, shard, &mut |_, _| true).unwrap()
    };
    let whole = run(&world, &plan).unwrap();
    assert!(whole.methods.iter().all(|summary| summary.signals.is_some()));
    let parts: Vec<LeaveOneOutPart> = [3, 1, 2].into_iter().map(|number| part(number, 3)).collect();
    assert_eq!(join_parts(&plan, parts.clone()), Ok(whole.clone()));
    assert_eq!(join_parts(&plan, vec![part(1, 1)]), Ok(whole));
    let shard = |number| Shard::new(number, 3).unwrap();
    let without = parts[..2].to_vec();
    assert_eq!(join_parts(&plan, without), Err(PartsError::Missing { shard: shard(2) }));
    let twice = [&parts[..], &parts[..1]].concat();
    assert_eq!(join_parts(&plan, twice), Err(PartsError::Twice { shard: shard(3) }));
    let mut other = parts.clone();
    other[1].reach_db += 1.0;
    let error = PartsError::Other { shard: shard(1), first: shard(3) };
    assert_eq!(join_parts(&plan, other), Err(error));
    // A plan with another number of methods.
    let fewer = Plan { blendings: vec![Mode::Field.into()], ..plan.clone() };
    assert!(matches!(join_parts(&fewer, parts), Err(PartsError::Other { .. })));
    assert_eq!(join_parts(&plan, Vec::new()), Err(PartsError::Empty));
}
