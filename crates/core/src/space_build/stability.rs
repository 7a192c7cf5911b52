//! How far places would move with other participants: the bootstrap of Efron (1979).
//!
//! Participants are drawn anew from those that there were, with replacement, as often as there were; sorts and ratings go
//! with them. What they make is scaled, pointed into and projected as the space itself was, and the deviation of each
//! texture's place over many draws says how much of it hangs on who happened to take part. Places run from 0 to 100
//! between the outermost textures of every draw, so those two hardly move by definition.

use std::collections::BTreeMap;

use crate::mds::{MdsOptions, nonmetric};
use crate::property::{ZeroAt, angle_degrees, axis_positions, fit_property, orthogonal_to, project};
use crate::ratings::RatingTable;
use crate::rng::{Random, derive_seed};
use crate::sorting::{Sort, similarity};
use crate::space_build::SpaceBuildError;
use crate::statistics::{mean, standard_deviation};

/// Fewest who sorted, and who rated, of whom some can be drawn instead of others.
pub const MIN_DRAWN: usize = 3;

/// Fewest draws that have a deviation.
const MIN_SPACES: usize = 2;

/// Random starts of each scaling beside the classical one: textures of a good space get there from most starts.
const N_RANDOM_STARTS: usize = 4;

/// How far places move when participants are drawn anew.
#[derive(Clone, Debug, PartialEq)]
pub struct Stability {
    /// Draws that made a space.
    pub n_draws: usize,
    /// Draws that made none: nobody who parts two textures, or an adjective that points nowhere.
    pub n_failed: usize,
    /// Standard deviation along both axes of the place where each texture was felt, in points of 100.
    pub deviations: Vec<[f64; 2]>,
    /// Their root mean square over the textures.
    pub typical: [f64; 2],
    /// Standard deviation of the angle between the two lines, in degrees.
    pub angle_deviation_degrees: f64,
}

/// What is drawn from.
pub(super) struct Drawn<'a> {
    /// The textures of the space.
    pub(super) textures: &'a [String],
    pub(super) sorts: &'a [Sort],
    pub(super) ratings: &'a RatingTable,
    /// Indices into the pairs of the table, and which end of each is 0.
    pub(super) axes: [(usize, ZeroAt); 2],
    pub(super) n_dims: usize,
    pub(super) is_orthogonal: bool,
    pub(super) mds: &'a MdsOptions,
}

/// `None` where no draws are asked for; where it cannot be told, too, and then a finding says why.
///
/// # Errors
/// [`SpaceBuildError::Stopped`] where `go_on`, which is asked before every draw, says no.
pub(super) fn stability(
    drawn: &Drawn<'_>,
    n_draws: usize,
    seed: u64,
    go_on: &mut dyn FnMut() -> bool,
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
            "how far places hang on who took part cannot be told: {n_sorters} sorted and {n_raters} rated, {MIN_DRAWN} of each are the least"
        ));
        return Ok(None);
    }
    let mut random = Random::new(derive_seed(seed, "participants"));
    let mut places: Vec<Places> = Vec::new();
    for _ in 0..n_draws {
        if !go_on() {
            return Err(SpaceBuildError::Stopped);
        }
        let mut participants = Vec::new();
        for stratum in strata.values() {
            let n = stratum.len();
            participants.extend((0..n).map(|_| stratum[random.below(n)]));
        }
        places.extend(places_by(drawn, &participants));
    }
    if places.len() < MIN_SPACES {
        let n_failed = n_draws - places.len();
        findings.push(format!(
            "places hang on who took part so far that drawing participants anew made no space in {n_failed} of {n_draws} draws"
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

/// Where the textures lie by one draw.
struct Places {
    /// Along each axis, 0..100.
    along: [Vec<f64>; 2],
    angle_degrees: f64,
}

/// What a participant did.
#[derive(Clone, Copy, Default, PartialEq, Eq, PartialOrd, Ord)]
struct Did {
    sorted: bool,
    rated: bool,
}

/// Participants by what they did: some may have sorted only, or rated only, and stand for others who did.
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

/// What the space is by these participants; `None` where they make none.
fn places_by(drawn: &Drawn<'_>, participants: &[&str]) -> Option<Places> {
    let mut sorts = Vec::new();
    for (copy, participant) in participants.iter().enumerate() {
        let own = drawn.sorts.iter().filter(|sort| sort.participant == *participant);
        // Somebody drawn twice counts as two.
        sorts.extend(own.map(|sort| Sort { participant: copy.to_string(), ..sort.clone() }));
    }
    let dissimilarities = similarity(drawn.textures, &sorts).ok()?.dissimilarities().ok()?;
    // From the same starts every time: what differs are the participants alone.
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
