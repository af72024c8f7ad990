"""The keys of a body from elsewhere, which specs of several rooms have."""

from __future__ import annotations

from dataclasses import dataclass

from flexcage.core.spec import GIVEN, option

#: Systems of units of a body's files; ``modes.exchange.systems`` says what they are in SI.
SYSTEM_NAMES = ("m-kg-s", "mm-t-s", "mm-kg-ms", "in-lbf-s")


@dataclass(frozen=True, kw_only=True)
class BodyFile:
    """A reduced body in a file of another program, or of flexcage."""

    body: str = option(
        "",
        doc="file of a body that was reduced elsewhere (.npz, .op4, .pch, .mtx), in place of what "
        "flexcage would compute",
        file=True,
    )
    body_nodes: str = option(
        "",
        doc="deck that says where its nodes are (.bdf, .dat, .nas, .asm, .inp, .cdb), if the file "
        "itself does not",
        file=True,
        when={"body": GIVEN},
    )
    body_units: str = option(
        SYSTEM_NAMES[0],
        doc="system of units of both files",
        choices=SYSTEM_NAMES,
        when={"body": GIVEN},
    )
