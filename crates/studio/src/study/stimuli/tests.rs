use std::sync::Arc;

use shagreen_core::dsp::spectrum::rms;
use shagreen_core::people::study::plan::{Design, Plan, Source, Variant};
use shagreen_core::people::study::schedule::trials;
use shagreen_core::people::study::trial::{Side, Task, Trial};
use shagreen_core::texture::TextureModel;
use shagreen_formats::starter::starter_library;
use shagreen_formats::study_plan::write_study_plan;

use super::{Stimuli, StimulusSound, Waveforms};
use crate::project::new_project;
use crate::report::Warnings;
use crate::study::new_plan::{authored_names, plan_with_textures};
use crate::study::plans::{StudyPlan, template};
use crate::study::textures::StudyTextures;

fn starter() -> StudyTextures {
    StudyTextures::of_library(starter_library().unwrap())
}

fn make(study: &StudyPlan, textures: &StudyTextures) -> anyhow::Result<Stimuli> {
    Stimuli::make(study, textures, &Warnings::default(), &mut |_, _| true)
}

/// The built-in plan with only these stimuli and its first part.
fn study(id: &str, change: impl Fn(&mut Plan)) -> StudyPlan {
    let mut plan = Plan::clone(&template(id).unwrap().study.plan);
    plan.parts.truncate(1);
    change(&mut plan);
    StudyPlan::read(&write_study_plan(&plan)).unwrap()
}

/// Values of the relief of a stimulus.
fn values(sound: &StimulusSound) -> Vec<f64> {
    let [(model, _)] = sound.voices() else { panic!("one texture") };
    model.relief().unwrap().profile().values().to_vec()
}

/// Levels of the grain of the first texture.
fn level_mps2(sound: &StimulusSound) -> f64 {
    let model: &TextureModel = &sound.voices()[0].0;
    model.nodes()[0].level_mps2
}

#[test]
fn textures_play_as_the_library_has_them_and_levels_are_changed() {
    let louder = study("bipolar-rating", |plan| plan.stimuli[1].level_db = 6.0);
    let (plain, changed) =
        (make(&template("bipolar-rating").unwrap().study, &starter()), make(&louder, &starter()));
    let (plain, changed) = (plain.unwrap(), changed.unwrap());
    let part = &louder.plan.parts[0];
    for trial in trials(&louder.plan, part, 1) {
        let Task::Rate { stimulus } = &trial.task else { panic!("a rating") };
        let (before, after) = (plain.of_trial(&trial).unwrap(), changed.of_trial(&trial).unwrap());
        let ratio = level_mps2(&after[0]) / level_mps2(&before[0]);
        let is_changed = *stimulus == louder.plan.stimuli[1].id;
        assert!((ratio - if is_changed { 10.0_f64.powf(0.3) } else { 1.0 }).abs() < 1e-9, "{stimulus}");
        assert_eq!(before[0].sha256() == after[0].sha256(), !is_changed, "{stimulus}");
    }
}

#[test]
fn an_authored_version_is_made_without_its_original() {
    let study = study("authored-dissimilarity", |plan| {
        let Design::Dissimilarity { pairs, reference } = &mut plan.parts[0].design else { panic!() };
        pairs.retain(|pair| pair.first == "cork" && pair.second == "cork-authored");
        *reference = None;
        plan.stimuli.retain(|stimulus| stimulus.id.starts_with("cork"));
    });
    let stimuli = make(&study, &starter()).unwrap();
    let trial = &trials(&study.plan, &study.plan.parts[0], 1)[0];
    let sounds = stimuli.of_trial(trial).unwrap();
    let hashes = Stimuli::hashes(&sounds);
    assert!(hashes.len() == 2 && hashes[0] != hashes[1], "{hashes:?}");
    assert_eq!(sounds[0].planes()[0].0.rate(), sounds[0].rate());
    // The same texture, made again, has the same hash.
    assert_eq!(Stimuli::hashes(&make(&study, &starter()).unwrap().of_trial(trial).unwrap()), hashes);
}

/// The original is the signal that was coded, so that only the codec differs; identical pairs are identical.
#[test]
fn coded_textures_and_their_originals_are_the_same_signal_in_segments() {
    let study = study("same-different", |plan| {
        let Design::SameDifferent { pairs, .. } = &mut plan.parts[0].design else { panic!() };
        pairs.truncate(1);
    });
    let stimuli = make(&study, &starter()).unwrap();
    let (textures, reporter) = (starter(), Warnings::default());
    let waveforms = Waveforms::new(&study, &textures, &reporter).unwrap();
    let mut segments = Vec::new();
    for trial in trials(&study.plan, &study.plan.parts[0], 1) {
        let Task::Discriminate { is_different, segment, .. } = trial.task else { panic!() };
        let sounds = stimuli.of_trial(&trial).unwrap();
        assert_eq!(sounds[0].sha256() != sounds[1].sha256(), is_different);
        // 0.8 s at 2000 Hz, one value for each sample.
        assert!(sounds.iter().all(|sound| values(sound).len() == 1600));
        if is_different {
            let (original, coded) = (values(&sounds[0]), values(&sounds[1]));
            // The waveform of a stimulus is what is presented.
            for (shown, presented) in trial.task.shown().iter().zip([&original, &coded]) {
                let waveform = waveforms.of(&shown.stimulus).unwrap();
                assert_eq!(waveform[1600 * segment..][..1600], presented[..]);
            }
            let ratio = rms(&coded) / rms(&original);
            assert!((0.3..1.7).contains(&ratio), "the codec changes the level by {ratio}");
            segments.push((segment, original));
        }
    }
    let of = |wanted: usize| &segments.iter().find(|(segment, _)| *segment == wanted).unwrap().1;
    assert!(of(0) != of(1) && of(1) != of(2), "segments are parts of one signal");
    let error = waveforms.of("steam").unwrap_err().to_string();
    assert!(error.contains("no stimulus \"steam\""), "{error}");
}

