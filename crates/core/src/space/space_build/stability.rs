//! Stability of positions under resampling of the participants: the bootstrap of Efron (1979).
//!
//! Each bootstrap sample draws as many participants as took part, with replacement, together with their sorts and
//! ratings. Scaling, property fitting and projection are repeated for each sample. The standard deviation of a
//! texture's position over the samples measures how much the position depends on who took part. In every sample, the
//! axis is scaled so that its two outermost textures are at 0 and 100. Textures at the ends of an axis therefore vary
//! little by construction.

use std::collections::BTreeMap;

use rayon::iter::{IntoParallelRefIterator, ParallelIterator};

use crate::maths::rng::{Random, derive_seed};
use crate::maths::statistics::{mean, standard_deviation};
use crate::people::mds::{MdsOptions, nonmetric};
use crate::people::property::{ZeroAt, angle_degrees, axis_positions, fit_property, orthogonal_to, project};
use crate::people::ratings::RatingTable;
use crate::people::sorting::{Sort, pooled_dissimilarities};
use crate::space::space_build::SpaceBuildError;

/// Minimum number of sorters, and of raters, for a bootstrap.
pub const MIN_DRAWN: usize = 3;

/// Minimum number of samples that yield a space, for a standard deviation.
const MIN_SPACES: usize = 2;

/// Random starts of each scaling in addition to the classical start; few suffice, because most starts reach a good
/// solution.
const N_RANDOM_STARTS: usize = 4;

/// Bootstrap result: variation of the positions when participants are resampled.
#[derive(Clone, Debug, PartialEq)]
pub struct Stability {
    /// Number of samples that yielded a space.
    pub n_draws: usize,
    /// Number of samples that yielded no space, for example because their sorts do not separate the textures, or
    /// because an adjective pair has no direction.
    pub n_failed: usize,
    /// Standard deviation of each texture's perceived position along both axes, in points of 100.
    pub deviations: Vec<[f64; 2]>,
    /// Root mean square of these standard deviations over the textures.
    pub typical: [f64; 2],
    /// Standard deviation of the angle between the directions of the two pairs, in degrees.
    pub angle_deviation_degrees: f64,
}

/// Data that the bootstrap resamples.
pub(super) struct Drawn<'a> {
    /// Identifiers of the textures in the space.
    pub(super) textures: &'a [String],
    pub(super) sorts: &'a [Sort],
    pub(super) ratings: &'a RatingTable,
    /// Indices of the axes among the pairs of the table, and which pole of each is at 0.
    pub(super) axes: [(usize, ZeroAt); 2],
    pub(super) n_dims: usize,
    pub(super) is_orthogonal: bool,
    pub(super) mds: &'a MdsOptions,
}

/// Bootstrap stability of the perceived positions; `None` if `n_draws` is 0, or if the stability cannot be estimated
/// (then a finding gives the reason).
///
/// # Errors
/// [`SpaceBuildError::Stopped`] if `go_on`, which is called before every sample, returns `false`.
pub(super) fn stability<'a>(
    drawn: &Drawn<'a>,
    n_draws: usize,
    seed: u64,
    go_on: &(dyn Fn() -> bool + Sync),
    findings: &mut Vec<String>,
) -> Result<Option<Stability>, SpaceBuildError> {
    if n_draws == 0 {
        return Ok(None);
    }
    let strata = strata(drawn);
    let n_who = |did: fn(&Did) -> bool| -> usize {
        strata.iter().filter(|(what, _)| did(what)).map(|(_, names)| names.len()).sum()
    };
    let (n_sorters, n_raters) = (n_who(|did| did.sorted), n_who(|did| did.rated));
    if n_sorters.min(n_raters) < MIN_DRAWN {
        findings.push(format!(
            "the stability of the positions cannot be estimated: {n_sorters} participants sorted and {n_raters} rated, but at least {MIN_DRAWN} of each are needed"
        ));
        return Ok(None);
    }
    let mut random = Random::new(derive_seed(seed, "participants"));
    let mut draw = || -> Vec<&str> {
        let stratum = |stratum: &Vec<&'a str>| -> Vec<&'a str> {
            (0..stratum.len()).map(|_| stratum[random.below(stratum.len())]).collect()
        };
        strata.values().flat_map(stratum).collect()
    };
    let draws: Vec<Vec<&str>> = (0..n_draws).map(|_| draw()).collect();
    let places = draws.par_iter().map(|participants| {
        if go_on() { Ok(places_by(drawn, participants)) } else { Err(SpaceBuildError::Stopped) }
    });
    let places: Vec<Option<Places>> = places.collect::<Result<_, _>>()?;
    let places: Vec<Places> = places.into_iter().flatten().collect();
    if places.len() < MIN_SPACES {
        let n_failed = n_draws - places.len();
        findings.push(format!(
            "the positions are unstable: resampling the participants yielded no space in {n_failed} of {n_draws} samples"
        ));
        return Ok(None);
    }
    let over_draws = |of: &dyn Fn(&Places) -> f64| {
        let values: Vec<f64> = places.iter().map(of).collect();
        standard_deviation(&values)
    };
    let deviations: Vec<[f64; 2]> =
        (0..drawn.textures.len()).map(|t| [0, 1].map(|axis| over_draws(&|p| p.along[axis][t]))).collect();
    let typical = [0, 1].map(|axis| {
        let squares: Vec<f64> = deviations.iter().map(|d| d[axis] * d[axis]).collect();
        mean(&squares).sqrt()
    });
    Ok(Some(Stability {
        n_draws: places.len(),
        n_failed: n_draws - places.len(),
        deviations,
        typical,
        angle_deviation_degrees: over_draws(&|p| p.angle_degrees),
    }))
}

