"""A riveted cage under an overturning moment: the paper on an aviation motor's bearing, repeated.

    python examples/papers/riveted_cage.py             # readings, maps, design: six hours
    python examples/papers/riveted_cage.py --quick     # 40 ms, one start, no map
    python examples/papers/riveted_cage.py --page      # writes the page from what is computed

Everything of the paper stands in the folder riveted_cage; ``repeat`` is the same for all papers.
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
