//! Trials of a participant that do not depend on answers: all but those of staircases.
//!
//! They follow from the plan, its seed and the number of the participant alone. Over participants, a Latin square is
//! balanced for each repeat by itself. The two stimuli of a pair change their order from repeat to repeat, and a coin for each
//! pair decides which order comes first.

use crate::maths::rng::{Random, derive_seed};
use crate::people::study::order::{Order, in_order, latin_row};
use crate::people::study::plan::{Comparison, Condition, Design, MushraPage, Part, Plan};
use crate::people::study::trial::{Side, Task, Trial};

/// Order of the parts for a participant, as indices into [`Plan::parts`]. Participants are numbered from 1.
pub fn part_order(plan: &Plan, participant: usize) -> Vec<usize> {
    let n_parts = plan.parts.len();
    match plan.part_order {
        Order::Listed => (0..n_parts).collect(),
        Order::LatinSquare => latin_row(n_parts, participant.saturating_sub(1)),
        Order::Shuffled | Order::ShuffledBlocks => {
            Random::new(derive_seed(plan.seed, &format!("participant {participant}, parts")))
                .shuffled(n_parts)
        }
    }
}

/// All trials of a participant in a part, practice first; none for a staircase.
pub fn trials(plan: &Plan, part: &Part, participant: usize) -> Vec<Trial> {
    let what = format!("participant {participant}, part {}", part.id);
    let mut random = Random::new(derive_seed(plan.seed, &what));
    let tasks = arranged(blocks(part, &mut random), part, participant, &mut random);
    let practice = practice(&tasks, part.n_practice, &mut random);
    let all =
        practice.into_iter().map(|task| (true, task)).chain(tasks.into_iter().map(|task| (false, task)));
    let trial = |(index, (is_practice, task)): (usize, (bool, Task))| {
        let number = index + 1;
        Trial {
            part: part.id.clone(),
            number,
            is_practice,
            seed: trial_seed(plan, part, participant, number),
            task,
        }
    };
    all.enumerate().map(trial).collect()
}

/// Seed of the noise in the stimuli of a trial; files store it as a signed number.
pub(crate) fn trial_seed(plan: &Plan, part: &Part, participant: usize, number: usize) -> u64 {
    derive_seed(plan.seed, &format!("participant {participant}, part {}, trial {number}", part.id)) >> 1
}

/// Whether a trial has the seed that the plan gives this participant. Another one is damaged, or of another participant.
pub fn is_trial_of(plan: &Plan, participant: usize, trial: &Trial) -> bool {
    let part = plan.part(&trial.part);
    part.is_some_and(|part| trial_seed(plan, part, participant, trial.number) == trial.seed)
}

/// Largest number of a participant that [`participant_of`] finds.
const MOST_PARTICIPANTS: usize = 10_000;
/// Number of trials whose participant is looked for, because one of them may be damaged.
const MOST_TRIED: usize = 5;

/// Number of the participant, from 1, to whom the plan gives most of these trials; `None` if there is none. For logs that do not
/// state the number any more.
pub fn participant_of(plan: &Plan, trials: &[&Trial]) -> Option<usize> {
    let of_trial = |trial: &&Trial| (1..=MOST_PARTICIPANTS).find(|number| is_trial_of(plan, *number, trial));
    let has_most = |number: &usize| {
        2 * trials.iter().filter(|trial| is_trial_of(plan, *number, trial)).count() > trials.len()
    };
    trials.iter().take(MOST_TRIED).filter_map(of_trial).find(has_most)
}

/// Tasks of a part in blocks that stay together unless all is shuffled: one for each repeat, or for each prompt of each repeat.
fn blocks(part: &Part, random: &mut Random) -> Vec<Vec<Task>> {
    let coins: Vec<[usize; 2]> =
        part.design.comparisons().iter().map(|_| [random.below(2), random.below(2)]).collect();
    let of_repeat = |repeat: usize| -> Vec<Vec<Task>> {
        match &part.design {
            Design::Likert { conditions, prompts, .. } => {
                (0..prompts.n_texts()).map(|prompt| questions(prompt, conditions)).collect()
            }
            design => vec![tasks(design, repeat, &coins, random)],
        }
    };
    (0..part.n_repeats).flat_map(of_repeat).collect()
}

fn questions(prompt: usize, conditions: &[Condition]) -> Vec<Task> {
    conditions.iter().map(|condition| Task::Question { prompt, condition: condition.id.clone() }).collect()
}

