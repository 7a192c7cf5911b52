//! One simulated participant.

use crate::maths::rng::{Random, derive_seed};
use crate::people::panel::{group, simulated_name};
use crate::people::ratings::AdjectivePair;
use crate::people::study::answer::Response;
use crate::people::study::plan::{Design, Plan, Prompts, Varied};
use crate::people::study::simulated::{Observers, SimulationError, World};
use crate::people::study::touch::required_mm;
use crate::people::study::trial::{Side, Task, Trial};

/// A simulated participant; the same seed and number give the same answers to the same trials in the same order.
#[derive(Clone, Debug)]
pub struct SimulatedParticipant<'a> {
    plan: &'a Plan,
    world: &'a World,
    observers: Observers,
    /// Seed of the habits.
    seed: u64,
    random: Random,
}

/// Distance, in points above the criterion, at which two stimuli are as different as a scale can say.
const FULL_POINTS: f64 = 50.0;
/// Largest distance that a guess states, in points.
const FARTHEST_POINTS: f64 = 100.0;
/// Proportion of wrong answers at the threshold: `1 - 0.5^(1/4)`, as at the end of a staircase with four down.
const WRONG_AT_THRESHOLD: f64 = 1.0 - 0.840_896_415_253_714_5;
/// Median response time, in s, and the standard deviation of its logarithm.
const RESPONSE_SECS: (f64, f64) = (4.0, 0.4);
/// Numbers that participants choose for a distance of one point: median, and the standard deviation of its logarithm.
const MODULUS: (f64, f64) = (0.1, 1.0);

impl<'a> SimulatedParticipant<'a> {
    /// Participant with this number, from 1.
    ///
    /// # Errors
    /// A parameter of the observers is out of range, or a stimulus of the plan has no position.
    pub fn new(
        plan: &'a Plan,
        world: &'a World,
        observers: Observers,
        number: usize,
        seed: u64,
    ) -> Result<Self, SimulationError> {
        observers.check()?;
        world.check(plan)?;
        let seed = derive_seed(seed, &simulated_name(number));
        Ok(Self { plan, world, observers, seed, random: Random::new(derive_seed(seed, "answers")) })
    }

    /// Response to a trial. For a trial of another plan, it may not fit the task.
    pub fn respond(&mut self, trial: &Trial) -> Response {
        let design = self.plan.part(&trial.part).map(|part| &part.design);
        let is_lapse = self.random.uniform() < self.observers.lapse_rate;
        let values = Asked::of(design, &trial.task);
        if is_lapse { self.guess(&trial.task, &values) } else { self.judge(&trial.task, &values) }
    }

    /// Distance that the part of a trial requires over each stimulus, in mm.
    pub(super) fn required_mm(&self, trial: &Trial) -> f64 {
        self.plan.part(&trial.part).and_then(required_mm).unwrap_or(0.0)
    }

    /// Time to a response, in s.
    pub(super) fn response_secs(&mut self) -> f64 {
        RESPONSE_SECS.0 * self.random.log_normal(RESPONSE_SECS.1)
    }

