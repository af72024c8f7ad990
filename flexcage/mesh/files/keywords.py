"""Keyword blocks of an Abaqus or CalculiX deck, and which keywords say nothing of the mesh."""

from __future__ import annotations

import math
import re
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, field

from flexcage.mesh.files.raw import Refused, lines_of

# Keywords of the model that neither make nor move nodes, elements or their sets. Any other one is
# refused by name; what stands after *STEP is history.
_HARMLESS = """
HEADING; PREPRINT; RESTART; FILE FORMAT; TIME POINTS; FILTER; AMPLITUDE; PHYSICAL CONSTANTS;
BOUNDARY; BASE MOTION; INITIAL CONDITIONS; EQUATION; MPC; USER MPC; COUPLING; KINEMATIC;
KINEMATIC COUPLING; DISTRIBUTING; DISTRIBUTING COUPLING; RIGID BODY; DISPLAY BODY; FASTENER;
FASTENER PROPERTY; EMBEDDED ELEMENT; SHELL TO SOLID COUPLING; TIE; CYCLIC SYMMETRY MODEL; SUBMODEL;
ORIENTATION; DISTRIBUTION; DISTRIBUTION TABLE; TRANSFORM; NORMAL; NODAL THICKNESS; RELEASE;
SOLID SECTION; SHELL SECTION; SHELL GENERAL SECTION; MEMBRANE SECTION; SURFACE SECTION;
BEAM SECTION; BEAM GENERAL SECTION; TRUSS SECTION; CONNECTOR SECTION; GASKET SECTION;
COHESIVE SECTION; SECTION CONTROLS; SECTION POINTS; HOURGLASS STIFFNESS; TRANSVERSE SHEAR;
TRANSVERSE SHEAR STIFFNESS; REBAR; REBAR LAYER; LAYER; MASS; ROTARY INERTIA; NONSTRUCTURAL MASS;
SPRING; DASHPOT; GAP; HEATCAP; CONNECTOR BEHAVIOR; CONNECTOR ELASTICITY; CONNECTOR DAMPING;
CONNECTOR FRICTION; CONNECTOR STOP; CONNECTOR LOCK; CONNECTOR CONSTITUTIVE REFERENCE;
PRE-TENSION SECTION; MATERIAL; USER MATERIAL; USER DEFINED FIELD; DEPVAR; DENSITY; ELASTIC; PLASTIC;
RATE DEPENDENT; CYCLIC HARDENING; CREEP; HYPERELASTIC; HYPERFOAM; VISCOELASTIC; VISCOUS; TRS;
UNIAXIAL TEST DATA; BIAXIAL TEST DATA; PLANAR TEST DATA; VOLUMETRIC TEST DATA;
SIMPLE SHEAR TEST DATA; MULLINS EFFECT; EXPANSION; CONDUCTIVITY; SPECIFIC HEAT; LATENT HEAT;
DAMPING; NO COMPRESSION; NO TENSION; POTENTIAL; DEFORMATION PLASTICITY; ANNEAL TEMPERATURE;
DAMAGE INITIATION; DAMAGE EVOLUTION; FAIL STRESS; FAIL STRAIN; TENSILE FAILURE; SHEAR FAILURE;
INELASTIC HEAT FRACTION; ELECTRICAL CONDUCTIVITY; JOULE HEAT FRACTION; BULK VISCOSITY; EOS;
MOHR COULOMB; MOHR COULOMB HARDENING; DRUCKER PRAGER; DRUCKER PRAGER HARDENING;
CAST IRON PLASTICITY; MAGNETIC PERMEABILITY; FLUID CONSTANTS; FLUID BEHAVIOR; FLUID DENSITY;
SURFACE INTERACTION; SURFACE BEHAVIOR; FRICTION; COHESIVE BEHAVIOR; CONTACT; CONTACT PAIR;
CONTACT INCLUSIONS; CONTACT EXCLUSIONS; CONTACT PROPERTY ASSIGNMENT; CONTACT CONTROLS;
CONTACT CONTROLS ASSIGNMENT; CONTACT FORMULATION; CONTACT DAMPING; CONTACT STABILIZATION;
CONTACT INITIALIZATION DATA; CONTACT INITIALIZATION ASSIGNMENT; GAP CONDUCTANCE; GAP RADIATION;
GAP HEAT GENERATION; SURFACE PROPERTY; SURFACE PROPERTY ASSIGNMENT; SURFACE SMOOTHING; CLEARANCE;
MATRIX INPUT; MATRIX ASSEMBLE; USER ELEMENT; MATRIX; UEL PROPERTY; SUBSTRUCTURE PROPERTY;
VALUES AT INFINITY; DESIGN VARIABLES; END PART; END ASSEMBLY
"""
_COMMA = re.compile(r',(?=(?:[^"]*"[^"]*")*[^"]*$)')
_LARGEST = 2**62  # number of a node or an element
HARMLESS = frozenset(" ".join(name.split()) for name in _HARMLESS.split(";"))
#: How its own program writes out a mesh that a deck makes by rules.
WRITTEN_OUT = (
    "let its program write the mesh out: in Abaqus/CAE by File, Import, Model, or Part from the "
    ".odb of a datacheck, and then Job, Write Input"
)
_MAKES = {"NGEN": "nodes", "NFILL": "nodes", "NCOPY": "nodes", "NMAP": "nodes",
          "ELGEN": "elements", "ELCOPY": "elements"}  # fmt: skip


