"""Specs of all cage types, which ``flexcage.spec`` shows; a new cage type is its line here."""

from flexcage.cages.barrel import *  # noqa: F403
from flexcage.cages.conical import *  # noqa: F403
from flexcage.cages.crown import *  # noqa: F403
from flexcage.cages.machined import *  # noqa: F403
from flexcage.cages.ribbon import *  # noqa: F403
from flexcage.cages.window import *  # noqa: F403
