"""Figures of what fits, warmth and speed leave of a bearing's clearance."""

from __future__ import annotations

from functools import partial

from flexcage.geometry.fits.mounting import Grip, Mounting
from flexcage.geometry.fits.telling import um
from flexcage.results.figures.figure import FigureTable, Found

_ALIKE = 1e-10  # m


def _part(key: str, mounting: Mounting) -> Found:
    least, _, largest = values = mounting.part(key).values
    within = f"{um(least)} to {um(largest)} within tolerances" if largest - least > _ALIKE else ""
    return Found(values[mounting.taken], within)


def _interference(grip: Grip, mounting: Mounting) -> Found:
    given = grip.interference[mounting.taken]
    return Found(grip.operating[mounting.taken], f"{um(given)} as toleranced")


# fmt: off
#: Of cases with [fit].
FITS = FigureTable[Mounting]("Clearance", "section [fit]")
for _key, _title, _meaning in (
    ("initial", "Radial clearance, before mounting", "of the class, or as the bearing has it"),
    ("inner_fit", "Clearance by the inner fit", "what the shaft's interference adds; < 0: takes"),
    ("outer_fit", "Clearance by the outer fit", "what the housing's interference adds"),
    ("smoothing", "Clearance by smoothing", "what smoothed seats give back"),
    ("temperature", "Clearance by temperature", "what warmth of rings, elements and seats adds"),
    ("centrifugal", "Clearance by centrifugal growth", "what the inner ring's growth adds"),
    ("operating", "Radial clearance, in operation", "what the run had"),
):
    FITS.add(f"clearance_{_key}", _title, "um", _meaning, "signed", take=partial(_part, _key))
FITS.add("interference_inner", "Interference, shaft and inner ring", "um",
         "in operation; < 0: a gap", "signed", take=lambda m: _interference(m.inner, m))
FITS.add("interference_outer", "Interference, housing and outer ring", "um",
         "in operation; < 0: a gap", "signed", take=lambda m: _interference(m.outer, m))
FITS.add("fit_pressure_inner", "Pressure, shaft and inner ring", "MPa", "in operation",
         take=lambda m: m.inner.pressure[m.taken])
FITS.add("fit_contact_angle", "Free contact angle, in operation", "deg",
         "of angular contact bearings",
         take=lambda m: None if m.angles is None else m.angles[1])
FITS.add("fit_approach", "Inner ring's approach", "um",
         "by which it meets its elements earlier along the axis, of angular contact bearings",
         "signed", take=lambda m: m.approach)
