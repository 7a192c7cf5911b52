//! Human judgments of textures: free sorting, ratings, and the perceptual space that scaling derives from them.
//!
//! Inputs: group labels and ratings per participant and texture. Outputs: agreement, dissimilarities, a configuration
//! from multidimensional scaling ([`mds`]) and the adjective directions in it ([`property`]). [`panel`] simulates
//! participants.

pub mod dissimilarities;
pub mod mds;
pub mod panel;
pub mod property;
pub mod ratings;
pub mod sorting;
