//! Prompts in a space with five axes: what the words tell, and the local mean of the other axes.

use egui::Key;
use egui_kittest::kittest::Queryable as _;
use shagreen_app::strings::{self, axes as axes_words, prompt as words};
use shagreen_core::surfaces::prompt::{OPEN, interpret};
use shagreen_core::surfaces::touch_words::ATTRIBUTES;
use shagreen_formats::lexicon_toml::built_in_lexicon;
use shagreen_formats::starter::simulated_library;

use super::{point, use_axes};
use crate::support::{Author, author_on, click, says, wait, wait_for_field, window, write_into};

pub(super) fn describe(harness: &mut Author, prompt: &str) {
    let n = window(harness).project().authored.len();
    write_into(harness, words::FIELD, prompt);
    harness.key_press(Key::Enter);
    wait(harness, "it was made", |h| window(h).project().authored.len() > n);
    wait(harness, "it was simulated", |h| !window(h).prompts().is_simulating());
    harness.run_steps(4);
}

#[test]
fn a_prompt_sets_the_axes_that_its_words_tell() {
    let mut harness = author_on(simulated_library().unwrap(), [1280.0, 720.0]);
    wait_for_field(&mut harness);
    use_axes(&mut harness, &ATTRIBUTES);
    let prompt = "rough and sticky";
    describe(&mut harness, prompt);
    let told = interpret(prompt, built_in_lexicon().unwrap()).attributes;
    let texture = window(&harness).project().texture().clone();
    let guess = window(&harness).prompts().guess_of(&texture).expect("it was estimated").clone();
    assert_eq!((guess.axes.as_slice(), guess.at()), (&told[..], texture.at));
    let (mut n_told, mut n_untold) = (0, 0);
    for (axis, (name, estimate)) in ATTRIBUTES.iter().zip(told).enumerate() {
        let coordinate = texture.at.get(axis).expect("five axes");
        if estimate == OPEN {
            assert_eq!(guess.mean(axis), Some(coordinate));
            assert!(says(&harness, &axes_words::untold(name, coordinate)), "{name}");
            n_untold += 1;
        } else {
            assert_eq!((guess.mean(axis), coordinate), (None, estimate.mean), "{name}");
            n_told += 1;
        }
    }
    assert!(n_told > 0 && n_untold > 0, "{n_told} told, {n_untold} not");
    // The mean of what is near on the told axes.
    let values: Vec<Option<f64>> =
        told.iter().map(|estimate| (*estimate != OPEN).then_some(estimate.mean)).collect();
    assert_eq!(window(&harness).session().completed(&values), texture.at);

    // On other axes, the estimate is not shown, until undo brings its axes back.
    use_axes(&mut harness, &["rough-smooth", "hard-soft"]);
    assert!(harness.query_by_label(&words::guessed(&guess.name)).is_none());
    click(&mut harness, strings::UNDO);
    harness.run_steps(2);
    assert!(harness.query_by_label(&words::guessed(&guess.name)).is_some());
    assert_eq!(point(&harness), texture.at);
}
