"""Wings: bearing families and cage types, found by name.

A floor of the program holds what all bearings share and imports no wing. This module holds the
empty registries of both wings. Each imports the folders of its package at the first look-up: the
one import that is not written at the head of a file. A user's own families and cage types join by
``add``.
"""

from __future__ import annotations

import importlib
import pkgutil
from collections.abc import Callable, Iterator, Mapping
from types import MappingProxyType
from typing import Any, Generic, Protocol, TypeVar

from flexcage.core.registry import add, check_free


class Member(Protocol):
    """A family or a cage type."""

    @property
    def name(self) -> str: ...


M = TypeVar("M", bound=Member)
P = TypeVar("P")


class Wing(Mapping[str, M], Generic[M]):
    """Members of a wing by name: one from each folder of its package, but for
    folders of what several share, then users' own.

    A folder calls its member ``constant``. ``what`` says in errors what a member is ("bearing
    family").
    """

    def __init__(self, package: str, constant: str, *, what: str) -> None:
        self.package, self.constant, self.what = package, constant, what
        self._members: dict[str, M] = {}
        self._imported = False

    def _all(self) -> dict[str, M]:
        if not self._imported:
            wing = importlib.import_module(self.package)
            folders = sorted(m.name for m in pkgutil.iter_modules(wing.__path__) if m.ispkg)
            for folder in folders:
                found = importlib.import_module(f"{self.package}.{folder}")
                if member := getattr(found, self.constant, None):
                    self._members[member.name] = member
            self._imported = True
        return self._members

    def __getitem__(self, name: str) -> M:
        return self._all()[name]

    def __iter__(self) -> Iterator[str]:
        return iter(self._all())

    def __len__(self) -> int:
        return len(self._all())

    def add(self, member: M) -> M:
        """Add a user's own member under its name; InputError if the name is taken."""
        return add(self._all(), member.name, member, what=self.what)


class Parts(Mapping[str, P], Generic[P]):
    """What the members of a wing list, by name, all together: types of bearings, defects.

    ``listed(member)`` gives a member's own by name. ``common`` are those that a floor has for all,
    which come first. ``add`` is for a user's own.
    """

    def __init__(
        self, wing: Wing[Any], listed: Callable[[Any], Mapping[str, P]], *, what: str,
        common: Mapping[str, P] = MappingProxyType({}),
    ) -> None:  # fmt: skip
        self.wing, self.listed, self.what, self.common = wing, listed, what, common
        self._added: dict[str, P] = {}

    def _all(self) -> dict[str, P]:
        found = {k: v for member in self.wing.values() for k, v in self.listed(member).items()}
        return {**self.common, **found, **self._added}

    @property
    def added(self) -> Mapping[str, P]:
        """A user's own."""
        return self._added

    def owners(self, name: str) -> tuple[str, ...]:
        """Names of the members that list a part; none if it is common or a user's own."""
        return tuple(m.name for m in self.wing.values() if name in self.listed(m))

    def __getitem__(self, name: str) -> P:
        return self.common[name] if name in self.common else self._all()[name]

    def __iter__(self) -> Iterator[str]:
        return iter(self._all())

    def __len__(self) -> int:
        return len(self._all())

    def add(self, name: str, part: P) -> P:
        """Add a user's own part; InputError if the name is taken."""
        check_free(self._all(), name, what=self.what)
        self._added[name] = part
        return part


#: Bearing families (``flexcage.bearings.family.Family``) and cage types
#: (``flexcage.cages.cage_type.CageType``), which floors know by their own Protocols alone.
FAMILIES: Wing[Any] = Wing("flexcage.bearings", "FAMILY", what="bearing family")
CAGE_TYPES: Wing[Any] = Wing("flexcage.cages", "CAGE_TYPE", what="cage type")
