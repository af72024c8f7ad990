"""What decides the claims of the paper on fluctuating speed, with the figures that show it."""

from __future__ import annotations

from collections.abc import Mapping
from math import pi

from ball_claim import Found, View, percent, short
from speed_fluctuation_claims import CONSTANT

RPM = 30.0 / pi


def reasons(found: Mapping[str, Found]) -> str:
    """What decides the claims, with the figures that show it."""
    names = ("step", "rigid cage", "static friction", "dynamic friction", "spherical pockets")
    base, rigid, stick, slide, round_ = (View(found.get(name, {})) for name in names)
    low, once, most, twice, thrice = "A 3 %", "A 6 %", "A 9 %", "A 6 %, N 2", "A 6 %, N 3"

    def n(view: View, key: str, label: str, factor: float = 1.0) -> str:
        return short(view(key, label), factor)

    def p(view: View, key: str, label: str) -> str:
        return percent(view(key, label))

    return f"""
- **Balls follow the ring, the cage rattles between them (002-1, 002-7).** The balls' mean orbital
  speed has the ring's wave to four digits: {p(base, "ball_gain", once)},
  {p(base, "ball_gain", twice)} and {p(base, "ball_gain", thrice)} at N = 1, 2, 3. The cage is
  only pushed: it crosses the play of its pockets (0.15 mm to either side), arrives faster than
  the ball, and is thrown back. So it
  swings by more than the ring, the more so the faster the waves: its part at the ring's frequency
  is {p(base, "gain", once)}, {p(base, "gain", twice)} and {p(base, "gain", thrice)}. What
  friction at balls and pockets takes of that decides how much: with the dynamic coefficients
  alone (0.002 and 0.02) the fluctuation is {p(slide, "swing", once)} at 6 % and
  {p(slide, "swing", most)} at 9 %, as in the paper, and {p(slide, "swing", twice)} at N = 2.
- **The static coefficient everywhere is another regime.** With 0.1 and 0.15 at any sliding speed,
  which is what LS-DYNA takes if it is not told how friction decays, a cage that anything disturbs
  is driven by friction in its pockets: {n(stick, "pocket_peak", low)} N a pass at 3 %, for
  {n(base, "pocket_peak", low)} N in the base reading, and a fluctuation of
  {p(stick, "swing", low)} in which the ring's sine has {p(stick, "follows", low)} of the
  variance. There 002-2 holds, and the cage's speed no longer follows the ring's. At constant
  speed the same cage stays calm ({n(stick, "pocket_peak", CONSTANT)} N): nothing disturbed it
  within this run. It takes both: 0.1 at races with 0.02 in pockets gives 0.80 N a pass at 3 %, and
  0.002 with 0.15 gives 1.50 N (0.15 s each).
- **At constant speed** the paper's cage fluctuates by 2.89 %; here it does by
  {p(base, "swing", CONSTANT)}, and by {p(stick, "swing", CONSTANT)} and
  {p(slide, "swing", CONSTANT)} with either coefficient alone. The paper's cage also lags: 922 rpm
  are 1.3 % below the kinematics. Here contact angles that differ from 60 degrees make
  {n(base, "speed", CONSTANT, RPM)} rpm, 0.3 % above, and no reading of friction brings 1
  % of sliding: 3500 N press every ball on its races.
- **Distances and orbits (002-3, 002-4).** A combined load makes balls run ahead and behind: they
  stand up to {n(base, "excursion", CONSTANT, 1e6)} um off even spacing, more than the play of the
  pockets, and carry the cage {n(base, "distance", CONSTANT, 1e6)} um off the axis without any
  wave. Fluctuation shakes it back ({n(base, "distance", most, 1e6)} um at 9 %,
  {n(base, "distance", thrice, 1e6)} um at N = 3): the distance does not rise. By the measure that
  was fixed beforehand the orbit stays regular: its line at the cage's own frequency has
  {p(base, "orbit_line", CONSTANT)} of the variance, and {p(base, "orbit_line", most)} at 9 %. To
  the eye it is as the paper says, an ellipse at constant speed and loops about it with waves
  (picture below): the rest of the variance is in them, at 3 % already.
- **Forces on the cage (002-3)** rise with N ({n(base, "pocket_peak", once)},
  {n(base, "pocket_peak", twice)}, {n(base, "pocket_peak", thrice)} N a pass) and with A
  ({n(base, "pocket_peak", CONSTANT)}, {n(base, "pocket_peak", low)},
  {n(base, "pocket_peak", once)}, {n(base, "pocket_peak", most)} N); the largest of all, which the
  claim names, is too rare for that.
- **Races (002-5, 002-6)** do not notice: the largest ball force ripples by
  {p(base, "ripple", CONSTANT)} at constant speed and {p(base, "ripple", most)} at 9 %, which is
  the passing of 17 balls, and {p(base, "by_place", CONSTANT)} of the variance of a ball's force
  follows from where it is. They range from {n(base, "force_least", CONSTANT)} to
  {n(base, "force_most", CONSTANT)} N (quasi-static: 15.0 to 542.5 N).
- **Rigid or flexible.** A rigid cage has {n(rigid, "pocket_peak", once)} N for
  {n(base, "pocket_peak", once)} N a pass at 6 %, {n(rigid, "pocket_peak", most)} for
  {n(base, "pocket_peak", most)} N at 9 %; speeds and orbits are the same.
- **Spherical pockets** hold the cage across the axis too: its centre goes
  {n(round_, "distance", CONSTANT, 1e6)} um off the axis, and its speed fluctuates by
  {p(round_, "swing", once)} at 6 % and {p(round_, "swing", thrice)} at N = 3.
"""
