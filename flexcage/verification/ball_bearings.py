"""Ball bearings of the chapter, and their static solutions."""

from __future__ import annotations

from dataclasses import replace
from math import pi, radians
from typing import TYPE_CHECKING, cast

import numpy as np

from flexcage.bearings import statics_of
from flexcage.case.presets import load_preset
from flexcage.geometry.bearing import BEARING_TYPES, Bearing
from flexcage.geometry.materials import Material
from flexcage.system.spec import Load
from flexcage.system.statics.options import StaticOptions
from flexcage.system.statics.solution import StaticSolution
from flexcage.system.statics.solve import solve_bearing

if TYPE_CHECKING:
    from flexcage.bearings.ball import AngularContactBallBearing, DeepGrooveBallBearing

RPM = pi / 30.0
DEGREES = 180.0 / pi


def preset(name: str) -> AngularContactBallBearing:
    """Angular contact bearing of a preset."""
    return cast("AngularContactBallBearing", load_preset(name).bearing)


def deep_groove(
    clearance: float, *, ball: float = 11.5e-3, count: int = 7
) -> DeepGrooveBallBearing:
    """The deep groove bearing of a published set of ISO/TS 16281 cases, at a clearance [m]."""
    steel = Material(name="steel", youngs_modulus=210e9, poisson_ratio=0.3, density=7850.0)
    spec: type[DeepGrooveBallBearing] = BEARING_TYPES["deep_groove_ball"]
    return spec(
        bore=25e-3, outside_diameter=62e-3, width=17e-3, pitch_diameter=43.5e-3,
        ball_diameter=ball, ball_count=count, inner_groove_radius=0.52 * ball,
        outer_groove_radius=0.53 * ball, radial_clearance=clearance, material=steel,
    )  # fmt: skip


def bearing_218() -> AngularContactBallBearing:
    """Harris's 218 angular contact bearing, 40 degrees, with this chapter's steel."""
    groove = 0.5232 * 22.225e-3
    return replace(
        preset("7010C-PI"), designation="218", bore=90e-3, outside_diameter=160e-3, width=30e-3,
        pitch_diameter=125.26e-3, ball_diameter=22.225e-3, ball_count=16,
        contact_angle=radians(40.0), inner_groove_radius=groove, outer_groove_radius=groove,
        inner_shoulder=None, outer_shoulder=None,
    )  # fmt: skip


def solved(
    bearing: Bearing,
    *,
    rpm: float = 0.0,
    options: StaticOptions | None = None,
    axial: float = 0.0,
    radial: float = 0.0,
    moment_y: float = 0.0,
    moment_z: float = 0.0,
) -> StaticSolution:
    """Static solution of a bearing under a load of these components."""
    load = Load(axial=axial, radial=radial, moment_y=moment_y, moment_z=moment_z, tilt="free")
    elements_of = statics_of(bearing)
    return solve_bearing(bearing, elements_of, load=load, speed=rpm * RPM, options=options)


def angles(solution: StaticSolution) -> np.ndarray:
    """Contact angles (Z, 2) [deg] at inner and outer race."""
    return DEGREES * solution.elements.angle
