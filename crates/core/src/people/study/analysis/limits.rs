//! Conditions under which answers say less than they seem to: nothing was felt, an unknown level, an audible actuator, sliders
//! of unknown length, no touch.
//!
//! Nothing is excluded because of them. Answers of practice trials are left out, as in all of the analysis.

use crate::people::study::analysis::scored_by_index;
use crate::people::study::answer::{Answer, Record};
use crate::people::study::plan::{Design, Part, Plan};
use crate::people::study::setup::Setup;
use crate::people::study::touch::required_mm;

/// A condition under which an answer says less than it seems to.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Limit {
    /// The participant is simulated. Further limits of simulated participants are not counted: they feel nothing.
    Simulated,
    /// The log does not state the devices, as logs of earlier versions.
    UnknownDevices,
    /// The output was the silent one, closed or muted: nothing was felt.
    Silent,
    /// No actuator profile was selected, so that the level of the stimuli is not known.
    NoActuator,
    /// The plan asks for masking noise, but no output played it.
    NoMasking,
    /// The plan states the length of sliders, but the scale of the screen was not measured.
    AssumedScale,
    /// The tip did not move in contact.
    NoTouch,
    /// The tip moved less over one of the stimuli than the part requires.
    ShortTouch,
}

/// Answers under a limit.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Limited {
    /// The limit.
    pub limit: Limit,
    /// Participants with such answers, in the order of the records.
    pub participants: Vec<String>,
    /// Number of such answers.
    pub n_answers: usize,
}

impl Limit {
    /// All limits, in the order of lists.
    pub const ALL: [Self; 8] = [
        Self::Simulated,
        Self::UnknownDevices,
        Self::Silent,
        Self::NoActuator,
        Self::NoMasking,
        Self::AssumedScale,
        Self::NoTouch,
        Self::ShortTouch,
    ];

    /// Identifier in reports.
    pub fn id(self) -> &'static str {
        match self {
            Self::Simulated => "simulated",
            Self::UnknownDevices => "unknown_devices",
            Self::Silent => "silent_output",
            Self::NoActuator => "no_actuator_profile",
            Self::NoMasking => "no_masking_noise",
            Self::AssumedScale => "screen_not_calibrated",
            Self::NoTouch => "no_touch",
            Self::ShortTouch => "short_touch",
        }
    }
}

/// Answers under each limit, in the order of [`Limit::ALL`]; limits without answers are left out.
pub fn limited_answers(plan: &Plan, records: &[Record]) -> Vec<Limited> {
    let mut all: Vec<Limited> = Limit::ALL
        .into_iter()
        .map(|limit| Limited { limit, participants: Vec::new(), n_answers: 0 })
        .collect();
    for part in &plan.parts {
        for (record, index, answer) in scored_by_index(records, part) {
            let limits = limits_of(plan, part, record, index, answer);
            for limited in all.iter_mut().filter(|limited| limits.contains(&limited.limit)) {
                limited.n_answers += 1;
                if !limited.participants.contains(&record.participant) {
                    limited.participants.push(record.participant.clone());
                }
            }
        }
    }
    // Parts are counted one after the other, but participants are listed in the order of the records.
    let position = |name: &String| records.iter().position(|record| record.participant == *name);
    for limited in &mut all {
        limited.participants.sort_by_key(position);
    }
    all.retain(|limited| limited.n_answers > 0);
    all
}

fn limits_of(plan: &Plan, part: &Part, record: &Record, index: usize, answer: &Answer) -> Vec<Limit> {
    if record.is_simulated {
        return vec![Limit::Simulated];
    }
    let mut limits = match record.setup_at(index) {
        Some(setup) => limits_of_devices(plan, part, setup),
        None => vec![Limit::UnknownDevices],
    };
    let distance_m = answer.measured.motion.map_or(0.0, |motion| motion.distance_m);
    let least_m = 1e-3 * required_mm(part).unwrap_or(0.0);
    if distance_m <= 0.0 {
        limits.push(Limit::NoTouch);
    } else if answer.measured.touched_m.iter().any(|touched_m| *touched_m < least_m) {
        limits.push(Limit::ShortTouch);
    }
    limits
}

fn limits_of_devices(plan: &Plan, part: &Part, setup: &Setup) -> Vec<Limit> {
    let has_stated_length = matches!(part.design, Design::Rating { .. });
    let found = [
        (Limit::Silent, setup.output.is_none()),
        (Limit::NoActuator, setup.actuator.is_none()),
        (Limit::NoMasking, plan.masking_noise.is_some() && setup.masking.is_none()),
        (Limit::AssumedScale, has_stated_length && !setup.screen.is_measured()),
    ];
    found.into_iter().filter(|(_, is_found)| *is_found).map(|(limit, _)| limit).collect()
}

#[cfg(test)]
mod tests {
    use super::{Limit, Limited, limited_answers};
    use crate::people::study::answer::{Answer, Measured, Motion, Record, Response, SetupFrom};
    use crate::people::study::plan::{Design, MaskingNoise, NoiseColor, Part, Plan, Timing};
    use crate::people::study::setup::{OutputDevice, ScreenScale, Setup};
    use crate::people::study::simulated::{Observers, World, simulated_study};
    use crate::people::study::test_plans::{all_designs, part, plan_of, rating};
    use crate::people::study::trial::{Task, Trial};

    /// A plan with masking noise and sliders of a stated length.
    fn plan() -> Plan {
        let masking_noise = Some(MaskingNoise { color: NoiseColor::Pink, level_db: -20.0 });
        let part = Part { touch_mm: Some(20.0), ..part("a", rating()) };
        Plan { masking_noise, ..plan_of(vec![part]) }
    }

