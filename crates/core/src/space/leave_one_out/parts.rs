//! Parts of an evaluation, which several computers can make, and their sum.

use crate::maths::shard::Shard;
use crate::space::leave_one_out::signals::{Rendered, check};
use crate::space::leave_one_out::{
    LeaveOneOut, LeftOut, Method, Outcome, Plan, SignalPlan, methods_of, summary,
};

/// Results of a part of the evaluated textures.
#[derive(Clone, Debug, PartialEq)]
pub struct LeaveOneOutPart {
    /// The part.
    pub shard: Shard,
    /// Number of textures of the whole evaluation.
    pub n_evaluated: usize,
    /// Results per texture of the part, in library order.
    pub textures: Vec<LeftOut>,
    /// As in [`LeaveOneOut`].
    pub on_hull: Vec<usize>,
    /// As in [`LeaveOneOut`], in dB.
    pub reach_db: f64,
}

/// Why parts are not the whole evaluation.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum PartsError {
    /// There are no parts.
    #[error("there are no parts; give at least one")]
    Empty,
    /// A part is of another evaluation.
    #[error(
        "part {shard} is of another evaluation than part {first}; make all parts with the same library and options"
    )]
    Other {
        /// The part that differs.
        shard: Shard,
        /// The first part.
        first: Shard,
    },
    /// A part is given twice.
    #[error("part {shard} is given twice; give each part once")]
    Twice {
        /// The part.
        shard: Shard,
    },
    /// A part is missing.
    #[error("part {shard} is missing; make it, and give it too")]
    Missing {
        /// The first part that is missing.
        shard: Shard,
    },
}

impl LeaveOneOutPart {
    /// The evaluation whose only part this is.
    pub(super) fn alone(self, methods: Vec<Method>, signals: Option<SignalPlan>) -> LeaveOneOut {
        let Self { textures, on_hull, reach_db, .. } = self;
        whole(textures, methods, signals, (on_hull, reach_db))
    }
}

/// Joins all parts of an evaluation with this plan, in any order.
///
/// # Errors
/// See [`PartsError`].
pub fn join_parts(plan: &Plan, parts: Vec<LeaveOneOutPart>) -> Result<LeaveOneOut, PartsError> {
    let Some(first) = parts.first() else { return Err(PartsError::Empty) };
    let of = first.shard.of();
    let n_methods = methods_of(plan).len();
    for (index, part) in parts.iter().enumerate() {
        let is_same = (part.shard.of(), part.n_evaluated, &part.on_hull, part.reach_db.to_bits())
            == (of, first.n_evaluated, &first.on_hull, first.reach_db.to_bits());
        let is_whole = part.textures.len() == part.shard.indices(part.n_evaluated).count()
            && part.textures.iter().all(|left| left.outcomes.len() == n_methods);
        if !is_same || !is_whole {
            return Err(PartsError::Other { shard: part.shard, first: first.shard });
        }
        if parts[..index].iter().any(|earlier| earlier.shard == part.shard) {
            return Err(PartsError::Twice { shard: part.shard });
        }
    }
    let has = |shard: &Shard| parts.iter().any(|part| part.shard == *shard);
    let mut all = (1..=of).filter_map(|number| Shard::new(number, of).ok()); // The numbers are valid.
    if let Some(shard) = all.find(|shard| !has(shard)) {
        return Err(PartsError::Missing { shard });
    }
    let (on_hull, reach_db) = (first.on_hull.clone(), first.reach_db);
    let mut textures: Vec<LeftOut> = parts.into_iter().flat_map(|part| part.textures).collect();
    textures.sort_by_key(|left| left.texture);
    Ok(whole(textures, methods_of(plan), plan.signals, (on_hull, reach_db)))
}

/// The evaluation with these results of all its textures.
fn whole(
    textures: Vec<LeftOut>,
    methods: Vec<Method>,
    signals: Option<SignalPlan>,
    (on_hull, reach_db): (Vec<usize>, f64),
) -> LeaveOneOut {
    let summaries = methods.into_iter().enumerate().map(|(index, method)| {
        let outcomes: Vec<&Outcome> = textures.iter().map(|left| &left.outcomes[index]).collect();
        let rendered: Vec<Rendered> = outcomes.iter().filter_map(|outcome| rendered(outcome)).collect();
        summary(method, &outcomes, signals.and_then(|plan| check(&plan, &rendered)))
    });
    let methods = summaries.collect();
    LeaveOneOut { methods, textures, on_hull, reach_db }
}

/// The spectral distances of a rendered texture; `None` if it was not rendered.
fn rendered(outcome: &Outcome) -> Option<Rendered> {
    Some(Rendered {
        error_db: outcome.signal_error_db?,
        model_error_db: outcome.error_db,
        from_model_db: outcome.signal_from_model_db?,
    })
}
