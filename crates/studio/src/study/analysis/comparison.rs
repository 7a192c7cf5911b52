//! Whether participants answer differently under different conditions.
//!
//! The conditions of one participant are compared with each other: an analysis of variance with repeated measures, corrected for
//! unequal variances of the differences (Greenhouse and Geisser), or Friedman's test if the residuals are not normal (test of
//! Shapiro and Wilk, p < 0.05). Both are reported, with the one that counts. Beside them stands a one-way analysis of variance,
//! which treats all answers as independent: it is for comparison with studies that used it.

use serde_json::{Value, json};
use shagreen_core::maths::hypothesis_tests::f_test::FTest;
use shagreen_core::maths::hypothesis_tests::friedman::{ConditionPair, Friedman, friedman, friedman_pairs};
use shagreen_core::maths::hypothesis_tests::groups::Groups;
use shagreen_core::maths::hypothesis_tests::intervals::Confidence;
use shagreen_core::maths::hypothesis_tests::levene::{Center, levene};
use shagreen_core::maths::hypothesis_tests::one_way::{OneWay, one_way};
use shagreen_core::maths::hypothesis_tests::repeated_measures::{RepeatedMeasures, repeated_measures};
use shagreen_core::maths::hypothesis_tests::shapiro_wilk::{ShapiroWilk, ShapiroWilkError, shapiro_wilk};
use shagreen_core::maths::hypothesis_tests::subject_table::{SubjectTable, SubjectTableError};
use shagreen_core::maths::hypothesis_tests::tukey::{TukeyHsd, TukeyPair, tukey_hsd, tukey_hsd_repeated};
use shagreen_core::maths::statistics::mean;
use shagreen_core::people::study::analysis::Cells;

use super::values::{interval, probability, statistic};

/// Probability below which a difference counts as found, and residuals as not normal.
pub const SIGNIFICANT: f64 = 0.05;

/// Test that counts.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum UsedTest {
    /// Analysis of variance with repeated measures.
    Anova,
    /// Friedman's test.
    Friedman,
}

/// The tests of one table of participants and conditions.
#[derive(Clone, Debug)]
pub struct ConditionComparison {
    table: SubjectTable,
    normality: Result<ShapiroWilk, ShapiroWilkError>,
    anova: RepeatedMeasures,
    friedman: Friedman,
    used: UsedTest,
}

impl ConditionComparison {
    /// Tests of cells (participants × conditions). Participants with a missing cell are left out and counted.
    ///
    /// # Errors
    /// There are fewer than two conditions, or fewer than two participants with an answer under each.
    pub fn of(cells: &Cells) -> Result<Self, SubjectTableError> {
        let table = SubjectTable::new(&cells.values)?;
        let (anova, friedman) = (repeated_measures(&table), friedman(&table));
        // Without an error, the residuals are nothing but rounding.
        let has_error = anova.test.is_some_and(|test| test.f_test.f.is_finite());
        let normality =
            if has_error { shapiro_wilk(&residuals(&table)) } else { Err(ShapiroWilkError::Equal) };
        // Without a test of normality, the residuals are equal, or there are thousands of them.
        let is_normal = !normality.as_ref().is_ok_and(|test| test.p_value < SIGNIFICANT);
        let used = if is_normal { UsedTest::Anova } else { UsedTest::Friedman };
        Ok(Self { table, normality, anova, friedman, used })
    }

    /// Test that counts.
    pub fn used(&self) -> UsedTest {
        self.used
    }

    /// Probability of differences at least as large if no conditions differ, by the test that counts; `None` if all answers of
    /// each participant are equal.
    pub fn p_value(&self) -> Option<f64> {
        match self.used {
            UsedTest::Anova => {
                let test = self.anova.test?;
                Some(test.greenhouse_geisser.map_or(test.f_test.p_value, |corrected| corrected.p_value))
            }
            UsedTest::Friedman => Some(self.friedman.test?.p_value),
        }
    }

    /// Whether the conditions differ, at a probability below 0.05.
    pub fn is_significant(&self) -> bool {
        self.p_value().is_some_and(|p| p < SIGNIFICANT)
    }

    /// The result in one sentence, with the reason for the test.
    pub fn sentence(&self) -> String {
        let Some(p) = self.p_value() else {
            return "Each participant gave the same answers under all conditions, so there is nothing to test."
                .to_owned();
        };
        let differ = if self.is_significant() { "The conditions differ" } else { "No difference is found" };
        let n = self.table.n_subjects();
        let test = match (self.used, self.anova.test, self.friedman.test) {
            (UsedTest::Anova, Some(test), _) => format!(
                "analysis of variance with repeated measures, F({}, {}) = {}, {}, partial η² = {:.2}",
                test.f_test.dof[0],
                test.f_test.dof[1],
                statistic(test.f_test.f),
                probability(p),
                test.partial_eta_squared
            ),
            (UsedTest::Friedman, _, Some(test)) => format!(
                "Friedman's test, χ²({}) = {}, {}, W = {:.2}",
                test.dof,
                statistic(test.chi_squared),
                probability(p),
                test.kendalls_w
            ),
            _ => probability(p),
        };
        format!("{differ} ({test}; n = {n}). {}", self.reason())
    }

