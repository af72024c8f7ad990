"""The N1013 with its ribs on other rings: bearings of each design."""

from dataclasses import replace

from flexcage.case.presets import load_preset

N = load_preset("N1013").bearing
INNER, OUTER, GAP = N.rib_diameter, 86.6e-3, 8.03e-3  # m; ribs of both rings are 1.95 mm high
_BOTH = {"counter_rib_gap": GAP}
NU = replace(N, design="NU", rib_diameter=OUTER)
NJ = replace(NU, design="NJ", counter_rib_diameter=INNER, **_BOTH)
NUP = replace(NJ, design="NUP")
NF = replace(N, design="NF", counter_rib_diameter=OUTER, **_BOTH)
DESIGNS = {"N": N, "NU": NU, "NJ": NJ, "NUP": NUP, "NF": NF}