    /// Devices with which nothing is wrong.
    fn good() -> Setup {
        Setup {
            output: Some(OutputDevice { id: "usb".to_owned(), name: "USB".to_owned() }),
            actuator: Some("haptuator".to_owned()),
            masking: Some("Headphones".to_owned()),
            pen: None,
            screen: ScreenScale::Measured { pixels_per_mm: 5.0 },
            program: "test".to_owned(),
        }
    }

    /// An answer with these distances over the stimulus, in mm; none without contact.
    fn answer(number: usize, touched_mm: Option<f64>) -> Answer {
        let motion = |mm: f64| Motion { distance_m: 1e-3 * mm, mean_speed_mps: 0.1, mean_force_n: 1.0 };
        Answer {
            trial: Trial {
                part: "a".to_owned(),
                number,
                is_practice: number == 1,
                seed: 1,
                task: Task::Rate { stimulus: "cork".to_owned() },
            },
            response: Response::Sliders(vec![50.0; 2]),
            measured: Measured {
                motion: touched_mm.map(motion),
                touched_m: touched_mm.map(|mm| 1e-3 * mm).into_iter().collect(),
                ..Measured::default()
            },
        }
    }

    /// Five answers, the first one of practice, with this setup.
    fn record(participant: &str, setup: Option<Setup>, touched_mm: Option<f64>) -> Record {
        Record {
            participant: participant.to_owned(),
            number: 1,
            is_simulated: false,
            answers: (1..=5).map(|number| answer(number, touched_mm)).collect(),
            setups: vec![SetupFrom { first_answer: 0, setup }],
        }
    }

    fn found(records: &[Record]) -> Vec<(Limit, usize)> {
        limited_answers(&plan(), records).iter().map(|of| (of.limit, of.n_answers)).collect()
    }

    #[test]
    fn good_answers_have_no_limit() {
        assert!(found(&[record("p01", Some(good()), Some(20.0))]).is_empty());
        let identifiers: std::collections::BTreeSet<&str> = Limit::ALL.map(Limit::id).into();
        assert_eq!(identifiers.len(), Limit::ALL.len());
    }

    /// Practice does not count.
    #[test]
    fn each_limit_is_counted_by_itself() {
        let check = |setup: Setup, limit: Limit| {
            assert_eq!(found(&[record("p01", Some(setup), Some(30.0))]), [(limit, 4)]);
        };
        check(Setup { output: None, ..good() }, Limit::Silent);
        check(Setup { actuator: None, ..good() }, Limit::NoActuator);
        check(Setup { masking: None, ..good() }, Limit::NoMasking);
        let screen = ScreenScale::Assumed { pixels_per_mm: 3.8 };
        check(Setup { screen, ..good() }, Limit::AssumedScale);
        assert_eq!(found(&[record("p01", None, Some(30.0))]), [(Limit::UnknownDevices, 4)]);
        let untouched = [None, Some(0.0)].map(|touched| record("p01", Some(good()), touched));
        for record in untouched {
            assert_eq!(found(&[record]), [(Limit::NoTouch, 4)]);
        }
        assert_eq!(found(&[record("p01", Some(good()), Some(19.0))]), [(Limit::ShortTouch, 4)]);
    }

    #[test]
    fn only_the_answers_after_a_change_have_its_limit() {
        let mut one = record("p02", Some(good()), Some(30.0));
        let lost = Setup { output: None, ..good() };
        one.setups.push(SetupFrom { first_answer: 3, setup: Some(lost) });
        let other = record("p01", Some(Setup { output: None, ..good() }), Some(30.0));
        let limited = limited_answers(&plan(), &[one, other]);
        let participants = vec!["p02".to_owned(), "p01".to_owned()];
        assert_eq!(limited, [Limited { limit: Limit::Silent, participants, n_answers: 2 + 4 }]);
    }

    /// A plan without masking noise and without sliders asks for neither.
    #[test]
    fn what_the_plan_does_not_ask_for_is_no_limit() {
        let screen = ScreenScale::Assumed { pixels_per_mm: 3.8 };
        let setup = Setup { masking: None, screen, ..good() };
        let records = [record("p01", Some(setup), Some(30.0))];
        let quiet = Plan { masking_noise: None, ..plan() };
        let limits: Vec<Limit> = limited_answers(&quiet, &records).iter().map(|of| of.limit).collect();
        assert_eq!(limits, [Limit::AssumedScale]);
    }

    /// The tip moves by itself over stimuli that follow each other, and may move less far than other parts require.
    #[test]
    fn no_distance_is_required_in_a_succession() {
        let is_it = |part: &Part| matches!(part.design, Design::SameDifferent { .. });
        let same_different = all_designs().parts.into_iter().find(is_it).unwrap();
        let timing = Timing { stimulus_secs: Some(0.8), ..Timing::default() };
        let passive = Part { id: "a".to_owned(), touch_mm: Some(20.0), timing, ..same_different };
        let records = [record("p01", Some(good()), Some(5.0))];
        assert!(limited_answers(&plan_of(vec![passive]), &records).is_empty());
    }

    #[test]
    fn simulated_participants_are_counted_as_such_alone() {
        let plan = std::sync::Arc::new(plan());
        let world = World::invented(&plan, 3);
        let records = simulated_study(&plan, &world, &Observers::usual(), 2, 1).unwrap();
        let limited = limited_answers(&plan, &records);
        assert_eq!((limited.len(), limited[0].limit, limited[0].n_answers), (1, Limit::Simulated, 10));
        assert_eq!(limited[0].participants.len(), 2);
    }
}
