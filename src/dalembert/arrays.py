"""What arrays hold, by name; their shapes stand in each docstring."""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray

Array = NDArray[Any]
"""Numbers; while an analysis is traced, symbols in their place."""

Ints = NDArray[np.intp]
"""Places and counts."""

Flags = NDArray[np.bool_]
"""Yes or no."""