#[test]
fn a_profile_and_its_reconstruction_have_one_factor() {
    let study = study("reconstruction-similarity", |plan| {
        let Design::Similarity { pairs, .. } = &mut plan.parts[0].design else { panic!() };
        pairs.retain(|pair| pair.second == "b-5");
        plan.stimuli.retain(|stimulus| ["b", "b-5"].contains(&stimulus.id.as_str()));
        plan.parts[0].n_practice = 0;
    });
    let stimuli = make(&study, &starter()).unwrap();
    for trial in trials(&study.plan, &study.plan.parts[0], 1) {
        let Task::Grade { is_swapped, .. } = trial.task else { panic!() };
        let sounds = stimuli.of_trial(&trial).unwrap();
        let levels: Vec<f64> = sounds.iter().map(|sound| rms(&values(sound))).collect();
        let original = levels[usize::from(is_swapped)];
        assert!((original - super::PROFILE_LEVEL_MPS2).abs() < 1e-9, "{levels:?}");
        assert!(levels.iter().all(|level| (0.2..2.0).contains(level)), "{levels:?}");
    }
}

#[test]
fn a_detection_has_its_target_on_its_side() {
    let study = template("gap-detection").unwrap().study;
    let stimuli = make(&study, &starter()).unwrap();
    let detect = |target: Side, level: f64, seed: u64| {
        let task = Task::Detect { track: 0, level, target, has_feedback: false };
        let trial = Trial { part: "gaps".to_owned(), number: 1, is_practice: false, seed, task };
        stimuli.of_trial(&trial).unwrap()
    };
    // Half of the profile is gaps, where neighboring values are equal.
    let n_flat = |sound: &Arc<StimulusSound>| {
        let values = values(sound);
        values.windows(2).filter(|two| two[0] == two[1]).count()
    };
    let first = detect(Side::First, 5.0, 7);
    assert!(
        n_flat(&first[0]) > 3000 && n_flat(&first[1]) < 100,
        "{} {}",
        n_flat(&first[0]),
        n_flat(&first[1])
    );
    let second = detect(Side::Second, 5.0, 7);
    assert_eq!((first[0].sha256(), first[1].sha256()), (second[1].sha256(), second[0].sha256()));
    assert_ne!(first[0].sha256(), detect(Side::First, 5.0, 8)[0].sha256());
    // Both sides have the same level.
    let [gaps, noise] = [&first[0], &first[1]].map(|sound| rms(&values(sound)));
    assert!((gaps / noise - 1.0).abs() < 0.01, "{gaps} {noise}");
}

#[test]
fn authored_textures_of_a_project_are_stimuli() {
    let textures = StudyTextures::of_project(&new_project()).unwrap();
    let rating = template("bipolar-rating").unwrap();
    let study = plan_with_textures(&rating, &authored_names(&textures).unwrap(), &textures).unwrap();
    let stimuli = make(&study, &textures).unwrap();
    let trial = &trials(&study.plan, &study.plan.parts[0], 1)[0];
    assert_eq!(stimuli.of_trial(trial).unwrap()[0].voices().len(), 1);
}

#[test]
fn what_cannot_be_made_is_explained() {
    let error = |change: &dyn Fn(&mut Plan)| {
        let changed = study("bipolar-rating", |plan| change(plan));
        format!("{:#}", make(&changed, &starter()).unwrap_err())
    };
    let missing = error(&|plan| plan.stimuli[0].source = Source::Texture("graphite".to_owned()));
    assert!(missing.contains("there is no texture \"graphite\"") && missing.contains("line "), "{missing}");
    let rate = error(&|plan| plan.stimuli[0].variant = Variant::Coded { kbps: 64.0 });
    assert!(rate.contains("stimulus \"glass\"") && rate.contains("no bit rate of 64 kbit/s"), "{rate}");
    let loud = error(&|plan| plan.stimuli[0].level_db = 40.0);
    assert!(loud.contains("level of the shape is 40"), "{loud}");
    let profile = error(&|plan| {
        plan.stimuli[0].source = Source::Profile("A".to_owned());
        plan.stimuli[0].variant = Variant::Authored;
    });
    assert!(profile.contains("original or reconstructed only"), "{profile}");
    let study = template("bipolar-rating").unwrap().study;
    let ended = Stimuli::make(&study, &starter(), &Warnings::default(), &mut |n_done, _| n_done < 2);
    assert!(ended.unwrap_err().to_string().contains("ended"));
}
