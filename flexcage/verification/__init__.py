"""The chapter of known answers: ``flexcage verify`` runs it for a user, the tests run it as well.

One file a case in ``cases``, each with its source, its tolerance and why. A case of one's own is a
``KnownAnswer`` handed to ``register_case``.
"""

from flexcage.verification.chapter import CHAPTER, chosen, register_case, run_case
from flexcage.verification.known_answer import KnownAnswer, Outcome, Row, Tolerance

__all__ = [
    "CHAPTER",
    "KnownAnswer",
    "Outcome",
    "Row",
    "Tolerance",
    "chosen",
    "register_case",
    "run_case",
]
