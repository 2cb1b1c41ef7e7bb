"""Drawings of bundled machines: the mechanism, all views and the animation as SVG; the animation as GIF and WebP.

Method. Solved once, one warming call, then processor time in one process, the picture from the result to the file's
bytes; the least of some calls, for a busy machine makes others longer.

    python benchmarks/pictures.py [--repeat 5]
"""

from __future__ import annotations

import os

for _name in ("OPENBLAS_NUM_THREADS", "OMP_NUM_THREADS", "MKL_NUM_THREADS"):
    os.environ[_name] = "1"

import argparse  # noqa: E402
from collections.abc import Callable  # noqa: E402
from functools import partial  # noqa: E402
from pathlib import Path  # noqa: E402
from tempfile import TemporaryDirectory  # noqa: E402
from time import process_time  # noqa: E402

import dalembert as da  # noqa: E402
from dalembert.bundled import examples  # noqa: E402

LIMITS = {("engine", "mechanism"): 0.040, ("scissor_lift", "mechanism"): 0.060}
"""Seconds."""


def svg(r: da.Result, view: da.draw.View) -> None:
    da.draw.view(r, view).to_svg()


def animated(r: da.Result, path: Path) -> None:
    da.draw.animation(r).save(path, overwrite=True)


def least(picture: Callable[[], None], repeat: int) -> float:
    picture()
    taken = []
    for _ in range(repeat):
        start = process_time()
        picture()
        taken.append(process_time() - start)
    return min(taken)


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--repeat", type=int, default=5)
    repeat = parser.parse_args().repeat
    with TemporaryDirectory() as folder:
        for name in ("engine", "scissor_lift", "rssr"):
            r = da.solve(da.load(examples()[name]))
            pictures = {view: partial(svg, r, view) for view in ("mechanism", "free-bodies", "charts", "all")}
            pictures |= {
                end: partial(animated, r, Path(folder) / f"a.{end}") for end in ("svg", "gif", "webp")
            }
            for what, picture in pictures.items():
                seconds, limit = least(picture, repeat), LIMITS.get((name, what))
                kept = (
                    "" if limit is None else f"  limit {limit} s: {'kept' if seconds < limit else 'MISSED'}"
                )
                print(f"{name:14}{what:12}{seconds:8.3f} s{kept}")


if __name__ == "__main__":
    main()
