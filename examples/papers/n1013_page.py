"""The page of results beside this script, written from a computed study: every number is its."""

from __future__ import annotations

import shutil
from collections import Counter
from collections.abc import Iterable, Sequence
from dataclasses import replace
from datetime import UTC, datetime
from pathlib import Path
from typing import Any

import numpy as np
from n1013_figures import HISTORIES, NAMES, slug
from n1013_reasons import findings, reason_of
from n1013_view import (
    AFTER,
    AT,
    BASE,
    BEFORE,
    CAGES,
    LINE_AT,
    PITCH,
    RIPPLE,
    SPIKES,
    STRESS,
    WHIRL,
    View,
    imbalance,
    rows_of,
    shown,
    slip,
    spin,
    written,
)  # fmt: skip

from flexcage import Case, StudyResults, __version__
from flexcage.render import sheet
from flexcage.results.audit import OF_DRIVE
from flexcage.study.results import ResultRow
from flexcage.study.verdicts import OUTCOMES, Verdict

HERE = Path(__file__).parent
_BESIDE = (
    "inner_speed.ripple", "inner_speed.frequency", RIPPLE, PITCH, "cage_omega[axis=x].frequency",
    "cage_slip_ratio", LINE_AT, "cage_centre_shift", "pinch_force",
)  # fmt: skip


def with_reason(verdict: Verdict, view: View) -> Verdict:
    """The verdict with the mechanical reason that the figures show, where there is one."""
    if verdict.reason:  # not computed
        return verdict
    return replace(verdict, reason=reason_of(verdict.key, verdict.outcome, view))


def write(results: StudyResults, verdicts: Sequence[Verdict], pictures: Path) -> Path:
    """Write README.md and its images beside this script; its path."""
    view = View(rows_of(results))
    images = _copy_images(pictures, HERE / "images")
    parts = [
        _head(results), _table(verdicts), _short(verdicts), findings(view), _details(verdicts),
        _slips(view), _sweep(results, view), _beside(results, view), _pictures(images), _TAIL,
    ]  # fmt: skip
    path = HERE / "README.md"
    path.write_text("\n\n".join(part.strip() for part in parts if part) + "\n", encoding="utf-8")
    return path


def _head(results: StudyResults) -> str:
    study = results.study
    today = datetime.now(UTC).strftime("%d %B %Y")
    case = study.case
    return f"""# An N1013 with a deformed cage pocket

"Dynamic Characteristics of Cylindrical Roller Bearing with Cage Pocket Deformation", Lubricants
2025, 13(11), 495, as a study with verdicts. Written by `n1013_pocket_deformation.py --page` on
{today} with flexcage {__version__}, from {results.count("done")} of {len(results.rows)} cases
({results.count("failed")} failed; what is not computed counts as undecided). A case is
{case.solver.duration * 1e3:.0f} ms of bearing time, of which the first
{100 * case.output.settle:.0f} % are left out: 10 turns of the cage remain. "±" is half of a 95 %
interval.

Pocket 5 is the paper's j. The cages: `dq` the crossbeam between rollers j-1 and j moved towards
j-1 by 0.1 or 0.2 mm, `dp` a side beam of pocket j moved by 0.3 mm, `+` away from its roller."""


def _table(verdicts: Sequence[Verdict]) -> str:
    rows = [(v.key, v.claim, f"**{v.outcome}**", v.range.partition(". (")[0]) for v in verdicts]
    head = (
        "",
        "claim of the paper",
        "at the base clearances",
        "over clearances, rollers, friction",
    )
    return "## Verdicts\n\n" + markdown(head, rows)


def _short(verdicts: Sequence[Verdict]) -> str:
    """Which claims hold, in one sentence an outcome."""
    lines = []
    for outcome in OUTCOMES:
        keys = [v.key for v in verdicts if v.outcome == outcome]
        if keys:
            lines.append(f"- {outcome}: {', '.join(keys)}")
    return "At the base clearances:\n\n" + "\n".join(lines)


def _details(verdicts: Sequence[Verdict]) -> str:
    parts = ["## Reasons and figures"]
    for v in verdicts:
        first, *rest = v.range.split(". (")
        where = "".join(f"\n- {part.replace(') ', ': ', 1)}" for part in rest)
        parts.append(f"### {v.key}: {v.outcome}\n\n{v.claim}.\n\n{v.reason}".strip())
        parts.append(f"Part by part:\n{where}" if rest else "")
        parts.append(_figures(v))
    return "\n\n".join(part for part in parts if part)


def _figures(verdict: Verdict) -> str:
    """The figures as a table with a column a cage, or one below the other."""
    table: dict[str, dict[str, str]] = {}
    split = [line.label.rpartition(", ") for line in verdict.figures]
    by_cage = all(cage in CAGES for _, _, cage in split)
    for line, (name, _, cage) in zip(verdict.figures, split):
        row, column = (name, cage) if by_cage else (line.label, "")
        table.setdefault(row, {})[column] = written(line)
    cages = [cage for cage in (*CAGES, "") if any(cage in cells for cells in table.values())]
    rows = [(name, *(cells.get(cage, "") for cage in cages)) for name, cells in table.items()]
    return markdown(("", *cages), rows)


