//! What is heard as a file: a signal in m/s², with its sidecar.

use std::io::ErrorKind;
use std::path::Path;
use std::sync::Arc;

use shagreen_core::blend::Mode;
use shagreen_core::plane::{Plane, Prepared};
use shagreen_core::render::{PathPlan, RenderError, RenderPlan, render, render_path};
use shagreen_core::texture_path::TexturePath;
use shagreen_core::units::{Contact, Hertz};
use shagreen_formats::wav::{SidecarV1, is_sidecar, sidecar_path, write_wav};

use crate::signals::bench_signal::BenchSignal;
use crate::strings::signal as strings;

/// Length of the signal, in seconds.
pub const SIGNAL_SECS: f64 = 5.0;
/// Rate of the signal, in Hz: what editors and engines take.
pub const SIGNAL_RATE_HZ: u32 = 48_000;
/// Seed of its noise.
pub const SIGNAL_SEED: u64 = 1;

/// What sounds in a signal.
#[derive(Clone, Debug)]
pub enum Sounding {
    /// Textures with their shares, mixed.
    Mix(Vec<(Arc<Plane>, f64)>, Mode),
    /// Textures one after the other along a path.
    Path(Box<TexturePath>),
    /// A signal of the bench, as it was recorded.
    Bench(Arc<BenchSignal>),
}

/// A signal on its way into a file.
#[derive(Clone, Debug)]
pub struct SignalFile {
    /// What sounds.
    pub sounding: Sounding,
    /// How fast and how hard the tip strokes all along.
    pub contact: Contact,
    /// What the samples are.
    pub sidecar: SidecarV1,
    /// Names of the textures in it that may not be passed on.
    pub restricted: Vec<String>,
}

impl SignalFile {
    /// Renders the signal and writes it with its sidecar.
    ///
    /// # Errors
    /// It cannot be rendered or written, or what lies where its sidecar would go is something else.
    pub(super) fn write(&self, path: &Path) -> Result<(), String> {
        if !Self::may_lie_beside(path) {
            return Err(strings::NO_SIGNAL.to_owned());
        }
        let samples = self.samples().map_err(|error| error.to_string())?;
        write_wav(path, &samples, &self.sidecar).map_err(|error| error.to_string())
    }

    /// Its samples in m/s², at [`SIGNAL_RATE_HZ`].
    ///
    /// # Errors
    /// It cannot be rendered.
    pub(crate) fn samples(&self) -> Result<Vec<f32>, RenderError> {
        let (rate, seconds, seed) = (Hertz(f64::from(SIGNAL_RATE_HZ)), SIGNAL_SECS, SIGNAL_SEED);
        let mut contact_at = |_| self.contact;
        match &self.sounding {
            Sounding::Bench(signal) => Ok(signal.at(rate).into_iter().map(|x| x as f32).collect()),
            Sounding::Path(path) => {
                let prepared: Vec<Prepared> =
                    path.keys().iter().map(|key| Plane::new(&key.model).prepare()).collect();
                render_path(&PathPlan { path, prepared: &prepared, rate, seconds, seed }, &mut contact_at)
            }
            Sounding::Mix(voices, mode) => {
                let prepared: Vec<(Prepared, f64)> =
                    voices.iter().map(|(plane, share)| (plane.prepare(), *share)).collect();
                let parents: Vec<(&Prepared, f64)> = prepared.iter().map(|(p, share)| (p, *share)).collect();
                let plan = RenderPlan { parents: &parents, mode: *mode, rate, seconds, seed };
                render(&plan, &mut contact_at)
            }
        }
    }

    /// Whether a signal may take the place of a file of these bytes at `path`: another one, with its sidecar.
    pub(super) fn may_replace(path: &Path, bytes: &[u8]) -> bool {
        let is_wave = bytes.starts_with(b"RIFF") && bytes.get(8..12) == Some(b"WAVE");
        is_wave && std::fs::read(sidecar_path(path)).is_ok_and(|beside| is_sidecar(&beside))
    }

    /// Whether what lies where the sidecar of a signal at `path` would is nothing, or another sidecar.
    fn may_lie_beside(path: &Path) -> bool {
        match std::fs::read(sidecar_path(path)) {
            Ok(beside) => is_sidecar(&beside),
            Err(error) => error.kind() == ErrorKind::NotFound,
        }
    }
}
