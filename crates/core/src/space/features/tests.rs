use super::physical::{level_exponents, tap_centroid};
use super::{
    FeatureError, FeaturePlan, FeatureWarning, NamedTexture, Statistic, centroid, level_db, per_frame,
    per_pattern, physical, physical_table,
};
use crate::dsp::mfcc::{MfccOptions, TransformLength, htk, paper, recommended};
use crate::texture::patterns::{PAPER_RATE, PatternPlan, paper_patterns, starter_patterns};
use crate::texture::plane::Plane;
use crate::texture::tap::Tap;
use crate::texture::test_textures::two_resonances;
use crate::texture::{GrainNode, TextureModel};
use crate::units::{Contact, Hertz, MetersPerSecond, Newtons};
use std::f64::consts::{PI, TAU};

fn textures() -> [TextureModel; 2] {
    let rough = two_resonances(&[0.05, 0.15, 0.25], &[0.1, 0.3, 0.5]);
    let faster = two_resonances(&[0.05, 0.2, 0.3], &[0.1, 0.3, 0.6]);
    [rough, faster]
}

fn named(models: &[TextureModel]) -> Vec<NamedTexture<'_>> {
    let names = ["cork", "felt"];
    names.iter().zip(models).map(|(name, model)| NamedTexture { name, model }).collect()
}

fn plan<'a>(contacts: &'a [Contact], mfcc: &'a MfccOptions) -> FeaturePlan<'a> {
    let patterns = PatternPlan { contacts, seconds: 1.0, rate: PAPER_RATE, seed: 3 };
    FeaturePlan { patterns, mfcc }
}

#[test]
fn tables_have_the_shapes_and_names_of_the_paper() {
    let (models, contacts) = (textures(), paper_patterns());
    let textures = named(&models);
    for (mfcc, n_frames) in [(paper(), 66), (htk(), 98)] {
        let table = per_frame(&textures, &plan(&contacts, &mfcc), &|| true).unwrap();
        assert_eq!(table.values.dim(), (2, 25 * n_frames * 13));
        assert_eq!(table.names.len(), 25 * n_frames * 13);
        assert_eq!(table.names[0], "c0 of frame 0 @ 50 mm/s, 0.1 N");
        assert_eq!(table.names[13 * (n_frames + 2) + 3], "c3 of frame 2 @ 50 mm/s, 0.2 N");
        assert!(
            table.label.starts_with(mfcc.label) && table.label.contains("every frame"),
            "{}",
            table.label
        );
    }
    let mfcc = recommended();
    let table = per_pattern(&textures, &plan(&starter_patterns(), &mfcc), Statistic::Mean, &|| true).unwrap();
    assert_eq!((table.values.dim(), table.names.len()), ((2, 325), 325));
    assert_eq!(table.names[12 * 13 + 3], "c3 @ 120 mm/s, 0.8 N");
    assert_eq!(table.textures, ["cork", "felt"]);
    assert!(table.values.iter().all(|v| v.is_finite()));
}

#[test]
fn means_and_deviations_are_those_of_the_frames() {
    let (models, contacts, mfcc) = (textures(), paper_patterns(), recommended());
    let (textures, plan) = (named(&models), plan(&contacts[..3], &mfcc));
    let frames = per_frame(&textures, &plan, &|| true).unwrap();
    let means = per_pattern(&textures, &plan, Statistic::Mean, &|| true).unwrap();
    let both = per_pattern(&textures, &plan, Statistic::MeanAndDeviation, &|| true).unwrap();
    assert_eq!((means.names.len(), both.names.len()), (39, 78));
    assert_eq!([&both.names[8], &both.names[9]], ["c4 @ 50 mm/s, 0.1 N", "s.d. of c4 @ 50 mm/s, 0.1 N"]);
    for texture in 0..2 {
        for (i, name) in means.names.iter().enumerate() {
            // Matched by name, because the tables have different column orders.
            let (coefficient, pattern) = name.split_once(" @ ").unwrap();
            let is_of = |n: &String| {
                n.starts_with(&format!("{coefficient} of ")) && n.ends_with(&format!("@ {pattern}"))
            };
            let columns = frames.names.iter().enumerate().filter(|(_, n)| is_of(n));
            let values: Vec<f64> = columns.map(|(column, _)| frames.values[[texture, column]]).collect();
            assert_eq!(values.len(), 66, "{name}");
            let mean = values.iter().sum::<f64>() / 66.0;
            let deviation = (values.iter().map(|v| v * v).sum::<f64>() / 66.0 - mean * mean).sqrt();
            assert!((means.values[[texture, i]] - mean).abs() < 1e-12, "{name}");
            assert!((both.values[[texture, 2 * i]] - mean).abs() < 1e-12, "{name}");
            // A difference of squares of up to some hundreds has a relative rounding error of 1e-13.
            assert!((both.values[[texture, 2 * i + 1]] - deviation).abs() < 1e-9, "{name}");
        }
    }
}

