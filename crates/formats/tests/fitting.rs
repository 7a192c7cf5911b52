//! Fitting strokes that were rendered from a known texture recovers its spectra.
//!
//! The strokes are simulated: the renderer with a hand that moves back and forth, on the 25 textures of the starter
//! library. Some time ranges are held out from the fit. There the fitted model is compared with the strokes and with
//! the original texture.
#![allow(
    clippy::unwrap_used,
    clippy::print_stdout,
    reason = "a test may panic on an unexpected result, and prints its figures on request"
)]

use std::f64::consts::TAU;

use shagreen_core::dsp::ar::comparison_frequencies;
use shagreen_core::dsp::spectrum::goodness_of_fit;
use shagreen_core::recording::Recording;
use shagreen_core::recording::fit::{FitOptions, Fitted, HeldOut, fit};
use shagreen_core::recording::segment::segment;
use shagreen_core::texture::TextureModel;
use shagreen_core::texture::blend::Mode;
use shagreen_core::texture::plane::Plane;
use shagreen_core::texture::render::{RenderPlan, render};
use shagreen_core::units::{Contact, Hertz, MetersPerSecond, Newtons};
use shagreen_formats::library::TextureEntry;
use shagreen_formats::starter::starter_library;

const RATE: Hertz = Hertz(1000.0);
const SECONDS: f64 = 40.0;

/// Simulated hand motion: back-and-forth strokes with slowly varying length and tempo, and a more slowly varying force.
fn hand(t: f64) -> Contact {
    let wander = |period_secs: f64, phase: f64| 0.5 + 0.5 * (TAU * t / period_secs + phase).sin();
    let phase = TAU * (0.55 * t + 0.8 * (TAU * t / 11.0).sin());
    let top_mps = 0.03 + 0.22 * (0.6 * wander(9.7, 0.0) + 0.4 * wander(3.1, 1.0));
    let force_n = 0.2 + 2.8 * (0.7 * wander(13.3, 2.0) + 0.3 * wander(5.3, 0.3)).powi(2);
    Contact { speed: MetersPerSecond(top_mps * phase.sin().abs()), force: Newtons(force_n) }
}

/// Renders simulated strokes on a texture. Without stick-slip, which a fit of the grain cannot know.
fn strokes(model: &TextureModel, seed: u64) -> Recording {
    let prepared = Plane::new(&model.clone().with_stick_slip(None)).prepare();
    let plan =
        RenderPlan { parents: &[(&prepared, 1.0)], mode: Mode::Shared, rate: RATE, seconds: SECONDS, seed };
    let acceleration_mps2: Vec<f64> = render(&plan, &mut hand).unwrap().into_iter().map(f64::from).collect();
    let contacts = (0..acceleration_mps2.len()).map(|i| hand(i as f64 / RATE.0));
    let (speed_mps, force_n) = contacts.map(|c| (c.speed.0, c.force.0)).unzip();
    let usable = std::iter::once(0..acceleration_mps2.len()).collect();
    Recording { rate: RATE, acceleration_mps2, speed_mps, force_n, usable }
}

/// Median goodness of fit (GFC), and median absolute level error in dB.
#[derive(Clone, Copy, Debug)]
struct Agreement {
    gfc: f64,
    level_db: f64,
}

fn median(values: impl Iterator<Item = f64>) -> f64 {
    let mut values: Vec<f64> = values.collect();
    values.sort_by(f64::total_cmp);
    values[values.len() / 2]
}

/// Compares the fitted model with the true one at the stationary segments of `unseen`.
fn against_truth(fitted: &Fitted, model: &TextureModel, unseen: &Recording) -> Agreement {
    let frequencies = comparison_frequencies(RATE, 256);
    let (truth, ours) = (Plane::new(model), Plane::new(&fitted.model));
    let stretches = segment(unseen, 0.1).stretches;
    let both = |s: &shagreen_core::recording::segment::Stretch| {
        let contact = Contact { speed: s.speed, force: s.force };
        (ours.at(contact), truth.at(contact))
    };
    Agreement {
        gfc: median(stretches.iter().map(|s| {
            let (ours, truth) = both(s);
            goodness_of_fit(&ours.psd(&frequencies), &truth.psd(&frequencies))
        })),
        level_db: median(stretches.iter().map(|s| {
            let (ours, truth) = both(s);
            (20.0 * (ours.level_mps2 / truth.level_mps2).log10()).abs()
        })),
    }
}

