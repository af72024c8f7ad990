"""Needle roller bearings for tests: a drawn cup on the shaft, as HK2016, and NA4904 on a ring."""

from dataclasses import replace

from flexcage.bearings.cylindrical_roller import DrawnCupNeedleRollerBearing, NeedleRollerBearing
from flexcage.cages.window.cage import WindowCage
from flexcage.case.presets import load_preset

CUP = DrawnCupNeedleRollerBearing(
    bore=20e-3, outside_diameter=26e-3, width=16e-3,
    inner_race_diameter=20e-3, outer_race_diameter=24e-3,
    roller_diameter=2e-3, roller_length=11.8e-3, effective_length=11.4e-3, roller_count=22,
    radial_clearance=20e-6, rib_diameter=21e-3, rib_gap=14.2e-3,
)  # fmt: skip
RINGED = NeedleRollerBearing(
    bore=20e-3, outside_diameter=37e-3, width=17e-3,
    inner_race_diameter=25e-3, outer_race_diameter=32e-3,
    roller_diameter=3.5e-3, roller_length=11e-3, effective_length=10.6e-3, roller_count=18,
    radial_clearance=20e-6, rib_diameter=29.5e-3, rib_gap=14e-3,
)  # fmt: skip
CAGE = WindowCage(
    material=load_preset("N1013").cage.material,
    bore=20.8e-3, outside_diameter=23.6e-3, width=13.8e-3, pocket_width=2.1e-3,
    pocket_length=11.95e-3, fillet_radius=0.15e-3, guidance="outer",
)  # fmt: skip
FULL = replace(CUP, roller_count=34, roller_length=13.8e-3, effective_length=13.4e-3)
CUP_CASE = """
[bearing]
type = "drawn_cup_needle_roller"
bore = "20 mm"
outside_diameter = "26 mm"
width = "16 mm"
inner_race_diameter = "20 mm"
outer_race_diameter = "24 mm"
roller_diameter = "2 mm"
roller_length = "11.8 mm"
effective_length = "11.4 mm"
roller_count = 22
radial_clearance = "30 um"
rib_diameter = "21 mm"
rib_gap = "14.2 mm"
[load]
radial = "600 N"
"""
