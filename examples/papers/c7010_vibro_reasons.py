"""What decides the claims of the vibro-impact paper, with the figures that show it."""

from __future__ import annotations

from collections.abc import Mapping
from math import degrees

from ball_claim import Found, View, percent, short
from c7010_vibro_claims import SPEEDS


def reasons(found: Mapping[str, Found]) -> str:
    """What decides the claims, with the figures that show it."""
    base, rigid, axial = (View(found.get(r, {})) for r in ("radial", "rigid cage", "axial"))
    thrown = View(found.get("axial + 1 g mm", {}))
    low, high = SPEEDS[0], SPEEDS[-1]

    def n(view: View, key: str, label: str, factor: float = 1.0) -> str:
        return short(view(key, label), factor)

    def p(view: View, key: str, label: str) -> str:
        return percent(view(key, label))

    return f"""
- **Peak force (004-1).** Centrifugal force takes {n(base, "peak", low)} N at 4000 rpm to
  {n(base, "peak", high)} N at 12,000; the quasi-static equations below have the same rise. Off the
  load balls let go of the inner ring for
  {p(base, "empty_opposite", low)} of the time at 4000 rpm. Under an axial load alone no ball does,
  and the force falls with speed ({n(axial, "peak", low)} to {n(axial, "peak", high)} N).
- **Deviation ratio (004-2, 004-4).** It is 40 to 50 % nearly everywhere, at any speed and load. A
  velocity whose three components are random and alike has sqrt(3 pi/8 - 1) = 42 %, one of two
  components 52 %: the ratio says that the cage rattles in no preferred way, not how much. Only
  a steady whirl brings it far below, and none of these cages whirls: weight and balls hold them on
  one side of their play, {n(base, "displacement", "8000 rpm", 1e6)} um off the axis of 150 um.
  At 12,500 N it is {p(base, "deviation", "12500 N")}, where the paper has 24.44 %: a whirl with
  noise on it.
  Under an axial load alone the cage drifts, slower than a turn: its strongest line is that drift.
- **Contact angles (004-3).** At 1500 N they part by centrifugal force, under a radial load to
  {n(base, "inner_angle", high, degrees(1.0))} and {n(base, "outer_angle", high, degrees(1.0))}
  degrees at 12,000 rpm. Under the axial load they stay within 5 %
  ({n(axial, "inner_angle", low, degrees(1.0))} to {n(axial, "inner_angle", high, degrees(1.0))}
  degrees inside): so the paper's figures are of an axial load here, and of a radial one in 004-1.
- **Clearance (004-5).** More play in the pockets lets the cage fall further and does nothing to the
  races. A larger radial clearance, at the same load, leaves fewer balls under it: the force rises
  from {n(base, "peak", "radial 0.02 mm")} to {n(base, "peak", "radial 0.14 mm")} N, and falls only
  under the axial load ({n(axial, "peak", "radial 0.02 mm")} to
  {n(axial, "peak", "radial 0.14 mm")} N), where the angle rises.
- **Waves (004-6).** A rectangle of the load moves the ring axially twice as far as a sine
  ({n(base, "axial_range", "load rectangle", 1e6)} and
  {n(base, "axial_range", "load sine", 1e6)} um) and has no more slip ripple. A rectangle of the
  speed has: jumps of speed throw the balls against the pockets
  ({n(base, "pocket_peak", "speed rectangle")} N, sine {n(base, "pocket_peak", "speed sine")} N).
  Triangle and sine do not differ beyond their intervals.
- **Acceleration (004-7).** Forces follow the speed that was reached, not how fast: axial motion is
  faster, as it must be, and nothing else changes beyond the intervals.
- **Rigid or flexible.** A rigid cage of this PA66 overstates the peak of a pocket's force:
  {n(rigid, "pocket_peak", "4000 rpm")} against {n(base, "pocket_peak", "4000 rpm")} N at 4000,
  {n(rigid, "pocket_peak", "8000 rpm")} against {n(base, "pocket_peak", "8000 rpm")} N at 8000,
  {n(rigid, "pocket_peak", high)} against {n(base, "pocket_peak", high)} N at 12,000 rpm. Races,
  angles and slip do not notice.
- **Inner centre held.** The peak force is {n(base, "peak", "held, 8000 rpm")} N at 8000 rpm, free
  {n(base, "peak", "8000 rpm")} N; at 12,000 rpm {n(base, "peak", "held, 12000 rpm")} and
  {n(base, "peak", high)} N: a free ring passes 18 balls a turn of the cage, and vibrates.
- **Unbalance.** 1 g mm, which whirls the cage of `c7010_centroid`, does nothing under the radial
  load: balls hold the cage. Under the axial load it throws the cage from ball to ball
  ({n(thrown, "pocket_peak", "8000 rpm")} N for
  {n(axial, "pocket_peak", "8000 rpm")} N at 8000 rpm), and neither makes the ratio fall with speed.
- **Mass.** The paper's 27 g in place of some 11 g brings {n(base, "pocket_peak", "27 g")} N for
  {n(base, "pocket_peak", "8000 rpm")} N at 8000 rpm and no other orbit."""