def _slips(view: View) -> str:
    """What the paper's Tables 2 and 3 hold: slip ratios of the three rollers."""
    rollers = {"j-1": BEFORE, "j": AT, "j+1": AFTER}
    rows = [
        (cage, *(written(shown(kind(r), cage, view(kind(r), cage))) for kind in (slip, spin)
                 for r in rollers.values()))
        for cage in CAGES if view.has(cage)
    ]  # fmt: skip
    head = ("cage", *(f"slip {name}" for name in rollers), *(f"speed {name}" for name in rollers))
    return (
        "## Slip ratios and speeds of the rollers beside the defect\n\n"
        "Means over whole turns of the cage, loaded and unloaded zone together: what Tables 2 and "
        "3 of the paper hold, whose numbers are not in the text that we have.\n\n"
        + markdown(head, rows)
    )


def _sweep(results: StudyResults, view: View) -> str:
    """The figures that the claims rest on, in every variation that was computed."""
    outputs = (slip(BEFORE), slip(AT), slip(AFTER), STRESS, RIPPLE, WHIRL, SPIKES)
    rows = []
    for point in results.study.axes[1].points:
        there = View(view.rows, point["label"])
        for cage in CAGES:
            if there.has(cage):
                cells = (written(shown(o, cage, there(o, cage))) for o in outputs)
                starts = str(len(view.rows[cage, point["label"]]))
                rows.append((point["label"], cage, starts, *cells))
    head = ("variation", "cage", "starts", "slip j-1", "slip j", "slip j+1", "mean peak stress",
            "cage speed ripple", "whirl radius", "kurtosis")  # fmt: skip
    return "## Over clearances, rollers and friction\n\n" + markdown(head, rows)


def _beside(results: StudyResults, view: View) -> str:
    cages = [cage for cage in CAGES if view.has(cage)]
    rows = []
    for output in _BESIDE:
        lines = [shown(output, cage, view(output, cage)) for cage in cages]
        name = lines[0].label.rpartition(",")[0]
        rows.append((name, *(written(line) for line in lines)))
    text = (
        "The inner ring turns through a compliant shaft, so its speed fluctuates. Frequencies of "
        "strongest lines are resolved to the inverse of the time after settling, "
        f"{_resolution(results.study.case):.1f} Hz. The mass centre moves because the displaced "
        "beam does."
    )
    table = markdown(("", *cages), rows)
    checks = "\n\n".join(filter(None, [_audit(results), _unsettled(results)]))
    return f"## Beside the claims\n\n{text}\n\n{table}\n\n{checks}"


def _resolution(case: Case) -> float:
    """Distance of the lines of a spectrum [Hz]."""
    return 1.0 / (case.solver.duration * (1.0 - case.output.settle))


def _audit(results: StudyResults) -> str:
    """How far the energy of the cases closes, and which were left out because theirs does not."""
    found = [(row.planned, imbalance(row)) for row in results.rows if row.state == "done"]
    within = max((v for _, v in found if v <= OF_DRIVE), default=float("nan"))
    beyond = [
        f"{', '.join(planned.point.labels.values())} ({100 * value:.2f} %)"
        for planned, value in found
        if value > OF_DRIVE
    ]
    return f"The energy of a case closes to {100 * within:.3f} % of the drive's work or better." + (
        f" Left out, as if not computed, because theirs does not close to "
        f"{100 * OF_DRIVE:g} %: {'; '.join(beyond)}."
        if beyond
        else ""
    )


def _unsettled(results: StudyResults) -> str:
    """How many cases had not settled by flexcage's own check, and in which quantity."""
    found = [(row.planned.point.labels, _drifting(results, row)) for row in results.rows]
    known = [(labels, names) for labels, names in found if names is not None]
    wrong = [(labels, names) for labels, names in known if names]
    if not known:
        return ""
    if not wrong:
        return f"Every one of {len(known)} cases had settled: no figure differs between its halves."
    times = Counter(name for _, names in wrong for name in names)
    text = (
        f"{len(wrong)} of {len(known)} cases had not settled: the halves of the run differ beyond "
        f"the intervals in {_counted(times)}."
    )
    base = [(labels["cage"], names) for labels, names in known if labels["variation"] == BASE]
    starts = Counter(cage for cage, _ in base)
    drifts = Counter((cage, name) for cage, names in base for name in names)
    parts = [f"{c}: {name} in {n} of {starts[c]} starts" for (c, name), n in drifts.items()]
    return f"{text} At the base clearances, {'; '.join(parts)}." if parts else text


