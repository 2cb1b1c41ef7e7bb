"""A study's results as text, in the units of its model file."""

from __future__ import annotations

import numpy as np

from dalembert.analysis.batch.symbolic_model import number_kinds
from dalembert.analysis.output.columns import Scale
from dalembert.printing import table
from dalembert.studies.design_study import Study
from dalembert.studies.study_result import PERCENTILES, StudyResult
from dalembert.studies.varied_numbers import varied_numbers

BLOCKS = " ▁▂▃▄▅▆▇█"
"""Heights of a histogram's columns."""


def summary(r: StudyResult) -> str:
    """Statuses, percentiles, histograms, worst and best designs, limits, of the designs that are there."""
    done, count = int(r.done.sum()), r.study.count
    seconds = r.ledger[:, 1].sum() / 1e3
    plan = r.study.plan
    seed = "" if plan.draw in ("table", "factorial") else f", seed {plan.seed}"
    head = f"{done:,} of {count:,} designs ({plan.draw}{seed}), {seconds:.3g} s of one core"
    parts = [f"{r.study.mechanism.title}\n{head}".strip(), _statuses(r)]
    return "\n\n".join([*parts, *_outputs(r), *_limits(r)])


def _statuses(r: StudyResult) -> str:
    counts = r.counts()
    total = sum(counts.values())
    rows = [[name, f"{n:,}", f"{n / total:.4%}"] for name, n in counts.items()]
    text = table(["status", "designs", "share"], rows, 1)
    said = [f"{f.status}: {f.sentence} First: design {', '.join(map(str, f.first))}" for f in r.failed()]
    return "\n".join([text, *said])


def _outputs(r: StudyResult) -> list[str]:
    """Of each output with one number a design a row, and its histogram."""
    to, rows, pictures = Scale(r.study.mechanism.units), [], []
    for name in r.study.outputs:
        if r.arrays[name].ndim > 1 or not len(values := r.values(name)):
            continue
        kind = r.kinds[name]
        shown = to(kind, np.array([values.mean(), values.std(), *r.percentiles(name).values()]))
        ends = (f"{to(kind, r[name][k]):.5g} ({k})" for k in (r.best(name), r.worst(name)))
        rows.append([name, to.text(kind), *(f"{x:.5g}" for x in shown), *ends])
        counts, edges = r.histogram(name)
        line = "".join(BLOCKS[round(8 * n / counts.max())] for n in counts.tolist())
        low, high = (to(kind, edges[k]) for k in (0, -1))
        pictures.append([name, f"{low:.5g}", line, f"{high:.5g}", to.text(kind)])
    more = [name for name in r.study.outputs if r.arrays[name].ndim > 1]
    said = [f"Several numbers a design, to be read in Python or by export: {', '.join(more)}"] if more else []
    if not rows:
        return said
    percents = [f"{p:g} %" for p in PERCENTILES]
    heads = ["output", "unit", "mean", "sigma", *percents, "least (design)", "greatest (design)"]
    reduce = f"Over the positions: {r.study.reduce}." if r.study.reduce else ""
    return [
        f"{reduce}\n{table(heads, rows, 2)}".strip(),
        table(["", "from", "", "to", ""], pictures, 1),
        *said,
    ]


def _limits(r: StudyResult) -> list[str]:
    shares = [[name, f"{share:.4%}"] for name, share in r.shares().items()]
    return [table(["limit", "designs that keep it"], shares, 1)] if shares else []


def design_text(study: Study, n: int) -> str:
    """The numbers of a design, in the units of the model file."""
    to, design = Scale(study.mechanism.units), study.design(n)
    kinds = number_kinds(study.mechanism, [varied_numbers(study.mechanism, path)[0] for path in design])
    rows = [
        [path, f"{to(kind, value):.12g}", to.text(kind)]
        for (path, value), kind in zip(design.items(), kinds, strict=True)
    ]
    return table(["number", f"design {n}", "unit"], rows, 1)


def contributions_text(study: Study, by: str) -> str:
    """Shares of the variance of each output of one number, the largest first."""
    to, parts = Scale(study.mechanism.units), []
    kinds = study.kinds
    for name in study.outputs:
        found = study.contributions(name, by)
        order = sorted(found.shares, key=lambda path: -found.shares[path])
        rows = [
            [path, f"{found.shares[path]:.2%}", *([f"{found.total[path]:.2%}"] if found.total else [])]
            for path in order
        ]
        heads = ["number", "share of the variance", *(["with its interactions"] if found.total else [])]
        sigma = f"{to(kinds[name], found.sigma):.5g} {to.text(kinds[name])}".strip()
        worst = study.worst_case(name)
        case = f"{to(kinds[name], worst.value):.5g} {to.text(kinds[name])}".strip()
        said = f"{name} ({by}): sigma {sigma}; worst case {case} ({worst.assumed})"
        parts.append(
            "\n".join([said, table(heads, rows, 1), *([f"Mind: {found.note}."] if found.note else [])])
        )
    return "\n\n".join(parts)