#[test]
fn rows_do_not_depend_on_the_company() {
    let (models, contacts, mfcc) = (textures(), paper_patterns(), recommended());
    let (all, plan) = (named(&models), plan(&contacts[..2], &mfcc));
    let both = per_pattern(&all, &plan, Statistic::Mean, &|| true).unwrap();
    let one = per_pattern(&all[1..], &plan, Statistic::Mean, &|| true).unwrap();
    assert_eq!(both.values.row(1), one.values.row(0));
    // The same model with another name has different noise.
    let twin = NamedTexture { name: "twin", model: &models[1] };
    assert_ne!(per_pattern(&[twin], &plan, Statistic::Mean, &|| true).unwrap().values, one.values);
}

#[test]
fn warnings_name_the_texture() {
    let small = two_resonances(&[0.05, 0.1], &[0.1, 0.2]);
    let texture = [NamedTexture { name: "lace", model: &small }];
    let mfcc = MfccOptions { transform: TransformLength::Samples(32), ..recommended() };
    let table = per_pattern(&texture, &plan(&paper_patterns(), &mfcc), Statistic::Mean, &|| true).unwrap();
    let warnings: Vec<String> = table.warnings.iter().map(ToString::to_string).collect();
    assert_eq!(
        warnings,
        [
            "lace: 21 of 25 patterns exceed the texture's range and are clamped to its maximum, 100 mm/s and 0.20 N"
        ]
    );
    let floored = MfccOptions { shape: crate::dsp::mfcc::FilterShape::FlooredToBins, ..mfcc };
    let table = per_pattern(&texture, &plan(&paper_patterns(), &floored), Statistic::Mean, &|| true).unwrap();
    assert_eq!(table.warnings[0], FeatureWarning::EmptyFilters { n: 4, n_filters: 20 });
}

#[test]
fn what_is_the_same_of_several_textures_is_said_once() {
    let small = two_resonances(&[0.05, 0.1], &[0.1, 0.2]);
    let names: Vec<String> = (0..5).map(|i| format!("lace{i}")).collect();
    let textures: Vec<NamedTexture<'_>> =
        names.iter().map(|name| NamedTexture { name, model: &small }).collect();
    let sentence =
        "21 of 25 patterns exceed the texture's range and are clamped to its maximum, 100 mm/s and 0.20 N";
    let mfcc = recommended();
    let cepstral =
        per_pattern(&textures, &plan(&paper_patterns(), &mfcc), Statistic::Mean, &|| true).unwrap();
    let physical = physical_table(&textures, &paper_patterns()).unwrap();
    // Features that some textures lack are left out and produce warnings, too.
    for table in [cepstral.clone(), physical.clone(), cepstral.beside(&physical)] {
        let of_patterns: Vec<String> =
            table.findings().into_iter().filter(|said| said.contains("patterns")).collect();
        assert_eq!(of_patterns, [format!("lace0, lace1, lace2 and 2 more: {sentence}")]);
    }
    let two = physical_table(&textures[..2], &paper_patterns()).unwrap();
    assert_eq!(two.findings()[0], format!("lace0, lace1: {sentence}"));
}

