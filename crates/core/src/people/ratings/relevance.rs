//! Relevance votes: selects the adjectives that enough participants consider relevant.

/// Minimum fraction of positive votes for an adjective to be kept.
pub const RELEVANCE_LIMIT: f64 = 0.5;

/// One person's vote on whether an adjective is relevant, for one texture or for the whole set.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct RelevanceVote {
    /// Name of the participant.
    pub participant: String,
    /// Name of the texture; `None` for the whole set.
    pub texture: Option<String>,
    /// The adjective.
    pub adjective: String,
    /// Whether the participant considers the adjective relevant.
    pub relevant: bool,
}

/// Vote count of one adjective.
#[derive(Clone, Debug, PartialEq)]
pub struct Relevance {
    /// The adjective.
    pub adjective: String,
    /// Number of votes.
    pub n_votes: usize,
    /// Number of votes for "relevant".
    pub n_relevant: usize,
    /// Fraction of votes for "relevant", 0..1.
    pub share: f64,
    /// Whether the fraction reaches [`RELEVANCE_LIMIT`].
    pub kept: bool,
}

/// Reasons why votes cannot be counted.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[non_exhaustive]
pub enum VoteError {
    /// A participant voted twice on the same adjective and texture.
    #[error("{participant} voted twice on \"{adjective}\"{}; keep one of the two", .texture.as_ref().map(|t| format!(" for \"{t}\"")).unwrap_or_default())]
    Twice {
        /// Name of the participant.
        participant: String,
        /// Name of the texture, if votes are per texture.
        texture: Option<String>,
        /// The adjective.
        adjective: String,
    },
}

/// Relevance of every adjective, in the order and spelling of its first appearance; case is ignored. Missing votes do
/// not count.
///
/// # Errors
/// [`VoteError::Twice`] if a participant voted twice on the same adjective and texture.
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
