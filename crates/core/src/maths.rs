//! Mathematics independent of haptics: random numbers, parts of lists, statistics, hypothesis tests, regression and plane
//! geometry.
//!
//! Input: slices and matrices of `f64`. Output: numbers, fitted models and triangulations.

pub mod birge;
pub mod class_distance;
pub mod gaussian_process;
pub mod hypothesis_tests;
pub mod isotonic;
pub mod kernel_ridge;
pub mod least_squares;
pub mod minimize;
pub mod multinomial;
pub mod natural_neighbor;
pub(crate) mod nearest_in_hull;
pub mod procrustes;
pub mod radial_basis;
pub mod ridge;
pub mod rng;
pub mod shard;
pub(crate) mod smoother;
pub mod statistics;
pub(crate) mod sums;
pub mod triangulation;
pub mod variance_components;
pub mod weighted_statistics;
