"""An extension: figures of a run's summary that flexcage does not have."""

from flexcage.register import figure


def farthest(part):
    """How far the cage's centre moves along the axis."""
    along = part.ds["cage_position"].sel(axis="x")
    return along.max() - along.min()


def loaded(part):
    """Mean over time: loaded elements at an instant, with an interval."""
    force = part.ds["race_force"].sel(race="inner")
    return part.windows.mean((force > 1.0).sum("element").values)


figure(
    "my_axial_play", farthest, title="Cage, motion along the axis", unit="um",
    meaning="largest less least place of its centre", marks=("a cage", "size", "brief", "large"),
)  # fmt: skip
figure(
    "my_loaded", loaded, title="Elements above 1 N, mean", unit="",
    meaning="number at an instant", marks=("size", "statistic"),
)  # fmt: skip
