//! Choice of the adjective pairs that become the axes.

use crate::maths::statistics::{correlation, is_constant};
use crate::people::property::{PropertyError, ZeroAt};
use crate::people::ratings::AdjectivePair;
use crate::space::space_build::{Adjective, LEAST_RATED, SpaceBuildError, SpaceOptions};

/// Cronbach's alpha from which the mean ratings of a pair count as reliable (Nunnally 1978).
pub const RELIABLE_ALPHA: f64 = 0.7;

/// Poles of the preferred axes.
const USUAL: [[&str; 2]; 2] = [["rough", "smooth"], ["hard", "soft"]];

/// Indices of the adjectives that become the axes, and which pole of each is at 0.
pub(super) type Chosen = [(usize, ZeroAt); 2];

/// Chooses the axes of a perceptual space: those that the options state, else the usual ones, else the pair that correlates
/// best with each of the first two dimensions.
pub(super) fn choose_in_space(
    adjectives: &[Adjective],
    options: &SpaceOptions,
) -> Result<Chosen, SpaceBuildError> {
    if let Some(stated) = stated(adjectives, options)? {
        return Ok(stated);
    }
    let usable = usable(adjectives)?;
    let usual = USUAL.map(|poles| find(adjectives, poles).filter(|(index, _)| usable.contains(index)));
    if let [Some(first), Some(second)] = usual {
        return Ok([first, second]);
    }
    let mut chosen: Vec<(usize, ZeroAt)> = Vec::new();
    for dimension in 0..2 {
        let strength = |i: &usize| {
            let line = adjectives[*i].line.as_ref().ok();
            line.and_then(|line| *line.correlations.get(dimension)?).map_or(0.0, f64::abs)
        };
        let free = usable.iter().filter(|i| chosen.iter().all(|(taken, _)| taken != *i));
        let best = free.max_by(|a, b| strength(a).total_cmp(&strength(b)));
        chosen.extend(best.map(|index| (*index, ZeroAt::LowRatings)));
    }
    match chosen[..] {
        [first, second] => Ok([first, second]),
        _ => Err(SpaceBuildError::TooFewPairs { n_pairs: chosen.len(), reasons: reasons(adjectives) }),
    }
}

/// Chooses the axes of mean ratings: those that the options state, else the two least correlated pairs with reliable
/// ratings. With fewer than two reliable pairs, all pairs are candidates, and a finding says so.
pub(super) fn choose_by_ratings(
    adjectives: &[Adjective],
    options: &SpaceOptions,
    findings: &mut Vec<String>,
) -> Result<Chosen, SpaceBuildError> {
    if let Some(stated) = stated(adjectives, options)? {
        return Ok(stated);
    }
    let usable = usable(adjectives)?;
    let reliable: Vec<usize> =
        usable.iter().copied().filter(|index| is_reliable(&adjectives[*index])).collect();
    let candidates = if reliable.len() < 2 {
        findings.push(format!(
            "fewer than two adjective pairs have reliable ratings (Cronbach's alpha of at least {RELIABLE_ALPHA}): the axes were selected among all pairs"
        ));
        usable
    } else {
        reliable
    };
    let mut least: Option<(f64, [usize; 2])> = None;
    for (n_before, second) in candidates.iter().enumerate() {
        for first in &candidates[..n_before] {
            let Some(r) = rating_correlation(&adjectives[*first], &adjectives[*second]) else { continue };
            if least.is_none_or(|(lowest, _)| r.abs() < lowest) {
                least = Some((r.abs(), [*first, *second]));
            }
        }
    }
    let (_, [first, second]) = least.ok_or(SpaceBuildError::RatedApart)?;
    let rank = |index: usize| USUAL.iter().position(|poles| names(&adjectives[index].pair, *poles).is_some());
    // Rough-smooth is the first axis, and hard-soft the second, as in every other space.
    let is_swapped = rank(second) == Some(0) || rank(first) == Some(1);
    let ordered = if is_swapped { [second, first] } else { [first, second] };
    Ok(ordered.map(|index| {
        let usual = USUAL.iter().find_map(|poles| names(&adjectives[index].pair, *poles));
        (index, usual.unwrap_or(ZeroAt::LowRatings))
    }))
}

/// Whether the mean ratings of a pair are reliable; without agreement between raters, they are not.
pub(super) fn is_reliable(adjective: &Adjective) -> bool {
    adjective.agreement.as_ref().is_ok_and(|agreement| agreement.alpha.value >= RELIABLE_ALPHA)
}

/// Correlation of the mean ratings on two pairs, over the textures rated on both; `None` with fewer than [`LEAST_RATED`] such
/// textures, or if one pair has the same mean for all of them.
pub(super) fn rating_correlation(first: &Adjective, second: &Adjective) -> Option<f64> {
    let both = first.ratings.iter().zip(&second.ratings).filter_map(|(a, b)| a.mean.zip(b.mean));
    let (a, b): (Vec<f64>, Vec<f64>) = both.unzip();
    if a.len() < LEAST_RATED { None } else { correlation(&a, &b) }
}

