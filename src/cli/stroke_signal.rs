//! The signal of a sound along a motion, for files.

use anyhow::bail;
use shagreen_core::texture::render::Hand;
use shagreen_core::units::{Contact, Hertz};
use shagreen_device::track::MAX_TRACK_SECS;
use shagreen_formats::library::Library;
use shagreen_formats::wav::{self, SidecarV1};
use shagreen_studio::levels::contact_level;
use shagreen_studio::render::{SEAM_SECS, SampleFormat};
use shagreen_studio::report::Reporter;
use shagreen_studio::silence::silence_warning;
use shagreen_studio::sound::Sound;
use shagreen_studio::sound_render::{add_separate_taps, render_sound};
use shagreen_studio::sound_sidecar::{SignalFacts, sidecar_of_sound};
use shagreen_studio::tap_transients::AddedTaps;

use crate::cli::motion::Motion;
use crate::cli::output;
use crate::cli::progress::{Progress, in_ms};

/// Signal of a sound along a motion.
pub(crate) struct StrokeSamples {
    /// Acceleration in m/s², at least one sample.
    pub(crate) samples: Vec<f32>,
    /// The same without tap transients; `None` if there are none.
    pub(crate) without_taps: Option<Vec<f32>>,
    /// What they are.
    pub(crate) sidecar: SidecarV1,
    /// Level in contact without tap transients, in m/s², as [`contact_level`] defines it.
    pub(crate) contact_rms: Option<f64>,
    /// The tap transients in the samples.
    pub(crate) taps: AddedTaps,
}

/// How samples are rendered.
#[derive(Clone, Copy)]
pub(crate) struct Rendering {
    /// Sample rate in Hz.
    pub(crate) rate_hz: u32,
    /// Random seed of the noise.
    pub(crate) seed: u64,
    /// Whether the end goes on into the beginning.
    pub(crate) loops: bool,
}

/// Renders a sound along a motion, with the tap transients of a recorded stroke. Limits of the texture are noted.
pub(crate) fn stroke_samples(
    library: &Library,
    sound: &Sound,
    motion: &Motion,
    rendering: Rendering,
    reporter: &dyn Reporter,
) -> anyhow::Result<StrokeSamples> {
    let Rendering { rate_hz, .. } = rendering;
    wav::check_length((motion.seconds() * f64::from(rate_hz)).round() as u64)?;
    sound.note_limits(library, &motion.trace(), reporter);
    let mut samples = rendered(library, sound, motion, rendering, reporter)?;
    if samples.is_empty() {
        bail!("{} s at {rate_hz} Hz contain no sample; choose a longer duration", motion.seconds());
    }
    // Before the tap transients, which would hide the level of everything else.
    let contact_rms = contact_level(&samples, rate_hz, |secs| motion.contact_at(secs).force.0 > 0.0);
    let (taps, without_taps) = match motion {
        Motion::Steady { .. } => (AddedTaps::default(), None),
        Motion::Stroke { contacts, .. } => {
            add_separate_taps(&mut samples, library, sound, (contacts.clone(), rate_hz), reporter)?
        }
    };
    let sidecar = sidecar(library, sound, motion, rendering);
    if let Some(warning) = silence_warning(&samples, &sidecar.trace) {
        reporter.warn(&warning);
    }
    Ok(StrokeSamples { samples, without_taps, sidecar, contact_rms, taps })
}

/// Motion that shows its progress.
struct Watched<'a> {
    motion: &'a Motion,
    progress: Progress,
}

impl Hand for Watched<'_> {
    fn contact_at(&mut self, time_secs: f64) -> Contact {
        self.progress.set_secs(time_secs);
        self.motion.contact_at(time_secs)
    }

    fn place_m_at(&mut self, time_secs: f64) -> Option<[f64; 2]> {
        self.motion.place_m_at(time_secs)
    }
}

fn rendered(
    library: &Library,
    sound: &Sound,
    motion: &Motion,
    Rendering { rate_hz, seed, loops }: Rendering,
    reporter: &dyn Reporter,
) -> anyhow::Result<Vec<f32>> {
    let mut hand = Watched { motion, progress: Progress::new("rendering", in_ms(motion.seconds())) };
    if loops && motion.seconds() > MAX_TRACK_SECS - SEAM_SECS {
        bail!("a loop lasts at most {} s; choose a shorter duration", MAX_TRACK_SECS - SEAM_SECS);
    }
    let format = SampleFormat { rate: Hertz(f64::from(rate_hz)), seconds: motion.seconds(), seed, loops };
    render_sound(library, sound, format, &mut hand, reporter)
}

fn sidecar(library: &Library, sound: &Sound, motion: &Motion, rendering: Rendering) -> SidecarV1 {
    let name = motion.stroke_path().and_then(|path| path.file_name());
    let facts = SignalFacts {
        rate_hz: rendering.rate_hz,
        seconds: motion.seconds(),
        loops: rendering.loops,
        seed: rendering.seed,
        stroke: name.map(|name| name.to_string_lossy().into_owned()),
        trace: motion.trace(),
        created_by: output::CREATED_BY,
    };
    sidecar_of_sound(library, sound, facts)
}
