"""A 7010C over speeds, loads, clearances, waves, accelerations: the vibro-impact paper, repeated.

    python examples/papers/c7010_vibro_impact.py             # all: an hour of a core
    python examples/papers/c7010_vibro_impact.py --quick     # 40 ms, one start, no map
    python examples/papers/c7010_vibro_impact.py --page      # writes the page from what is computed

All of the paper stands in the folder c7010_vibro_impact; ``repeat`` is the same for all papers.
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
