"""The record of a bearing that warms up: a table, numbers, iterations, picture and settled case."""

from __future__ import annotations

import csv
import io
import json
import logging
from pathlib import Path

from flexcage._version import __version__
from flexcage.core.errors import pictures_alone
from flexcage.core.listing import PAGE
from flexcage.core.writing import write_text
from flexcage.warming.warmth import ZERO, Warmth

log = logging.getLogger(__name__)


def write_warmth(warmth: Warmth, folder: Path) -> list[Path]:
    """Write warm.txt, warm.json, warm.csv and warm.png into a folder and, of a bearing that
    settled, its case at these temperatures as case.toml; their paths.

    A machine that cannot draw costs the picture alone.
    """
    folder.mkdir(parents=True, exist_ok=True)
    texts = {
        "warm.txt": warmth.table(PAGE) + "\n",
        "warm.json": json.dumps({"flexcage": __version__, **warmth.to_dict()}, indent=1) + "\n",
        "warm.csv": _csv(warmth),
    }
    if warmth.settled:
        texts["case.toml"] = warmth.case.to_toml()
    for name, text in texts.items():
        write_text(folder / name, text)
    written = [folder / name for name in texts]
    with pictures_alone(log):
        written.append(draw_warmth(warmth, folder / "warm.png"))
    return written


def draw_warmth(warmth: Warmth, path: str | Path) -> Path:
    """Picture of temperatures and of losses by place over the iterations."""
    from flexcage.render import warm_picture

    rows = warmth.iterations
    return warm_picture(
        {b: [i.temperatures[b] - ZERO for i in rows] for b in warmth.temperatures},
        {p: [i.losses.get(p, 0.0) for i in rows] for p in warmth.last.losses},
        path, title=warmth.name, note=warmth.sentence,
    )  # fmt: skip


def _csv(warmth: Warmth) -> str:
    """A row an iteration: temperatures in degC, clearance in um, viscosity in mPa s, losses in
    W."""
    bodies, places = list(warmth.temperatures), list(warmth.last.losses)
    text = io.StringIO()
    table = csv.writer(text, lineterminator="\n")
    table.writerow(
        ["iteration", *(f"{b}_degC" for b in bodies), "film_degC", "viscosity_mPas",
         "clearance_um", *(f"{p.replace(' ', '_')}_W" for p in places), "losses_W", "out_W",
         "change_K"]
    )  # fmt: skip
    for k, i in enumerate(warmth.iterations):
        values = [
            *(i.temperatures[b] - ZERO for b in bodies), i.film - ZERO, 1e3 * i.viscosity,
            1e6 * i.clearance, *(i.losses.get(p, 0.0) for p in places), i.loss,
            sum(i.out.values()), i.change,
        ]  # fmt: skip
        table.writerow([k + 1, *(f"{value:.6g}" for value in values)])
    return text.getvalue()
