"""python -m rkverify"""

import sys

from rkverify.cli import main

if __name__ == "__main__":
    sys.exit(main())
