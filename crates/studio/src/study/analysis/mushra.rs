//! Ratings beside a hidden reference, with and without the participants who did not recognize it.

use serde_json::json;
use shagreen_core::people::study::analysis::mushra::{
    LOWEST_FOR_REFERENCE, MOST_MISSED, PageRatings, Rejected, page_ratings, rejected,
};
use shagreen_core::people::study::answer::Record;
use shagreen_core::people::study::plan::Part;

use super::scales::measured;
use super::{Analyzed, Measure};

/// Ratings of each page of a part. The main results leave out the rejected participants, and all of them are reported too.
pub(super) fn analyze(part: &Part, records: &[Record]) -> Analyzed {
    let excluded = rejected(part, records);
    let measure =
        |page: PageRatings| Measure::of(format!("beside {}", page.reference), "0 to 100", page.cells);
    let screened: Vec<Measure> = page_ratings(part, records, &excluded).into_iter().map(measure).collect();
    let everyone = measured(&page_ratings(part, records, &[]).into_iter().map(measure).collect::<Vec<_>>());
    let mut analyzed = measured(&screened);
    let named =
        |of: &Rejected| json!({"participant": of.participant, "missed": of.n_missed, "pages": of.n_pages});
    analyzed.results.insert("rejected".to_owned(), json!(excluded.iter().map(named).collect::<Vec<_>>()));
    if let Some(measures) = everyone.results.get("measures") {
        analyzed.results.insert("measures_of_everyone".to_owned(), measures.clone());
    }
    analyzed.warnings.extend(excluded.iter().map(|of| {
        format!(
            "the means leave out {}, who rated the hidden reference below {LOWEST_FOR_REFERENCE:.0} on {} of {} pages (more than {:.0} %, ITU-R BS.1534-3)",
            of.participant,
            of.n_missed,
            of.n_pages,
            100.0 * MOST_MISSED
        )
    }));
    analyzed
}
