#!/usr/bin/env python3
"""Statistical tests of made-up data sets: the reference of core::maths::hypothesis_tests, by scipy, statsmodels and pingouin.

Writes statistics.json beside itself. null is a missing cell in the data and an undefined number in a result; "infinite" and
"minus infinite" are infinite ones. Where a library refuses data that our tests accept, its published formula is written out below.
"""
import json, math, os, platform, warnings
import numpy as np
import pandas as pd
import pingouin
import scipy
import statsmodels
from scipy import stats
from statsmodels.stats.anova import AnovaRM
from statsmodels.stats.multitest import multipletests
from statsmodels.stats.proportion import proportion_confint
from statsmodels.stats.weightstats import DescrStatsW

HERE = os.path.dirname(os.path.abspath(__file__))
warnings.filterwarnings("ignore")
rng = np.random.default_rng(29)


def plain(x):
    """A number for JSON."""
    x = float(x)
    return None if math.isnan(x) else ("infinite" if x > 0 else "minus infinite") if math.isinf(x) else x


def present(values):
    values = np.asarray(values, dtype=float)
    return values[~np.isnan(values)]


def spread(values):
    values = present(np.ravel(np.concatenate([np.ravel(v) for v in values])))
    return float(np.ptp(values))


def cells(values):
    return [None if math.isnan(v) else float(v) for v in values]


# ---------------------------------------------------------------- tests of groups


def one_way(groups):
    f, p = stats.f_oneway(*groups)
    k, n = len(groups), sum(map(len, groups))
    # Values minus one of them are exact, and squares do not change.
    groups = [g - groups[0][0] for g in groups]
    every = np.concatenate(groups)
    between = sum(len(g) * (g.mean() - every.mean()) ** 2 for g in groups)
    within = sum(((g - g.mean()) ** 2).sum() for g in groups)
    total = between + within
    error = within / (n - k)
    out = dict(f=plain(f), p=plain(p), dof=[k - 1, n - k], between=between, within=within)
    out["eta_squared"] = plain(between / total) if total else None
    out["omega_squared"] = plain((between - (k - 1) * error) / (total + error)) if total else None
    return out


def is_constant(values):
    """Whether values are equal but for rounding errors, which scipy takes for a variance."""
    return np.ptp(values) <= 1e-13 * np.abs(values).max()


def levene(groups, center):
    if all(len(g) < 3 or is_constant(g) for g in groups):
        return None
    w, p = stats.levene(*groups, center=center)
    return dict(f=plain(w), p=plain(p)) if not math.isnan(w) else None


def tukey(groups, confidence):
    means, sizes = [g.mean() for g in groups], [len(g) for g in groups]
    k, dof = len(groups), sum(sizes) - len(groups)
    error = sum(((g - g.mean()) ** 2).sum() for g in groups) / dof
    if all(is_constant(g) for g in groups):
        return None
    if min(sizes) > 1:
        result = stats.tukey_hsd(*groups)
        ci = result.confidence_interval(confidence)
        row = lambda i, j: (result.statistic[i, j], ci.low[i, j], ci.high[i, j], result.pvalue[i, j])
    else:
        # scipy refuses a group with one value.
        row = lambda i, j: tukey_pair(means[i] - means[j], error * (1 / sizes[i] + 1 / sizes[j]) / 2, k, dof, confidence)
    return [[i, j, *map(plain, row(i, j))] for i in range(k) for j in range(i + 1, k)]


def tukey_pair(difference, half_variance, k, dof, confidence):
    scale = math.sqrt(half_variance)
    p = stats.studentized_range.sf(abs(difference) / scale, k, dof)
    radius = scale * stats.studentized_range.ppf(confidence, k, dof)
    return difference, difference - radius, difference + radius, p


