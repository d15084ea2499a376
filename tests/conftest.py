"""What all tests share: kernels run on the threads that the command line gives them."""

from __future__ import annotations

import os

os.environ.setdefault("NUMBA_THREADING_LAYER", "workqueue")
