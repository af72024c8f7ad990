"""What a path is that was given in place of a run's or a study's folder, and what to give."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path

from flexcage.core.errors import InputError
from flexcage.core.locks import LOCK
from flexcage.core.missing import no_folder

RESULTS = "results.zarr"
SHAFT_STORE, SHAFT_RESULTS = "shaft.zarr", "shaft.nc"  # of a machine's run; for other programs
#: Endings that no folder of output has: whoever gives one wants a file.
_OF_FILES = frozenset(
    ".csv .gif .html .inp .json .mat .msh .mtx .nc .npz .op4 .parquet .pch .pdf .png .pvd .svg "
    ".toml .txt .vtu .xlsx .zarr .zip".split()
)
_NAMED = 4  # runs that a sentence names


def check_no_file(path: Path) -> None:
    """InputError if what is to be a folder for output is a file, or is named as one."""
    if path.exists() and not path.is_dir():
        raise InputError(f"'{path}' is a file; name a folder for the output.", where="out")
    if not path.exists() and path.suffix.lower() in _OF_FILES:
        raise InputError(
            f"'{path}' is named as a file; name a folder for the output, as '{path.with_suffix('')}"
            "'.",
            where="out",
            value=str(path),
        )


def check_run(path: Path) -> None:
    """InputError unless a path is the folder of a run that has results; it says what it is."""
    if not (path / RESULTS).exists():
        raise InputError(f"{_not_of(path, 'a run')}.", where="run", value=str(path))


def check_study(path: Path) -> None:
    """InputError unless a path is the folder of a study; it says what it is."""
    if not (path / "study.toml").is_file():
        raise InputError(f"{_not_of(path, 'a study')}.", where="study", value=str(path))


def holds_machine_run(path: Path) -> bool:
    """Is this the folder of a machine's run?"""
    return (path / SHAFT_STORE).is_dir() and (path / "machine.toml").is_file()


def check_either(path: Path) -> None:
    """InputError unless a path is the folder of a run, or of a study that was planned."""
    study = all((path / name).is_file() for name in ("study.toml", "plan.json"))
    if not study and not (path / RESULTS).exists():
        raise InputError(f"{_not_of(path, 'a run or a study')}.", where="folder", value=str(path))


def _not_of(path: Path, wanted: str) -> str:
    if not path.exists():
        return f"{no_folder(path)}; name the folder of {wanted}"
    found = next(_found(path, wanted), "")
    return f"'{path}' is not the folder of {wanted}: {found}"


def _found(path: Path, wanted: str) -> Iterator[str]:
    """What it is instead, and what to do; the first that holds."""
    if path.name == RESULTS or path.is_file() and (path.parent / RESULTS).exists():
        yield f"it lies in that folder; name '{path.parent}'"
    if path.suffix == ".nc":
        yield "it is netCDF, which flexcage writes for other programs and does not read"
    if path.is_file():
        way = "run" if "run" in wanted else "study run"
        makes = f", of which 'flexcage {way} {path}' makes one" if path.suffix == ".toml" else ""
        yield f"it is a file{makes}"
    if (path / RESULTS).exists():
        yield f"it is that of a run, as it has {RESULTS}"
    if (path / "study.toml").is_file():
        if "study" in wanted:
            yield f"its study has no plan yet; 'flexcage study resume {path}' begins it"
        yield f"it is that of a study, whose runs are in '{path / 'cases'}'"
    if (path / "compare.json").is_file():
        inside = _runs_in(path)
        yield "it is that of a comparison" + (f", whose runs are {inside}" if inside else "")
    if (path / "summary.json").is_file() and "run" in wanted:
        packed = next(path.glob(f"{RESULTS}.*"), None)
        way = f"unpack '{packed}' there" if packed else "bring it back from a copy"
        yield f"its run has finished, but its {RESULTS} is gone; {way}, or run the case again"
    if (path / "case.toml").is_file() or (path / LOCK).is_file():
        yield f"it has no {RESULTS}, for its run has not come to its first results"
    if inside := _runs_in(path):
        yield f"it holds {inside}; name one of them"
    lacks = [name for name, kind in ((RESULTS, "run"), ("study.toml", "study")) if kind in wanted]
    yield f"it has no {' and no '.join(lacks)}"


def _runs_in(path: Path) -> str:
    """The folders of runs and studies in a folder, in quotes; empty if there are none."""
    try:
        entries = sorted(path.iterdir())
    except OSError:
        return ""
    names = [p.name for p in entries if any((p / f).exists() for f in (RESULTS, "study.toml"))]
    named = ", ".join(f"'{path / name}'" for name in names[:_NAMED])
    more = f" and {len(names) - _NAMED} more" if len(names) > _NAMED else ""
    return named + more
