"""A study's results as text, in the units of its model file."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

from dalembert.analysis.output.summary.printed_units import Printed
from dalembert.errors import NUMBERED
from dalembert.printing import Part, TextTable, number, table
from dalembert.studies.design_study import Study
from dalembert.studies.study_result import PERCENTILES, Difference, Failure, StudyResult
from dalembert.studies.varied_numbers import varied_numbers

BLOCKS = " ▁▂▃▄▅▆▇█"
"""Heights of a histogram's columns."""


def summary(r: StudyResult) -> str:
    """Statuses, percentiles, histograms, worst and best designs, limits, of the computed designs."""
    return "\n\n".join(
        [f"{r.study.mechanism.title}\n{heading(r)}".strip(), _statuses(r), *_outputs(r), *_limits(r)]
    )


def study_parts(r: StudyResult) -> Iterator[Part]:
    """Designs, their statuses, outputs and limits: sentences and tables."""
    yield heading(r)
    yield TextTable(["status", "designs", "share"], status_rows(r))
    yield from (failure_text(r, f) for f in r.failed())
    heads, rows = output_rows(r)
    if rows:
        yield TextTable(heads, rows, 2, " ".join(filter(None, (reduction(r), left_out(r)))))
    if limits := limit_rows(r):
        yield TextTable(["limit", "designs that keep it", "Cpk"], limits)


def heading(r: StudyResult) -> str:
    """Number of designs, their sampling, and the reduction of the outputs."""
    done, plan = int(r.done.sum()), r.study.plan
    seconds = r.ledger[:, 1].sum() / 1e3
    seed = "" if plan.draw in ("table", "factorial") else f", seed {plan.seed}"
    motion = "" if r.study.motion is None else f"; {r.study.motion}"
    return f"{done:,} of {r.study.count:,} designs ({plan.draw}{seed}), {seconds:.3g} s of core time{motion}"


def reduction(r: StudyResult) -> str:
    """Sentence on the reduction of the outputs."""
    over = "positions" if r.study.motion is None else "instants"
    return f"Over the {over}: {r.study.reduce}." if r.study.reduce else ""


def status_rows(r: StudyResult) -> list[list[str]]:
    """Status, designs, share."""
    counts = r.counts()
    return [[name, f"{n:,}", f"{n / sum(counts.values()):.4%}"] for name, n in counts.items()]


def _statuses(r: StudyResult) -> str:
    text = table(["status", "designs", "share"], status_rows(r), 1)
    return "\n".join([text, *(failure_text(r, f) for f in r.failed())])


def failure_text(r: StudyResult, f: Failure) -> str:
    """Status, reason, the first designs, and how the numbers of these designs differ."""
    first = f"First: design {', '.join(map(str, f.first))}"
    reason = f" Design {f.first[0]}: {f.reason}" if f.reason else ""
    return f"{f.status}: {f.sentence} {first}.{reason}{_difference_text(r, f.differs)}"


def _difference_text(r: StudyResult, d: Difference | None) -> str:
    if d is None:
        return ""
    kind, to = r.study.number_kinds[d.path], Printed(r.study.mechanism.units)
    value = f"{float(to(kind, d.value)):.4g} {to.text(kind)}".strip()
    side = "above" if d.above else "below"
    return (
        f" These designs differ most in {d.path}: {d.failing:.0%} of them have it {side} {value}, "
        f"and {d.answered:.0%} of the solved designs."
    )


def left_out(r: StudyResult) -> str:
    """Sentence on the designs that statistics do not cover; empty where they cover all."""
    count, without = r.unsolved()
    if not without:
        return ""
    shares = [
        f"{f.status} {f.share:.2%}" for f in r.failed(1) if f.status not in (*NUMBERED, "no_derivative")
    ]
    return (
        f"Means, sigmas and percentiles are of the {count - without:,} of {count:,} designs that have numbers "
        f"({1 - without / count:.2%}); the others have none: {', '.join(shares)}. As these may differ from the rest, "
        "the figures may be biased. A design without numbers keeps no limit."
    )


def output_rows(r: StudyResult) -> tuple[list[str], list[list[str]]]:
    """Heads, and a row for each output with one number per design: mean, sigma, percentiles, least and greatest."""
    to, rows = Printed(r.study.mechanism.units), []
    for name in r.study.outputs:
        if r.arrays[name].ndim > 1 or not len(values := r.values(name)):
            continue
        kind = r.kinds[name]
        shown = to(kind, np.array([values.mean(), values.std(), *r.percentiles(name).values()]))
        ends = (f"{number(float(to(kind, r[name][k])), 5)} ({k})" for k in (r.best(name), r.worst(name)))
        rows.append([name, to.text(kind), *(number(float(x), 5) for x in shown), *ends])
    percents = [f"{p:g} %" for p in PERCENTILES]
    return ["output", "unit", "mean", "sigma", *percents, "least (design)", "greatest (design)"], rows


