use std::f64::consts::TAU;
use std::sync::Arc;

use shagreen_core::dsp::spectrum::{median, welch};
use shagreen_core::surfaces::prompt::interpret;
use shagreen_core::surfaces::shading::Picture as Surface;
use shagreen_core::texture::TextureModel;
use shagreen_core::texture::blend::Mode;
use shagreen_core::texture::plane::Plane;
use shagreen_core::texture::render::{RenderPlan, render};
use shagreen_core::units::{Contact, Hertz};
use shagreen_formats::built_in::BuiltIn;
use shagreen_formats::lexicon_toml::built_in_lexicon;
use shagreen_formats::library::TextureEntry;
use shagreen_formats::picture::{Rgb, encode_jpeg};
use shagreen_formats::project::{AuthoredTexture, Project, ProjectLibrary};
use shagreen_formats::starter::starter_library;

use super::{FELT_ORIGIN, felt, felt_entry, join_felt};
use crate::generate::{GeneratedPicture, generate_procedurally};
use crate::parallel::in_parallel;

/// Descriptions and the period in mm that they state.
const PERIODS: [(&str, f64); 10] = [
    ("ridges 5 mm apart", 5.0),
    ("corrugated cardboard with 4 mm flutes", 4.0),
    ("grooved hard plastic with 5 mm ridges", 5.0),
    ("3 mm ribs in rubber", 3.0),
    ("ribbed steel, 2 mm", 2.0),
    ("a wooden board with 6 mm grooves", 6.0),
    ("fine ridges 1 mm apart on glass", 1.0),
    ("reeded oak, 2.5 mm", 2.5),
    ("a washboard with 8 mm ripples", 8.0),
    ("leather with wide grooves, 7 mm", 7.0),
];

/// A period is searched from this share of it up to its inverse, which leaves out its double and its half.
const SEARCHED: f64 = 0.7;

const RATE: Hertz = Hertz(1000.0);

fn generated(prompt: &str, side: usize) -> GeneratedPicture {
    let understood = interpret(prompt, built_in_lexicon().unwrap());
    generate_procedurally(prompt, &understood, side, 1).unwrap()
}

/// Frequency in Hz of the strongest peak near `expected_hz` in a stroke across a texture at 100 mm/s and 1 N, and its
/// density over the median density around it.
fn peak_of_stroke(model: &TextureModel, expected_hz: f64) -> (f64, f64) {
    let prepared = Plane::new(model).prepare();
    let plan =
        RenderPlan { parents: &[(&prepared, 1.0)], mode: Mode::Field, rate: RATE, seconds: 8.0, seed: 1 };
    let contact = Contact::from_mm_per_s_and_n(100.0, 1.0);
    let signal = render(&plan, &mut |_: f64| contact).unwrap();
    let signal: Vec<f64> = signal.into_iter().map(f64::from).collect();
    // Windows of 4 s resolve 0.25 Hz.
    let density = welch(&signal, RATE, 4000);
    let near: Vec<(f64, f64)> = density
        .iter()
        .map(|(at, power)| (at.0, *power))
        .filter(|(at, _)| (SEARCHED * expected_hz..=expected_hz / SEARCHED).contains(at))
        .collect();
    let (at, power) = near.iter().copied().max_by(|a, b| a.1.total_cmp(&b.1)).unwrap();
    (at, power / median(near.iter().map(|(_, power)| *power).collect()))
}

/// Period in mm of a seamless picture along its rows, near `expected_mm`: the lag of the highest circular autocorrelation of
/// the mean brightness of its columns.
fn period_of_picture(picture: &Surface, expected_mm: f64) -> f64 {
    let n = picture.width;
    let mut columns = vec![0.0; n];
    for (i, pixel) in picture.rgb.chunks_exact(3).enumerate() {
        columns[i % n] += pixel.iter().map(|channel| f64::from(*channel)).sum::<f64>();
    }
    let mean = columns.iter().sum::<f64>() / n as f64;
    // The circular autocorrelation at any lag, from the power of each wave that fits the picture.
    let powers: Vec<f64> = (1..=n / 4)
        .map(|k| {
            let phase = |i: usize| TAU * ((k * i) % n) as f64 / n as f64;
            let sum = |of: fn(f64) -> f64| {
                columns.iter().enumerate().map(|(i, x)| (x - mean) * of(phase(i))).sum::<f64>()
            };
            sum(f64::cos).powi(2) + sum(f64::sin).powi(2)
        })
        .collect();
    let correlation = |lag_mm: f64| {
        let turns = lag_mm / picture.millimeters;
        powers.iter().zip(1..).map(|(power, k)| power * (TAU * f64::from(k) * turns).cos()).sum::<f64>()
    };
    let lags =
        (0..=800).map(|i| expected_mm * (SEARCHED + (1.0 / SEARCHED - SEARCHED) * f64::from(i) / 800.0));
    lags.max_by(|a, b| correlation(*a).total_cmp(&correlation(*b))).unwrap()
}

