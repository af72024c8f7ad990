"""One cache folder for arrays that are expensive to make, safe between processes.

An entry is an .npz named by kind and content hash. It is written to a temporary file and renamed,
so a reader sees all of it or nothing; a lock per entry keeps two processes from making the same;
a broken file is made anew. When the folder grows over its limit the least recently used go.
A folder that cannot be written, or a full disk, costs time and never a result.
"""

from __future__ import annotations

import logging
import os
import shutil
import tempfile
from collections.abc import Callable, Iterator, Sequence
from contextlib import contextmanager
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from flexcage.core.arrays import UNREADABLE, read_arrays
from flexcage.core.trust import distrusted, make_private

logger = logging.getLogger(__name__)

_LIMIT = "FLEXCAGE_CACHE_LIMIT_GB"
_DEFAULT_LIMIT_GB, _MOST_GB = 4.0, 1e9
_PROBE_BYTES = 1_000_000  # bytes that a folder must have room for, or it counts as full

Arrays = dict[str, np.ndarray]


def cache_root() -> Path:
    """The cache folder: FLEXCAGE_CACHE_DIR, or the user's cache folder of this platform."""
    given = os.environ.get("FLEXCAGE_CACHE_DIR")
    if given:
        return Path(given)
    import platformdirs

    return Path(platformdirs.user_cache_dir("flexcage"))


def check_writable(folder: Path) -> None:
    """Raise OSError if a folder cannot be made, or has no room for a file of some size."""
    make_private(folder)
    with tempfile.TemporaryFile(dir=folder) as file:
        file.write(b"0" * _PROBE_BYTES)


_reported: set[Path | str] = set()  # folders and variables of which something was said


def warn_unwritable(path: Path, error: OSError) -> None:
    """Say once that the cache folder in which ``path`` lies cannot be written."""
    folder = cache_root() if path.is_relative_to(cache_root()) else path
    if folder in _reported:
        return
    _reported.add(folder)
    logger.warning(
        "the cache folder '%s' cannot be written (%s): kernels and modes are made anew in every "
        "run; make room there, or set FLEXCAGE_CACHE_DIR to a folder that can be written",
        folder, (error.strerror or str(error)).lower(),
    )  # fmt: skip


def trusted(folder: Path) -> bool:
    """Whether nobody else may have written to a folder of the cache; says once if one may have."""
    reason = distrusted(folder)
    if reason and folder not in _reported:
        _reported.add(folder)
        logger.warning(
            "the cache folder '%s' is not used: %s, and what others put there could run as yours; "
            "set FLEXCAGE_CACHE_DIR to a folder of your own", folder, reason,
        )  # fmt: skip
    return not reason


def cache_limit() -> int:
    """Limit of the array cache [bytes]; FLEXCAGE_CACHE_LIMIT_GB changes it. Says once if that is no
    number of GB."""
    text = os.environ.get(_LIMIT, "")
    try:
        size = float(text or _DEFAULT_LIMIT_GB)
    except ValueError:
        size = -1.0
    if not 0.0 <= size < _MOST_GB:
        size = _DEFAULT_LIMIT_GB
        if _LIMIT not in _reported:
            _reported.add(_LIMIT)
            logger.warning(
                "%s is '%s', but should be a number of GB that is not negative, as 10; %g GB are "
                "taken", _LIMIT, text, size,
            )  # fmt: skip
    return int(size * 1e9)


def cached_arrays(
    kind: str,
    key: str,
    make: Callable[[], Arrays],
    *,
    only: Sequence[str] = (),
    without: Sequence[str] = (),
) -> Arrays:
    """Arrays named ``kind``/``key`` from disk, or made by ``make()`` and stored there.

    ``key`` must name everything that the arrays depend on (see ``hashing.content_hash``). ``only``
    names those that are read, where not all are, and ``without`` those that are not; all come back
    where they had to be made.
    """
    if not trusted(cache_root()):
        return {name: np.asarray(value) for name, value in make().items()}
    path = cache_root() / "arrays" / kind / f"{key}.npz"
    found = _read(path, only, without)
    if found is not None:
        return found
    with _lock(path):
        found = _read(path, only, without)  # another process may have made it while this one waited
        if found is not None:
            return found
        arrays = {name: np.asarray(value) for name, value in make().items()}
        _write(path, arrays)
    _evict(cache_limit(), keep=path)
    return arrays