def _outputs(r: StudyResult) -> list[str]:
    """The same as text, and their histograms."""
    more = [name for name in r.study.outputs if r.arrays[name].ndim > 1]
    sentences = (
        [f"Several numbers a design, to be read in Python or by export: {', '.join(more)}"] if more else []
    )
    heads, rows = output_rows(r)
    if not rows:
        return sentences
    pictures = [_histogram(r, row[0]) for row in rows]
    return [
        "\n".join(part for part in (reduction(r), left_out(r), table(heads, rows, 2)) if part),
        table(["", "from", "", "to", ""], pictures, 1),
        *sentences,
    ]


def _histogram(r: StudyResult, name: str) -> list[str]:
    to, kind = Printed(r.study.mechanism.units), r.kinds[name]
    counts, edges = r.histogram(name)
    line = "".join(BLOCKS[round(8 * n / counts.max())] for n in counts.tolist())
    low, high = (to(kind, edges[k]) for k in (0, -1))
    return [name, f"{low:.5g}", line, f"{high:.5g}", to.text(kind)]


def limit_rows(r: StudyResult) -> list[list[str]]:
    """Limit, share of the designs that keep it, process capability Cpk where it is one number's."""
    shares = r.shares()
    capable = [f"{r.capability(limit.output, limit.text):.3f}" for limit in r.study.limits]
    capable += [""] * (len(shares) - len(capable))
    return [[name, f"{share:.4%}", cpk] for (name, share), cpk in zip(shares.items(), capable, strict=True)]


def _limits(r: StudyResult) -> list[str]:
    rows = limit_rows(r)
    return [table(["limit", "designs that keep it", "Cpk"], rows, 1)] if rows else []


def extreme_rows(r: StudyResult, name: str) -> list[list[str]]:
    """Number, unit, value in the model file, in the designs with the least and greatest of an output."""
    study, to = r.study, Printed(r.study.mechanism.units)
    designs = [study.design(n) for n in (r.best(name), r.worst(name))]
    in_file = {n.path: n.value for path in study.paths for n in varied_numbers(study.mechanism, path)}
    kinds = study.number_kinds | {name: r.kinds[name]}
    values = {path: [in_file[path], *(d[path] for d in designs)] for path in study.paths}
    nominal = study.engine.block(np.array([list(in_file.values())]))[name][0]
    values |= {name: [float(nominal), *(float(r[name][n]) for n in (r.best(name), r.worst(name)))]}
    return [
        [path, to.text(kinds[path]), *(f"{to(kinds[path], x):.6g}" for x in of)]
        for path, of in values.items()
    ]


def design_text(study: Study, n: int) -> str:
    """The numbers of a design, in the units of the model file."""
    to, kinds = Printed(study.mechanism.units), study.number_kinds
    rows = [
        [path, f"{to(kinds[path], value):.12g}", to.text(kinds[path])]
        for path, value in study.design(n).items()
    ]
    return table(["number", f"design {n}", "unit"], rows, 1)


def contributions_text(study: Study, by: str) -> str:
    """Shares of the variance of each output of one number, the largest first."""
    to, parts = Printed(study.mechanism.units), []
    kinds = study.kinds
    for name in study.outputs:
        contributions = study.contributions(name, by)
        order = sorted(contributions.shares, key=lambda path: -contributions.shares[path])
        rows = [
            [
                path,
                f"{contributions.shares[path]:.2%}",
                *([f"{contributions.total[path]:.2%}"] if contributions.total else []),
            ]
            for path in order
        ]
        heads = [
            "number",
            "share of the variance",
            *(["with its interactions"] if contributions.total else []),
        ]
        sigma = f"{to(kinds[name], contributions.sigma):.5g} {to.text(kinds[name])}".strip()
        worst = study.worst_case(name)
        case = f"{to(kinds[name], worst.value):.5g} {to.text(kinds[name])}".strip()
        title = f"{name} ({by}): sigma {sigma}; worst case {case} ({worst.assumed})"
        parts.append(
            "\n".join(
                [
                    title,
                    table(heads, rows, 1),
                    *([f"Note: {contributions.note}."] if contributions.note else []),
                ]
            )
        )
    return "\n\n".join(parts)
