//! Options of the user interface: enums without behavior. Their labels are in [`strings`](crate::strings), which
//! matches on them, so that every option has a label.

pub mod conflict;
pub mod networks;
pub mod scope;
pub mod signals;
pub mod textures;
pub mod tour;
