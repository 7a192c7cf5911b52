//! Strength of a landing from the speed of the tip towards the surface.

pub use shagreen_synth::impact::strength_of;