/// Tasks of one repeat.
fn tasks(design: &Design, repeat: usize, coins: &[[usize; 2]], random: &mut Random) -> Vec<Task> {
    let pairs = || design.comparisons().into_iter().zip(coins);
    let is_swapped = |coin: usize| (repeat + coin) % 2 == 1;
    match design {
        Design::Sorting { stimuli, groups } => {
            let sort =
                |n_groups: &usize| Task::Sort { stimuli: shuffled(stimuli, random), n_groups: *n_groups };
            groups.iter().map(sort).collect()
        }
        Design::Relevance { stimuli, .. } => {
            stimuli.iter().map(|stimulus| Task::Vote { stimulus: stimulus.clone() }).collect()
        }
        Design::Rating { stimuli, .. } => {
            stimuli.iter().map(|stimulus| Task::Rate { stimulus: stimulus.clone() }).collect()
        }
        Design::Dissimilarity { .. } => {
            pairs().map(|(pair, coin)| Task::Compare { pair, is_swapped: is_swapped(coin[0]) }).collect()
        }
        Design::SameDifferent { pairs, n_segments } => {
            let both = |pair: &Comparison, segment: usize| {
                [true, false].map(|is_different| Task::Discriminate {
                    pair: pair.clone(),
                    is_different,
                    segment,
                })
            };
            pairs
                .iter()
                .flat_map(|pair| (0..*n_segments).flat_map(move |segment| both(pair, segment)))
                .collect()
        }
        Design::Similarity { .. } => {
            pairs().map(|(pair, coin)| Task::Grade { pair, is_swapped: is_swapped(coin[0]) }).collect()
        }
        Design::Abx { .. } => {
            // Four repeats have each order with each answer.
            let x = |coin: usize| Side::second_if((repeat / 2 + coin) % 2 == 1);
            pairs()
                .map(|(pair, coin)| Task::Match { pair, is_swapped: is_swapped(coin[0]), x: x(coin[1]) })
                .collect()
        }
        Design::Mushra { pages } => pages.iter().map(|page| page_of(page, random)).collect(),
        Design::Anchors { stimuli, low, high } => {
            let place = |stimulus: &String| Task::Place {
                stimulus: stimulus.clone(),
                low: low.clone(),
                high: high.clone(),
            };
            stimuli.iter().map(place).collect()
        }
        // Staircases have no fixed trials; questions are arranged by prompt.
        Design::Staircase { .. } | Design::Likert { .. } => Vec::new(),
    }
}

fn page_of(page: &MushraPage, random: &mut Random) -> Task {
    let MushraPage { reference, tested, anchors } = page;
    let rated: Vec<String> = [reference].into_iter().chain(tested).chain(anchors).cloned().collect();
    Task::Page { reference: reference.clone(), stimuli: shuffled(&rated, random) }
}

fn shuffled(stimuli: &[String], random: &mut Random) -> Vec<String> {
    random.shuffled(stimuli.len()).into_iter().map(|index| stimuli[index].clone()).collect()
}

/// Tasks in the order of the part.
fn arranged(blocks: Vec<Vec<Task>>, part: &Part, participant: usize, random: &mut Random) -> Vec<Task> {
    // The conditions of a questionnaire stay with their prompt.
    let is_mixed = part.order == Order::Shuffled && !matches!(part.design, Design::Likert { .. });
    let blocks = if is_mixed { vec![blocks.into_iter().flatten().collect()] } else { blocks };
    let mut all = Vec::new();
    for (index, tasks) in blocks.into_iter().enumerate() {
        let n_tasks = tasks.len();
        let order = match part.order {
            Order::Listed => (0..n_tasks).collect(),
            Order::LatinSquare => latin_row(n_tasks, participant.saturating_sub(1) + index),
            Order::Shuffled | Order::ShuffledBlocks => random.shuffled(n_tasks),
        };
        all.extend(in_order(tasks, &order));
    }
    all
}

/// Practice tasks: different ones as far as there are enough.
fn practice(tasks: &[Task], n_practice: usize, random: &mut Random) -> Vec<Task> {
    let mut chosen = Vec::with_capacity(n_practice);
    while chosen.len() < n_practice && !tasks.is_empty() {
        let n_left = n_practice - chosen.len();
        let order = random.shuffled(tasks.len());
        chosen.extend(order.into_iter().take(n_left).map(|index| tasks[index].clone()));
    }
    chosen
}

#[cfg(test)]
mod tests;