def _read(path: Path, only: Sequence[str], without: Sequence[str]) -> Arrays | None:
    if not path.is_file():
        return None
    try:
        arrays = read_arrays(
            path, wanted=lambda name: name in only if only else name not in without
        )
        if missing := set(only) - arrays.keys():
            raise KeyError(sorted(missing)[0])
    except (OSError, *UNREADABLE) as exc:
        logger.warning("cache entry %s cannot be read (%s); it is made anew", path.name, exc)
        return None
    try:
        os.utime(path)  # marks it as used
    except OSError:
        pass
    return arrays


@contextmanager
def _lock(path: Path) -> Iterator[None]:
    import filelock

    try:
        make_private(path.parent)
        lock = filelock.FileLock(str(path) + ".lock")
        lock.acquire()
    except OSError as exc:
        warn_unwritable(path.parent, exc)
        yield
        return
    try:
        yield
    finally:
        lock.release()


def _write(path: Path, arrays: Arrays) -> None:
    temporary = ""
    try:
        handle, temporary = tempfile.mkstemp(dir=path.parent, prefix=path.stem, suffix=".tmp")
        with os.fdopen(handle, "wb") as file:
            np.savez(file, **arrays)  # type: ignore[arg-type]
            file.flush()
            os.fsync(file.fileno())
        os.replace(temporary, path)
    except OSError as exc:
        warn_unwritable(path.parent, exc)
        if temporary:
            Path(temporary).unlink(missing_ok=True)


def _entries() -> list[tuple[float, int, Path]]:
    """(time of last use, bytes, path) of every entry, least recently used first."""
    found = []
    for path in (cache_root() / "arrays").rglob("*.npz"):
        try:
            stat = path.stat()
        except OSError:
            continue  # another process removed it
        found.append((stat.st_mtime, stat.st_size, path))
    return sorted(found)


def _evict(limit: int, *, keep: Path) -> None:
    entries = _entries()
    total = sum(size for _, size, _ in entries)
    for _, size, path in entries:
        if total <= limit:
            return
        if path == keep:
            continue
        try:
            path.unlink(missing_ok=True)
        except OSError:
            continue
        total -= size


@dataclass(frozen=True)
class CacheInfo:
    """What the cache folder holds: array entries by kind, their bytes, and compiled kernels."""

    folder: Path
    entries: dict[str, int]
    size: int
    kernel_size: int
    limit: int

    def __str__(self) -> str:
        kinds = ", ".join(f"{n} {kind}" for kind, n in sorted(self.entries.items())) or "no entries"
        return (
            f"{self.folder}: {kinds}, {self.size / 1e6:.1f} MB of {self.limit / 1e9:g} GB; "
            f"compiled kernels {self.kernel_size / 1e6:.1f} MB"
        )


def cache_info() -> CacheInfo:
    """Count and size of what the cache holds."""
    entries: dict[str, int] = {}
    size = 0
    for _, bytes_, path in _entries():
        entries[path.parent.name] = entries.get(path.parent.name, 0) + 1
        size += bytes_
    kernels = cache_root() / "kernels"
    kernel_size = sum(p.stat().st_size for p in kernels.rglob("*") if p.is_file())
    return CacheInfo(cache_root(), entries, size, kernel_size, cache_limit())


def clear_cache() -> int:
    """Remove all entries and compiled kernels; the bytes that this freed."""
    info = cache_info()
    for name in ("arrays", "kernels", "drawing"):
        shutil.rmtree(cache_root() / name, ignore_errors=True)
    return info.size + info.kernel_size
