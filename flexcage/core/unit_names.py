"""The names of units that the field uses, and what others probably mean.

pint knows far more: a shake is a time, baud a frequency, a knot (kn) a speed. Here a slip of the
pen is not one of them.
"""

from __future__ import annotations

import re
from functools import cache

# prefixes, and the names that may have them
_SYMBOLS: tuple[tuple[str, str], ...] = (
    (" k d c m u µ n p", "m"),
    (" m u µ n", "s"),
    (" k m u µ", "g"),
    (" k M da m u µ", "N Nm"),
    (" k M G h m u µ", "Pa"),
    (" k m", "bar J W t"),
    (" m u µ n", "rad"),
    (" m", "deg K l L"),
    (" k M G T m", "Hz"),
    (" k", "rpm Nmm psi"),
    (" c m", "P St"),
    (" u µ", "in inch"),
)
_WORDS: tuple[tuple[str, str], ...] = (
    (
        " kilo centi milli micro nano",
        "metre metres meter meters second seconds gram grams radian radians poise stokes",
    ),
    (" kilo mega giga milli micro", "newton newtons pascal pascals hertz newton_metre"),
)
_PLAIN = (
    "per percent % ° °C °F degree degrees degC degF celsius fahrenheit degree_Celsius "
    "degree_Fahrenheit kelvin kelvins delta_degC delta_degF Δ Δ°C Δ°F arcmin arcsec gon turn turns "
    "rev revs revolution revolutions rot r tr U cycle cycles rps sec secs min minute minutes h hr "
    "hour hours day days micron microns inches ft foot feet thou mil km tonne tonnes ton tons kton "
    "lb lbs pound pounds lbf kgf ksi atm cc liter litre g_0 g0 newton_millimetre J W"
)
_WORD = re.compile(r"Δ°[CF]|°\s*[CF](?!\w)|[^\W\d]\w*|[%°]")


@cache
def known_names() -> frozenset[str]:
    """All of them, each with the prefixes that are used with it."""
    found = set(_PLAIN.split())
    for prefixes, names in (*_SYMBOLS, *_WORDS):
        found.update(p + name for p in prefixes.split(" ") for name in names.split())
    return frozenset(found)


def wrong_name(given: str) -> tuple[str, str]:
    """The first name in a unit's text that is none of the field's, and what is probably meant, as
    the end of a sentence; empty where all are known, and where nothing is near."""
    known = known_names()
    for word in _WORD.findall(given):
        if word.replace(" ", "") not in known:
            return word, _probably(word, given, known)
    return "", ""


def _probably(word: str, given: str, known: frozenset[str]) -> str:
    if word.endswith("s") and word[:-1] in known:
        one, both = (given.replace(word, f"{word[:-1]}{tail}") for tail in ("", "*s"))
        return f"write '{one}' or '{both}', whichever is meant"
    alike = sorted(name for name in known if name.casefold() == word.casefold())
    alike = ["degC"] if word == "C" else alike
    if not alike:
        return ""
    return "is " + " or ".join(f"'{given.replace(word, name)}'" for name in alike) + " meant?"
