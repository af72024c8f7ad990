"""Tests that decide claims, against published examples and independent code."""

from itertools import product

import numpy as np
import pytest
from scipy import stats

from flexcage.core.errors import InputError
from flexcage.study import claims, decisions, looks, ranks
from flexcage.study.verdicts import FAILS, HOLDS, UNDECIDED

# Hollander, Wolfe, Nonparametric Statistical Methods (2nd ed., 1999), example 6.2
KNOWLEDGE = [[40, 35, 38, 43, 44, 41], [38, 40, 47, 44, 40, 42], [48, 40, 45, 43, 46, 44]]


def test_jonckheere_as_published():
    """J = 79 of 108 pairs, P = .0231 by the table for 6, 6, 6 without ties, J* = 2.02."""
    found = ranks.jonckheere(KNOWLEDGE)
    assert (found.count, found.pairs) == (79, 108)
    assert found.p == pytest.approx(stats.norm.sf(2.04), abs=0.002)  # J* with the ties' variance
    apart = [np.asarray(group) + 1e-3 * np.arange(6) for group in KNOWLEDGE]  # no ties
    chances = ranks._chances((6, 6, 6), None)
    assert chances[79:].sum() == pytest.approx(0.0231, abs=5e-5)
    assert ranks.jonckheere(apart).p < 0.05 < ranks.jonckheere(apart, rising=False).p


def test_mack_wolfe_as_published():
    """Example 6.3 of the same book: sizes 7, 3, 5, 4, 4, 3, peak at the fourth: the tail of the
    exact distribution that it uses is .0101."""
    chances = ranks._chances((7, 3, 5, 4, 4, 3), 3)
    tails = chances[::-1].cumsum()[::-1]
    assert np.abs(tails - 0.0101).min() < 5e-5
    # moments by Mack and Wolfe's formulas: mean (N1^2 + N2^2 - sum n^2 - n_p^2)/4
    n, count = np.array([7, 3, 5, 4, 4, 3]), np.arange(len(chances))
    first, last, n_p, total = 19, 11, 4, 26
    mean = 0.25 * (first**2 + last**2 - (n**2).sum() - n_p**2)
    variance = (
        2 * (first**3 + last**3) + 3 * (first**2 + last**2) - (n**2 * (2 * n + 3)).sum()
        - n_p**2 * (2 * n_p + 3) + 12 * n_p * first * last - 12 * n_p**2 * total
    ) / 72  # fmt: skip
    assert chances @ count == pytest.approx(mean)
    assert chances @ (count - mean) ** 2 == pytest.approx(variance)


def test_exact_chances_are_those_of_all_orders():
    """Four samples of two: every order of eight values, by SciPy's permutation test."""
    groups = [[3.0, 1.0], [4.0, 8.0], [9.0, 5.0], [2.0, 6.0]]

    def umbrella(*samples):
        pairs = [(0, 1), (0, 2), (1, 2), (3, 2)]
        return sum(float(y > x) for i, j in pairs for x, y in product(samples[i], samples[j]))

    found = ranks.mack_wolfe(groups, turn=2)
    exact = stats.permutation_test(
        groups, umbrella, alternative="greater", n_resamples=np.inf, vectorized=False
    )
    assert found.count == exact.statistic
    assert found.p == pytest.approx(exact.pvalue, abs=1e-12)


def test_equivalence_as_published():
    """Moery and Calin-Jageman's data in D. Lakens, Soc. Psychol. Pers. Sci. 8 (2017) 355: within
    0.384 with p = .004, by t of 182 degrees."""
    found = decisions.equal_by_moments((5.25, 5.22), (0.95, 0.83), (95, 89), margin=0.384)
    assert round(found.p, 3) == 0.004 and found.against > 0.99
    rng = np.random.default_rng(1)
    one, other = rng.normal(10.0, 1.0, 12), rng.normal(10.5, 2.0, 9)
    low = stats.ttest_ind(other + 1.0, one, equal_var=False, alternative="greater").pvalue
    high = stats.ttest_ind(other - 1.0, one, equal_var=False, alternative="less").pvalue
    mine = decisions.equal(one, other, within=1.0, absolute=True)
    assert mine.p == pytest.approx(max(low, high))
    above = stats.ttest_ind(other - 1.0, one, equal_var=False, alternative="greater").pvalue
    below = stats.ttest_ind(other + 1.0, one, equal_var=False, alternative="less").pvalue
    assert mine.against == pytest.approx(min(above, below))