#[test]
fn nonsense_is_refused() {
    let (models, contacts, mfcc) = (textures(), paper_patterns(), recommended());
    let plan = plan(&contacts, &mfcc);
    assert_eq!(per_frame(&[], &plan, &|| true), Err(FeatureError::NoTextures));
    let twice = [NamedTexture { name: "cork", model: &models[0] }; 2];
    assert_eq!(per_frame(&twice, &plan, &|| true), Err(FeatureError::SameName { name: "cork".to_owned() }));
    assert!(matches!(physical_table(&twice, &contacts), Err(FeatureError::SameName { .. })));
    let too_many = MfccOptions { n_coefficients: 30, ..recommended() };
    let error = per_frame(&twice[..1], &FeaturePlan { mfcc: &too_many, ..plan }, &|| true).unwrap_err();
    assert!(matches!(error, FeatureError::Mfcc(_)), "{error}");
    let short = PatternPlan { seconds: 0.02, ..plan.patterns };
    let error =
        per_frame(&twice[..1], &FeaturePlan { patterns: short, ..plan }, &|| true).unwrap_err().to_string();
    assert!(error.contains("cork at 50 mm/s, 0.1 N: the signal has 20 samples"), "{error}");
    let backwards = [Contact::from_mm_per_s_and_n(-1.0, 1.0)];
    let patterns = PatternPlan { contacts: &backwards, ..plan.patterns };
    let error = per_frame(&twice[..1], &FeaturePlan { patterns, ..plan }, &|| true).unwrap_err().to_string();
    assert!(error.starts_with("cork: pattern 0 is at -0.001 m/s"), "{error}");
}

/// White noise (`n` evenly spaced line spectral frequencies) whose level is a power law of speed and force.
fn white(exponents: (f64, f64)) -> TextureModel {
    let node = |c: Contact| GrainNode {
        speed: c.speed,
        force: c.force,
        lsf: vec![PI / 3.0, 2.0 * PI / 3.0],
        level_mps2: 5.0 * (c.speed.0 / 0.1).powf(exponents.0) * c.force.0.powf(exponents.1),
    };
    TextureModel::new(Hertz(1000.0), starter_patterns().into_iter().map(node).collect(), Some(0.4)).unwrap()
}

#[test]
fn power_laws_are_found() {
    for exponents in [(1.0, 0.3), (0.7, -0.2), (0.0, 0.0)] {
        let plane = Plane::new(&white(exponents));
        let (speed, force) = level_exponents(&plane, &starter_patterns()).unwrap();
        // At the nodes, the plane reproduces their levels to rounding.
        assert!((speed - exponents.0).abs() < 1e-9 && (force - exponents.1).abs() < 1e-9, "{speed} {force}");
    }
    let flat = Plane::new(&white((0.0, 0.0)));
    assert!((level_db(&flat, &starter_patterns()).unwrap() - 20.0 * 5.0_f64.log10()).abs() < 1e-9);
    // One speed, speeds proportional to forces, or no contacts do not determine the exponents.
    let contacts = starter_patterns();
    assert_eq!(level_exponents(&flat, &contacts[..5]), None);
    let line: Vec<Contact> =
        (1..5).map(|i| Contact::from_mm_per_s_and_n(40.0 * f64::from(i), 0.5 * f64::from(i))).collect();
    assert_eq!(level_exponents(&flat, &line), None);
    assert_eq!((level_exponents(&flat, &[]), level_db(&flat, &[]), centroid(&flat, &[])), (None, None, None));
    // At rest the texture is silent, which does not count.
    assert_eq!(level_db(&flat, &[Contact::default()]), None);
}

#[test]
fn exponents_are_of_what_the_texture_reaches() {
    let far: Vec<Contact> =
        starter_patterns().into_iter().chain([Contact::from_mm_per_s_and_n(900.0, 9.0)]).collect();
    let of = physical(&white((1.0, 0.3)), &far);
    assert!(
        (of.speed_exponent.unwrap() - 1.0).abs() < 1e-9 && (of.force_exponent.unwrap() - 0.3).abs() < 1e-9
    );
}