def welch(a, b, confidence):
    if min(len(a), len(b)) < 2:
        return None
    difference = float(a.mean() - b.mean())
    if is_constant(a) and is_constant(b):
        differs = not is_constant(np.concatenate([a, b]))
        t, p = (plain(math.copysign(math.inf, difference)), 0.0) if differs else (None, None)
        difference = difference if differs else 0.0
        return dict(t=t, p=p, dof=1.0, low=difference, high=difference, cohens_d=None, hedges_g=None)
    result = stats.ttest_ind(a, b, equal_var=False)
    ci = result.confidence_interval(confidence)
    return dict(
        t=plain(result.statistic), p=plain(result.pvalue), dof=plain(result.df), low=plain(ci.low), high=plain(ci.high),
        cohens_d=plain(pingouin.compute_effsize(a, b, eftype="cohen")),
        hedges_g=plain(pingouin.compute_effsize(a, b, eftype="hedges")),
    )


def groups_case(name, groups, confidence=0.95):
    values = [cells(g) for g in groups]
    groups = [present(g) for g in groups]
    return dict(
        name=name, values=values, spread=spread(groups), confidence=confidence, one_way=one_way(groups),
        levene_mean=levene(groups, "mean"), levene_median=levene(groups, "median"), tukey=tukey(groups, confidence),
        welch=welch(groups[0], groups[1], confidence),
    )


def normal(sizes, means, deviations=None, digits=3):
    deviations = deviations or [1.0] * len(sizes)
    return [np.round(rng.normal(m, s, n), digits) for n, m, s in zip(sizes, means, deviations)]


def likert(sizes, means, low=1, high=5):
    return [np.clip(np.round(rng.normal(m, 1.1, n)), low, high) for n, m in zip(sizes, means)]


def with_missing(values, n_missing):
    values = [np.array(v, dtype=float) for v in values]
    for _ in range(n_missing):
        row = values[rng.integers(len(values))]
        row[rng.integers(len(row))] = np.nan
    return values


GROUPS = [
    groups_case("three normal groups", normal([10] * 3, [0.0, 0.4, 1.1])),
    groups_case("two normal groups", normal([12, 12], [5.0, 5.7])),
    groups_case("five normal groups of unequal size", normal([4, 9, 15, 7, 22], [1.0, 1.2, 0.7, 1.9, 1.0]), 0.9),
    groups_case("four skewed groups", [np.round(np.exp(rng.normal(m, 0.9, 14)), 3) for m in (0.0, 0.2, 0.5, 1.0)]),
    groups_case("heavy ties", [rng.choice([0.0, 50.0, 100.0], 20, p=p) for p in ([.6, .3, .1], [.3, .4, .3], [.2, .2, .6])]),
    groups_case("Likert, seven steps", likert([16] * 4, [3.0, 4.0, 4.3, 5.5], 1, 7)),
    groups_case("Likert, five steps, two groups", likert([30, 28], [3.0, 3.4])),
    groups_case("equal values in one group", [np.full(8, 3.0), *likert([8, 8], [3.0, 4.0])]),
    groups_case("equal values in every group, means differ", [np.full(4, 3.0), np.full(5, 5.0), np.full(3, 4.0)]),
    groups_case("equal tenths in every group, means differ", [np.full(6, 0.1), np.full(7, 0.3), np.full(3, 0.7)]),
    groups_case("all values are equal", [np.full(5, 0.1), np.full(7, 0.1), np.full(3, 0.1)]),
    groups_case("missing cells", with_missing(normal([12, 12, 12, 12], [0.0, 0.5, 0.6, 1.0]), 9)),
    groups_case("missing cells, Likert", with_missing(likert([15, 15, 15], [2.0, 3.0, 3.2]), 7)),
    groups_case("two values in a group", normal([2, 2, 2], [0.0, 1.0, 4.0])),
    groups_case("three values in a group", normal([3, 3, 3], [0.0, 1.0, 2.0]), 0.99),
    groups_case("one value in a group", normal([6, 1, 5], [0.0, 2.0, 1.0])),
    groups_case("large offset", [1e8 + g for g in normal([11, 9, 13], [0.0, 0.8, 1.5])]),
    groups_case("large offset, Likert", [g - 1e8 for g in likert([14, 14, 14], [2.5, 3.0, 4.0])]),
    groups_case("tiny values", [1e-9 * g for g in normal([9, 9, 9, 9], [0.0, 0.8, 1.0, 1.5])]),
    groups_case("small differences about one", [1.0 + 1e-6 * g for g in normal([10, 12, 10], [0.0, 0.8, 1.0])]),
    groups_case("large values", [1e12 * g for g in normal([8, 8, 8], [0.0, 0.8, 1.0])]),
    groups_case("unequal variances", normal([15, 15, 15], [0.0, 1.0, 2.0], [0.2, 2.0, 9.0])),
    groups_case("unequal variances and sizes, two groups", normal([5, 40], [0.0, 1.0], [6.0, 0.5])),
    groups_case("sliders, six groups", [np.clip(g, 0.0, 100.0) for g in normal([25] * 6, [20.0, 35.0, 50.0, 52.0, 70.0, 95.0], [18.0] * 6, 1)]),
    groups_case("equal means", [np.array([1.0, 2.0, 3.0, 4.0]), np.array([0.0, 2.0, 3.0, 5.0]), np.array([2.0, 2.0, 3.0, 3.0])]),
    groups_case("twelve groups", normal([6] * 12, list(np.linspace(0.0, 2.0, 12)))),
]