def _drifting(results: StudyResults, row: ResultRow) -> list[str] | None:
    """Quantities that differ between the halves of a case's run; None where it is not known."""
    stored = results.stored.get(row.planned.hash)
    figure = stored.figures.get("drift") if stored else None
    if figure is None or figure.value is None:
        return None
    return [] if figure.value == "nothing" else str(figure.value).split(", ")


def _counted(times: Counter[str]) -> str:
    return ", ".join(f"{name} ({count})" for name, count in times.most_common())


def _copy_images(pictures: Path, folder: Path) -> list[Path]:
    """What the paper plots, as far as it was drawn, under 200 kB each."""
    folder.mkdir(exist_ok=True)
    found = []
    for name in _captions():
        if (pictures / name).is_file():
            found.append(Path(shutil.copy(pictures / name, folder / name)))
            _shrink(found[-1])
    return found


def _shrink(path: Path, *, width: int = 1250) -> None:
    """Write the image no wider than ``width`` pixels, in 256 colours."""
    from PIL import Image

    image = Image.open(path).convert("RGB")
    if image.width > width:
        size = (width, round(image.height * width / image.width))
        image = image.resize(size, Image.Resampling.LANCZOS)
    if path.stem in HISTORIES:  # lines over each other have colours of their own, but few
        small = image.quantize(256, dither=Image.Dither.NONE)
    else:
        small = _in_colours_of_stress(image)
    small.save(path, optimize=True)


def _in_colours_of_stress(image: Any) -> Any:
    """The image in the 256 colours of stress pictures: their colour map, greys, and the colours of
    marks and of what lies beyond the range."""
    import matplotlib as mpl
    from PIL import Image
    from scipy.spatial import KDTree

    marks = (sheet.VERMILION, sheet.BLUE, sheet.SKY, sheet.GREEN, sheet.ORANGE)
    colours = np.vstack([
        mpl.colormaps["viridis"](np.linspace(0.0, 1.0, 200))[:, :3],
        np.linspace(0.0, 1.0, 51)[:, None].repeat(3, axis=1),
        [mpl.colors.to_rgb(mark) for mark in marks],
    ])  # fmt: skip
    nearest = KDTree(colours).query(np.asarray(image) / 255.0)[1].astype(np.uint8)
    small = Image.fromarray(nearest, "P")
    small.putpalette(np.rint(255.0 * colours).astype(np.uint8).tobytes())
    return small


def _captions() -> dict[str, str]:
    """What the page says of every picture, by its file's name, in the order of the page."""
    captions = {
        f"stress_{slug(cage)}.png": f"Stress at its largest: {NAMES[cage]}." for cage in CAGES
    }
    captions |= {f"{name}.png": curve.caption for name, curve in HISTORIES.items()}
    return captions | {
        "orbits.png": "Orbits of the cage centre.",
        "pinch.png": "Corner stress of a shortened pocket against its clearance.",
    }


def _pictures(images: Sequence[Path]) -> str:
    captions = _captions()
    lines = [
        f"![{captions[path.name].rstrip('.')}](images/{path.name})\n\n*{captions[path.name]}*"
        for path in images
    ]
    return "## Pictures\n\n" + "\n\n".join(lines) if lines else ""


_TAIL = f"""## How the paper was read

- The crossbeam between pockets j-1 and j is displaced as a whole (`shape = "shifted"`).
- Conclusion 1 (a negative deviation *reduces* stress) contradicts conclusions 2 and 3 and the
  text; the text was taken.
- "n_rth" of the slip ratio is the roller's theoretical speed, "n_r" its computed one.
- "The first increases, then decreases" of the whirl radius was taken as 0 < 0.1 > 0.2 mm.
- "Unchanged" is within 10 % (roller speeds: 1 %), "clearly" is by 25 % or more (roller speeds: a
  drop of 5 %), "more" is beyond both intervals: fixed before the study was computed.
- 320.51 MPa is an order of magnitude, within a factor of two: a linear cage of unknown clearance
  and fillet allows no more.

What the paper does not say is an assumption: the preset's inside of the bearing, the housing
(a bushing of 200 N/um), the compliant shaft (10 kN m/rad), the traction curve, restitution. The
clearances Cq - Dw (base 0.20 mm) and Cp - Lw (base 0.25 mm) are varied one at a time.

## Repeat it

```sh
pip install '.[fast,study]'
python examples/papers/n1013_pocket_deformation.py --quick             # minutes
python examples/papers/n1013_pocket_deformation.py --stages {BASE}        # the five cages
python examples/papers/n1013_pocket_deformation.py --page              # all, and this page
```

Four more papers, and measured numbers beside computed ones, are listed in
[published work, repeated](../README.md#published-work-repeated).
"""


def markdown(head: Iterable[str], rows: Iterable[Iterable[str]]) -> str:
    """A table in Markdown."""
    head = list(head)
    lines = [head, ["---"] * len(head), *map(list, rows)]
    return "\n".join("| " + " | ".join(cells) + " |" for cells in lines)
