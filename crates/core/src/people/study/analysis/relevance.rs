//! Votes on the relevance of adjectives, which [`crate::people::ratings::relevances`] counts.

use crate::people::ratings::RelevanceVote;
use crate::people::study::analysis::scored;
use crate::people::study::answer::{Record, Response};
use crate::people::study::plan::{Design, Part, Plan};
use crate::people::study::trial::Task;

/// Votes of a part; none if it has another design. Textures have the names of [`Plan::texture_name`].
pub fn votes(plan: &Plan, part: &Part, records: &[Record]) -> Vec<RelevanceVote> {
    let Design::Relevance { adjectives, .. } = &part.design else { return Vec::new() };
    let mut votes = Vec::new();
    for (record, answer) in scored(records, part) {
        let (Task::Vote { stimulus }, Response::Votes(relevant)) = (&answer.trial.task, &answer.response)
        else {
            continue;
        };
        votes.extend(adjectives.iter().zip(relevant).map(|(adjective, relevant)| RelevanceVote {
            participant: record.participant.clone(),
            texture: Some(plan.texture_name(stimulus).to_owned()),
            adjective: adjective.clone(),
            relevant: *relevant,
        }));
    }
    votes
}
