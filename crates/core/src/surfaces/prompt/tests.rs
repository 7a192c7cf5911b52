use proptest::prelude::{prop_assert, proptest};

use super::{PromptInterpretation, Role, interpret};
use crate::maths::gaussian_process::Estimate;
use crate::surfaces::material::PatternKind;
use crate::surfaces::touch_words::{Hints, Lexicon, Meaning, Shade};

fn hints(values: &[(usize, f64, f64)]) -> Hints {
    let mut hints = [None; 5];
    for (attribute, mean, deviation) in values {
        hints[*attribute] = Some(Estimate { mean: *mean, deviation: *deviation });
    }
    hints
}

fn lexicon() -> Lexicon {
    let quality =
        |values: &[(usize, f64, f64)]| Meaning::Quality { hints: hints(values), gloss: None, mottle: None };
    let surface = |like: &str, rs: f64, hs: f64| Meaning::Surface {
        like: like.to_owned(),
        hints: hints(&[(0, rs, 10.0), (1, hs, 8.0)]),
        color_srgb: Some([150, 110, 90]),
        gloss: None,
    };
    let pattern =
        Meaning::Pattern { kind: PatternKind::Ridges, period_m: 2e-3, hints: hints(&[(2, 70.0, 15.0)]) };
    let entries: Vec<(&[&str], Meaning)> = vec![
        (&["rough", "coarse"], quality(&[(0, 14.0, 14.0)])),
        (&["smooth"], quality(&[(0, 88.0, 14.0)])),
        (&["soft"], quality(&[(1, 88.0, 12.0)])),
        (&["carpet", "rug"], surface("loop-carpet", 30.0, 88.0)),
        (&["steel"], surface("polished-metal", 85.0, 1.0)),
        (&["steel wool"], surface("felt", 30.0, 60.0)),
        (&["groove", "ribbed"], pattern),
        (&["red"], Meaning::Color([200, 20, 20])),
        (&["white"], Meaning::Color([250, 250, 250])),
        (&["dark"], Meaning::Shade(Shade { lightness: -0.4, saturation: 0.0 })),
        (&["light"], Meaning::Shade(Shade { lightness: 0.3, saturation: 0.0 })),
        (&["fine"], Meaning::Size(0.5)),
        (&["very"], Meaning::Degree { weight: 2.0, reach: 0.3 }),
        (&["slightly"], Meaning::Degree { weight: 0.5, reach: -0.5 }),
        (&["not", "isnt"], Meaning::Negation),
        (&["a", "is", "like", "surface", "and", "of", "on", "in", "photo", "sketch"], Meaning::Filler),
    ];
    let words = |words: &[&str]| -> Vec<String> { words.iter().map(|word| (*word).to_owned()).collect() };
    let lexicon = Lexicon::new(entries.into_iter().map(|(of, meaning)| (words(of), meaning)).collect());
    lexicon.unwrap().with_depictions(words(&["light", "photo", "sketch"])).unwrap()
}

fn of(prompt: &str) -> PromptInterpretation {
    interpret(prompt, &lexicon())
}

#[test]
fn the_prompt_of_the_paper_is_understood() {
    let understood = of("a rough, soft carpet-like surface");
    let [rough, soft, bumpy, ..] = understood.attributes;
    // Computed by hand: (14/14² + 30/10²) / (1/14² + 1/10²), and so on.
    let (p, q) = (1.0 / 196.0, 1.0 / 100.0);
    assert!((rough.mean - (14.0 * p + 30.0 * q) / (p + q)).abs() < 1e-9);
    assert!((rough.deviation - (1.0 / (p + q)).sqrt()).abs() < 1e-9);
    assert!((soft.mean - 88.0).abs() < 1e-9 && soft.deviation < 8.0);
    assert_eq!((bumpy.mean, bumpy.deviation), (50.0, 28.9));
    assert_eq!(understood.looks.like.as_deref(), Some("loop-carpet"));
    assert!(understood.is_about_touch() && understood.unknown.is_empty() && understood.disputed.is_empty());
    let roles: Vec<Role> = understood.words.iter().map(|word| word.role).collect();
    assert_eq!(roles, [Role::Quality, Role::Quality, Role::Surface]);
}

#[test]
fn degrees_and_negations_go_with_the_next_word() {
    let mean = |prompt: &str| of(prompt).attributes[0].mean;
    assert!(mean("very rough") < mean("rough") && mean("rough") < mean("slightly rough"));
    assert_eq!(mean("not rough"), 86.0);
    assert_eq!(mean("it isn't rough"), 86.0);
    assert!(of("not rough").attributes[0].deviation > of("rough").attributes[0].deviation);
    // A modifier does not apply across a comma, and applies to one word only.
    assert_eq!(mean("not, rough"), 14.0);
    let two = of("not rough and soft");
    assert!(two.words[0].is_denied && !two.words[1].is_denied);
    assert_eq!(of("not a carpet").looks.like, None);
    assert_eq!(mean("not not rough"), 14.0);
}