# ---------------------------------------------------------------- tests of subjects x conditions


def repeated_measures(rows):
    n, k = rows.shape
    rows = rows - rows[0, 0]
    grand, subjects, conditions = rows.mean(), rows.mean(1, keepdims=True), rows.mean(0, keepdims=True)
    rest = rows - subjects - conditions + grand
    ss = dict(
        conditions=n * ((conditions - grand) ** 2).sum(), subjects=k * ((subjects - grand) ** 2).sum(), error=(rest**2).sum()
    )
    out = dict(squares={key: float(value) for key, value in ss.items()}, dof=[k - 1, (n - 1) * (k - 1)])
    if ss["error"] < 1e-24 * (rows**2).sum() or not rows.any():
        out["f"] = "infinite" if ss["conditions"] > 1e-20 * (rows**2).sum() and rows.any() else None
        return out
    long = pd.DataFrame(
        [dict(subject=s, condition=c, value=rows[s, c]) for s in range(n) for c in range(k)]
    )
    table = AnovaRM(long, "value", "subject", within=["condition"]).fit().anova_table.iloc[0]
    f = float(table["F Value"])
    assert abs(f / ((ss["conditions"] / (k - 1)) / (ss["error"] / out["dof"][1])) - 1) < 1e-9, (f, ss)
    out.update(f=f, p=float(table["Pr > F"]))
    out["partial_eta_squared"] = ss["conditions"] / (ss["conditions"] + ss["error"])
    out["generalized_eta_squared"] = ss["conditions"] / sum(ss.values())
    wide = pd.DataFrame(rows)
    corrections = [("greenhouse_geisser", "gg")] + ([("huynh_feldt", "hf")] if n > 2 else [])
    for name, key in corrections:
        epsilon = float(pingouin.epsilon(wide, correction=key))
        out[name] = [epsilon, float(stats.f.sf(f, epsilon * (k - 1), epsilon * out["dof"][1]))]
    if n > 2:
        partial = pingouin.rm_anova(wide, effsize="np2", detailed=True).iloc[0]
        assert abs(partial["np2"] - out["partial_eta_squared"]) < 1e-9
        assert abs(pingouin.rm_anova(wide, effsize="ng2").iloc[0]["ng2"] - out["generalized_eta_squared"]) < 1e-9
    return out


def friedman(rows):
    n, k = rows.shape
    if k < 3:
        # scipy refuses two conditions. With two, the statistic is that of the sign test.
        plus, minus = (rows[:, 0] > rows[:, 1]).sum(), (rows[:, 0] < rows[:, 1]).sum()
        if plus + minus == 0:
            return None
        chi = (plus - minus) ** 2 / (plus + minus)
        p = stats.chi2.sf(chi, 1)
    else:
        chi, p = stats.friedmanchisquare(*rows.T)
        if math.isnan(chi):
            return None
    return dict(chi_squared=plain(chi), p=plain(p), kendalls_w=plain(chi / (n * (k - 1))))


