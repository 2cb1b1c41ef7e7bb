"""One thread for small matrices; random tests draw anew, but not where a verdict has to repeat; tests in another order.

`left_to_long.txt` names quick tests that are long ones: `benchmarks/quick_tests.py` writes it.

The suite runs as many processes as there are cores; threads of linear algebra in each would wait for each other.
"""

import gc
import os
import random
import signal
from pathlib import Path

import pytest
from hypothesis import HealthCheck, settings

os.environ.setdefault("OPENBLAS_NUM_THREADS", "1")  # before numpy is imported
# A shell's background jobs ignore Ctrl-C, and what they start with them: programs that tests interrupt do not.
signal.signal(signal.SIGINT, signal.default_int_handler)

LEFT_TO_LONG = frozenset(
    (Path(__file__).parent / "left_to_long.txt").read_text(encoding="utf-8").splitlines()
)

settings.register_profile("patient", deadline=None, suppress_health_check=[HealthCheck.too_slow])
settings.register_profile("ci", settings.get_profile("patient"), derandomize=True, database=None)
settings.load_profile("ci" if os.environ.get("CI") else "patient")


def pytest_addoption(parser: pytest.Parser) -> None:
    parser.addoption(
        "--shuffle", type=int, metavar="SEED", help="import test files and run tests in a random order"
    )
    parser.addoption(
        "--every-quick", action="store_true", help="with the quick tests of tests/left_to_long.txt"
    )


def pytest_configure(config: pytest.Config) -> None:
    from dalembert.kernel.emit import machine_code  # numpy is imported with it

    if "not long" in config.option.markexpr:
        machine_code.LEVEL = (
            0  # a third of the time of the tests of kernels; the long tests have it as users have
        )
    seed = config.getoption("--shuffle")
    if seed is not None and config.args == config.getini("testpaths"):
        here = Path(__file__).parent
        config.args = [
            *sorted(map(str, here.rglob("test_*.py"))),
            str(here / "tiers.py"),
            str(here.parent / "src"),
        ]
        random.Random(seed).shuffle(config.args)


def pytest_itemcollected(item: pytest.Item) -> None:
    if item.nodeid in LEFT_TO_LONG and not item.config.getoption("--every-quick"):
        item.add_marker(pytest.mark.long)


@pytest.hookimpl(trylast=True)
def pytest_collection_modifyitems(config: pytest.Config, items: list[pytest.Item]) -> None:
    if config.getoption("--shuffle") is not None:
        random.Random(config.getoption("--shuffle")).shuffle(items)


@pytest.hookimpl(trylast=True)
def pytest_collection_finish(session: pytest.Session) -> None:
    """What is imported stays: garbage collection need not walk through it again and again (7 % of the time)."""
    gc.collect()
    gc.freeze()
    gc.set_threshold(50_000, 20, 50)
