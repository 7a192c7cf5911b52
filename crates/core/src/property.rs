//! Property fitting: where an adjective points in a perceptual space.
//!
//! The mean ratings `y` of an adjective are regressed on the coordinates `X` of a configuration, `y = a + X b`. The
//! line of the adjective has the direction `b / |b|` and the length R²; projecting the textures on it gives their
//! positions on the adjective's axis. Two adjectives meet at whatever angle they meet: axes are never assumed to be
//! orthogonal, since a principal-axis configuration gives no reason why they should be.

use crate::least_squares::least_squares;
use crate::statistics::{correlation, dot, f_upper_tail, is_constant, mean};

/// The line of one adjective in a configuration.
#[derive(Clone, Debug, PartialEq)]
pub struct PropertyLine {
    /// Unit vector in which ratings grow, one component a dimension.
    pub direction: Vec<f64>,
    /// Points of rating by which the fit grows per unit of the configuration along [`Self::direction`].
    pub slope: f64,
    /// The fitted rating at the origin.
    pub intercept: f64,
    /// Goodness of fit R², 0..1: the length of the line.
    pub r_squared: f64,
    /// F of the regression.
    pub f: f64,
    /// Degrees of freedom of the regression and of what is left.
    pub dof: [usize; 2],
    /// Probability of an F as large without any relation.
    pub p_value: f64,
    /// Correlation of the ratings with each dimension; `None` for a dimension in which all textures lie alike.
    pub correlations: Vec<Option<f64>>,
}

/// Which end of the ratings becomes 0 on an axis.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum ZeroAt {
    /// The low pole: an axis grows with the ratings. Right where 0 was rated "rough" or "hard".
    LowRatings,
    /// The high pole: an axis runs against the ratings.
    HighRatings,
}

impl ZeroAt {
    /// A direction in which ratings grow, turned so that it grows away from this end.
    #[must_use]
    pub fn oriented(self, direction: Vec<f64>) -> Vec<f64> {
        match self {
            Self::LowRatings => direction,
            Self::HighRatings => direction.into_iter().map(|x| -x).collect(),
        }
    }
}

/// Why an adjective has no line.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum PropertyError {
    /// Places and ratings are of different textures.
    #[error("{n_points} textures have a place, {n_ratings} a rating; give the same ones to both")]
    Lengths {
        /// Textures with a place.
        n_points: usize,
        /// Textures with a rating.
        n_ratings: usize,
    },
    /// A texture has another number of dimensions than the first.
    #[error("texture {texture} has {n_dims} coordinates, the first has {expected}")]
    Dimensions {
        /// Index of the texture.
        texture: usize,
        /// Its coordinates.
        n_dims: usize,
        /// Those of the first texture.
        expected: usize,
    },
    /// Too few textures for the test.
    #[error("{n_points} textures in {n_dims} dimensions leave nothing to test; {} are the least", .n_dims + 2)]
    TooFew {
        /// Textures.
        n_points: usize,
        /// Dimensions.
        n_dims: usize,
    },
    /// Something is not a number.
    #[error("the {what} of texture {texture} is not a finite number; leave that texture out")]
    NotFinite {
        /// Rating or coordinate.
        what: &'static str,
        /// Index of the texture.
        texture: usize,
    },
    /// All textures are rated alike.
    #[error("all textures have the same rating: the adjective points nowhere")]
    ConstantRatings,
    /// A dimension holds nothing of its own.
    #[error(
        "dimension {dimension} of the configuration is constant or follows from the others; leave it out"
    )]
    FlatDimension {
        /// Index of the dimension.
        dimension: usize,
    },
    /// Ratings grow in no direction.
    #[error("the ratings have no trend in the configuration: the adjective points nowhere")]
    NoDirection,
    /// A line lies along those that it is to be orthogonal to.
    #[error("the line lies along the others: nothing of it is orthogonal to them")]
    Parallel,
}

/// The line of an adjective: `coordinates` are those of each texture, `ratings` its mean rating.
///
/// # Errors
/// See [`PropertyError`].
pub fn fit_property(coordinates: &[Vec<f64>], ratings: &[f64]) -> Result<PropertyLine, PropertyError> {
    let n_dims = check(coordinates, ratings)?;
    let n = ratings.len();
    let mut columns = vec![vec![1.0; n]];
    columns.extend((0..n_dims).map(|d| column(coordinates, d)));
    let fit = least_squares(&columns, ratings).map_err(|error| match error {
        crate::least_squares::LeastSquaresError::Dependent { column } => {
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

/// Where each texture falls on a direction, in units of the configuration.
///
/// # Panics
/// If a texture has another number of coordinates than the direction.
pub fn project(coordinates: &[Vec<f64>], direction: &[f64]) -> Vec<f64> {
    let place = |point: &Vec<f64>| {
        assert_eq!(point.len(), direction.len(), "a direction has the dimensions of its configuration");
        dot(point, direction)
    };
    coordinates.iter().map(place).collect()
}

/// Spreads what [`project`] gives over an axis, 0 to 100; `None` where all textures fall on one place.
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
    // Rounding may carry an end past its end.
    Some(projections.iter().map(|t| place(t).clamp(0.0, 100.0)).collect())
}

/// The angle between two unit vectors, in degrees, 0 to 180.
///
/// # Panics
/// If their dimensions differ.
pub fn angle_degrees(a: &[f64], b: &[f64]) -> f64 {
    assert_eq!(a.len(), b.len(), "two directions of one configuration");
    // The arc cosine loses half the digits near 0 and 180 degrees; the half angle of sum and difference does not.
    let length = |sign: f64| a.iter().zip(b).map(|(x, y)| (x + sign * y).powi(2)).sum::<f64>().sqrt();
    2.0 * length(-1.0).atan2(length(1.0)).to_degrees()
}

/// The part of a direction that is orthogonal to `others`, as a unit vector (Gram-Schmidt). Only on request: the axis
/// that comes of it is no longer the line of its adjective.
///
/// # Errors
/// [`PropertyError::Parallel`].
pub fn orthogonal_to(direction: &[f64], others: &[Vec<f64>]) -> Result<Vec<f64>, PropertyError> {
    let mut columns: Vec<Vec<f64>> = Vec::new();
    for other in others {
        // Lines that follow from others already span their plane.
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

/// Correlations of every row column with every column column, row by row: adjectives by adjectives, or adjectives by
/// dimensions. `None` where one of the two is constant.
///
/// # Panics
/// If columns differ in length.
pub fn correlation_table(rows: &[Vec<f64>], columns: &[Vec<f64>]) -> Vec<Vec<Option<f64>>> {
    rows.iter().map(|row| columns.iter().map(|column| correlation(row, column)).collect()).collect()
}

/// The coordinates of all textures in one dimension.
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
            return Err(PropertyError::NotFinite { what: "place", texture });
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
