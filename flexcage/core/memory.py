"""How much memory this process may take: the machine's, or the limit of its control group."""

from __future__ import annotations

import os
from collections.abc import Iterator
from pathlib import Path

_GROUPS = Path("/sys/fs/cgroup")
_OF_PROCESS = Path("/proc/self/cgroup")
_UNLIMITED = 2**60  # version 1 writes a number near 2^63 for no limit


def total_memory() -> float:
    """Bytes that this process may take if nothing else runs; infinite where no one says."""
    return min([_machine("MemTotal"), *(limit for limit, _ in _limits())])


def free_memory() -> float:
    """Bytes that are free for this process now; infinite where no one says."""
    left = (limit - used for limit, used in _limits())
    return max(0.0, min([_machine("MemAvailable"), *left]))


def in_bytes(size: float) -> str:
    """A number of bytes as text."""
    for unit, one in (("TB", 1e12), ("GB", 1e9)):
        if size >= one:
            return f"{size / one:.3g} {unit}"
    return f"{size / 1e6:.0f} MB"


def _machine(line: str) -> float:
    """Bytes of a line of /proc/meminfo; what the system says of its pages where there is none."""
    try:
        text = Path("/proc/meminfo").read_text("ascii")
        found = next(row for row in text.splitlines() if row.startswith(f"{line}:"))
        return 1024.0 * int(found.split()[1])
    except (OSError, StopIteration, ValueError):
        pass
    try:
        return float(os.sysconf("SC_PAGE_SIZE") * os.sysconf("SC_PHYS_PAGES"))
    except (AttributeError, ValueError, OSError):
        return float("inf")


def _limits() -> Iterator[tuple[float, float]]:
    """Limit and use [bytes] of every control group that this process is in, version 2 or 1.

    Pages of files that can be dropped do not count as used.
    """
    try:
        rows = [row.split(":", 2) for row in _OF_PROCESS.read_text("utf-8").splitlines()]
    except OSError:
        return
    for row in rows:
        if len(row) != 3:
            continue
        _, controllers, path = row
        if controllers == "":
            yield from _upwards(_GROUPS, path, "memory.max", "memory.current", "inactive_file")
        elif "memory" in controllers.split(","):
            names = "memory.limit_in_bytes", "memory.usage_in_bytes", "total_inactive_file"
            yield from _upwards(_GROUPS / "memory", path, *names)


def _upwards(
    root: Path, path: str, limit: str, use: str, idle: str
) -> Iterator[tuple[float, float]]:
    """Of a group and all above it; in a container ``root`` is the process's own."""
    inside = root / path.lstrip("/")
    for folder in dict.fromkeys([inside, *inside.parents]):
        most = _number(folder / limit)
        if most is not None and most < _UNLIMITED:
            yield float(most), float((_number(folder / use) or 0) - _idle(folder, idle))
        if folder == root:
            return


def _number(file: Path) -> int | None:
    try:
        return int(file.read_text("ascii"))
    except (OSError, ValueError):  # ValueError: "max"
        return None


def _idle(folder: Path, name: str) -> int:
    try:
        rows = (row.split() for row in (folder / "memory.stat").read_text("ascii").splitlines())
        return next((int(row[1]) for row in rows if row[0] == name), 0)
    except (OSError, ValueError, IndexError):
        return 0
