//! Property fitting: finds the direction of an adjective in a perceptual space.
//!
//! The mean ratings `y` of an adjective are regressed on the coordinates `X` of a configuration, `y = a + X b`. The
//! line of the adjective has the direction `b / |b|` and the length R². Projections of the textures onto it give their
//! positions on the adjective's axis. The angle between two adjectives is measured, never assumed to be 90°: nothing
//! about a principal-axis configuration makes adjective directions orthogonal.

use crate::maths::least_squares::least_squares;
use crate::maths::statistics::{correlation, dot, f_upper_tail, is_constant, mean};

/// Fitted line of one adjective in a configuration.
#[derive(Clone, Debug, PartialEq)]
pub struct PropertyLine {
    /// Unit vector along which ratings increase, one component per dimension.
    pub direction: Vec<f64>,
    /// Increase of the fitted rating, in points, per unit of the configuration along [`Self::direction`].
    pub slope: f64,
    /// Fitted rating at the origin.
    pub intercept: f64,
    /// Coefficient of determination R², 0..1; it is also the length of the line.
    pub r_squared: f64,
    /// F statistic of the regression.
    pub f: f64,
    /// Degrees of freedom of the regression and of the residuals.
    pub dof: [usize; 2],
    /// Probability of an F statistic at least this large under the null hypothesis.
    pub p_value: f64,
    /// Correlation of the ratings with each dimension; `None` for a dimension on which all coordinates are equal.
    pub correlations: Vec<Option<f64>>,
}

/// Which end of the rating scale becomes 0 on an axis.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum ZeroAt {
    /// The low pole: the axis increases with the ratings. Use it if a rating of 0 means "rough" or "hard".
    LowRatings,
    /// The high pole: the axis decreases with the ratings.
    HighRatings,
}

impl ZeroAt {
    /// Given a direction of increasing ratings, returns the direction of increasing axis values.
    #[must_use]
    pub fn oriented(self, direction: Vec<f64>) -> Vec<f64> {
        match self {
            Self::LowRatings => direction,
            Self::HighRatings => direction.into_iter().map(|x| -x).collect(),
        }
    }
}

/// Reasons why property fitting fails.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum PropertyError {
    /// The numbers of positions and of ratings differ.
    #[error(
        "{n_points} textures have a position but {n_ratings} have a rating; use the same textures for both"
    )]
    Lengths {
        /// Number of textures with a position.
        n_points: usize,
        /// Number of textures with a rating.
        n_ratings: usize,
    },
    /// A texture has a different number of dimensions than the first one.
    #[error("texture {texture} has {n_dims} coordinates, but the first texture has {expected}")]
    Dimensions {
        /// Index of the texture.
        texture: usize,
        /// Number of its coordinates.
        n_dims: usize,
        /// Number of coordinates of the first texture.
        expected: usize,
    },
    /// There are too few textures for the F test.
    #[error("{n_points} textures in {n_dims} dimensions are too few for the F test; it needs at least {}", .n_dims + 2)]
    TooFew {
        /// Number of textures.
        n_points: usize,
        /// Number of dimensions.
        n_dims: usize,
    },
    /// A coordinate or rating is not finite.
    #[error("the {what} of texture {texture} is not a finite number; leave that texture out")]
    NotFinite {
        /// "rating" or "position".
        what: &'static str,
        /// Index of the texture.
        texture: usize,
    },
    /// There is no configuration, because nobody sorted the textures.
    #[error("there are no sorts, so there is no perceptual space in which the adjective has a direction")]
    NoConfiguration,
    /// All ratings are equal.
    #[error("all textures have the same rating, so the adjective has no direction")]
    ConstantRatings,
    /// A dimension is constant or linearly dependent on others.
    #[error(
        "dimension {dimension} of the configuration is constant or linearly dependent on the others; leave it out"
    )]
    FlatDimension {
        /// Index of the dimension.
        dimension: usize,
    },
    /// The regression slope is zero.
    #[error("the ratings have no trend in the configuration, so the adjective has no direction")]
    NoDirection,
    /// A direction lies in the span of those that it should be orthogonal to.
    #[error("the direction is a linear combination of the others, so it has no part orthogonal to them")]
    Parallel,
}

/// Line of an adjective, fitted to the coordinates and the mean rating of each texture.
///
/// # Errors
/// See [`PropertyError`].
pub fn fit_property(coordinates: &[Vec<f64>], ratings: &[f64]) -> Result<PropertyLine, PropertyError> {
    let n_dims = check(coordinates, ratings)?;
    let n = ratings.len();
    let mut columns = vec![vec![1.0; n]];
    columns.extend((0..n_dims).map(|d| column(coordinates, d)));
    let fit = least_squares(&columns, ratings).map_err(|error| match error {
        crate::maths::least_squares::LeastSquaresError::Dependent { column } => {
            PropertyError::FlatDimension { dimension: column.saturating_sub(1) }
        }
    })?;
    let slopes = &fit.coefficients[1..];
    let slope = dot(slopes, slopes).sqrt();
    if slope <= 0.0 {
        return Err(PropertyError::NoDirection);
    }
    let center = mean(ratings);
    let total: f64 = ratings.iter().map(|r| (r - center) * (r - center)).sum();
    let r_squared = (1.0 - dot(&fit.residuals, &fit.residuals) / total).clamp(0.0, 1.0);
    let dof = [n_dims, n - n_dims - 1];
    let f = (r_squared / dof[0] as f64) / ((1.0 - r_squared) / dof[1] as f64);
    Ok(PropertyLine {
        direction: slopes.iter().map(|s| s / slope).collect(),
        slope,
        intercept: fit.coefficients[0],
        r_squared,
        f,
        dof,
        p_value: f_upper_tail(f, dof[0] as f64, dof[1] as f64),
        correlations: columns[1..].iter().map(|c| correlation(c, ratings)).collect(),
    })
}

