use super::{
    PAPER_RATE, PAPER_SECS, PatternError, PatternPlan, PatternWarning, paper_patterns, pattern_name,
    render_patterns, starter_patterns,
};
use crate::dsp::spectrum::{rms, welch};
use crate::texture::plane::Plane;
use crate::texture::rate::at_rate;
use crate::texture::test_textures::{arma, two_resonances};
use crate::texture::{GrainNode, TextureModel};
use crate::units::{Contact, Hertz, MetersPerSecond, Newtons};

fn plan(contacts: &[Contact]) -> PatternPlan<'_> {
    PatternPlan { contacts, seconds: PAPER_SECS, rate: PAPER_RATE, seed: 5 }
}

/// Covers the patterns of the paper.
fn wide() -> TextureModel {
    two_resonances(&[0.05, 0.15, 0.25], &[0.1, 0.3, 0.5])
}

#[test]
fn there_are_twenty_five_with_names() {
    assert_eq!((paper_patterns().len(), starter_patterns().len()), (25, 25));
    let names: Vec<String> = paper_patterns().into_iter().map(pattern_name).collect();
    assert_eq!([&names[0], &names[1], &names[24]], ["50 mm/s, 0.1 N", "50 mm/s, 0.2 N", "250 mm/s, 0.5 N"]);
    assert_eq!(pattern_name(starter_patterns()[12]), "120 mm/s, 0.8 N");
}

#[test]
fn patterns_have_the_levels_of_the_model_and_noise_of_their_own() {
    let (model, contacts) = (wide(), paper_patterns());
    let rendered = render_patterns(&model, &plan(&contacts)).unwrap();
    assert!(rendered.warnings.is_empty(), "{:?}", rendered.warnings);
    let plane = Plane::new(&model);
    for (signal, contact) in rendered.signals.iter().zip(&contacts) {
        assert_eq!(signal.len(), 1000);
        // One second of two resonances about 30 Hz wide has about 60 independent values: 9 % standard error, times
        // four.
        let ratio = rms(signal) / plane.at(*contact).level_mps2;
        assert!((ratio - 1.0).abs() < 0.36, "{ratio} at {}", pattern_name(*contact));
    }
    let scaled = |i: usize| rendered.signals[i][0] / rms(&rendered.signals[i]);
    assert!((scaled(0) - scaled(1)).abs() > 1e-3, "two patterns must have different noise");
}

#[test]
fn a_pattern_depends_on_its_seed_and_contact_alone() {
    let (model, contacts) = (wide(), paper_patterns());
    let all = render_patterns(&model, &plan(&contacts)).unwrap().signals;
    assert_eq!(render_patterns(&model, &plan(&contacts[7..9])).unwrap().signals, all[7..9]);
    let other = PatternPlan { seed: 6, ..plan(&contacts[7..9]) };
    assert_ne!(render_patterns(&model, &other).unwrap().signals, all[7..9]);
}

#[test]
fn what_lies_beyond_is_clamped_and_said() {
    let model = two_resonances(&[0.05, 0.1, 0.2], &[0.5, 1.0]);
    let at = |v, f| Contact::from_mm_per_s_and_n(v, f);
    let contacts = [at(100.0, 0.7), at(250.0, 0.7), at(100.0, 3.0)];
    let rendered = render_patterns(&model, &plan(&contacts)).unwrap();
    let warning = rendered.warnings[0].clone();
    assert!(matches!(warning, PatternWarning::Clamped { n: 2, n_patterns: 3, .. }), "{warning:?}");
    assert!(warning.to_string().contains("2 of 3 patterns exceed the texture's range"), "{warning}");
    let highest = Plane::new(&model).at(at(200.0, 0.7)).level_mps2;
    assert!((rms(&rendered.signals[1]) / highest - 1.0).abs() < 0.36);
}

