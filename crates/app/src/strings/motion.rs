//! Reduced motion.

/// Entry of the file menu.
pub const REDUCE: &str = "Reduce motion";
pub const REDUCE_HELP: &str = "Turns off animations: fading and sliding of controls, the trail behind the tip, and smooth scrolling. Until you choose, the setting of the desktop applies where it can be read.";
/// Mark of work in progress without motion.
pub const BUSY: &str = "…";
