//! The samples of a sound along a motion: its texture, and the tap transients where a stroke lands.

use anyhow::Context as _;
use shagreen_core::texture::render::Hand;
use shagreen_core::texture::tap::TAP_AMPLITUDES_MPS2;
use shagreen_formats::library::Library;

use crate::render::{SampleFormat, render_along, render_mixture};
use crate::report::Reporter;
use crate::sound::Sound;
use crate::stroke_contacts::StrokeContacts;
use crate::tap_transients::{AddedTaps, add_tap_transients};

/// Renders the acceleration in m/s² of a sound, without its tap transients. `library` has the textures of the sound.
///
/// # Errors
/// A texture cannot be converted to the common rate, or the format is out of range
/// ([`RenderError`](shagreen_core::texture::render::RenderError)).
pub fn render_sound(
    library: &Library,
    sound: &Sound,
    format: SampleFormat,
    hand: &mut dyn Hand,
    reporter: &dyn Reporter,
) -> anyhow::Result<Vec<f32>> {
    if let Some(path) = &sound.path {
        return render_along(path, format, hand).context("the path cannot be rendered with these options");
    }
    let voices = sound.planes(library, reporter)?;
    render_mixture(&voices, sound.mixing, format, hand)
        .context("the texture cannot be rendered with these options")
}

/// Adds the tap transients of a stroke to the rendered samples of a sound, in m/s² at a rate in Hz. A sound without a tap
/// transient changes nothing. Transients that are limited are noted.
///
/// # Errors
/// The stroke cannot be replayed, or the engine does not support the rate.
pub fn add_taps_of_stroke(
    samples: &mut [f32],
    library: &Library,
    sound: &Sound,
    (stroke, rate_hz): (StrokeContacts, u32),
    reporter: &dyn Reporter,
) -> anyhow::Result<AddedTaps> {
    let Some(tap) = sound.tap else { return Ok(AddedTaps::default()) };
    let model_rate_hz = sound.rate(library)?.0;
    let taps = add_tap_transients(samples, rate_hz, model_rate_hz, stroke.into_track()?, tap.into())?;
    if taps.n_limited > 0 {
        reporter.note(&format!(
            "{} so fast that the tap transient would exceed {} m/s²; it is limited to this value",
            counted_landings(taps.n_limited),
            TAP_AMPLITUDES_MPS2.end()
        ));
    }
    Ok(taps)
}

/// Adds tap transients as [`add_taps_of_stroke`] does, and returns also the samples without them; `None` if none was added.
///
/// # Errors
/// Those of [`add_taps_of_stroke`].
pub fn add_separate_taps(
    samples: &mut [f32],
    library: &Library,
    sound: &Sound,
    stroke: (StrokeContacts, u32),
    reporter: &dyn Reporter,
) -> anyhow::Result<(AddedTaps, Option<Vec<f32>>)> {
    let bare = sound.tap.is_some().then(|| samples.to_vec());
    let taps = add_taps_of_stroke(samples, library, sound, stroke, reporter)?;
    Ok((taps, bare.filter(|bare| *bare != *samples)))
}

fn counted_landings(n: usize) -> String {
    if n == 1 { "1 landing is".to_owned() } else { format!("{n} landings are") }
}

#[cfg(test)]
mod tests {
    use super::{add_separate_taps, add_taps_of_stroke, render_sound};
    use crate::render::SampleFormat;
    use crate::report::Warnings;
    use crate::sound::Sound;
    use crate::stroke_contacts::StrokeContacts;
    use shagreen_core::texture::blend::Mode;
    use shagreen_core::texture::shape::Shape;
    use shagreen_core::units::Hertz;
    use shagreen_formats::starter::starter_library;
    use shagreen_formats::stroke::TimedContact;

    fn contact(time_secs: f64, speed_mps: f64, force_n: f64) -> TimedContact {
        TimedContact { time_secs, speed_mps, force_n, impact_mps: None }
    }

    /// In the air for a quarter of a second, then in contact.
    fn landing() -> StrokeContacts {
        StrokeContacts::given(vec![contact(0.0, 0.1, 0.0), contact(0.25, 0.1, 0.0), contact(0.5, 0.1, 1.0)])
            .unwrap()
    }

    #[test]
    fn a_stroke_is_silent_in_the_air_and_taps_where_it_lands() {
        let library = starter_library().unwrap();
        let reporter = Warnings::default();
        let tapping = library.textures.iter().find(|texture| texture.model.tap().is_some()).unwrap();
        let mut sound = Sound::of_texture(&library, &tapping.id, Mode::default(), &Shape::default()).unwrap();
        let format = SampleFormat { rate: Hertz(2000.0), seconds: 0.5, seed: 1, loops: false };
        let stroke = landing();
        let mut hand = |secs: f64| stroke.contact_at(secs);
        let bare = render_sound(&library, &sound, format, &mut hand, &reporter).unwrap();
        assert_eq!(bare.len(), 1000);
        assert!(bare[..400].iter().all(|x| x.abs() < 1e-6) && bare[700..].iter().any(|x| x.abs() > 1e-3));
        let mut tapped = bare.clone();
        add_taps_of_stroke(&mut tapped, &library, &sound, (landing(), 2000), &reporter).unwrap();
        let first = tapped.iter().zip(&bare).position(|(a, b)| a != b).unwrap();
        assert!((480..560).contains(&first), "{first}");
        let mut separate = bare.clone();
        let (_, without_taps) =
            add_separate_taps(&mut separate, &library, &sound, (landing(), 2000), &reporter).unwrap();
        assert_eq!((&separate, without_taps.as_ref()), (&tapped, Some(&bare)));
        sound.tap = None;
        let (_, without_taps) =
            add_separate_taps(&mut separate, &library, &sound, (landing(), 2000), &reporter).unwrap();
        assert_eq!((separate, without_taps), (tapped, None));
        let mut untapped = bare.clone();
        add_taps_of_stroke(&mut untapped, &library, &sound, (landing(), 2000), &reporter).unwrap();
        assert_eq!(untapped, bare);
    }
}
