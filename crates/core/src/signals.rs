//! Signals and pairs of signals: spatial spectrograms, perceptual quality, and the codec.
//!
//! In: acceleration over time in m/s², or profiles over position. Out: spectrograms and reconstructions
//! ([`spatial_spectrogram`]), predicted discriminability d' of a pair ([`quality`]) and coded frames ([`codec`]).

pub mod codec;
pub mod profile_stimuli;
pub mod quality;
pub mod spatial_spectrogram;
