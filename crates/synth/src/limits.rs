//! Array sizes of the renderer, which cannot allocate.

/// Highest order of a linear predictor.
pub const MAX_ORDER: usize = 64;

/// Highest order of a moving average.
pub const MAX_MA_ORDER: usize = 32;

/// Longest control tick in model samples: 5 ms at 4 kHz.
pub const MAX_TICK: usize = 20;