def test_limits_of_looks_as_published():
    """Lan and DeMets' limits for five and three even looks, two-sided 5 %: the tables of Proschan,
    Lan, Wittes, Statistical Monitoring of Clinical Trials (2006), and of the package ldbounds."""
    five, three = (0.2, 0.4, 0.6, 0.8, 1.0), (1 / 3, 2 / 3, 1.0)
    brien = looks.boundaries(five, 0.025, "obrien_fleming")
    np.testing.assert_allclose(brien, [4.877, 3.357, 2.680, 2.290, 2.031], atol=5e-4)
    pocock = looks.boundaries(five, 0.025, "pocock")
    np.testing.assert_allclose(pocock, [2.438, 2.427, 2.410, 2.397, 2.386], atol=5e-4)
    np.testing.assert_allclose(looks.boundaries(three, 0.025, "obrien_fleming"),
                               [3.710, 2.511, 1.993], atol=5e-4)  # fmt: skip


def test_looks_spend_what_they_say():
    """A random walk passes the limits at 8, 16 or 30 starts in 2.5 % of 400,000 trials."""
    planned = looks.Looks(spending="pocock")
    rng = np.random.default_rng(2)
    at8, to16, to30 = (rng.normal(0.0, np.sqrt(n), 400_000) for n in (8, 8, 14))
    sums = (at8, at8 + to16, at8 + to16 + to30)
    limits = [stats.norm.isf(planned.level(n)) * np.sqrt(n) for n in planned.starts]
    passed = np.any([s > limit for s, limit in zip(sums, limits)], axis=0)
    assert passed.mean() == pytest.approx(0.025, abs=3 * np.sqrt(0.025 / 400_000))
    with pytest.raises(InputError, match="There are 12 starts.*8, 16, 30"):
        planned.level(12)
    with pytest.raises(InputError, match="rise from 2"):
        looks.Looks((16, 8))
    with pytest.raises(InputError, match="one of obrien_fleming, pocock"):
        looks.Looks(spending="all")


def test_holm_as_published():
    """The worked example of the encyclopaedia's article on the Holm-Bonferroni method."""
    assert decisions.holm([0.01, 0.04, 0.03, 0.005]) == pytest.approx([0.03, 0.06, 0.06, 0.02])


def starts(*means, n=8, spread=0.1, seed=3):
    rng = np.random.default_rng(seed)
    return [mean + spread * rng.standard_normal(n) for mean in means]


def test_a_trend_speaks_for_its_direction_or_for_none():
    assert decisions.trend(starts(1, 2, 3)).p < 1e-4
    assert decisions.trend(starts(3, 2, 1)).against < 1e-4
    level = starts(1, 1, 1, seed=4)
    flat = decisions.trend(level, least=0.5)
    assert flat.p > 0.05 and flat.against < 1e-3
    assert decisions.trend(level).against > 0.05  # nothing was said to be least


def test_a_turn_wants_both_arms():
    """A long arm alone passes Mack and Wolfe's test, but is no turn."""
    groups = starts(4, 3, 2, 2)
    assert ranks.mack_wolfe(groups, turn=2, lowest=True).p < 1e-4
    assert decisions.turning(groups, turn=2).p > 0.05
    assert decisions.turning(starts(4, 3, 2, 3), turn=2).p < 1e-3
    assert decisions.turning(starts(4, 3, 2, 1), turn=2).against < 1e-3
    assert decisions.turning(starts(1, 2, 3, 2), turn=2, lowest=False).p < 1e-3