    fn judge(&mut self, task: &Task, asked: &Asked<'_>) -> Response {
        match task {
            Task::Sort { stimuli, n_groups } => {
                let felt: Vec<Vec<f64>> = stimuli.iter().map(|stimulus| self.felt(stimulus)).collect();
                let first = self.random.below(felt.len());
                Response::Groups(group(&felt, *n_groups, first))
            }
            Task::Vote { stimulus } => {
                let vote = |adjective: &String| self.value(stimulus, adjective) > 50.0;
                Response::Votes(asked.scales.iter().map(vote).collect())
            }
            Task::Rate { stimulus } => {
                Response::Sliders(asked.scales.iter().map(|scale| self.rating(stimulus, scale)).collect())
            }
            Task::Compare { pair, .. } => {
                Response::Magnitude(self.modulus() * self.distance(&pair.first, &pair.second))
            }
            Task::Discriminate { pair, is_different, .. } => {
                let second = if *is_different { &pair.second } else { &pair.first };
                Response::IsDifferent(self.distance(&pair.first, second) > self.observers.criterion_points)
            }
            Task::Detect { level, target, .. } => {
                let is_right = self.random.uniform() < self.proportion_right(*level, asked.varied);
                Response::Side(Side::second_if((*target == Side::Second) == is_right))
            }
            Task::Grade { pair, .. } => {
                let share = self.difference(&pair.first, &pair.second);
                Response::Grade(grade(share, asked.n_points))
            }
            Task::Question { prompt, condition } => {
                let mean = self.world.conditions.get(condition).copied().unwrap_or(0.5);
                let answer = |statement: &String| {
                    let bias = 0.01 * self.observers.bias_points * self.habits(statement).normal();
                    grade(mean + bias + self.observers.grade_noise * self.random.normal(), asked.n_points)
                };
                let grades = asked.scales.iter().map(answer).collect();
                Response::Grades { prompt: asked.prompt(*prompt), grades }
            }
            Task::Match { pair, is_swapped, x } => {
                let (first, second) = (&pair.first, &pair.second);
                let [a, b] = if *is_swapped { [second, first] } else { [first, second] };
                let third = if *x == Side::First { a } else { b };
                let [a, b, third] = [a, b, third].map(|stimulus| self.felt(stimulus));
                Response::Side(Side::second_if(distance(&third, &b) < distance(&third, &a)))
            }
            Task::Page { reference, stimuli } => {
                let score = |stimulus: &String| 100.0 * (1.0 - self.difference(reference, stimulus));
                Response::Sliders(stimuli.iter().map(score).collect())
            }
            Task::Place { stimulus, low, high } => {
                // The anchors can be felt at any time, so that only the stimulus has noise.
                let at = self.felt(stimulus);
                Response::Sliders(vec![self.world.position_between(&at, low, high)])
            }
        }
    }

    fn guess(&mut self, task: &Task, asked: &Asked<'_>) -> Response {
        match task {
            Task::Sort { stimuli, n_groups } => {
                // Every group has a texture.
                let order = self.random.shuffled(stimuli.len());
                Response::Groups(order.into_iter().map(|rank| rank % n_groups).collect())
            }
            Task::Vote { .. } => {
                Response::Votes(asked.scales.iter().map(|_| self.random.below(2) == 1).collect())
            }
            Task::Rate { .. } => Response::Sliders(self.anywhere(asked.scales.len())),
            Task::Page { stimuli, .. } => Response::Sliders(self.anywhere(stimuli.len())),
            Task::Place { .. } => Response::Sliders(self.anywhere(1)),
            Task::Compare { .. } => {
                Response::Magnitude(FARTHEST_POINTS * self.modulus() * self.random.uniform())
            }
            Task::Discriminate { .. } => Response::IsDifferent(self.random.below(2) == 1),
            Task::Detect { .. } | Task::Match { .. } => {
                Response::Side(Side::second_if(self.random.below(2) == 1))
            }
            Task::Grade { .. } => Response::Grade(grade(self.random.uniform(), asked.n_points)),
            Task::Question { prompt, .. } => {
                let grades =
                    asked.scales.iter().map(|_| grade(self.random.uniform(), asked.n_points)).collect();
                Response::Grades { prompt: asked.prompt(*prompt), grades }
            }
        }
    }

    fn anywhere(&mut self, n: usize) -> Vec<f64> {
        (0..n).map(|_| 100.0 * self.random.uniform()).collect()
    }

    /// Generator of the habits of this participant in one respect.
    fn habits(&self, what: &str) -> Random {
        Random::new(derive_seed(self.seed, what))
    }

    /// Perceived position of a stimulus.
    fn felt(&mut self, stimulus: &str) -> Vec<f64> {
        let (world, noise) = (self.world, self.observers.noise_points);
        world.position(stimulus).iter().map(|x| x + noise * self.random.normal()).collect()
    }

    /// Perceived value of a stimulus on a scale.
    fn value(&mut self, stimulus: &str, scale: &str) -> f64 {
        self.world.value(stimulus, scale) + self.observers.noise_points * self.random.normal()
    }