/// Projection of each texture onto a direction, in units of the configuration.
///
/// # Panics
/// If a texture and the direction have different numbers of coordinates.
pub fn project(coordinates: &[Vec<f64>], direction: &[f64]) -> Vec<f64> {
    let place = |point: &Vec<f64>| {
        assert_eq!(point.len(), direction.len(), "a direction must have the dimensions of its configuration");
        dot(point, direction)
    };
    coordinates.iter().map(place).collect()
}

/// Rescales the projections from [`project`] to an axis of 0 to 100; `None` if all projections are equal.
pub fn axis_positions(projections: &[f64], zero_at: ZeroAt) -> Option<Vec<f64>> {
    let low = projections.iter().copied().fold(f64::INFINITY, f64::min);
    let high = projections.iter().copied().fold(f64::NEG_INFINITY, f64::max);
    if projections.is_empty() || is_constant(projections) {
        return None;
    }
    let place = |t: &f64| match zero_at {
        ZeroAt::LowRatings => 100.0 * (t - low) / (high - low),
        ZeroAt::HighRatings => 100.0 * (high - t) / (high - low),
    };
    // Rounding may move an end slightly out of the range.
    Some(projections.iter().map(|t| place(t).clamp(0.0, 100.0)).collect())
}

/// Angle between two unit vectors, in degrees, 0 to 180.
///
/// # Panics
/// If their dimensions differ.
pub fn angle_degrees(a: &[f64], b: &[f64]) -> f64 {
    assert_eq!(a.len(), b.len(), "both directions must have the dimensions of one configuration");
    // The arc cosine loses half of its digits near 0 and 180 degrees; this half-angle formula does not.
    let length = |sign: f64| a.iter().zip(b).map(|(x, y)| (x + sign * y).powi(2)).sum::<f64>().sqrt();
    2.0 * length(-1.0).atan2(length(1.0)).to_degrees()
}

/// Component of a direction orthogonal to `others`, as a unit vector (Gram-Schmidt). Apply it only on request: the
/// resulting axis is no longer the line of its adjective.
///
/// # Errors
/// [`PropertyError::Parallel`].
pub fn orthogonal_to(direction: &[f64], others: &[Vec<f64>]) -> Result<Vec<f64>, PropertyError> {
    let mut columns: Vec<Vec<f64>> = Vec::new();
    for other in others {
        // Linearly dependent directions are dropped; their span is already covered.
        columns.push(other.clone());
        if least_squares(&columns, direction).is_err() {
            columns.pop();
        }
    }
    let rest = least_squares(&columns, direction).map_err(|_| PropertyError::Parallel)?.residuals;
    let length = dot(&rest, &rest).sqrt();
    if length < 1e-9 {
        return Err(PropertyError::Parallel);
    }
    Ok(rest.iter().map(|r| r / length).collect())
}

/// Correlation of each vector in `rows` with each vector in `columns`, row by row: adjectives by adjectives, or
/// adjectives by dimensions. An entry is `None` if one of its two vectors is constant.
///
/// # Panics
/// If the vectors differ in length.
pub fn correlation_table(rows: &[Vec<f64>], columns: &[Vec<f64>]) -> Vec<Vec<Option<f64>>> {
    rows.iter().map(|row| columns.iter().map(|column| correlation(row, column)).collect()).collect()
}

/// Coordinates of all textures along one dimension.
pub fn column(coordinates: &[Vec<f64>], dimension: usize) -> Vec<f64> {
    coordinates.iter().map(|point| point[dimension]).collect()
}

fn check(coordinates: &[Vec<f64>], ratings: &[f64]) -> Result<usize, PropertyError> {
    let (n_points, n_ratings) = (coordinates.len(), ratings.len());
    if n_points != n_ratings {
        return Err(PropertyError::Lengths { n_points, n_ratings });
    }
    let n_dims = coordinates.first().map_or(0, Vec::len);
    for (texture, (point, rating)) in coordinates.iter().zip(ratings).enumerate() {
        if point.len() != n_dims {
            return Err(PropertyError::Dimensions { texture, n_dims: point.len(), expected: n_dims });
        }
        if !point.iter().all(|c| c.is_finite()) {
            return Err(PropertyError::NotFinite { what: "position", texture });
        }
        if !rating.is_finite() {
            return Err(PropertyError::NotFinite { what: "rating", texture });
        }
    }
    if n_dims == 0 || n_points < n_dims + 2 {
        return Err(PropertyError::TooFew { n_points, n_dims });
    }
    if is_constant(ratings) {
        return Err(PropertyError::ConstantRatings);
    }
    Ok(n_dims)
}

#[cfg(test)]
mod tests;
