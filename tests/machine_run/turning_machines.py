"""A spindle in a pair of bearings, for runs of a few milliseconds."""

SPINDLE = """
name = "pair"
[drive]
speed = "8000 rpm"
[shaft]
kind = "{kind}"
[[shaft.sections]]
length = "240 mm"
diameter = "50 mm"
bore = "20 mm"
[[shaft.discs]]
name = "tool"
position = "5 mm"
mass = "0.5 kg"
unbalance = "{unbalance} g*mm"
[[shaft.loads]]
position = "0 mm"
force = ["0 N", "200 N", "0 N"]
[[bearings]]
name = "front"
preset = "7010C-PI"
position = "60 mm"
facing = "-x"
axial_offset = "4 um"
cage.model = "rigid"
[[bearings]]
name = "rear"
preset = "7010C-PI"
position = "180 mm"
facing = "+x"
axial_offset = "4 um"
cage.model = "rigid"
[solver]
duration = "{duration} ms"
[output]
block = 50
"""


def spindle(kind="rigid", duration=4, unbalance=0):
    return SPINDLE.format(kind=kind, duration=duration, unbalance=unbalance)
