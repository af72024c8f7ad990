"""A user's own files: Python that registers laws, bases, outputs or pictures, and presets as TOML.

A process knows only what it has loaded, so a worker process loads the same ``sources`` first.
"""

from __future__ import annotations

import importlib
import importlib.util
import sys
from collections.abc import Iterable
from pathlib import Path

from flexcage.case.presets import register_preset
from flexcage.core import users_files
from flexcage.core.binding import path_of
from flexcage.core.errors import FlexcageError, InputError
from flexcage.core.missing import no_file

_loaded: list[str] = []


def sources() -> tuple[str, ...]:
    """What ``load_extension`` loaded in this process, in order: absolute paths and module names."""
    return tuple(_loaded)


def forget(source: str | Path) -> None:
    """Take a file off the list that processes of a study load; what it has added here stays."""
    text = str(path_of(source, "use").resolve())
    if text in _loaded:
        _loaded.remove(text)
        users_files.forget([Path(text)])


def not_loaded(wanted: Iterable[str]) -> list[str]:
    """Those among the names of files and modules that this process has not loaded, nor another
    file of that name."""
    names = {Path(source).name for source in _loaded}
    return [s for s in wanted if Path(s).name not in names and s not in sys.modules]


def load_extension(source: str | Path) -> None:
    """Load a Python file or module that registers things, or register a preset's .toml file.

    Loading the same one again does nothing. Raises InputError if it is not there, or fails.
    """
    text = str(source)
    is_file = text.endswith((".py", ".toml")) or isinstance(source, Path) or Path(text).is_file()
    if is_file:
        path = path_of(source, "use").resolve()
        text = str(path)
        if not path.is_file():
            what = no_file("file", Path(source), (path.suffix,))
            raise InputError(f"{what}; --use loads one.", where="use", value=text)
        if not text.endswith((".py", ".toml")):
            raise InputError(
                f"'{source}' is no file that can be loaded: .py (your own laws ...) or .toml (a "
                "preset).",
                where="use",
                value=text,
            )
    if text in _loaded:
        return
    code = [path] if is_file and text.endswith(".py") else [] if is_file else _code_of(text)
    users_files.remember(code)
    try:
        if text.endswith(".toml"):
            register_preset(path)
        elif is_file:
            _run(path)
        else:
            importlib.import_module(text)
    except BaseException as exc:
        users_files.forget(code)
        ended = isinstance(exc, SystemExit)
        if isinstance(exc, FlexcageError) or not (ended or isinstance(exc, Exception)):
            raise
        if ended:
            raise InputError(
                f"'{source}' ends the program as it is loaded (sys.exit); put what it runs by "
                "itself under if __name__ == '__main__'.",
                where="use",
                value=text,
            ) from exc
        raise InputError(
            f"'{source}' cannot be loaded: {type(exc).__name__}: {exc}.", where="use", value=text
        ) from exc
    _loaded.append(text)


def _code_of(module: str) -> list[Path]:
    """Files of the module, or of the package that it is of; none if it cannot be found."""
    spec = importlib.util.find_spec(module.partition(".")[0])
    if spec is None or spec.origin is None:
        return []
    folders = spec.submodule_search_locations
    if folders is None:
        return [Path(spec.origin)]
    return [file for folder in folders for file in sorted(Path(folder).rglob("*.py"))]


def _run(path: Path) -> None:
    name = path.stem if path.stem not in sys.modules else f"flexcage_extension_{path.stem}"
    if any(getattr(m, "__file__", None) == str(path) for m in list(sys.modules.values())):
        return  # imported before, as a module
    spec = importlib.util.spec_from_file_location(name, path)
    if spec is None or spec.loader is None:
        raise InputError(f"'{path}' is not a Python file.", where="use", value=str(path))
    module = importlib.util.module_from_spec(spec)
    sys.modules[name] = module
    try:
        spec.loader.exec_module(module)
    except BaseException:
        del sys.modules[name]
        raise