/// The pair with the pole at 0 first.
pub(super) fn as_axis(pair: &AdjectivePair, zero_at: ZeroAt) -> AdjectivePair {
    match zero_at {
        ZeroAt::LowRatings => pair.clone(),
        ZeroAt::HighRatings => AdjectivePair { low: pair.high.clone(), high: pair.low.clone() },
    }
}

/// Reason why a pair cannot be an axis.
enum Fault<'a> {
    Irrelevant,
    NoLine(&'a PropertyError),
    FewTextures,
    Constant,
}

impl Fault<'_> {
    fn reason(&self) -> String {
        match self {
            Self::Irrelevant => "too few votes find it relevant".to_owned(),
            Self::NoLine(error) => error.to_string(),
            Self::FewTextures => format!("fewer than {LEAST_RATED} textures were rated on it"),
            Self::Constant => "all textures have the same mean rating on it".to_owned(),
        }
    }
}

/// Reason why a pair cannot be an axis; `None` if it can. Without sorts it needs mean ratings, otherwise a direction.
fn fault(adjective: &Adjective) -> Option<Fault<'_>> {
    if !adjective.is_relevant {
        return Some(Fault::Irrelevant);
    }
    match &adjective.line {
        Ok(_) => None,
        Err(PropertyError::NoConfiguration) => {
            let means: Vec<f64> = adjective.rated().map(|(_, mean)| mean).collect();
            if means.len() < LEAST_RATED {
                Some(Fault::FewTextures)
            } else {
                is_constant(&means).then_some(Fault::Constant)
            }
        }
        Err(error) => Some(Fault::NoLine(error)),
    }
}

/// Indices of the adjectives that can be axes.
///
/// # Errors
/// [`SpaceBuildError::TooFewPairs`].
fn usable(adjectives: &[Adjective]) -> Result<Vec<usize>, SpaceBuildError> {
    let usable: Vec<usize> = (0..adjectives.len()).filter(|i| fault(&adjectives[*i]).is_none()).collect();
    if usable.len() < 2 {
        return Err(SpaceBuildError::TooFewPairs { n_pairs: usable.len(), reasons: reasons(adjectives) });
    }
    Ok(usable)
}

/// Reasons why pairs cannot be axes, each after a semicolon.
fn reasons(adjectives: &[Adjective]) -> String {
    let reason =
        |adjective: &Adjective| Some(format!("; {}: {}", adjective.pair, fault(adjective)?.reason()));
    adjectives.iter().filter_map(reason).collect()
}

/// The axes that the options state; `None` if they state none.
fn stated(adjectives: &[Adjective], options: &SpaceOptions) -> Result<Option<Chosen>, SpaceBuildError> {
    let Some([first, second]) = &options.axes else { return Ok(None) };
    let axes = [named(adjectives, first)?, named(adjectives, second)?];
    if axes[0].0 == axes[1].0 {
        return Err(no_such_axis(adjectives, second, "it is already the other axis".to_owned()));
    }
    Ok(Some(axes))
}

/// Which pole of a pair is at 0 if its poles are these, in either order; `None` if they are not.
fn names(pair: &AdjectivePair, [low, high]: [&str; 2]) -> Option<ZeroAt> {
    let is = |a: &str, b: &str| a.trim().eq_ignore_ascii_case(b.trim());
    if is(&pair.low, low) && is(&pair.high, high) {
        Some(ZeroAt::LowRatings)
    } else if is(&pair.low, high) && is(&pair.high, low) {
        Some(ZeroAt::HighRatings)
    } else {
        None
    }
}

/// Index of the adjective with these poles, and which pole of it is at 0.
fn find(adjectives: &[Adjective], poles: [&str; 2]) -> Option<(usize, ZeroAt)> {
    let found = |(index, adjective): (usize, &Adjective)| Some((index, names(&adjective.pair, poles)?));
    adjectives.iter().enumerate().find_map(found)
}

fn named(adjectives: &[Adjective], pair: &AdjectivePair) -> Result<(usize, ZeroAt), SpaceBuildError> {
    let Some((index, zero_at)) = find(adjectives, [&pair.low, &pair.high]) else {
        return Err(no_such_axis(adjectives, pair, "it was not rated".to_owned()));
    };
    match fault(&adjectives[index]) {
        None => Ok((index, zero_at)),
        Some(Fault::NoLine(source)) => {
            Err(SpaceBuildError::Axis { pair: pair.name(), source: source.clone() })
        }
        Some(fault) => Err(no_such_axis(adjectives, pair, fault.reason())),
    }
}

fn no_such_axis(adjectives: &[Adjective], pair: &AdjectivePair, reason: String) -> SpaceBuildError {
    let usable = adjectives.iter().filter(|adjective| fault(adjective).is_none());
    let pairs: Vec<String> = usable.map(|adjective| adjective.pair.name()).collect();
    SpaceBuildError::NoSuchAxis { pair: pair.name(), reason, pairs: pairs.join(", ") }
}
