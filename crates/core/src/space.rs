//! The authoring space: positions of the textures, derivation of the positions from human judgments, and interpolation
//! between the textures.
//!
//! Inputs: texture models, positions, judgments and features. Outputs: positions with their validation
//! ([`space_build`]), and the weights and interpolated texture at any point ([`authoring`]). Leave-one-out errors
//! measure the accuracy of the interpolation ([`leave_one_out`]). The *authoring paper* is that of Hassan, Abdulali and
//! Jeon (2020), cited in [`space_build`].

pub mod attribute_predictor;
pub mod authoring;
mod authoring_space;
pub mod axis_evaluation;
pub mod features;
pub mod fidelity;
mod field;
pub mod heat_map;
mod inverse_distance;
pub mod leave_one_out;
mod local_mean;
mod mean_axes;
mod sampled;
pub mod selection;
pub mod signal_axes;
pub mod space_build;
mod space_point;
pub mod texture_path;

pub use crate::space::authoring_space::{LabelSource, Location, Space, SpaceError};
pub use crate::space::local_mean::{LocalMean, LocalMeans, with_local_means};
pub use crate::space::space_point::{MIDDLE, MOST_AXES, SpacePoint, SpacePointError};
