//! The dissimilarity experiment of the paper with simulated participants: 36 pairs, each twice, and the references.

use shagreen_core::maths::statistics::mean;
use shagreen_core::people::study::analysis::dissimilarity::{
    Dissimilarity, Normalization, dissimilarities, realism_scores,
};
use shagreen_core::people::study::plan::{Design, Part};
use shagreen_formats::figure::Figure;
use shagreen_formats::library::Library;

use crate::reproduce::charts::table;
use crate::reproduce::simulated::{simulated_answers, simulated_participants};

/// Number of participants of the paper.
const N_PARTICIPANTS: usize = 10;

/// Dissimilarities by simulated participants.
pub(super) struct Judged {
    /// Number of the participants, in words that call them simulated.
    pub(super) who: String,
    /// Number of pairs of an authored texture and an original, without references and repeats.
    pub(super) n_pairs: Option<usize>,
    /// Normalized dissimilarity of the two most different textures, of the first one with itself and of the second one.
    pub(super) references: Option<[f64; 3]>,
    /// Mean realism score of the authored textures.
    pub(super) mean_score: Option<f64>,
    /// Dissimilarities of authored textures and originals.
    pub(super) figure: Figure,
}

/// Simulates the experiment with participants who perceive the textures of a library at their positions. The same seed gives
/// the same answers.
pub(super) fn judged(library: &Library, seed: u64) -> anyhow::Result<Judged> {
    let (plan, records) = simulated_answers("authored-dissimilarity", N_PARTICIPANTS, Some(library), seed)?;
    let part = plan.parts.first();
    let found = part.and_then(|part| dissimilarities(part, &records, Normalization::Range));
    let scores: Vec<f64> =
        found.iter().flat_map(|found| realism_scores(&plan, found)).map(|(_, score)| score).collect();
    let who = simulated_participants(N_PARTICIPANTS);
    Ok(Judged {
        n_pairs: part.and_then(n_pairs),
        references: found.as_ref().and_then(references),
        mean_score: (!scores.is_empty()).then(|| mean(&scores)),
        figure: figure(found.as_ref(), &who),
        who,
    })
}

fn n_pairs(part: &Part) -> Option<usize> {
    let Design::Dissimilarity { pairs, .. } = &part.design else { return None };
    Some(pairs.len())
}

/// The last three comparisons of a part with references.
fn references(found: &Dissimilarity) -> Option<[f64; 3]> {
    let averages = found.cells.averages();
    let [.., different, first, second] = averages.as_slice() else { return None };
    Some([different.mean?, first.mean?, second.mean?])
}

fn figure(found: Option<&Dissimilarity>, who: &str) -> Figure {
    let title = "Normalized dissimilarity of authored textures (rows) and originals (columns)";
    let Some(found) = found else { return table(title, Vec::new(), Vec::new(), who) };
    let n_references = 3 * usize::from(found.references.is_some());
    let pairs = &found.comparisons[..found.comparisons.len().saturating_sub(n_references)];
    let averages = found.cells.averages();
    let mut columns: Vec<String> = Vec::new();
    let mut rows: Vec<(String, Vec<Option<f64>>)> = Vec::new();
    for (pair, average) in pairs.iter().zip(&averages) {
        let column = position_or_new(&mut columns, &pair.first);
        let row = rows.iter().position(|(name, _)| *name == pair.second).unwrap_or_else(|| {
            rows.push((pair.second.clone(), Vec::new()));
            rows.len() - 1
        });
        let cells = &mut rows[row].1;
        cells.resize(cells.len().max(column + 1), None);
        cells[column] = average.mean;
    }
    for (_, cells) in &mut rows {
        cells.resize(columns.len(), None);
    }
    table(title, columns, rows, who)
}

fn position_or_new(names: &mut Vec<String>, name: &str) -> usize {
    names.iter().position(|known| known == name).unwrap_or_else(|| {
        names.push(name.to_owned());
        names.len() - 1
    })
}

#[cfg(test)]
mod tests {
    use super::judged;
    use shagreen_formats::figure::Figure;
    use shagreen_formats::starter::starter_library;

    #[test]
    fn the_matrix_has_every_pair_and_says_that_nobody_judged() {
        let judged = judged(&starter_library().unwrap(), 3).unwrap();
        assert_eq!((judged.who.as_str(), judged.n_pairs), ("10 SIMULATED participants", Some(36)));
        let [different, first, second] = judged.references.unwrap();
        assert!(different > first && different > second, "{different} {first} {second}");
        assert!(judged.mean_score.unwrap() > 0.5);
        assert!(judged.figure.title().contains("SIMULATED"));
        let Figure::Table(table) = &judged.figure else { panic!("a table") };
        assert_eq!((table.rows.len(), table.columns.len()), (6, 6));
        assert!(table.rows.iter().all(|(_, cells)| cells.iter().all(Option::is_some)), "{table:?}");
    }
}