@dataclass(frozen=True)
class Block:
    """One keyword with its parameters and data lines; ``line`` and ``lines`` count from 1."""

    keyword: str  # in capitals
    line: int
    values: Mapping[str, str]  # parameters, their names in capitals
    rows: list[list[str]] = field(default_factory=list)
    lines: list[int] = field(default_factory=list)  # of the rows

    def data(self) -> Iterator[tuple[int, list[str]]]:
        """Line and values of every row."""
        return zip(self.lines, self.rows)

    def only(self, *known: str) -> None:
        """Refuse parameters that are not known to be followed or harmless."""
        for name, value in self.values.items():
            if name == "INPUT":
                raise Refused(
                    f"line {self.line}: *{self.keyword} takes its data from another file "
                    f"('{value}'), and one file must hold the whole mesh, so that a run knows what "
                    "it used; write the data in its place"
                )
            if name not in known:
                raise Refused(
                    f"line {self.line}: *{self.keyword} has the parameter {name}, which is not "
                    "followed; export the mesh without it"
                )


def blocks(text: str) -> Iterator[Block]:
    """Keyword blocks of a deck up to its first *STEP, comments left out."""
    block, begun, at = Block("", 0, {}), "", 0
    for number, raw in enumerate(lines_of(text), start=1):
        line = raw.strip()
        if not line or line.startswith("**"):
            continue
        if begun or line.startswith("*"):
            at = at if begun else number
            begun += line
            if begun.endswith(","):  # goes on in the next line
                continue
            if block.keyword:
                yield block
            block, begun = _begun(begun, at), ""
            if block.keyword == "STEP":
                return
        else:
            block.rows.append([v.strip().strip("\"'") for v in _fields(line)])
            block.lines.append(number)
    if block.keyword:
        yield block


def _fields(text: str) -> list[str]:
    """What stands between commas; those within a name in quotes part nothing."""
    return text.split(",") if '"' not in text else _COMMA.split(text)


def _begun(text: str, line: int) -> Block:
    head, *parameters = _fields(text[1:])
    pairs = [p.partition("=") for p in parameters]
    values = {" ".join(k.upper().split()): v.strip().strip("\"'") for k, _, v in pairs}
    return Block(" ".join(head.upper().split()), line, values)


def refuse(block: Block) -> None:
    """Raise ``Refused`` for a keyword that is not followed, unless it says nothing of the mesh."""
    name, line = block.keyword, block.line
    if name in HARMLESS:
        return
    if name == "INCLUDE":
        block.only()
    if name in _MAKES:
        raise Refused(
            f"line {line}: *{name} makes {_MAKES[name]} by a rule, and only those written out are "
            f"read; {WRITTEN_OUT}"
        )
    raise Refused(
        f"line {line}: *{name} is not followed, and may change nodes, elements or sets; delete its "
        f"block if it does not, or {WRITTEN_OUT}"
    )


def whole(text: str, line: int) -> int:
    """A whole number of a deck."""
    try:
        value = int(text)
    except ValueError:
        raise Refused(f"line {line}: '{text}' stands where a whole number belongs") from None
    if abs(value) > _LARGEST:
        raise Refused(f"line {line}: the number {text} is larger than any program counts; renumber")
    return value


def real(text: str, line: int) -> float:
    """A number of a deck: an empty field is zero, exponents may be written with D."""
    try:
        value = float(text.upper().replace("D", "E")) if text else 0.0
    except ValueError:
        value = math.nan
    if not math.isfinite(value):
        raise Refused(f"line {line}: '{text}' stands where a number belongs")
    return value


def reals(row: Sequence[str], line: int, count: int) -> list[float]:
    """The first ``count`` numbers of a row; those that are not there are zero."""
    return [real(text, line) for text in [*row[:count], *[""] * (count - len(row))]]
