"""Specs of all families, which ``flexcage.spec`` shows; a new family is its line here."""

from flexcage.bearings.ball import *  # noqa: F403
from flexcage.bearings.cylindrical_roller import *  # noqa: F403
from flexcage.bearings.double_row_ball import *  # noqa: F403
from flexcage.bearings.double_row_roller import *  # noqa: F403
from flexcage.bearings.four_point import *  # noqa: F403
from flexcage.bearings.spherical_roller import *  # noqa: F403
from flexcage.bearings.tapered_roller import *  # noqa: F403
