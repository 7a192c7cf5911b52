//! Ratings beside a hidden reference.

use crate::people::study::analysis::cells::Entry;
use crate::people::study::analysis::{Cells, scored};
use crate::people::study::answer::{Answer, Record, Response};
use crate::people::study::plan::{Design, MushraPage, Part};
use crate::people::study::trial::Task;

/// Lowest rating that a hidden reference should have (ITU-R BS.1534-3, section 4.1.2).
pub const LOWEST_FOR_REFERENCE: f64 = 90.0;
/// Share of pages on which a participant may rate the hidden reference lower.
pub const MOST_MISSED: f64 = 0.15;

/// Participant who did not recognize the hidden reference often enough.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Rejected {
    /// Name of the participant.
    pub participant: String,
    /// Number of pages on which the hidden reference is rated below [`LOWEST_FOR_REFERENCE`].
    pub n_missed: usize,
    /// Number of rated pages.
    pub n_pages: usize,
}

/// Ratings of one page.
#[derive(Clone, Debug, PartialEq)]
pub struct PageRatings {
    /// The reference.
    pub reference: String,
    /// Ratings: participants × the hidden reference, the tested versions and the anchors.
    pub cells: Cells,
}

/// Participants to reject by the rule of the recommendation: they rate the hidden reference below 90 on more than 15 % of the
/// pages. Their ratings are not removed; see [`page_ratings`].
pub fn rejected(part: &Part, records: &[Record]) -> Vec<Rejected> {
    let mut all: Vec<Rejected> = Vec::new();
    for (record, answer) in scored(records, part) {
        let Some((reference, ratings)) = rated(answer) else { continue };
        let is_missed = ratings.iter().any(|(id, value)| *id == reference && *value < LOWEST_FOR_REFERENCE);
        let at = all.iter().position(|of| of.participant == record.participant).unwrap_or_else(|| {
            all.push(Rejected { participant: record.participant.clone(), n_missed: 0, n_pages: 0 });
            all.len() - 1
        });
        all[at].n_pages += 1;
        all[at].n_missed += usize::from(is_missed);
    }
    all.retain(|of| of.n_missed as f64 > MOST_MISSED * of.n_pages as f64);
    all
}

/// Ratings of each page of a part, in its order, without the excluded participants; none if it has another design.
pub fn page_ratings(part: &Part, records: &[Record], excluded: &[Rejected]) -> Vec<PageRatings> {
    let Design::Mushra { pages } = &part.design else { return Vec::new() };
    let is_kept = |record: &&Record| excluded.iter().all(|of| of.participant != record.participant);
    let kept: Vec<Record> = records.iter().filter(is_kept).cloned().collect();
    let of_page = |MushraPage { reference, tested, anchors }: &MushraPage| {
        let columns: Vec<String> = [reference].into_iter().chain(tested).chain(anchors).cloned().collect();
        let mut entries = Vec::new();
        for (record, answer) in scored(&kept, part) {
            let Some((_, ratings)) = rated(answer).filter(|(of, _)| of == reference) else { continue };
            entries.extend(ratings.into_iter().filter_map(|(id, value)| {
                let column = columns.iter().position(|column| column == id)?;
                Some(Entry { participant: record.participant.clone(), column, value })
            }));
        }
        PageRatings { reference: reference.clone(), cells: Cells::of(columns, &kept, &entries) }
    };
    pages.iter().map(of_page).collect()
}

/// Reference of a rated page, and the rating of each stimulus.
fn rated(answer: &Answer) -> Option<(&str, Vec<(&str, f64)>)> {
    match (&answer.trial.task, &answer.response) {
        (Task::Page { reference, stimuli }, Response::Sliders(values)) => {
            let ratings = stimuli.iter().map(String::as_str).zip(values.iter().copied()).collect();
            Some((reference.as_str(), ratings))
        }
        _ => None,
    }
}