/// Results for one texture.
struct Outcome {
    held_out: Agreement,
    truth: Agreement,
    /// Agreement with the next texture of the library, as a negative control.
    other: Agreement,
}

/// Fits the simulated strokes of the texture with this index.
fn outcome(index: usize, textures: &[TextureEntry]) -> Outcome {
    let texture = &textures[index];
    let recording = strokes(&texture.model, index as u64 + 1);
    let all = fit(std::slice::from_ref(&recording), &FitOptions::usual()).unwrap();
    assert_eq!(all.report.held_out, HeldOut::Segments);
    let held_out = Agreement { gfc: all.report.gfc_median(), level_db: all.report.level_error_db_median() };
    // For the comparison with the true texture, every fifth second is held out.
    let (mut seen, mut unseen) = (recording.clone(), recording);
    seen.usable = (0..8).map(|i| 5000 * i..5000 * i + 4000).collect();
    unseen.usable = (0..8).map(|i| 5000 * i + 4000..5000 * (i + 1)).collect();
    let fitted = fit(&[seen], &FitOptions::usual()).unwrap();
    let truth = against_truth(&fitted, &texture.model, &unseen);
    println!(
        "{:<24} order {:2}, {:3} segments, coverage {:.2}: held-out {:.3} {:.2} dB, truth {:.3} {:.2} dB",
        texture.name,
        fitted.report.order,
        fitted.report.segments.len(),
        fitted.report.coverage,
        held_out.gfc,
        held_out.level_db,
        truth.gfc,
        truth.level_db
    );
    let next = &textures[(index + 1) % textures.len()];
    Outcome { held_out, truth, other: against_truth(&fitted, &next.model, &unseen) }
}

#[test]
fn forty_seconds_of_strokes_give_back_the_texture() {
    let textures = starter_library().unwrap().textures;
    let outcomes: Vec<Outcome> = std::thread::scope(|scope| {
        let textures = &textures;
        let every_other = |first: usize| {
            move || (first..textures.len()).step_by(2).map(|i| outcome(i, textures)).collect::<Vec<_>>()
        };
        let halves = [0, 1].map(|first| scope.spawn(every_other(first)));
        halves.into_iter().flat_map(|half| half.join().unwrap()).collect()
    });
    let of = |which: fn(&Outcome) -> Agreement| outcomes.iter().map(which).collect::<Vec<_>>();
    let (measured, true_to, others) = (of(|o| o.held_out), of(|o| o.truth), of(|o| o.other));
    for (name, agreements) in [("held-out segments", measured), ("the texture itself", true_to)] {
        let gfc = median(agreements.iter().map(|a| a.gfc));
        let level_db = median(agreements.iter().map(|a| a.level_db));
        let worst_gfc = agreements.iter().map(|a| a.gfc).fold(1.0, f64::min);
        let worst_db = agreements.iter().map(|a| a.level_db).fold(0.0, f64::max);
        println!("{name}: median {gfc:.3} {level_db:.2} dB, worst {worst_gfc:.3} {worst_db:.2} dB");
        assert!(gfc >= 0.95, "{name}: {gfc}");
        assert!(level_db < 1.0, "{name}: {level_db}");
        // Even the worst texture must stay recognizable. Measured: 0.925 and 0.92 dB.
        assert!(worst_gfc > 0.9 && worst_db < 1.3, "{name}: {worst_gfc}, {worst_db} dB");
    }
    // Negative control: compared with the next texture, hardly any model would pass.
    let would_pass = others.iter().filter(|a| a.gfc >= 0.95 && a.level_db < 1.0).count();
    println!("compared with another texture, {would_pass} of {} would pass", others.len());
    assert!(would_pass <= 2, "{others:?}");
}
