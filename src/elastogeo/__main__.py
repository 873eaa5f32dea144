"""`python -m elastogeo` is the command `elastogeo`."""

import sys

from elastogeo.cli import main

sys.exit(main())