/// Positions of the textures in one bootstrap sample.
struct Places {
    /// Positions along each axis, 0..100.
    along: [Vec<f64>; 2],
    angle_degrees: f64,
}

/// Which parts of the study a participant did.
#[derive(Clone, Copy, Default, PartialEq, Eq, PartialOrd, Ord)]
struct Did {
    sorted: bool,
    rated: bool,
}

/// Participants by the parts they did; resampling within each stratum keeps the numbers of sorters and raters.
fn strata<'a>(drawn: &Drawn<'a>) -> BTreeMap<Did, Vec<&'a str>> {
    let mut did: BTreeMap<&str, Did> = BTreeMap::new();
    for sort in drawn.sorts {
        did.entry(&sort.participant).or_default().sorted = true;
    }
    for participant in drawn.ratings.participants() {
        did.entry(participant).or_default().rated = true;
    }
    let mut strata: BTreeMap<Did, Vec<&str>> = BTreeMap::new();
    for (participant, what) in did {
        strata.entry(what).or_default().push(participant);
    }
    strata
}

/// Positions from these participants; `None` if they yield no space.
fn places_by(drawn: &Drawn<'_>, participants: &[&str]) -> Option<Places> {
    // The sorts of a participant drawn twice count twice.
    let own = |name| drawn.sorts.iter().filter(move |sort| sort.participant == name);
    let sorts: Vec<&Sort> = participants.iter().copied().flat_map(own).collect();
    let dissimilarities = pooled_dissimilarities(drawn.textures, &sorts).ok()?.ok()?;
    // All samples use the same random starts, so that only the participants differ.
    let options = MdsOptions { n_random_starts: N_RANDOM_STARTS, ..drawn.mds.clone() };
    let points = nonmetric(&dissimilarities, drawn.n_dims, &options).ok()?.points;
    let raters: Vec<usize> = participants
        .iter()
        .filter_map(|name| drawn.ratings.participants().iter().position(|p| p == name))
        .collect();
    let line = |(pair, zero_at): (usize, ZeroAt)| -> Option<Vec<f64>> {
        let rated = drawn.textures.iter().zip(&points).filter_map(|(texture, point)| {
            let row = drawn.ratings.textures().iter().position(|t| t == texture)?;
            let values: Vec<f64> =
                raters.iter().filter_map(|rater| drawn.ratings.value(*rater, row, pair)).collect();
            (!values.is_empty()).then(|| (point.clone(), mean(&values)))
        });
        let (points, means): (Vec<Vec<f64>>, Vec<f64>) = rated.unzip();
        Some(zero_at.oriented(fit_property(&points, &means).ok()?.direction))
    };
    let [first, mut second] = [line(drawn.axes[0])?, line(drawn.axes[1])?];
    let angle_degrees = angle_degrees(&first, &second);
    if drawn.is_orthogonal {
        second = orthogonal_to(&second, std::slice::from_ref(&first)).ok()?;
    }
    let along = |direction: &[f64]| axis_positions(&project(&points, direction), ZeroAt::LowRatings);
    Some(Places { along: [along(&first)?, along(&second)?], angle_degrees })
}
