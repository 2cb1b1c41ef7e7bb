"""How long the studio takes to answer a change of topology: the text read, drawn, solved and written for the page.

    python benchmarks/studio.py

Of each mechanism fifty gestures, each of which makes another structure: couples, forces, springs and dampers one after
another on its links, from the file as it is. Median and p95, processor time and wall time. On a busy machine run it
with `chrt -r 1`.
"""

from __future__ import annotations

import gc
import json
import statistics
import time
from itertools import product

from dalembert.bundled import examples
from dalembert.model.files.rewriting import text_of
from dalembert.model.library import scissor
from dalembert.model.library.from_files import file_text
from dalembert.studio.document import Document
from dalembert.studio.editing.gestures import gesture
from dalembert.studio.solver import Question, answered, collect_rarely, written

COUNT, WARM = 50, 4
"""Changes that are timed of each mechanism, and some before them."""


def texts() -> dict[str, str]:
    """The mechanisms, as files."""
    return {
        "four-bar": examples()["four_bar"].read_text(encoding="utf-8"),
        "shaper": file_text("crank_shaper"),
        "engine": examples()["engine"].read_text(encoding="utf-8"),
        "scissor lift of 3 stages": text_of(scissor(3), "yaml"),
    }


def gestures(d: Document) -> list[object]:
    """Loads on each moving link, by kind."""
    links = [link for link in d.reading.drawing["links"] if link["name"] != "ground" and link["points"]]
    ground = d.reading.drawing["links"][0]
    fixed = next(iter(ground["points"].items()))

    def end(link: str, point: str, at: object) -> dict[str, object]:
        return {"link": link, "point": point, "at": at}

    out = list[object]()
    for op, link in product(("couple", "force", "spring", "damper"), links):
        here = end(link["name"], *list(link["points"].items())[-1])
        out.append(
            {
                "couple": {"op": op, "link": link["name"], "value": "3 N*m"},
                "force": {"op": op, "where": here, "vector": [5.0, 3.0]},
            }.get(op, {"op": op, "first": end("ground", *fixed), "second": here})
        )
    return out


def answer(d: Document, asked: object) -> tuple[float, float]:
    """Processor time and wall time of the answer to a gesture, ms."""
    cpu, wall = time.process_time(), time.perf_counter()
    d.do(gesture(asked))
    reading = d.reading
    json.dumps({"text": d.text, "drawing": reading.drawing}, default=float)
    assert reading.source is not None
    told = answered(Question("data", d.text, d.form, d.name, read=(reading.tree, reading.source)))
    assert "data" in told, told
    written(told)
    return 1e3 * (time.process_time() - cpu), 1e3 * (time.perf_counter() - wall)


def p95(some: list[float]) -> float:
    return sorted(some)[int(0.95 * (len(some) - 1))]


def main() -> None:
    print("                              processor, ms         wall, ms")
    print("                              median    p95     median    p95")
    collect_rarely()
    for name, text in texts().items():
        taken = list[tuple[float, float]]()
        while len(taken) < WARM + COUNT:
            d = Document(text)
            for asked in gestures(d)[: WARM + COUNT - len(taken)]:
                taken.append(answer(d, asked))
                d.prepare()
                gc.collect()  # as the solver does while it waits
        cpu, wall = zip(*taken[WARM:], strict=True)
        figures = (f(x) for x in (list(cpu), list(wall)) for f in (statistics.median, p95))
        print(f"{name:28}" + "".join(f"{x:8.0f}" for x in figures))


if __name__ == "__main__":
    main()
