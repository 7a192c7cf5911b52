//! Studies: experiments in which people sort, rate, compare and detect textures, from the plan to the analysis.
//!
//! Input: a [`plan::Plan`] and the number of a participant. From these two alone follows everything that the participant
//! meets: [`schedule`] lists the trials of all designs but staircases, whose next [`trial`] depends on the answers so far
//! ([`staircase`]). [`progress`] takes the [`answer`]s and returns the next step; to resume a session is to replay its
//! answers. [`setup`] states the devices of a session, and [`touch`] whether a trial can be answered already.
//!
//! Output: [`analysis`] turns answers into sorts, ratings, dissimilarities, d′ ([`same_different`]), thresholds and means,
//! as tables of participants × conditions without filled-in values. Tests of hypotheses are not part of it.
//!
//! [`simulated`] participants answer in the place of people, to test a plan and to estimate how many people it needs
//! ([`power`]). Their names contain "simulated" ([`crate::people::panel::is_simulated`]).

pub mod analysis;
pub mod answer;
pub mod order;
pub mod plan;
pub mod power;
pub mod progress;
pub mod same_different;
pub mod schedule;
pub mod setup;
pub mod simulated;
pub mod staircase;
#[cfg(test)]
mod test_plans;
pub mod touch;
pub mod trial;
