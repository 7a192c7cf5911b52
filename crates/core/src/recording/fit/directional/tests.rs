use super::{DirectedRecording, FittedDirections, LEAST_MODULATION_DB, fit_directions};
use crate::dsp::ar::{psd, test_signals::from_resonances};
use crate::dsp::spectrum::{goodness_of_fit, rms};
use crate::maths::rng::lcg_noise;
use crate::recording::Recording;
use crate::recording::fit::{FitError, FitOptions};
use crate::texture::GrainNode;
use crate::texture::plane::Plane;
use crate::units::{Contact, Hertz};
use std::f64::consts::{PI, TAU};

const RATE: Hertz = Hertz(1000.0);
const ACROSS: [(Hertz, f64); 2] = [(Hertz(90.0), 0.9), (Hertz(230.0), 0.9)];
const ALONG: [(Hertz, f64); 2] = [(Hertz(160.0), 0.9), (Hertz(320.0), 0.9)];
/// Speed in mm/s, force in N and duration in s of the strokes in each direction.
const CONTACTS: [(f64, f64); 4] = [(60.0, 0.5), (120.0, 0.5), (60.0, 1.0), (120.0, 1.0)];
const STROKE_SECS: f64 = 1.5;
const EIGHT: [f64; 8] = [0.0, 45.0, 90.0, 135.0, 180.0, 225.0, 270.0, 315.0];

/// Surface whose power across and along its lay is known.
struct Surface {
    /// Direction across the lay, in degrees.
    across_deg: f64,
    /// Level along the lay relative to the level across it, in dB.
    along_db: f64,
    along: [(Hertz, f64); 2],
}

impl Surface {
    fn level_across_mps2(contact: Contact) -> f64 {
        5.0 * contact.speed.0.powf(0.9) * contact.force.0.powf(0.3)
    }

    /// Noise with these resonances and the root mean square 1.
    fn noise(resonances: &[(Hertz, f64)], n: usize, seed: u64) -> Vec<f64> {
        let ar = from_resonances(RATE, resonances);
        let mut x = lcg_noise(n, seed);
        for i in 0..n {
            x[i] -= (1..=ar.len().min(i)).map(|k| ar[k - 1] * x[i - k]).sum::<f64>();
        }
        let scale = 1.0 / rms(&x);
        x.iter().map(|x| scale * x).collect()
    }

    /// Strokes in one direction at all contacts; powers across and along are independent and add up.
    fn strokes(&self, direction_deg: f64, seed: u64) -> DirectedRecording {
        let n_stroke = (STROKE_SECS * RATE.0) as usize;
        let n = n_stroke * CONTACTS.len();
        let share = (direction_deg - self.across_deg).to_radians().sin().powi(2);
        let across = Self::noise(&ACROSS, n, 2 * seed);
        let along = Self::noise(&self.along, n, 2 * seed + 1);
        let contact = |i: usize| {
            let (mm_per_s, force_n) = CONTACTS[i / n_stroke];
            Contact::from_mm_per_s_and_n(mm_per_s, force_n)
        };
        let along_level = 10_f64.powf(0.05 * self.along_db);
        let acceleration = |i: usize| {
            let grain = (1.0 - share).sqrt() * across[i] + share.sqrt() * along_level * along[i];
            9.81 + Self::level_across_mps2(contact(i)) * grain
        };
        DirectedRecording {
            direction_rad: direction_deg.to_radians(),
            recording: Recording {
                rate: RATE,
                acceleration_mps2: (0..n).map(acceleration).collect(),
                speed_mps: (0..n).map(|i| contact(i).speed.0).collect(),
                force_n: (0..n).map(|i| contact(i).force.0).collect(),
                usable: std::iter::once(0..n).collect(),
            },
        }
    }

    /// Strokes in these directions, each twice.
    fn recordings(&self, directions_deg: &[f64]) -> Vec<DirectedRecording> {
        let both = directions_deg.iter().chain(directions_deg).zip(1..);
        both.map(|(direction, seed)| self.strokes(*direction, seed)).collect()
    }

    fn fitted(&self, directions_deg: &[f64]) -> FittedDirections {
        fit_directions(self.recordings(directions_deg), &FitOptions::usual()).unwrap()
    }
}

