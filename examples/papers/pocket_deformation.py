"""An N1013 with a deformed cage pocket: the paper on crossbeams and side beams, repeated.

    python examples/papers/pocket_deformation.py             # readings, map: half an hour of a core
    python examples/papers/pocket_deformation.py --quick     # 40 ms, one start, no map
    python examples/papers/pocket_deformation.py --page      # writes the page from what is computed

All of the paper stands in the folder pocket_deformation; ``repeat`` is the same for all papers.
"""

from __future__ import annotations

import sys
from collections.abc import Sequence
from pathlib import Path

import repeat

FOLDER = Path(__file__).with_suffix("")


def main(arguments: Sequence[str] | None = None) -> repeat.Computed:
    """Compute what is missing, and print a line for every claim."""
    return repeat.main([str(FOLDER), *(sys.argv[1:] if arguments is None else arguments)])


if __name__ == "__main__":
    main()