#[test]
fn a_period_is_heard_and_seen_as_it_is_described() {
    let said = in_parallel(PERIODS.len(), |index| {
        let (prompt, period_mm) = PERIODS[index];
        let made = generated(prompt, 256);
        let seen_mm = period_of_picture(&made.picture, period_mm);
        let relief = made.relief.unwrap();
        let model = felt(&relief.surface, |_, _| true).unwrap().unwrap();
        let (heard_hz, above) = peak_of_stroke(&model, 100.0 / period_mm);
        let (heard, seen) = (heard_hz * period_mm / 100.0, seen_mm / period_mm);
        let is_right = (heard - 1.0).abs() < 0.05 && (seen - 1.0).abs() < 0.05 && above > 10.0;
        (!is_right).then(|| {
            format!(
                "{prompt}: peak at {heard:.3} and picture at {seen:.3} of it, {above:.1} times the median"
            )
        })
    });
    let wrong: Vec<String> = said.into_iter().flatten().collect();
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
}

#[test]
fn a_texture_is_simulated_step_by_step_and_can_be_stopped() {
    let relief = generated("sandstone", 64).relief.unwrap();
    let steps = std::cell::RefCell::new(Vec::new());
    let model = felt(&relief.surface, |done, of| {
        steps.borrow_mut().push((done, of));
        true
    });
    let steps = steps.into_inner();
    let n = steps.len();
    assert!(n >= 25 && steps.first() == Some(&(1, n)) && steps.last() == Some(&(n, n)), "{steps:?}");
    let model = model.unwrap().unwrap();
    assert!(model.tap().is_some() && model.friction().is_some());
    assert!(felt(&relief.surface, |done, _| done < 2).unwrap().is_none());
}

#[test]
fn the_entry_says_where_it_comes_from() {
    let made = generated("sandstone", 64);
    let model = felt(&made.relief.unwrap().surface, |_, _| true).unwrap().unwrap();
    let picture = encode_jpeg(&Rgb::from(&made.picture), made.picture.millimeters).unwrap();
    let entry = felt_entry("stone".to_owned(), "Stone", "Generated from a prompt.", model, picture, None);
    assert_eq!(
        entry.description,
        "Simulated from its height field; nobody rated it. Generated from a prompt."
    );
    assert_eq!((entry.origin.as_str(), entry.place), (FELT_ORIGIN, None));
}

/// Entry without a position, like one next to another texture.
fn entry(id: &str) -> Arc<TextureEntry> {
    let texture = starter_library().unwrap().textures[0].clone();
    Arc::new(TextureEntry { id: id.to_owned(), origin: FELT_ORIGIN.to_owned(), place: None, ..texture })
}

#[test]
fn a_simulated_texture_replaces_the_earlier_one_unless_something_else_needs_it() {
    let (earlier, later) = (entry("earlier"), entry("later"));
    let mut project = Project::new(ProjectLibrary::BuiltIn(BuiltIn::Starter), "Stone");
    join_felt(&mut project, 1, Arc::clone(&earlier), None);
    assert!(project.texture().blend.locked.contains("earlier"), "pinned without a position, too");
    assert!(project.is_own(0), "no other authored texture changes");
    let joined_after = |change: &dyn Fn(&mut Project)| {
        let mut project = project.clone();
        change(&mut project);
        join_felt(&mut project, 1, Arc::clone(&later), Some(&earlier));
        assert_eq!(project.solo.as_deref(), Some("later"));
        assert!(project.texture().blend.locked.contains("later"));
        assert!(project.own.contains("later"));
        project.joined.iter().map(|joined| joined.id.clone()).collect::<Vec<_>>()
    };
    assert_eq!(joined_after(&|_| ()), ["later"]);
    let needs: [&dyn Fn(&mut Project); 6] = [
        &|project| project.snapshots.push(Arc::clone(&project.authored[0])),
        &|project| project.starred.extend(["earlier".to_owned()]),
        &|project| project.renamed.extend([("earlier".to_owned(), "Mine".to_owned())]),
        &|project| {
            let other = AuthoredTexture { key: 2, ..project.texture().clone() };
            project.authored.push(Arc::new(other));
        },
        &|project| Arc::make_mut(&mut project.authored[0]).blend.locked.clear(),
        // The same texture from a file.
        &|project| project.joined = vec![Arc::new(TextureEntry::clone(&earlier))],
    ];
    for (index, need) in needs.into_iter().enumerate() {
        assert_eq!(joined_after(need), ["earlier", "later"], "need {index}");
    }
}