/// Largest level error in dB of nodes whose true level relative to the level across the lay is `offset_db`.
fn worst_db(nodes: &[GrainNode], offset_db: f64) -> f64 {
    let error_db = |node: &GrainNode| {
        let contact = Contact { speed: node.speed, force: node.force };
        20.0 * (node.level_mps2 / Surface::level_across_mps2(contact)).log10() - offset_db
    };
    nodes.iter().map(|node| error_db(node).abs()).fold(0.0, f64::max)
}

/// Smallest goodness of fit of nodes of a plane to a spectrum.
fn worst_gfc(plane: &Plane, nodes: &[GrainNode], resonances: &[(Hertz, f64)]) -> f64 {
    let frequencies: Vec<Hertz> = (10..490).map(|f| Hertz(f64::from(f))).collect();
    let truth = psd(&from_resonances(RATE, resonances), 1.0, RATE, &frequencies);
    let of = |node: &GrainNode| {
        let contact = Contact { speed: node.speed, force: node.force };
        goodness_of_fit(&plane.at(contact).psd(&frequencies), &truth)
    };
    nodes.iter().map(of).fold(1.0, f64::min)
}

#[track_caller]
fn check_lay(across_deg: f64, along_db: f64, directions_deg: &[f64]) {
    let surface = Surface { across_deg, along_db, along: ALONG };
    let fitted = surface.fitted(directions_deg);
    let (model, report) = (&fitted.model, &fitted.report);
    let lay_rad = report.lay_rad.expect("a lay");
    let off_deg = (lay_rad - (across_deg + 90.0).to_radians()).sin().asin().to_degrees().abs();
    assert!(off_deg < 10.0, "the lay is off by {off_deg}°");
    let turned_rad = (model.turn_rad() + 0.5 * PI - lay_rad).sin().abs();
    assert!(turned_rad < 1e-9, "the texture lies as it was measured");
    let mut axes_deg: Vec<i64> =
        directions_deg.iter().map(|deg| deg.rem_euclid(180.0).round() as i64).collect();
    axes_deg.sort_unstable();
    axes_deg.dedup();
    let is_assumed = report.notes.iter().any(|note| note.contains("assumed to lie along one of them"));
    assert_eq!(is_assumed, axes_deg.len() == 2, "{:?}", report.notes);
    let modulation_db = report.modulation_db.unwrap();
    assert!((modulation_db + along_db).abs() < 1.0, "{modulation_db} dB, expected {}", -along_db);
    assert!(report.chance_db.unwrap() < 1.0, "{:?}", report.chance_db);

    let along = model.along().expect("grain along the lay");
    let contacts = |nodes: &[GrainNode]| -> Vec<[f64; 2]> {
        nodes.iter().map(|node| [node.speed.0, node.force.0]).collect()
    };
    assert_eq!(contacts(along), contacts(model.nodes()));
    assert!(along.iter().all(|node| node.lsf.len() == model.order()));
    // Six seconds a node and axis, of some 150 Hz statistical bandwidth, have a standard error of 0.15 dB.
    let (across_db, along_error_db) = (worst_db(model.nodes(), 0.0), worst_db(along, along_db));
    assert!(across_db < 1.0 && along_error_db < 1.0, "{across_db} and {along_error_db} dB");
    // Burg's method on so much signal gives 0.98 at least; nodes at the ends of strokes have less.
    let plane = Plane::new(model);
    let gfc = [worst_gfc(&plane, model.nodes(), &ACROSS), worst_gfc(plane.along().unwrap(), along, &ALONG)];
    assert!(gfc.iter().all(|gfc| *gfc > 0.9), "{gfc:?}");
    // Between the axes of the lay, the model mixes line spectral frequencies, which moves resonances instead of mixing
    // them: at 45°, these two spectra agree to 0.72.
    assert!(report.level_error_db_median < 1.0 && report.gfc_median > 0.6, "{report:?}");
}

#[test]
fn a_lay_along_a_measured_direction_is_recovered() {
    check_lay(90.0, -6.0, &EIGHT);
}

#[test]
fn a_lay_between_measured_directions_is_recovered() {
    check_lay(25.0, -6.0, &EIGHT);
}

#[test]
fn two_directions_show_a_lay_along_one_of_them() {
    check_lay(0.0, -5.0, &[0.0, 90.0]);
}

