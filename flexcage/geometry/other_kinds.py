"""Kinds of bearings that flexcage has not, by their names and by makers' designations, and what of
a bearing's surroundings it does not compute: declined by name where people look for them."""

from __future__ import annotations

import re
from collections.abc import Mapping
from types import MappingProxyType

from flexcage.core.wings import FAMILIES

_HAS = "flexcage has none ('flexcage keys bearing' lists its types)"
_AS_TYPE = (
    "its internal geometry is not inferred: give that in a case as bearing.type '{}', for "
    "'flexcage static'"
)
# ISO 15 and makers' catalogues (SKF, Schaeffler, NSK): first digits and letters of designations
# without spaces, dashes and strokes, and what such a bearing is
_DESIGNATIONS = {
    r"(HR|T)?3(0[23]|13|2[02389]|3[0-2])\d\d.*": "a tapered roller bearing",
    r"(J?L|J?H|J?M|LL|J?LM|J?HM|HH)\d{5,6}.*": "a tapered roller bearing in inches",
    r"[BHJ]?5[1-4][1-4]\d\d.*": "a thrust ball bearing",
    r"2(13|2[23]|3[0-29]|4[01])\d\d.*": "a spherical roller bearing",
    r"29[234]\d\d.*": "a spherical roller thrust bearing",
    r"8(1[12]|74|9[34])\d\d.*": "a cylindrical roller thrust bearing",
    r"(1[23]|2[23])\d\d([A-Z].*)?": "a self-aligning ball bearing",
    r"(3[0238]|5[23])\d\d([A-Z].*)?": "a double row angular contact ball bearing",
    r"4[23]\d\d([A-Z].*)?": "a double row deep groove ball bearing",
    r"(NKIA|NKIB|NKX|NKXR)\d.*": "a needle roller bearing combined with a ball bearing",
    r"(AXK|AXW)\d.*": "a thrust needle roller bearing",
    r"K\d.*": "a needle roller and cage assembly, without rings",
    r"(NNCF|NNCL|NNC|NNF|SL0\d|SL1850)\d.*": "a double row full complement cylindrical roller "
    "bearing",
    r"RSL1[89]\d.*": "a full complement cylindrical roller bearing without an outer ring",
    r"N[CJ]F\d+ECJ[AB].*": "a high-capacity cylindrical roller bearing, with a cage",
    r"RNU\d{3,}.*": "a cylindrical roller bearing without an inner ring",
    r"RN\d{3,}.*": "a cylindrical roller bearing without an outer ring",
    r"NH\d{3,}.*": "a cylindrical roller bearing with an angle ring",
    r"NNU?\d.*": "a double row cylindrical roller bearing",
    r"(UC|YAR|YET|YEL|GYE|SA|SB)\d.*": "an insert bearing",
    r"C[2345]\d{3}.*": "a toroidal roller bearing",
    r"X[RS]U?\d.*|RB\d{4,}.*": "a crossed roller bearing",
}
_NAMES = {
    r".*thrust.*": "thrust bearings",
    r"(double|two|multi|four).?row.*|duplex.*": "such bearings of several rows",
    r"(cross|toroid|carb|insert|slewing|linear|plain|journal|magnetic|slide).*": "such bearings",
}
_CAGELESS = re.compile(r"full.?complement.*|cageless", re.IGNORECASE)
_PAIR = re.compile(r"(7\d{3}[A-Z0-9]*?)(DB|DF|DT(?!N)|DG|DU|QBC|QFC|QBT|QFT|TBT|TFT|TBTX)[A-Z0-9]*")
_SETS = {"DB": "back to back", "DF": "face to face", "DT": "in tandem"}
# digits alone, set off from what follows: "3206-2RS" has four, "32062" five
_FOUR_DIGITS = re.compile(r"(3[0238]|4[23]|5[23])\d\d[\s_/.-].*")

