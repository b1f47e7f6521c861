"""``python -m lpcal``."""

import sys

from lpcal.cli.main import main

sys.exit(main())
