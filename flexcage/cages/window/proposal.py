"""A machined window cage of usual proportions for a roller bearing."""

from __future__ import annotations

from typing import Any

from flexcage.cages.window.cage import WindowCage
from flexcage.geometry.inference import ProposedCage, rounded
from flexcage.geometry.materials import MATERIALS

_AROUND, _ALONG = 0.2e-3, 0.25e-3  # m, clearances of a pocket
_TO_RIBS = 0.25e-3  # m, radially
_WALL = 0.48  # over the roller's diameter
_SIDE_BEAM = 0.35  # likewise
_WIDEST = 0.9  # over the bearing's width
_FILLET = 0.06  # over the roller's diameter
_STEP = 10e-6  # m
# of needles: clearances [m] of a pocket, to the ribs beside the cage and to the outer race
_NEEDLE_AROUND, _NEEDLE_ALONG, _BESIDE, _TO_RACE = 0.1e-3, 0.15e-3, 0.2e-3, 0.15e-3
_NEEDLE_WALL = 0.6  # over the needle's diameter


def propose_window_cage(bearing: Any) -> ProposedCage:
    """A hollow cylinder guided by ribs, above the inner ring's or below the outer ring's: pockets
    with flat walls do not hold a cage radially."""
    if bearing.cage_between_ribs:
        return _needle_cage(bearing)
    roller, length = bearing.element_diameter, bearing.element_length
    inner, outer = (limit.diameter for limit in bearing.cage_space(None))
    guide = _guide(bearing, inner, outer)
    above = guide == "inner"
    wall = min(_WALL * roller, 0.5 * (outer - inner) - 2.0 * _TO_RIBS)
    bore, outside = inner + 2.0 * _TO_RIBS, inner + 2.0 * (_TO_RIBS + wall)
    if not above:
        bore, outside = outer - 2.0 * (_TO_RIBS + wall), outer - 2.0 * _TO_RIBS
    pocket = length + _ALONG
    cage = WindowCage(
        bore=rounded(bore, _STEP),
        outside_diameter=rounded(outside, _STEP),
        width=rounded(min(pocket + 2.0 * _SIDE_BEAM * roller, _WIDEST * bearing.width), _STEP),
        pocket_width=rounded(roller + _AROUND, _STEP),
        pocket_length=rounded(pocket, _STEP),
        fillet_radius=rounded(_FILLET * roller, _STEP),
        guidance=guide,
    )
    to_ribs = f"assumption: {1e3 * _TO_RIBS:g} mm of radial clearance to the ribs"
    thick = f"assumption: a wall {wall / roller:.2g} times the roller's diameter thick"
    return ProposedCage(
        cage=cage,
        reasons={
            "material": "assumption: machined cages are of brass",
            "bore": to_ribs if above else thick,
            "outside_diameter": thick if above else to_ribs,
            "width": f"assumption: side beams {_SIDE_BEAM:g} times the roller's diameter wide, or "
            f"{_WIDEST:g} of the bearing's width",
            "pocket_width": f"assumption: {1e3 * _AROUND:g} mm of clearance",
            "pocket_length": f"assumption: {1e3 * _ALONG:g} mm of clearance",
            "fillet_radius": f"assumption: {_FILLET:g} times the roller's diameter",
            "guidance": "assumption: by the ribs, as flat pocket walls do not hold a cage radially",
        },
    )


def _guide(bearing: Any, inner: float, outer: float) -> str:
    """The ring that has ribs on both sides; of two, the one whose ribs, of diameters ``inner`` and
    ``outer`` [m], come nearer to the pitch circle."""
    pitch = bearing.pitch_diameter
    gaps = {"inner": pitch - inner, "outer": outer - pitch}
    both = [ring for ring in gaps if (ribs := bearing.ribs(ring)) and all(ribs.sides)]
    return min(both, key=lambda ring: gaps[ring])


def _needle_cage(bearing: Any) -> ProposedCage:
    """A cage between the ribs of the outer ring, guided by its race."""
    needle, (_, outer) = bearing.element_diameter, bearing.cage_space(None)
    outside = outer.diameter - 2.0 * _TO_RACE
    cage = WindowCage(
        material=MATERIALS["steel"],
        bore=rounded(outside - 2.0 * _NEEDLE_WALL * needle, _STEP),
        outside_diameter=rounded(outside, _STEP),
        width=rounded(bearing.rib_gap - _BESIDE, _STEP),
        pocket_width=rounded(needle + _NEEDLE_AROUND, _STEP),
        pocket_length=rounded(bearing.element_length + _NEEDLE_ALONG, _STEP),
        fillet_radius=rounded(_FILLET * needle, _STEP),
        guidance="outer",
    )
    return ProposedCage(
        cage=cage,
        reasons={
            "material": "assumption: needle cages are of steel",
            "bore": f"assumption: a wall {_NEEDLE_WALL:g} times the needle's diameter thick",
            "outside_diameter": f"assumption: {1e3 * _TO_RACE:g} mm of radial clearance to the "
            "outer race",
            "width": f"assumption: {1e3 * _BESIDE:g} mm of axial play between the ribs",
            "pocket_width": f"assumption: {1e3 * _NEEDLE_AROUND:g} mm of clearance",
            "pocket_length": f"assumption: {1e3 * _NEEDLE_ALONG:g} mm of clearance",
            "fillet_radius": f"assumption: {_FILLET:g} times the needle's diameter",
            "guidance": "assumption: by the outer race, between its ribs",
        },
    )
