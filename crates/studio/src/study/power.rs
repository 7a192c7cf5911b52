//! How many participants a plan needs, from simulated repetitions of one of its parts.
//!
//! For each number of participants, the part is simulated many times with participants who perceive a stated effect, and the
//! decision of its design is made in each simulation. The power is the share of simulations in which it holds. It depends on
//! what the simulated participants are, and says nothing about an effect that people perceive.

mod decision;

use std::sync::Arc;
use std::sync::atomic::{AtomicBool, AtomicUsize, Ordering};

use anyhow::{Context as _, bail};
use shagreen_core::maths::rng::derive_seed;
use shagreen_core::people::study::plan::{Part, Plan};
use shagreen_core::people::study::power::{Power, participants_needed, power};
use shagreen_core::people::study::simulated::{Observers, SimulationError, simulated_study};

use crate::parallel::in_parallel;
use crate::study::plans::StudyPlan;
use crate::study::simulation::Simulation;

use self::decision::Decision;

/// Which part is simulated, how, and how often.
#[derive(Clone, Debug, PartialEq)]
pub struct PowerOptions {
    /// Identifier of the part; `None` for the first one.
    pub part: Option<String>,
    /// Numbers of participants.
    pub numbers: Vec<usize>,
    /// Number of simulations for each number of participants.
    pub n_studies: usize,
    /// Difference between what is compared, in points of a scale of 0 to 100.
    pub effect_points: f64,
    /// Wanted precision of the threshold of a staircase, as a share of the threshold.
    pub precision: f64,
    /// Wanted power, 0 to 1.
    pub wanted: f64,
    /// How the participants perceive and answer.
    pub observers: Observers,
    /// Seed: the same one gives the same result.
    pub seed: u64,
}

/// Power of one part by the number of participants.
#[derive(Clone, Debug, PartialEq)]
pub struct PowerReport {
    /// Identifier of the part.
    pub part: String,
    /// Identifier of its design.
    pub design: &'static str,
    /// What is decided in each simulation, in one sentence.
    pub decision: String,
    /// Power at each number of participants, in the order of the numbers.
    pub powers: Vec<Power>,
    /// Smallest of the numbers from which on the power is the wanted one; `None` if no number suffices.
    pub needed: Option<usize>,
}

/// Numbers of participants of [`PowerOptions::usual`].
pub const USUAL_NUMBERS: [usize; 6] = [4, 8, 12, 16, 20, 30];

/// Number of groups of simulations that run beside each other; the result does not depend on the number of processors.
const N_GROUPS: usize = 20;

impl PowerOptions {
    /// Attentive participants, an effect of 20 points, a precision of 20 %, 100 simulations, a power of 0.8.
    pub fn usual(seed: u64) -> Self {
        Self {
            part: None,
            numbers: USUAL_NUMBERS.to_vec(),
            n_studies: 100,
            effect_points: 20.0,
            precision: 0.2,
            wanted: 0.8,
            observers: Observers::usual(),
            seed,
        }
    }
}

/// Power of a part of a plan. `on_step` receives the number of finished groups of simulations and the number of all, from several
/// threads, and returns whether to continue.
///
/// # Errors
/// The plan has no such part, a number of participants is 0, a parameter is out of range, or `on_step` ended the work.
pub fn study_power(
    study: &StudyPlan,
    options: &PowerOptions,
    on_step: &(dyn Fn(usize, usize) -> bool + Sync),
) -> anyhow::Result<PowerReport> {
    let part = chosen(&study.plan, options.part.as_deref())?;
    if options.numbers.is_empty() || options.numbers.contains(&0) {
        bail!("the power needs numbers of participants of 1 or more; state some");
    }
    let plan = Arc::new(Plan { parts: vec![part.clone()], ..Plan::clone(&study.plan) });
    let simulation = Simulation {
        n_participants: 1,
        seed: options.seed,
        observers: options.observers,
        effect_points: Some(options.effect_points),
    };
    let world = simulation.world(&plan);
    let decision = Decision::of(part, options.precision);
    let (is_ended, n_done) = (AtomicBool::new(false), AtomicUsize::new(0));
    let of_group = |group: usize| -> Result<Vec<Power>, SimulationError> {
        if is_ended.load(Ordering::Relaxed) {
            return Ok(Vec::new());
        }
        let n_studies = share(options.n_studies, group);
        let seed = derive_seed(options.seed, &format!("group {group}"));
        let powers = power(&options.numbers, n_studies, seed, |n, seed| {
            let records = simulated_study(&plan, &world, &options.observers, n, seed)?;
            Ok(decision.holds(&plan, &records, &world))
        });
        if !on_step(n_done.fetch_add(1, Ordering::Relaxed) + 1, N_GROUPS) {
            is_ended.store(true, Ordering::Relaxed);
        }
        powers
    };
    let groups = in_parallel(N_GROUPS, of_group).into_iter().collect::<Result<Vec<_>, _>>()?;
    if is_ended.load(Ordering::Relaxed) {
        bail!("the power was not computed: the work was ended");
    }
    let powers = summed(&options.numbers, &groups);
    Ok(PowerReport {
        part: part.id.clone(),
        design: part.design.id(),
        decision: decision.sentence(&world),
        needed: participants_needed(&powers, options.wanted),
        powers,
    })
}

/// Part with this identifier, or the first one.
fn chosen<'a>(plan: &'a Plan, id: Option<&str>) -> anyhow::Result<&'a Part> {
    let Some(id) = id else { return plan.parts.first().context("the plan has no parts; add a [[part]]") };
    plan.part(id).with_context(|| {
        let ids: Vec<&str> = plan.parts.iter().map(|part| part.id.as_str()).collect();
        format!("the plan has no part \"{id}\"; choose one of {}", ids.join(", "))
    })
}

/// Number of simulations of a group.
fn share(n_studies: usize, group: usize) -> usize {
    n_studies / N_GROUPS + usize::from(group < n_studies % N_GROUPS)
}

/// Power of all groups together.
fn summed(numbers: &[usize], groups: &[Vec<Power>]) -> Vec<Power> {
    let at = |(index, n_participants): (usize, &usize)| {
        let of_groups = || groups.iter().filter_map(|powers| powers.get(index));
        Power {
            n_participants: *n_participants,
            n_studies: of_groups().map(|power| power.n_studies).sum(),
            n_held: of_groups().map(|power| power.n_held).sum(),
        }
    };
    numbers.iter().enumerate().map(at).collect()
}

#[cfg(test)]
mod tests;