    /// Why this test counts.
    fn reason(&self) -> String {
        match &self.normality {
            Ok(ShapiroWilk { w, p_value }) => format!(
                "The residuals are {} (Shapiro-Wilk, W = {w:.3}, {}).",
                if self.used == UsedTest::Anova {
                    "compatible with a normal distribution"
                } else {
                    "not normal"
                },
                probability(*p_value)
            ),
            Err(ShapiroWilkError::Size { n }) => {
                format!("The test of normality is not defined for {n} residuals.")
            }
            Err(_) => "The residuals are all equal, so their normality is not tested.".to_owned(),
        }
    }

    /// All tests as JSON, with the comparisons of pairs; `columns` are the names of the conditions.
    pub(super) fn json(&self, columns: &[String]) -> Value {
        let anova = &self.anova;
        json!({
            "used": match self.used {
                UsedTest::Anova => "repeated-measures-anova",
                UsedTest::Friedman => "friedman",
            },
            "why": self.reason(),
            "p": self.p_value(),
            "n_participants": self.table.n_subjects(),
            "n_left_out": self.table.n_left_out(),
            "shapiro_wilk": self.normality.as_ref().ok().map(|test| json!({"w": test.w, "p": test.p_value})),
            "anova": anova.test.map(|test| json!({
                "f": test.f_test.f,
                "dof": test.f_test.dof,
                "p": test.f_test.p_value,
                "greenhouse_geisser": test.greenhouse_geisser.map(|of| json!({"epsilon": of.epsilon, "p": of.p_value})),
                "huynh_feldt": test.huynh_feldt.map(|of| json!({"epsilon": of.epsilon, "p": of.p_value})),
                "partial_eta_squared": test.partial_eta_squared,
                "generalized_eta_squared": test.generalized_eta_squared,
            })),
            "friedman": self.friedman.test.map(|test| json!({
                "chi_squared": test.chi_squared,
                "dof": test.dof,
                "p": test.p_value,
                "kendalls_w": test.kendalls_w,
                "mean_ranks": self.friedman.mean_ranks,
            })),
            "pairs": self.pairs(columns),
            "one_way": one_way_json(&self.table, columns),
        })
    }

    /// Comparisons of pairs that belong to the test that counts.
    fn pairs(&self, columns: &[String]) -> Vec<Value> {
        match self.used {
            UsedTest::Anova => tukey_hsd_repeated(&self.table, Confidence::NINETY_FIVE)
                .map_or_else(Vec::new, |tukey| tukey_json(&tukey, columns)),
            UsedTest::Friedman => {
                let of_pair = |pair: ConditionPair| {
                    let [first, second] = pair.conditions;
                    json!({
                        "first": columns[first],
                        "second": columns[second],
                        "test": "signed-rank, adjusted by Holm",
                        "p": pair.adjusted_p_value,
                        "rank_biserial": pair.signed_rank.map(|test| test.rank_biserial),
                    })
                };
                friedman_pairs(&self.table).into_iter().map(of_pair).collect()
            }
        }
    }
}

/// What an additive model of participants and conditions leaves of each answer.
fn residuals(table: &SubjectTable) -> Vec<f64> {
    let conditions: Vec<f64> = (0..table.n_conditions()).map(|index| mean(&table.condition(index))).collect();
    let grand = mean(&conditions);
    let of_row = |row: &Vec<f64>| {
        let subject = mean(row);
        let left = row.iter().zip(&conditions).map(|(x, condition)| x - subject - condition + grand);
        left.collect::<Vec<f64>>()
    };
    table.rows().iter().flat_map(of_row).collect()
}

fn tukey_json(tukey: &TukeyHsd, columns: &[String]) -> Vec<Value> {
    let of_pair = |pair: &TukeyPair| {
        json!({
            "first": columns[pair.means[0]],
            "second": columns[pair.means[1]],
            "test": "Tukey HSD",
            "difference": pair.difference,
            "interval_95": interval(pair.interval),
            "p": pair.p_value,
        })
    };
    tukey.pairs.iter().map(of_pair).collect()
}

/// One-way analysis of variance with the test of equal variances; null if there are too few answers.
fn one_way_json(table: &SubjectTable, columns: &[String]) -> Value {
    let values = (0..table.n_conditions()).map(|condition| table.condition(condition)).collect();
    // Two or more participants under two or more conditions are groups to compare.
    let Ok(groups) = Groups::new(values) else { return Value::Null };
    let OneWay { test, .. } = one_way(&groups);
    let variances = |of: Option<FTest>| of.map(|of| json!({"w": of.f, "dof": of.dof, "p": of.p_value}));
    json!({
        "note": "treats all answers as independent",
        "f": test.map(|test| test.f_test.f),
        "dof": groups.dof(),
        "p": test.map(|test| test.f_test.p_value),
        "eta_squared": test.map(|test| test.eta_squared),
        "omega_squared": test.map(|test| test.omega_squared),
        "levene": variances(levene(&groups, Center::Mean)),
        "brown_forsythe": variances(levene(&groups, Center::Median)),
        "pairs": tukey_hsd(&groups, Confidence::NINETY_FIVE).map(|tukey| tukey_json(&tukey, columns)),
    })
}