#[test]
fn white_noise_has_its_centroid_in_the_middle_of_the_band() {
    let f = centroid(&Plane::new(&white((0.5, 0.5))), &starter_patterns()).unwrap();
    // 10, 12, … 500 Hz, all with the same density.
    assert!((f.0 - 255.0).abs() < 1e-6, "{f}");
    // One narrow resonance of a two-pole predictor: the centroid is near it.
    let ar = [-2.0 * 0.99 * (TAU * 0.2).cos(), 0.99 * 0.99];
    let node = GrainNode {
        speed: MetersPerSecond(0.1),
        force: Newtons(1.0),
        lsf: crate::dsp::lsf::lsf_from_ar(&ar).unwrap(),
        level_mps2: 1.0,
    };
    let plane = Plane::new(&TextureModel::new(Hertz(1000.0), vec![node], None).unwrap());
    let f = centroid(&plane, &[Contact::from_mm_per_s_and_n(100.0, 1.0)]).unwrap();
    assert!((f.0 - 200.0).abs() < 5.0, "{f}");
}

#[test]
fn the_centroid_of_a_tap_is_that_of_its_spectrum() {
    for (frequency_hz, decay_per_sec) in [(200.0, 30.0), (80.0, 300.0), (50.0, 600.0)] {
        let tap = Tap { frequency: Hertz(frequency_hz), decay_per_sec, amplitude_mps2: 3.0 };
        let (w, b) = (TAU * frequency_hz, decay_per_sec);
        // |A|² of the transform w / ((b + jx)² + w²), summed over steps that grow with frequency, to 1e-6 of the tail.
        let (mut moment, mut sum) = (0.0, 0.0);
        for i in 0..400_000 {
            let at = |i: f64| 0.1 * (i * 5e-5).exp() - 0.1;
            let (low, high) = (at(f64::from(i)), at(f64::from(i) + 1.0));
            let x = 0.5 * (low + high);
            let (re, im) = (b * b - x * x + w * w, 2.0 * b * x);
            let power = w * w / (re * re + im * im) * (high - low);
            (moment, sum) = (moment + x * power, sum + power);
        }
        let (got, wanted) = (tap_centroid(&tap).unwrap().0, moment / sum / TAU);
        assert!((got / wanted - 1.0).abs() < 1e-4, "{got} for {wanted}");
    }
    let still = Tap { frequency: Hertz(0.0), decay_per_sec: 10.0, amplitude_mps2: 1.0 };
    assert_eq!(tap_centroid(&still), None);
}

#[test]
fn what_one_texture_lacks_is_left_out_and_said() {
    let tap = Tap { frequency: Hertz(150.0), decay_per_sec: 40.0, amplitude_mps2: 3.0 };
    let (hard, soft) = (white((1.0, 0.3)).with_tap(Some(tap)), white((0.8, 0.4)));
    let contacts = starter_patterns();
    let both = [NamedTexture { name: "oak", model: &hard }, NamedTexture { name: "felt", model: &soft }];
    let table = physical_table(&both, &contacts).unwrap();
    let names: Vec<&str> = table.names.iter().map(String::as_str).collect();
    assert_eq!(names[4], "friction coefficient");
    assert_eq!((names.len(), table.values.dim(), table.warnings.len()), (5, (2, 5), 3));
    assert!((table.values[[0, 1]] - 1.0).abs() < 1e-9 && (table.values[[1, 1]] - 0.8).abs() < 1e-9);
    let message = table.warnings[0].to_string();
    assert_eq!(message, "feature left out: frequency of a tap (Hz) is unknown for felt");
    let alone = physical_table(&both[..1], &contacts).unwrap();
    assert_eq!((alone.values.dim(), alone.values[[0, 5]], alone.values[[0, 6]]), ((1, 8), 150.0, 40.0));
}
