"""How much memory a result may take: what the system says is free, within a container's limit."""

from __future__ import annotations

import io
import math
import os
from typing import Any

import pytest

from dalembert.kernel import memory

GROUP = "/sys/fs/cgroup/memory."
MEMINFO = "MemTotal:       900 kB\nMemFree:         50 kB\nMemAvailable:    200 kB\nHugePages_Total: none\n\n"


@pytest.mark.parametrize(("files", "bytes_"), [
    ({}, 900_000),
    ({"/proc/meminfo": MEMINFO}, 200 * 1024),
    ({"/proc/meminfo": MEMINFO, f"{GROUP}max": "max\n"}, 200 * 1024),
    ({"/proc/meminfo": MEMINFO, f"{GROUP}max": "1000000\n"}, 200 * 1024),
    ({"/proc/meminfo": MEMINFO, f"{GROUP}max": "100000\n"}, 100_000),
    ({"/proc/meminfo": MEMINFO, f"{GROUP}max": "100000\n", f"{GROUP}current": "30000\n"}, 70_000),
    (
        {f"{GROUP}max": "100000\n", f"{GROUP}current": "30000\n", f"{GROUP}stat": "anon 7\ninactive_file 4000\n"},
        74_000,
    ),
])  # fmt: skip
def test_the_least_of_what_the_system_and_a_container_leave(
    files: dict[str, str], bytes_: float, monkeypatch: pytest.MonkeyPatch
) -> None:
    """What a container has used counts against its limit, but for pages of files that it gives back."""

    def opened(path: str, **_: Any) -> io.StringIO:
        if path not in files:
            raise FileNotFoundError(path)
        return io.StringIO(files[path])

    monkeypatch.setattr(memory, "open", opened, raising=False)
    monkeypatch.setattr(os, "sysconf", {"SC_PHYS_PAGES": 900, "SC_PAGE_SIZE": 1000}.get)
    assert memory.available() == bytes_


def test_nothing_limits_what_no_system_reports(monkeypatch: pytest.MonkeyPatch) -> None:
    def opened(path: str, **_: Any) -> io.StringIO:
        raise FileNotFoundError(path)

    def unknown(name: str) -> int:
        raise ValueError(name)

    monkeypatch.setattr(memory, "open", opened, raising=False)
    monkeypatch.setattr(os, "sysconf", unknown)
    assert memory.available() == math.inf