#[test]
fn a_silent_texture_is_said_to_be() {
    let node = |v: f64, f: f64| GrainNode {
        speed: MetersPerSecond(v),
        force: Newtons(f),
        lsf: vec![1.0, 2.0],
        level_mps2: 0.0,
    };
    let model = TextureModel::new(Hertz(1000.0), vec![node(0.3, 1.0)], None).unwrap();
    let rendered = render_patterns(&model, &plan(&paper_patterns())).unwrap();
    assert_eq!(rendered.warnings, [PatternWarning::Silent { n: 25, n_patterns: 25 }]);
}

/// Power of the patterns within a band, in dB re (m/s²)².
fn band_db(model: &TextureModel, rate: Hertz, low: f64, high: f64) -> f64 {
    let contacts = [Contact::from_mm_per_s_and_n(100.0, 0.3)];
    let plan = PatternPlan { contacts: &contacts, seconds: 20.0, rate, seed: 5 };
    let signal = &render_patterns(model, &plan).unwrap().signals[0];
    assert_eq!(signal.len(), (20.0 * rate.0) as usize);
    let density = welch(signal, rate, (0.256 * rate.0) as usize);
    let inside = density.iter().filter(|(f, _)| f.0 >= low && f.0 < high);
    10.0 * (inside.map(|(_, d)| d).sum::<f64>() * rate.0 / (0.256 * rate.0)).log10()
}

#[test]
fn models_of_other_rates_have_the_same_spectrum_where_both_have_one() {
    let slow = wide();
    let fast = at_rate(&slow, Hertz(2000.0)).unwrap().model;
    for (low, high) in [(30.0, 100.0), (100.0, 250.0), (250.0, 430.0)] {
        let wanted = band_db(&slow, PAPER_RATE, low, high);
        // Twenty seconds with about 70 Hz bandwidth: 0.12 dB standard error for each of the two, and 0.3 dB for the
        // conversion.
        let down = band_db(&fast, PAPER_RATE, low, high);
        let up = band_db(&slow, Hertz(2000.0), low, high);
        assert!((down - wanted).abs() < 1.0 && (up - wanted).abs() < 1.0, "{wanted} dB: {down}, {up}");
    }
    let contacts = paper_patterns();
    let warnings =
        |model, rate| render_patterns(model, &PatternPlan { rate, ..plan(&contacts) }).unwrap().warnings;
    let message = warnings(&fast, PAPER_RATE)[0].to_string();
    assert!(message.contains("content above 500 Hz is lost in patterns at 1000 Hz"), "{message}");
    let message = warnings(&slow, Hertz(2000.0))[0].to_string();
    assert!(message.contains("has no content above 500 Hz"), "{message}");
}

#[test]
fn published_textures_have_patterns_too() {
    let rendered = render_patterns(&arma(6, 4), &plan(&paper_patterns())).unwrap();
    assert!(rendered.signals.iter().all(|s| s.len() == 1000 && rms(s) > 0.0));
}

#[test]
fn nonsense_is_refused() {
    let model = wide();
    let refused = |plan: &PatternPlan<'_>| render_patterns(&model, plan).unwrap_err();
    assert_eq!(refused(&plan(&[])), PatternError::None);
    let contacts = [Contact::from_mm_per_s_and_n(100.0, 0.3), Contact::from_mm_per_s_and_n(f64::NAN, 0.3)];
    assert!(matches!(refused(&plan(&contacts)), PatternError::Contact { index: 1, .. }));
    let fine = &contacts[..1];
    for rate_hz in [100.0, 8000.0, f64::NAN] {
        let rate = Hertz(rate_hz);
        assert!(matches!(refused(&PatternPlan { rate, ..plan(fine) }), PatternError::Rate { .. }));
    }
    let endless = PatternPlan { seconds: f64::INFINITY, ..plan(fine) };
    assert!(refused(&endless).to_string().contains("100 mm/s, 0.3 N"), "{}", refused(&endless));
}