def post_hoc(rows):
    pairs, raw = [], []
    k = rows.shape[1]
    for i in range(k):
        for j in range(i + 1, k):
            difference = rows[:, i] - rows[:, j]
            if not difference.any():
                pairs.append([i, j, None, 1.0])
                raw.append(1.0)
                continue
            statistic, p = stats.wilcoxon(rows[:, i], rows[:, j])
            pairs.append([i, j, float(statistic), float(p)])
            raw.append(float(p))
    adjusted = multipletests(raw, method="holm")[1]
    return [[*pair, float(a)] for pair, a in zip(pairs, adjusted)]


def tukey_repeated(rows, confidence):
    n, k = rows.shape
    r = repeated_measures(rows)
    if r["f"] is None or r["f"] == "infinite":
        return None
    dof, error = r["dof"][1], r["squares"]["error"] / r["dof"][1]
    m = (rows - rows[0, 0]).mean(0)
    return [
        [i, j, *map(plain, tukey_pair(m[i] - m[j], error / n, k, dof, confidence))] for i in range(k) for j in range(i + 1, k)
    ]


def paired(rows, confidence):
    a, b = rows[:, 0], rows[:, 1]
    d = a - b
    result = stats.ttest_rel(a, b)
    least = 1e-13 * np.abs(rows).max()
    if np.ptp(d) <= least:
        t, p = (plain(math.copysign(math.inf, d[0])), 0.0) if abs(d[0]) > least else (None, None)
        return dict(t=t, p=p, dof=len(d) - 1, low=float(d[0]), high=float(d[0]))
    ci = result.confidence_interval(confidence)
    d_z = d.mean() / d.std(ddof=1)
    n = len(d)
    return dict(
        t=plain(result.statistic), p=plain(result.pvalue), dof=plain(result.df), low=plain(ci.low), high=plain(ci.high),
        d_z=plain(d_z), hedges_g=plain(d_z * (1 - 3 / (4 * (n - 1) - 1))),
        cohens_d=plain(pingouin.compute_effsize(a, b, paired=True, eftype="cohen")),
    )


def table_case(name, rows, confidence=0.95):
    rows = np.array(rows, dtype=float)
    complete = rows[~np.isnan(rows).any(1)]
    return dict(
        name=name, values=[cells(r) for r in rows], spread=spread([complete]), confidence=confidence,
        n_left_out=len(rows) - len(complete), repeated_measures=repeated_measures(complete), friedman=friedman(complete),
        post_hoc=post_hoc(complete), tukey=tukey_repeated(complete, confidence), paired=paired(complete, confidence),
    )


def subjects(n, k, effect=0.4, between=1.0, digits=3):
    rows = rng.normal(0, between, (n, 1)) + effect * np.arange(k) + rng.normal(0, 1, (n, k))
    return np.round(rows, digits)


def likert_rows(n, k, effect=0.5, low=1, high=5):
    return np.clip(np.round(subjects(n, k, effect) + 2.2), low, high)


