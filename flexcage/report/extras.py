"""What else a folder holds for its report: ``figures/*.png`` with captions, ``figures/*.csv``."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path

from flexcage.core.errors import InputError
from flexcage.core.reading import read_json
from flexcage.core.writing import check_own
from flexcage.report.blocks import Block, Gallery, Image, PageSection
from flexcage.report.tables import frame_table

FOLDER, CAPTIONS = "figures", "captions.json"


def extra_figures(folder: str | Path) -> PageSection | None:
    """Section "Figures" from the folder's own pictures and tables; None if there are none.

    ``figures/captions.json`` maps file names to captions; a file without one is named by itself.
    """
    place = Path(folder) / FOLDER
    check_own(place)
    captions = _captions(place / CAPTIONS)
    images = [
        Image(path, captions.get(path.name, _title(path))) for path in sorted(place.glob("*.png"))
    ]
    tables = sorted(place.glob("*.csv"))
    blocks: list[Block] = [Gallery(images)] if images else []
    if tables:
        import pandas as pd

        for path in tables:
            try:
                frame = pd.read_csv(path)
            except (OSError, ValueError) as exc:
                raise InputError(f"'{path}' cannot be read as a table ({exc}).") from exc
            blocks.append(frame_table(frame, captions.get(path.name, _title(path))))
    return PageSection("Figures", blocks) if blocks else None


def _title(path: Path) -> str:
    return path.stem.replace("_", " ").replace("-", " ").capitalize()


def _captions(path: Path) -> dict[str, str]:
    if not path.is_file():
        return {}
    try:
        stored = read_json(path)
    except (OSError, ValueError) as exc:
        raise InputError(f"'{path}' cannot be read as JSON ({exc}).") from exc
    if not isinstance(stored, Mapping):
        raise InputError(f'\'{path}\' should map file names to captions, as {{"a.png": "..."}}.')
    return {str(k): str(v) for k, v in stored.items()}
