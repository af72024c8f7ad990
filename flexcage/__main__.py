"""``python -m flexcage`` is the console script."""

import sys

from flexcage.cli import main

sys.exit(main())
