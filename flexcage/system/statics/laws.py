"""Which normal laws a static solution can take: those whose force at rest it computes itself."""

from __future__ import annotations

from flexcage.core.errors import InputError

AT_REST = ("restitution", "lankarani_nikravesh", "impact_step", "elastic")  # K d^n at rest


def check_law(law: str, where: str, force: str) -> None:
    """Raise InputError for a law that has no force at rest, or another one than the static solution
    takes, which ``force`` names ("rollers on races by ISO/TS 16281")."""
    if law not in AT_REST:
        raise InputError(
            f"{where} is '{law}', but a static solution has {force}, as {', '.join(AT_REST)} have "
            "them at rest; take one of these.",
            where=where,
            value=law,
        )