WALK = np.round(np.cumsum(rng.normal(0, 1, (18, 6)), axis=1) + 0.5 * np.arange(6), 3)
CONSTANT_COLUMN = np.column_stack([np.full(11, 3.0), likert_rows(11, 3)])
ZEROS = np.array([[3, 3], [4, 4], [2, 3], [5, 3], [1, 2], [4, 2], [3, 3], [2, 4], [1, 5]], dtype=float)
TABLES = [
    table_case("normal, three conditions", subjects(10, 3)),
    table_case("normal, four conditions", subjects(20, 4, 0.3), 0.9),
    table_case("two conditions", subjects(12, 2, 0.9)),
    table_case("two conditions, sixty subjects", subjects(60, 2, 0.3)),
    table_case("three subjects", subjects(3, 3, 1.0)),
    table_case("two subjects, four conditions", subjects(2, 4, 1.0)),
    table_case("more conditions than subjects", subjects(5, 8)),
    table_case("random walks: no sphericity", WALK),
    table_case("Likert, five conditions", likert_rows(15, 5)),
    table_case("Likert, seven steps", likert_rows(24, 3, 0.8, 1, 7)),
    table_case("heavy ties", rng.choice([1.0, 2.0], (16, 4))),
    table_case("zeros and ties, few subjects", ZEROS),
    table_case("zeros and ties, more subjects", likert_rows(20, 3, 0.3)),
    table_case("missing cells", with_missing(subjects(16, 4), 5)),
    table_case("missing cells, Likert", with_missing(likert_rows(22, 5), 6)),
    table_case("all values are equal", np.full((6, 3), 0.1)),
    table_case("every subject gives one answer", np.repeat([[1.0], [4.0], [2.0], [0.1]], 3, axis=1)),
    table_case("conditions add a constant", np.array([[1.0], [4.0], [2.0], [6.0]]) + [[0.0, 1.0, 3.0]]),
    table_case("conditions add tenths", np.array([[0.1], [0.4], [0.2], [0.7]]) + [[0.0, 0.1, 0.3]]),
    table_case("equal values under one condition", CONSTANT_COLUMN),
    table_case("large offset", 1e8 + subjects(13, 4)),
    table_case("tiny values", 1e-9 * subjects(13, 4)),
    table_case("subjects differ far more than conditions", subjects(15, 3, 0.4, 1000.0)),
    table_case("skewed", np.round(np.exp(subjects(25, 3, 0.3)), 3)),
    table_case("sliders, six conditions", np.clip(np.round(50 + 18 * subjects(25, 6, 0.3), 1), 0.0, 100.0)),
    table_case("sixty subjects, Likert", likert_rows(60, 3, 0.2)),
    table_case("fifty subjects without ties", subjects(50, 3, 0.15, digits=6)),
]

# ---------------------------------------------------------------- tests of one sample


def lcg_noise(n, seed):
    """The portable noise of vectors/a_ar/ar_ref.py."""
    mask, state, out = (1 << 64) - 1, seed, []

    def uniform():
        nonlocal state
        state = (state * 6364136223846793005 + 1442695040888963407) & mask
        return ((state >> 11) + 0.5) / float(1 << 53)

    while len(out) < n:
        u1, u2 = uniform(), uniform()
        r = math.sqrt(-2 * math.log(u1))
        out += [r * math.cos(2 * math.pi * u2), r * math.sin(2 * math.pi * u2)]
    return np.array(out[:n])


def sample_case(name, values, expected_mean, confidence=0.95, seed=None):
    given = cells(values)
    values = present(values)
    n = len(values)
    constant = np.ptp(values) == 0
    out = dict(name=name, spread=float(np.ptp(values)), confidence=confidence, expected_mean=expected_mean)
    out.update(dict(lcg=[n, seed]) if seed else dict(values=given))
    # scipy answers W = 1 and p = 1 with a warning if all values are equal.
    out["shapiro"] = None if n < 3 or constant else [float(x) for x in stats.shapiro(values)]
    if constant:
        difference = float(values[0] - expected_mean)
        t, p = (plain(math.copysign(math.inf, difference)), 0.0) if difference else (None, None)
        out["t_test"] = dict(t=t, p=p, dof=n - 1)
        out["interval"] = [float(values[0])] * 2
        return out
    result = stats.ttest_1samp(values, expected_mean)
    d = (values.mean() - expected_mean) / values.std(ddof=1)
    out["t_test"] = dict(
        t=float(result.statistic), p=float(result.pvalue), dof=n - 1, d=d, hedges_g=d * (1 - 3 / (4 * (n - 1) - 1))
    )
    out["interval"] = [float(x) for x in DescrStatsW(values).tconfint_mean(alpha=1 - confidence)]
    return out


def sample(n, digits=3):
    return np.round(rng.normal(2.0, 1.5, n), digits)


