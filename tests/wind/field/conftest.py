"""Small fields are stepped on one thread: handing them out to more takes longer than the work itself."""

from collections.abc import Iterator

import pytest
from numba import get_num_threads, set_num_threads


@pytest.fixture(autouse=True)
def one_thread() -> Iterator[None]:
    before = get_num_threads()
    set_num_threads(1)
    yield
    set_num_threads(before)
