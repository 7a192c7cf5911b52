//! Forty prompts: what is understood of them, where they lie, and what lies near.
//!
//! `UPDATE_SNAPSHOTS=1 cargo test --test cli forty_prompts` writes the table into `docs/notes/prompts.md`. Read it before
//! you commit it.

use std::fmt::Write as _;
use std::path::Path;

use shagreen_core::maths::gaussian_process::Estimate;
use shagreen_core::surfaces::generated::{Witness, place};
use shagreen_core::surfaces::prompt::{PromptInterpretation, interpret};
use shagreen_core::surfaces::touch_words::ATTRIBUTES;
use shagreen_formats::lexicon_toml::built_in_lexicon;
use shagreen_formats::library::Library;
use shagreen_formats::starter::starter_library;
use shagreen_learn::picture_predictor::PicturePredictor;
use shagreen_studio::generate::{generate_procedurally, nearest};
use shagreen_studio::parallel::in_parallel;

const PROMPTS: &str = include_str!("prompts.toml");
/// Groups of prompts, with the headings of their tables.
const GROUPS: [(&str, &str); 2] = [
    ("unseen", "Written before their author looked at the lexicon"),
    ("chosen", "Written with the lexicon open, for each part of the grammar"),
];
/// Page with the table, and the lines around it.
const PAGE: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/docs/notes/prompts.md");
const BEGIN: &str = "<!-- forty prompts: begin -->\n";
const END: &str = "<!-- forty prompts: end -->\n";
/// Pixels along each side of a picture.
const SIDE: usize = 512;

fn prompts(group: &str) -> Vec<String> {
    let all: toml::Table = toml::from_str(PROMPTS).unwrap();
    let prompts = all[group].as_array().unwrap().iter();
    prompts.map(|prompt| prompt.as_str().unwrap().to_owned()).collect()
}

/// A line of the table. The picture of the prompt must leave the position where the words put it.
fn row(prompt: &str, looker: &PicturePredictor, library: &Library) -> String {
    let understood = interpret(prompt, built_in_lexicon().unwrap());
    let made = generate_procedurally(prompt, &understood, SIDE, 1).unwrap();
    let seen = looker.look(&made.for_prediction()).unwrap();
    let [rough_smooth, hard_soft, ..] = understood.attributes;
    let words = [rough_smooth, hard_soft];
    assert_eq!(made.witness(), Witness::OfTheWords, "{prompt}");
    let placed = place(words, [seen.attributes[0], seen.attributes[1]], made.witness());
    assert_eq!(placed.axes.map(|axis| axis.estimate), words, "{prompt}: the picture moved the words");
    assert_eq!([placed.at.x(), placed.at.y()], words.map(|of| of.mean), "{prompt}");
    let near: Vec<String> =
        nearest(library, placed.at, 3).iter().map(|(texture, _)| texture.name.clone()).collect();
    let numbers =
        understood.attributes.map(|Estimate { mean, deviation }| format!("{mean:.0} ± {deviation:.0}"));
    format!(
        "| {prompt} | {} | {} | {:.0}, {:.0} | {} |\n",
        words_of(&understood),
        numbers.join(" | "),
        placed.at.x(),
        placed.at.y(),
        near.join(", ")
    )
}

/// What the words were taken for, and those that are not known.
fn words_of(understood: &PromptInterpretation) -> String {
    let known = understood.words.iter().map(|word| {
        let not = if word.is_denied { "not " } else { "" };
        format!("{not}{}", word.taken_for)
    });
    let unknown = understood.unknown.iter().map(|word| format!("*{word}?*"));
    known.chain(unknown).collect::<Vec<_>>().join(", ")
}

fn table() -> String {
    let looker = PicturePredictor::built_in(None).unwrap();
    let library = starter_library().unwrap();
    let mut table = String::new();
    for (group, heading) in GROUPS {
        let prompts = prompts(group);
        assert_eq!(prompts.len(), 20, "{group}");
        let names = ATTRIBUTES.join(" | ");
        write!(
            table,
            "\n### {heading}\n\n| prompt | understood | {names} | position | nearest textures |\n|---|---|{}--:|---|\n",
            "--:|".repeat(ATTRIBUTES.len())
        )
        .unwrap();
        table.extend(in_parallel(prompts.len(), |index| row(&prompts[index], &looker, &library)));
    }
    table + "\n"
}

#[test]
fn forty_prompts_lie_where_their_words_put_them_and_the_note_has_their_table() {
    let page = std::fs::read_to_string(PAGE).unwrap();
    let (before, rest) = page.split_once(BEGIN).expect("the page has a place for the table");
    let (kept, after) = rest.split_once(END).expect("the page has a place for the table");
    let table = table();
    if std::env::var_os("UPDATE_SNAPSHOTS").is_some() {
        std::fs::write(Path::new(PAGE), [before, BEGIN, &table, END, after].concat()).unwrap();
        return;
    }
    assert_eq!(
        kept, table,
        "the table has changed; if that is meant, write it again (see the head of this file)"
    );
}
