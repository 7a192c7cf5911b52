//! The output, its device setup, and the data drawn from its signal.

use std::collections::VecDeque;
use std::time::Instant;

use super::audible::{Audible, ShapedTextures};
use super::played_signal::PlayedSignal;
use super::player::Player;
use super::{Spectra, drawn_frequencies};
use crate::state::rig::Rig;
use crate::state::scope_buffer::ScopeBuffer;

/// Sample rate of the scope until an output is open, in Hz.
const SCOPE_RATE_HZ: f64 = 48_000.0;

/// The output and its signal.
pub(super) struct Sound {
    pub(super) player: Player,
    pub(super) rig: Rig,
    /// The audible textures and their mixture.
    pub(super) heard: Audible,
    /// Library textures in the shape of the audible texture.
    pub(super) shaped: ShapedTextures,
    /// A signal of the workspace Signals that is felt instead.
    pub(super) felt: Option<PlayedSignal>,
    /// Power spectral densities at the present contact.
    pub(super) spectra: Spectra,
    pub(super) scope: ScopeBuffer,
    /// Latencies of recent strokes and taps in seconds, and when they were measured.
    pub(super) latencies: VecDeque<(Instant, f32, f32)>,
    /// Sample rate of the audible textures, in Hz.
    pub(super) rate_hz: f64,
}

impl Sound {
    /// Silence, for `n_textures` textures and a sample rate in Hz.
    pub(super) fn new(n_textures: usize, rate_hz: f64) -> Self {
        Self {
            player: Player::new(n_textures),
            rig: Rig::default(),
            heard: Audible::default(),
            shaped: ShapedTextures::default(),
            felt: None,
            spectra: Spectra { frequencies: drawn_frequencies(rate_hz), ..Spectra::default() },
            scope: ScopeBuffer::new(SCOPE_RATE_HZ, rate_hz),
            latencies: VecDeque::new(),
            rate_hz,
        }
    }
}