#[test]
fn adjectives_of_a_picture_or_of_light_say_nothing_about_the_surface() {
    for prompt in [
        "a rough sketch of steel",
        "soft light on steel",
        "rough photos of steel",
        "very soft light on steel",
        "soft red light on steel",
        "steel in soft light",
        "steel, soft light, smooth photo",
        "not soft light on steel",
    ] {
        let understood = of(prompt);
        assert_eq!(understood.attributes, of("steel").attributes, "{prompt}");
        assert_eq!(understood.looks.color_srgb, Some([150, 110, 90]), "{prompt}");
    }
    assert_eq!(of("very soft light on rough steel").attributes, of("rough steel").attributes);
    // Adjectives of the surface.
    for (prompt, plain) in [
        ("soft light steel", "soft steel"),
        ("soft light red steel", "soft steel"),
        ("a steel that is soft and light", "soft steel"),
        ("soft light and smooth steel", "soft smooth steel"),
        ("soft, light on steel", "soft steel"),
        ("a soft light", "soft"),
        ("a rough sketch", "rough"),
        ("rough surface photo", "rough"),
    ] {
        assert_eq!(of(prompt).attributes, of(plain).attributes, "{prompt}");
    }
}

#[test]
fn words_that_disagree_leave_it_open() {
    let understood = of("rough and smooth");
    assert!((understood.attributes[0].mean - 51.0).abs() < 1e-9);
    assert!(understood.attributes[0].deviation > 25.0);
    assert_eq!(understood.disputed, ["rough-smooth"]);
}

#[test]
fn the_longest_phrase_and_inflections_count() {
    assert_eq!(of("steel wool").looks.like.as_deref(), Some("felt"));
    assert_eq!(of("steel").looks.like.as_deref(), Some("polished-metal"));
    for prompt in ["carpets", "Rugs", "carpett", "a carpetlike thing"] {
        assert_eq!(of(prompt).looks.like.as_deref(), Some("loop-carpet"), "{prompt}");
    }
    assert_eq!(of("rougher").attributes[0].mean, 14.0);
    // The last surface is the object, the one before it a modifier.
    let both = of("steel carpet");
    assert_eq!(both.looks.like.as_deref(), Some("loop-carpet"));
    assert!(both.attributes[1].mean > 50.0);
}

#[test]
fn looks_are_collected() {
    let looks = of("dark red and white ribbed carpet, 1.5 mm grooves, fine").looks;
    assert_eq!((looks.color_srgb, looks.second_srgb), (Some([200, 20, 20]), Some([250, 250, 250])));
    assert_eq!((looks.pattern, looks.is_period_stated), (Some((PatternKind::Ridges, 1.5e-3)), true));
    assert!(!of("fine ribbed carpet").looks.is_period_stated);
    assert_eq!((looks.shade.lightness, looks.scale), (-0.4, 0.5));
    assert_eq!(of("carpet").looks.color_srgb, Some([150, 110, 90]));
    assert_eq!(of("not ribbed").looks.pattern, None);
    assert!((of("not ribbed").attributes[2].mean - 30.0).abs() < 1e-9);
}

#[test]
fn what_says_nothing_is_open_and_said() {
    for prompt in
        ["", "   ", "...", "\u{7c97}\u{3044}", "xyzzy plugh", "\u{1f600}", "\u{645}\u{644}\u{645}\u{633}"]
    {
        let understood = of(prompt);
        assert!(!understood.is_about_touch(), "{prompt}");
        assert!(understood.attributes.iter().all(|a| a.mean == 50.0 && a.deviation > 28.0));
    }
    assert_eq!(of("xyzzy rough").unknown, ["xyzzy"]);
    let long = format!("rough {}", "blah ".repeat(5000));
    let understood = of(&long);
    assert_eq!(understood.attributes[0].mean, 14.0);
    assert_eq!(understood.n_left_out, 5001 - 400);
}

proptest! {
    #[test]
    fn any_text_has_a_sensible_answer(prompt in ".{0,200}") {
        for attribute in of(&prompt).attributes {
            prop_assert!((0.0..=100.0).contains(&attribute.mean));
            prop_assert!((4.0..=28.9).contains(&attribute.deviation));
        }
    }

    #[test]
    fn any_words_of_the_lexicon_have_a_sensible_answer(indices in proptest::collection::vec(0..30_usize, 0..20)) {
        let lexicon = lexicon();
        let all: Vec<&str> = lexicon.words().map(|(word, _)| word).collect();
        let prompt: Vec<&str> = indices.iter().map(|i| all[i % all.len()]).collect();
        let understood = of(&prompt.join(" "));
        for attribute in understood.attributes {
            prop_assert!((0.0..=100.0).contains(&attribute.mean) && attribute.deviation >= 4.0);
        }
        prop_assert!(understood.unknown.is_empty());
    }
}

#[test]
fn a_word_that_is_said_again_says_nothing_new() {
    let once = of("rough rug");
    let often = of("rough rough carpet and a rough, rough rug, rough rug");
    assert_eq!(often.attributes, once.attributes);
    assert_eq!(often.looks, once.looks);
    // "Carpet" and "rug" are synonyms.
    assert!(often.words.len() <= 3, "{:?}", often.words);
    // Two different degrees give two different estimates.
    assert_ne!(of("rough, very rough").attributes, of("rough").attributes);
}

#[test]
fn titles_are_short_and_of_one_line() {
    assert_eq!(super::title("  a\n rough\tone ", 40).as_deref(), Some("a rough one"));
    assert_eq!(super::title(" \u{7}\n", 40), None);
    assert_eq!(super::title("abcdef", 4).as_deref(), Some("abc…"));
    assert_eq!(super::title("粗い布", 3).as_deref(), Some("粗い布"));
}
