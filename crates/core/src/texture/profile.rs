//! Profile of height, friction or level along a line on a surface, sampled at equal steps.

/// Profile: equally spaced values in an arbitrary unit.
#[derive(Clone, Debug, PartialEq)]
pub struct Profile {
    step_m: f64,
    values: Vec<f64>,
}

/// Error of creating a profile.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum ProfileError {
    /// The step is out of range.
    #[error("the step of a profile must be from 1e-9 to 1 m, got {step_m} m")]
    Step {
        /// Step in m.
        step_m: f64,
    },
    /// There are fewer than two values.
    #[error("a profile needs at least two values, got {n}")]
    Short {
        /// Number of values.
        n: usize,
    },
    /// A value is not finite.
    #[error("value {index} of the profile is not finite; remove or correct it")]
    NotFinite {
        /// Index of the value, from zero.
        index: usize,
    },
    /// The magnitude of a value exceeds 1e100.
    #[error(
        "value {index} of the profile is {value:e}; its magnitude may be at most 1e100, so choose another unit"
    )]
    Huge {
        /// Index of the value, from zero.
        index: usize,
        /// Value.
        value: f64,
    },
}

/// Largest magnitude of a value, in any unit.
const MAX_VALUE: f64 = 1e100;
/// Shortest and longest step, in m.
const STEPS_M: std::ops::RangeInclusive<f64> = 1e-9..=1.0;

impl Profile {
    /// Creates a profile from values that are `step_m` meters apart.
    ///
    /// # Errors
    /// See [`ProfileError`].
    pub fn new(step_m: f64, values: Vec<f64>) -> Result<Self, ProfileError> {
        if !STEPS_M.contains(&step_m) {
            return Err(ProfileError::Step { step_m });
        }
        if values.len() < 2 {
            return Err(ProfileError::Short { n: values.len() });
        }
        let is_value = |value: &f64| value.is_finite() && value.abs() <= MAX_VALUE;
        match values.iter().position(|value| !is_value(value)) {
            Some(index) if values[index].is_finite() => {
                Err(ProfileError::Huge { index, value: values[index] })
            }
            Some(index) => Err(ProfileError::NotFinite { index }),
            None => Ok(Self { step_m, values }),
        }
    }

    /// Distance between neighboring values, in m.
    pub fn step_m(&self) -> f64 {
        self.step_m
    }

    /// All values, in the unit of the profile.
    pub fn values(&self) -> &[f64] {
        &self.values
    }

    /// Length in m, including the last step.
    pub fn length_m(&self) -> f64 {
        self.step_m * self.values.len() as f64
    }
}

#[cfg(test)]
mod tests {
    use super::{Profile, ProfileError};

    #[test]
    fn what_is_no_profile_is_named() {
        let profile = Profile::new(1e-5, vec![0.0, 1.0, 0.5]).unwrap();
        assert!((profile.length_m() - 3e-5).abs() < 1e-18);
        assert!(matches!(Profile::new(1e-3, vec![0.0, -1e101]), Err(ProfileError::Huge { index: 1, .. })));
        for step_m in [0.0, -1e-3, 2.0, f64::NAN] {
            assert!(matches!(Profile::new(step_m, vec![0.0; 9]), Err(ProfileError::Step { .. })));
        }
        assert_eq!(Profile::new(1e-5, vec![1.0]), Err(ProfileError::Short { n: 1 }));
        assert_eq!(Profile::new(1e-5, vec![1.0, f64::NAN]), Err(ProfileError::NotFinite { index: 1 }));
    }
}