#: What a bearing's surroundings have, by pattern of a key that people look for: what there is.
SURROUNDINGS: Mapping[str, str] = MappingProxyType({
    r"shafts?|rotors?|spindle": "a case has one bearing, and no shaft that bends: a shaft in "
    "several bearings is a machine, [shaft] and [[bearings]]; of one bearing's, drive.kind and "
    "drive.shaft_stiffness twist it, load.axial_stiffness and load.tilt_stiffness hold the ring, "
    "load.shaft_mass moves with it",
    r"housings?": "a housing is [mount]",
    r"bearings|pairs?|duplex|arrangement|rows?|sets?": "a case has one single-row bearing, "
    "[bearing]; pairs, sets and bearings of one shaft are a machine, [shaft] and [[bearings]]",
    r"pre.?load.*|springs?": "a preload between bearings is that of a machine, in its "
    "[[bearings]]; in the case of one give its force as load.axial, or a negative "
    "bearing.radial_clearance of deep groove balls",
    r"(.*_)?temperatures?(_.*)?|heat.*|thermal.*|cooling": "flexcage computes no heat: give "
    "lubricant.viscosity at the temperature of work, temperatures of rings, shaft and housing in "
    "[fit] for the clearance, and cage.temperature for the cage's modulus",
    r"fits|fitting|seats?|interferences?|press.?fits?|tolerances?|mounting": "fits of both rings, "
    "and what they leave of the clearance, are [fit]",
    r"(ball|roller|rolling|ceramic).*materials?|hybrid|ceramics?": "the material of rolling "
    'elements is bearing.element_material, as "Si3N4"',
    r"grease.*|seals?": "flexcage knows the oil of [lubricant]; grease, seals and "
    "their torque are not computed",
})  # fmt: skip


def kind_of(designation: str) -> str:
    """Why flexcage has not the bearing of a maker's designation, as a part of a sentence: its kind;
    empty for one that may be of a kind that it has."""
    name = re.sub(r"[\s_/-]", "", designation.upper())
    if pair := _PAIR.fullmatch(name):
        how = f" {_SETS[pair[2]]}" if pair[2] in _SETS else ""
        return (
            f"is a set of bearings{how} ({pair[2]}); flexcage has single ones: take {pair[1]}, "
            "each in its place of a machine's [[bearings]], or one with its share of the load and "
            "the preload in load.axial"
        )
    kind = _named_so(designation, name)
    return _here(kind) if kind else ""


def _named_so(designation: str, name: str) -> str:
    """The kind of a bearing with a designation, ``name`` without separators; or ""."""
    two_rows = _FOUR_DIGITS.fullmatch(designation.strip())
    for pattern, kind in _DESIGNATIONS.items():
        if re.fullmatch(pattern, designation.strip()[:4] if two_rows else name):
            return kind
    return ""


def inferred_kind(designation: str) -> tuple[str, str] | None:
    """Kind and type of a bearing with a designation whose inside is inferred; None of others."""
    kind = _named_so(designation, re.sub(r"[\s_/-]", "", designation.upper()))
    name, inferred = _type_of(kind)
    return (kind, name) if inferred else None


def _type_of(kind: str) -> tuple[str, bool]:
    """The type of a kind, "a needle roller bearing", or "", and whether its inside is inferred."""
    for family in FAMILIES.values():
        for spec in family.types:
            if kind == f"a {spec.kind}":
                name = str(spec.__dataclass_fields__["type"].default)
                return name, family.inside is not None and name in family.inside().cages
    return "", False


def _here(kind: str) -> str:
    """What there is of a kind; empty where its inside is inferred."""
    name, inferred = _type_of(kind)
    if inferred:
        return ""
    return f"is {kind}; {_AS_TYPE.format(name) if name else _HAS}"


def named_kind(name: str) -> str:
    """That flexcage has no bearings of a kind, by a name such as "tapered_roller", as a part of a
    sentence; empty if the name is of none that it has not."""
    if _CAGELESS.fullmatch(name.strip()):
        return 'a bearing without a cage is one of these types, with model = "none" in [cage]'
    for pattern, kinds in _NAMES.items():
        if re.fullmatch(pattern, name.strip(), re.IGNORECASE):
            return f"of {kinds} {_HAS}"
    return ""