def test_a_curvature_is_seen_at_uneven_places_and_a_slope_is_none():
    at = np.array([4.0, 7.0, 10.0, 11.0])
    bowl = decisions.bending(starts(*(0.1 * (at - 8.0) ** 2)), at)
    assert bowl.p < 1e-3 and decisions.bending(starts(*at), at).p > 0.05
    contrast = decisions._quadratic(at)
    np.testing.assert_allclose([contrast.sum(), contrast @ at], 0.0, atol=1e-12)
    assert contrast @ at**2 > 0.0
    with pytest.raises(InputError, match="three or more that differ"):
        decisions.bending(starts(1, 2), [1.0, 2.0])


def test_decisions_wait_for_looks_and_share_the_error():
    sure, vague = decisions.Evidence(1e-7, 1.0), decisions.Evidence(0.004, 0.99)
    found = decisions.decide({"a": sure, "b": vague}, starts=8)
    assert found == {"a": HOLDS, "b": UNDECIDED}  # the first look may spend 1.4e-5
    found = decisions.decide({"a": sure, "b": vague, "c": sure.contrary}, starts=30)
    assert found == {"a": HOLDS, "b": HOLDS, "c": FAILS}  # Holm: 0.025/1 for the last
    alone = {f"c{k}": decisions.Evidence(0.01, 1.0) for k in range(4)}
    assert set(decisions.decide(alone, starts=30).values()) == {UNDECIDED}  # 0.025/4
    with pytest.raises(InputError, match="looks are planned at"):
        decisions.decide(alone, starts=9)


def test_claims_may_have_starts_of_their_own():
    """The same numbers for all claims are one number; a claim with more starts has a wider level,
    and one that is rejected leaves its error to the others."""
    p = {"a": 1e-9, "b": 3e-3, "c": 0.2}
    found = {k: decisions.Evidence(value, 1.0) for k, value in p.items()}
    for starts in (8, 16, 30):
        each = decisions.decide(found, starts=dict.fromkeys(p, starts))
        assert each == decisions.decide(found, starts=starts)
    mixed = decisions.decide(found, starts={"a": 8, "b": 30, "c": 16})
    assert mixed == {"a": HOLDS, "b": HOLDS, "c": UNDECIDED}
    assert decisions.decide(found, starts={"a": 8, "b": 16, "c": 16})["b"] == UNDECIDED


def test_wrong_decisions_are_as_rare_as_promised():
    """Ten claims of no effect at three looks: one or more is decided in 5 % of studies at most."""
    rng, planned, wrong, trials = np.random.default_rng(5), looks.Looks(), 0, 400
    for _ in range(trials):
        noise = rng.standard_normal((10, 3, 30))
        for n in planned.starts:
            found = decisions.decide(
                {str(k): decisions.trend(noise[k, :, :n]) for k in range(10)}, starts=n
            )
            if set(found.values()) != {UNDECIDED}:
                wrong += 1
                break
    assert wrong <= stats.binom.isf(1e-3, trials, 0.05)


def test_samples_that_cannot_be_tested_are_refused():
    with pytest.raises(InputError, match="at least 2 samples"):
        ranks.jonckheere([[1.0, 2.0]])
    with pytest.raises(InputError, match="no number"):
        ranks.jonckheere([[1.0], [np.nan]])
    with pytest.raises(InputError, match="others on both sides"):
        ranks.mack_wolfe(KNOWLEDGE, turn=2)
    with pytest.raises(InputError, match="two or more"):
        decisions.above([1.0], 0.0)


def table(**outputs):
    """Numbers by output and condition "a", "b", "c"."""
    return lambda output, condition: outputs[output]["abc".index(condition)]


