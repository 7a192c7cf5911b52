//! Conditions of a texture model: its speeds and forces, with the spectrum at each of them as sines.

use shagreen_core::dsp::band_power::BandPower;
use shagreen_core::texture::TextureModel;
use shagreen_core::texture::plane::Plane;
use shagreen_core::units::{Contact, Hertz};

use crate::library::{DIGITS, digits};

/// Edges of the bands in Hz, about two thirds of an octave apart: seven bands, the most of level 1. A texture with a lower
/// model rate has fewer.
pub(super) const BAND_EDGES_HZ: [u16; 8] = [0, 50, 80, 125, 200, 315, 500, 1000];

/// Vibration at one speed and force.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Condition {
    /// Tip speed and normal force.
    pub(super) contact: Contact,
    /// A sine for each band from the lowest one on.
    pub(super) sines: Vec<Sine>,
}

/// Sine that stands for a band.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Sine {
    /// Amplitude in m/s², which gives the power of the band.
    pub(super) amplitude_mps2: f64,
    /// Mean frequency of the band in whole Hz, at least 1.
    pub(super) frequency_hz: i32,
}

impl Condition {
    /// Name of the condition: tip speed in mm/s and normal force in N.
    pub(super) fn name(&self) -> String {
        let Contact { speed, force } = self.contact;
        format!("speed={} force={}", digits(speed.mm_per_s(), DIGITS), digits(force.0, DIGITS))
    }

    /// Sum of the amplitudes in m/s², which the signal does not exceed.
    pub(super) fn peak_mps2(&self) -> f64 {
        self.sines.iter().map(|sine| sine.amplitude_mps2).sum()
    }
}

/// Returns the condition at each node of a model where the tip slides and presses, in the order of the nodes. In each band,
/// the power of the sine is that of the grain across the lay.
pub(super) fn conditions(model: &TextureModel) -> Vec<Condition> {
    let edges = edges_below(Hertz(0.5 * model.rate().0));
    let plane = Plane::new(model);
    let condition = |contact: Contact| {
        let sine = |band: BandPower| Sine {
            amplitude_mps2: (2.0 * band.power).sqrt(),
            // A sine of 0 Hz would be silent.
            frequency_hz: (band.mean.0.round() as i32).max(1),
        };
        let sines = plane.at(contact).band_powers(&edges).into_iter().map(sine).collect();
        Condition { contact, sines }
    };
    let moves = |contact: &Contact| contact.speed.0 > 0.0 && contact.force.0 > 0.0;
    model.contacts().filter(moves).map(condition).collect()
}

/// Returns the index of the condition nearest to the middle of a usual stroke, 100 mm/s and 1 N, on logarithmic scales; `None`
/// if there is none.
pub(super) fn usual(conditions: &[Condition]) -> Option<usize> {
    let usual = Contact::from_mm_per_s_and_n(100.0, 1.0);
    let distance = |condition: &Condition| {
        let Contact { speed, force } = condition.contact;
        (speed.0 / usual.speed.0).ln().hypot((force.0 / usual.force.0).ln())
    };
    let distances = conditions.iter().map(distance).enumerate();
    distances.min_by(|(_, a), (_, b)| a.total_cmp(b)).map(|(index, _)| index)
}

/// Edges of the bands up to this frequency, which is the last edge unless it is above all of them.
fn edges_below(highest: Hertz) -> Vec<Hertz> {
    let edges = BAND_EDGES_HZ.iter().map(|hz| Hertz(f64::from(*hz)));
    let mut below: Vec<Hertz> = edges.filter(|edge| edge.0 < highest.0).collect();
    if below.len() < BAND_EDGES_HZ.len() {
        below.push(highest);
    }
    below
}