#[test]
fn directions_are_counted_and_their_levels_reported() {
    let surface = Surface { across_deg: 0.0, along_db: -6.0, along: ALONG };
    let report = surface.fitted(&EIGHT).report;
    let degrees: Vec<f64> = report.directions.iter().map(|d| d.direction_rad.to_degrees().round()).collect();
    assert_eq!(degrees, EIGHT);
    assert!(report.directions.iter().all(|d| d.n_recordings == 2 && d.seconds > 8.0));
    // Across is louder than the mean of all directions, along is quieter, by 6 dB together.
    let difference_db = report.directions[0].level_db - report.directions[2].level_db;
    assert!((difference_db - 6.0).abs() < 1.0, "{difference_db}");
    assert_eq!((report.rate, report.tap), (RATE, None));
    assert!(report.notes.iter().all(|note| !note.contains("differ by")), "{:?}", report.notes);
}

#[test]
fn an_isotropic_surface_has_no_grain_along_a_lay() {
    let surface = Surface { across_deg: 0.0, along_db: 0.0, along: ACROSS };
    let fitted = surface.fitted(&EIGHT);
    assert!(fitted.model.along().is_none() && fitted.report.lay_rad.is_none());
    assert_eq!(fitted.model.turn_rad(), 0.0);
    assert!(fitted.report.modulation_db.unwrap() < LEAST_MODULATION_DB);
    assert!(worst_db(fitted.model.nodes(), 0.0) < 1.0);
}

#[test]
fn a_modulation_below_the_spread_of_the_strokes_is_chance() {
    // The strokes of each direction differ by 12 dB, and the directions by 2 dB on average.
    let surface = Surface { across_deg: 0.0, along_db: -2.0, along: ALONG };
    let mut strokes = surface.recordings(&EIGHT);
    for (i, stroke) in strokes.iter_mut().enumerate() {
        let gain = if i < EIGHT.len() { 2.0 } else { 0.5 };
        for a in &mut stroke.recording.acceleration_mps2 {
            *a = 9.81 + gain * (*a - 9.81);
        }
    }
    let report = fit_directions(strokes, &FitOptions::usual()).unwrap().report;
    let (found_db, chance_db) = (report.modulation_db.unwrap(), report.chance_db.unwrap());
    assert!(found_db > 1.0 && chance_db > found_db, "{found_db} and {chance_db} dB");
    assert_eq!(report.lay_rad, None);
}

#[test]
fn one_direction_is_isotropic_and_says_why() {
    let surface = Surface { across_deg: 30.0, along_db: -6.0, along: ALONG };
    let FittedDirections { model, report } = surface.fitted(&[0.0, 180.0]);
    assert!(model.along().is_none() && report.modulation_db.is_none() && report.chance_db.is_none());
    assert!(report.notes.iter().any(|note| note.contains("0° do not show a lay")), "{:?}", report.notes);
}

#[test]
fn opposite_strokes_that_differ_are_said() {
    let surface = Surface { across_deg: 0.0, along_db: -6.0, along: ALONG };
    let mut strokes = surface.recordings(&EIGHT);
    for stroke in strokes.iter_mut().filter(|stroke| (stroke.direction_rad - PI).abs() < 0.1) {
        for a in &mut stroke.recording.acceleration_mps2 {
            *a = 9.81 + 0.5 * (*a - 9.81);
        }
    }
    let report = fit_directions(strokes, &FitOptions::usual()).unwrap().report;
    let is_said = |note: &String| note.starts_with("Strokes at 0° and 180° differ by");
    assert!(report.notes.iter().any(is_said), "{:?}", report.notes);
}

#[test]
fn what_cannot_be_fitted_says_why() {
    assert_eq!(fit_directions(Vec::new(), &FitOptions::usual()), Err(FitError::Empty));
    let surface = Surface { across_deg: 0.0, along_db: -6.0, along: ALONG };
    let mut strokes = surface.recordings(&[0.0, 90.0]);
    strokes[2].direction_rad = f64::NAN;
    assert_eq!(
        fit_directions(strokes.clone(), &FitOptions::usual()),
        Err(FitError::Direction { recording: 2 })
    );
    // A full turn more is the same direction.
    strokes[2].direction_rad = TAU;
    strokes[1].recording.force_n.pop();
    assert_eq!(fit_directions(strokes, &FitOptions::usual()), Err(FitError::Columns { recording: 1 }));
}
