//! Human judgments of textures: free sorting, ratings, and the perceptual space that scaling derives from them.
//!
//! Inputs: group labels and ratings per participant and texture. Outputs: agreement, dissimilarities, a configuration
//! from multidimensional scaling ([`mds`]), the adjective directions in it ([`property`]) and the principal components
//! of mean ratings ([`components`]). [`panel`] simulates participants. [`study`] plans, runs and analyzes the experiments
//! from which judgments come.

pub mod components;
pub mod dissimilarities;
pub mod mds;
pub mod panel;
pub mod property;
pub mod ratings;
pub mod sorting;
pub mod study;