def test_rules_and_tests_of_claims_agree():
    """Every kind of part, on numbers where it holds and where its contrary does."""
    up, down, bowl = (1.0, 2.0, 3.0), (3.0, 2.0, 1.0), (3.0, 1.0, 2.0)
    conditions = ("a", "b", "c")
    cases = [
        (claims.Trend("x", conditions), up, down),
        (claims.Trend("x", conditions, rising=False), down, up),
        (claims.Turn("x", conditions, 1), bowl, (1.0, 3.0, 2.0)),
        (claims.Between("x", conditions, 0.5, 3.5), up, (1.0, 4.0, 3.0)),
        (claims.Unchanged("x", ("a", "c"), 0.5), (1.0, 3.0, 1.01), up),
        (claims.Below("x", "y", "a", by=0.1), (1.0, 0, 0), (2.0, 0, 0)),
        (claims.Together("x", "y", conditions), up, down),
    ]
    for part, good, bad in cases:
        for numbers, so in ((good, True), (bad, False)):
            assert part.holds(table(x=numbers, y=(1.5, 2.0, 2.5))) is so, part
            many = {"x": starts(*numbers), "y": starts(1.5, 2.0, 2.5, seed=4)}
            found = part.evidence(table(**many))
            assert (found.p if so else found.against) < 1e-3, (part, found)
            assert (found.against if so else found.p) > 0.05, (part, found)


def test_a_claim_without_a_figure_is_open():
    claim = claims.Claim("k", "text", "", {"up": claims.Trend("x", ("a", "b"))}, ("x",))
    holes = table(x=[np.array([1.0, np.nan]), np.array([2.0, 3.0])])
    assert claim.evidence(holes) == decisions.NOTHING
    assert claim.contrary(table(x=(2.0, 1.0))) == ("up",)


def rising(counts):
    rng = np.random.default_rng(0)
    found = {c: 10.0 + 3.0 * k + rng.normal(0.0, 0.5, n) for k, (c, n) in enumerate(counts)}
    return claims.Trend("x", tuple(found)).evidence(lambda output, condition: found[condition])


def test_starts_are_those_that_the_evidence_has():
    """A later look has a higher level, which an earlier look's starts must not take."""
    plan, eight = looks.Looks((8, 16)), rising([("a", 8), ("b", 8), ("c", 8)])
    assert decisions.decide({"r": eight}, starts=8, looks=plan) == {"r": HOLDS}
    with pytest.raises(InputError, match="claim 'r' is of 8 starts, but starts says 16"):
        decisions.decide({"r": eight}, starts=16, looks=plan)
    with pytest.raises(InputError, match="is of 3 to 8 starts, but starts says 16"):
        whole = decisions.all_of([eight, rising([("a", 8), ("b", 3)])]).contrary
        decisions.decide({"r": whole}, starts=16, looks=plan)
    for of in (decisions.above([1.0, 2.0], 0.0), decisions.less([1.0, 2.0], [3.0, 4.0]),
               decisions.equal([1.0, 2.0], [3.0, 4.0], within=0.1),
               decisions.bending([[1, 2], [3, 4], [0, 2]], (1.0, 2.0, 3.0)),
               decisions.turning([[3, 2], [1, 0], [4, 5]], turn=1)):  # fmt: skip
        assert of.starts == {2}


@pytest.mark.parametrize("bad", [np.nan, np.inf])
def test_no_test_takes_what_is_no_number(bad):
    """NaN passed every comparison, and so every claim was undecided."""
    for of in (
        lambda: decisions.above([1.0, bad], 0.0),
        lambda: decisions.less([1.0, 2.0], [bad, 4.0]),
        lambda: decisions.equal([1.0, 2.0], [bad, 4.0], within=0.1),
    ):
        with pytest.raises(InputError, match="a value that is no number; leave it out"):
            of()


def test_conditions_and_looks_that_are_none():
    for conditions in ("abc", ("a", "a")):
        for part in (claims.Trend, claims.Between):
            with pytest.raises(InputError, match="The conditions are .* labels that differ"):
                part("x", conditions)
    with pytest.raises(InputError, match="whole numbers that rise from 2"):
        looks.Looks((8.5, 16))
