//! Statistical tests for the analysis of studies.
//!
//! Input: values of independent groups ([`groups::Groups`]), values of subjects under conditions
//! ([`subject_table::SubjectTable`]), or one sample. Output: test statistics with degrees of freedom and p-values,
//! effect sizes, and confidence intervals.
//!
//! A statistic that is 0/0, such as F of equal values, is `None`. A statistic with an error of zero and an effect above
//! zero is infinite, with a p-value of 0, as in scipy. Values count as equal if they differ by rounding errors only: by
//! less than eight units in the last place of the largest value. The tests are two-sided. `docs/notes/statistics.md`
//! lists definitions and defaults.

pub mod bootstrap;
pub mod f_test;
pub mod friedman;
pub mod groups;
pub mod holm;
pub mod intervals;
pub mod levene;
pub mod one_way;
mod ranks;
pub mod repeated_measures;
mod rounding;
pub mod shapiro_wilk;
pub mod signed_rank;
pub mod studentized_range;
pub mod subject_table;
pub mod t_tests;
pub mod tukey;

#[cfg(test)]
mod tests;
