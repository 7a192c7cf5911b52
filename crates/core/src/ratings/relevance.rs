//! Which adjectives are worth rating: those that enough people find relevant.

/// Share of votes from which an adjective is kept: half.
pub const RELEVANCE_LIMIT: f64 = 0.5;

/// Whether one person finds an adjective relevant, for one texture or for all of them.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct RelevanceVote {
    /// Who votes.
    pub participant: String,
    /// For which texture; `None` for the whole set.
    pub texture: Option<String>,
    /// Which adjective.
    pub adjective: String,
    /// The vote.
    pub relevant: bool,
}

/// What the votes on one adjective come to.
#[derive(Clone, Debug, PartialEq)]
pub struct Relevance {
    /// The adjective.
    pub adjective: String,
    /// How many votes there are on it.
    pub n_votes: usize,
    /// How many find it relevant.
    pub n_relevant: usize,
    /// The share that finds it relevant, 0..1.
    pub share: f64,
    /// Whether the share reaches [`RELEVANCE_LIMIT`].
    pub kept: bool,
}

/// Why votes cannot be counted.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[non_exhaustive]
pub enum VoteError {
    /// Somebody voted twice on the same.
    #[error("{participant} voted twice on \"{adjective}\"{}; keep one of the two", .texture.as_ref().map(|t| format!(" for \"{t}\"")).unwrap_or_default())]
    Twice {
        /// Who.
        participant: String,
        /// For which texture, where votes are by texture.
        texture: Option<String>,
        /// On which adjective.
        adjective: String,
    },
}

/// The relevance of every adjective, in the order of first appearance and as it is spelled there: case does not matter. A
/// vote that was not cast does not count.
///
/// # Errors
/// A vote that was cast twice.
pub fn relevances(votes: &[RelevanceVote]) -> Result<Vec<Relevance>, VoteError> {
    let mut cast = std::collections::BTreeSet::new();
    let mut counts: Vec<(String, usize, usize)> = Vec::new();
    for vote in votes {
        let plain = vote.adjective.trim().to_lowercase();
        if !cast.insert((&vote.participant, &vote.texture, plain.clone())) {
            return Err(VoteError::Twice {
                participant: vote.participant.clone(),
                texture: vote.texture.clone(),
                adjective: vote.adjective.clone(),
            });
        }
        let relevant = usize::from(vote.relevant);
        match counts.iter_mut().find(|(adjective, ..)| adjective.trim().to_lowercase() == plain) {
            Some((_, n_votes, n_relevant)) => {
                *n_votes += 1;
                *n_relevant += relevant;
            }
            None => counts.push((vote.adjective.clone(), 1, relevant)),
        }
    }
    let summary = |(adjective, n_votes, n_relevant): (String, usize, usize)| {
        let share = n_relevant as f64 / n_votes as f64;
        Relevance { adjective, n_votes, n_relevant, share, kept: share >= RELEVANCE_LIMIT }
    };
    Ok(counts.into_iter().map(summary).collect())
}