SAMPLES = [
    *(sample_case(f"normal, {n} values", sample(n), 1.5) for n in (2, 3, 4, 5, 6, 8, 11, 12, 20, 50, 200)),
    sample_case("exponential", np.round(rng.exponential(1.0, 30), 3), 1.0, 0.9),
    sample_case("log-normal", np.round(np.exp(rng.normal(0, 1, 60)), 3), 1.0),
    sample_case("uniform", np.round(rng.uniform(0, 100, 40), 1), 50.0, 0.99),
    sample_case("Likert", likert([40], [3.3])[0], 3.0),
    sample_case("heavy ties", rng.choice([0.0, 100.0], 25), 50.0),
    sample_case("equal values", np.full(10, 0.1), 0.1),
    sample_case("equal values, another expected mean", np.full(7, 0.1), 0.3),
    sample_case("equal values but one", np.array([2.0] * 9 + [3.0]), 2.0),
    sample_case("equal values but one of three", np.array([2.0, 2.0, 3.0]), 2.0),
    sample_case("large offset", 1e8 + sample(24), 1e8),
    sample_case("tiny values", 1e-9 * sample(24), 0.0),
    sample_case("one outlier", np.append(sample(19), 40.0), 2.0),
    sample_case("two clusters", np.concatenate([sample(15), sample(15) + 20.0]), 12.0),
    sample_case("missing cells", with_missing([sample(18)], 5)[0], 1.0),
    sample_case("five thousand", lcg_noise(5000, 7), 0.0, seed=7),
]

# ---------------------------------------------------------------- distributions

PROPORTIONS = [
    [k, n, c, *map(float, proportion_confint(k, n, 1 - c, method="wilson")), *map(float, proportion_confint(k, n, 1 - c, method="beta"))]
    for k, n, c in [
        (0, 1, 0.95), (1, 1, 0.95), (0, 12, 0.95), (12, 12, 0.9), (1, 12, 0.95), (11, 12, 0.99), (7, 20, 0.95), (50, 100, 0.95),
        (3, 400, 0.95), (999, 1000, 0.95), (840, 1000, 0.99),
    ]
]
STUDENTIZED_RANGE = [
    [q, k, dof, float(stats.studentized_range.sf(q, k, dof if dof else np.inf))]
    for k in (2, 3, 6, 12, 30) for dof in (1, 2, 5, 24, 120, 5000, None) for q in (0.3, 1.5, 3.0, 4.5, 8.0)
]
CRITICAL = [
    [p, k, dof, float(stats.studentized_range.ppf(1 - p, k, dof))]
    for p, k, dof in [(0.05, 2, 10), (0.05, 3, 10), (0.01, 4, 20), (0.05, 10, 60), (0.1, 5, 3), (0.05, 3, 1), (0.05, 20, 200)]
]

out = dict(
    made_by="vectors/statistics/make.py",
    versions=dict(
        python=platform.python_version(), numpy=np.__version__, scipy=scipy.__version__, statsmodels=statsmodels.__version__,
        pingouin=pingouin.__version__, pandas=pd.__version__,
    ),
    groups=GROUPS, tables=TABLES, samples=SAMPLES, proportions=PROPORTIONS, studentized_range=STUDENTIZED_RANGE, critical=CRITICAL,
)


def text(value, depth=0):
    """JSON with one line for each list of numbers."""
    if isinstance(value, dict):
        parts = [f"{' ' * (depth + 1)}{json.dumps(key)}: {text(v, depth + 1)}" for key, v in value.items()]
        return "{\n" + ",\n".join(parts) + "\n" + " " * depth + "}"
    if isinstance(value, list) and any(isinstance(v, (list, dict)) for v in value):
        return "[\n" + ",\n".join(" " * (depth + 1) + text(v, depth + 1) for v in value) + "\n" + " " * depth + "]"
    return json.dumps(value, allow_nan=False)


with open(os.path.join(HERE, "statistics.json"), "w") as file:
    file.write(text(out) + "\n")
print(len(GROUPS) + len(TABLES) + len(SAMPLES), "data sets;", out["versions"])
