//! Signals and pairs of signals: spatial spectrograms, perceptual quality, the codec, and haptic clips.
//!
//! In: acceleration over time in m/s², or profiles over position. Out: spectrograms and reconstructions
//! ([`spatial_spectrogram`]), predicted discriminability d' of a pair ([`quality`]) and coded frames ([`codec`]). The envelopes
//! of a haptic clip become acceleration ([`haptic_envelope`]), and acceleration becomes envelopes ([`haptic_outline`]).

pub mod codec;
pub mod haptic_envelope;
pub mod haptic_outline;
pub mod profile_stimuli;
pub mod quality;
pub mod spatial_spectrogram;
