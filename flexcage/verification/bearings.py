"""Bearings of the chapter, and their static solutions."""

from __future__ import annotations

from dataclasses import replace
from math import pi, radians
from typing import Any

import numpy as np

import flexcage
from flexcage import spec

RPM = pi / 30.0
DEGREES = 180.0 / pi
_families: Any = spec  # a flexcage without one of its bearing families still passes its checks


def preset(name: str) -> Any:
    """The bearing of a preset; its attributes depend on its family."""
    return flexcage.load_preset(name).bearing


def deep_groove(clearance: float, *, ball: float = 11.5e-3, count: int = 7) -> Any:
    """The deep groove bearing of a published set of ISO/TS 16281 cases, at a clearance [m]."""
    steel = spec.Material(name="steel", youngs_modulus=210e9, poisson_ratio=0.3, density=7850.0)
    return _families.DeepGrooveBallBearing(
        bore=25e-3, outside_diameter=62e-3, width=17e-3, pitch_diameter=43.5e-3,
        ball_diameter=ball, ball_count=count, inner_groove_radius=0.52 * ball,
        outer_groove_radius=0.53 * ball, radial_clearance=clearance, material=steel,
    )  # fmt: skip


def bearing_218() -> Any:
    """Harris's 218 angular contact bearing, 40 degrees, with this chapter's steel."""
    groove = 0.5232 * 22.225e-3
    return replace(
        preset("7010C-PI"), designation="218", bore=90e-3, outside_diameter=160e-3, width=30e-3,
        pitch_diameter=125.26e-3, ball_diameter=22.225e-3, ball_count=16,
        contact_angle=radians(40.0), inner_groove_radius=groove, outer_groove_radius=groove,
        inner_shoulder=None, outer_shoulder=None,
    )  # fmt: skip


def solved(
    bearing: spec.Bearing,
    *,
    rpm: float = 0.0,
    options: spec.StaticOptions | None = None,
    **load: Any,
) -> flexcage.StaticSolution:
    """Static solution of a bearing whose ring tilts freely, under a load of these components."""
    case = flexcage.StaticCase(
        bearing=bearing, load=spec.Load(tilt="free", **load), drive=spec.Drive(speed=rpm * RPM)
    )
    return flexcage.solve_static(case, options=options)


def angles(solution: flexcage.StaticSolution) -> np.ndarray:
    """Contact angles (Z, 2) [deg] at inner and outer race."""
    return DEGREES * solution.elements.angle