    /// Rating `50 + scale (value + noise - 50) + bias`, as of simulated raters ([`crate::people::panel`]).
    fn rating(&mut self, stimulus: &str, scale: &str) -> f64 {
        let mut habits = self.habits(scale);
        let factor = habits.log_normal(self.observers.scale_log_spread);
        let bias = self.observers.bias_points * habits.normal();
        (50.0 + factor * (self.value(stimulus, scale) - 50.0) + bias).clamp(0.0, 100.0)
    }

    /// Distance of two perceptions, in points.
    fn distance(&mut self, one: &str, other: &str) -> f64 {
        let (one, other) = (self.felt(one), self.felt(other));
        distance(&one, &other)
    }

    /// Number that this participant chooses for a distance of one point.
    fn modulus(&self) -> f64 {
        MODULUS.0 * self.habits("modulus").log_normal(MODULUS.1)
    }

    /// Perceived difference, 0 up to the criterion, 1 from [`FULL_POINTS`] above it.
    fn difference(&mut self, one: &str, other: &str) -> f64 {
        let above = self.distance(one, other) - self.observers.criterion_points;
        (above / FULL_POINTS).clamp(0.0, 1.0)
    }

    /// Probability of naming the right one of two alternatives: a Weibull function that is 84.1 % at the threshold.
    fn proportion_right(&self, level: f64, varied: Option<&Varied>) -> f64 {
        let (what, median) = match varied {
            Some(Varied::Level { .. }) => ("level threshold", self.observers.level_threshold_db),
            Some(Varied::Gap) | None => ("gap threshold", self.observers.gap_threshold_mm),
        };
        let threshold = median * self.habits(what).log_normal(self.observers.threshold_log_spread);
        1.0 - 0.5 * (2.0 * WRONG_AT_THRESHOLD).powf((level / threshold).powf(self.observers.slope))
    }
}

/// What a design asks in each trial.
struct Asked<'a> {
    /// Adjectives, adjective pairs or statements.
    scales: Vec<String>,
    n_points: u32,
    varied: Option<&'a Varied>,
    prompts: Option<&'a Prompts>,
}

impl<'a> Asked<'a> {
    fn of(design: Option<&'a Design>, task: &Task) -> Self {
        let nothing = Self { scales: Vec::new(), n_points: 1, varied: None, prompts: None };
        match design.filter(|design| task.fits(design)) {
            Some(Design::Relevance { adjectives, .. }) => Self { scales: adjectives.clone(), ..nothing },
            Some(Design::Rating { pairs, .. }) => {
                Self { scales: pairs.iter().map(AdjectivePair::name).collect(), ..nothing }
            }
            Some(Design::Similarity { n_points, .. }) => Self { n_points: *n_points, ..nothing },
            Some(Design::Likert { statements, prompts, n_points, .. }) => Self {
                scales: statements.iter().map(|statement| statement.id.clone()).collect(),
                n_points: *n_points,
                prompts: Some(prompts),
                ..nothing
            },
            Some(Design::Staircase { varied, .. }) => Self { varied: Some(varied), ..nothing },
            _ => nothing,
        }
    }

    /// Text of a prompt by its index.
    fn prompt(&self, index: usize) -> String {
        match self.prompts {
            Some(Prompts::Given(texts)) => texts.get(index).cloned().unwrap_or_default(),
            Some(Prompts::Own(_)) | None => format!("simulated prompt {}", index + 1),
        }
    }
}

/// Grade from 1 to `n_points` of a share of the scale, which may lie outside 0 to 1.
fn grade(share: f64, n_points: u32) -> u32 {
    let steps = f64::from(n_points.saturating_sub(1));
    1 + (steps * share).round().clamp(0.0, steps) as u32
}

fn distance(one: &[f64], other: &[f64]) -> f64 {
    one.iter().zip(other).map(|(a, b)| (a - b) * (a - b)).sum::<f64>().sqrt()
}
