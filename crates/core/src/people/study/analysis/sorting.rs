//! Sorts, from which [`crate::people::sorting::similarity`] computes similarities.

use std::collections::BTreeMap;

use crate::people::sorting::{Grouped, Sort};
use crate::people::study::analysis::scored;
use crate::people::study::answer::{Record, Response};
use crate::people::study::plan::{Part, Plan};
use crate::people::study::trial::Task;

/// Sorts of a part. Textures have the names of [`Plan::texture_name`].
pub fn sorts(plan: &Plan, part: &Part, records: &[Record]) -> Vec<Sort> {
    let mut n_of: BTreeMap<(&str, usize), usize> = BTreeMap::new();
    let mut sorts = Vec::new();
    for (record, answer) in scored(records, part) {
        let (Task::Sort { stimuli, n_groups }, Response::Groups(groups)) =
            (&answer.trial.task, &answer.response)
        else {
            continue;
        };
        let n = n_of.entry((record.participant.as_str(), *n_groups)).or_default();
        *n += 1;
        let trial =
            if *n == 1 { format!("{n_groups} groups") } else { format!("{n_groups} groups, repeat {n}") };
        let place = |(id, group): (&String, &usize)| Grouped {
            texture: plan.texture_name(id).to_owned(),
            group: (group + 1).to_string(),
        };
        sorts.push(Sort {
            participant: record.participant.clone(),
            trial,
            n_groups: Some(*n_groups),
            placements: stimuli.iter().zip(groups).map(place).collect(),
        });
    }
    sorts
}
