"""`dalembert study`: run, resume, extend, show and design."""

from __future__ import annotations

import sys
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Literal

from cyclopts import App

from dalembert.cli.answer_files import NO_LABELLED, LabelledOutputs
from dalembert.cli.options import AS_IN_FILE, Changes, Force, flag, numeric, output, with_help
from dalembert.errors import ModelError
from dalembert.progress import progress

if TYPE_CHECKING:
    from dalembert.studies import Study, StudyResult

study = App(
    name="study",
    help="Many designs of one mechanism: sampled, analysed, stored and resumed; their statistics.",
    help_epilogue="""Examples:
  dalembert study run study.yaml -o pump.zarr
  dalembert study resume pump.zarr
  dalembert study extend pump.zarr --designs 1e6
  dalembert study show pump.zarr --contributions linear
  dalembert study show pump.zarr --report pump.html --csv pump.csv
  dalembert study design pump.zarr 4711 -o worst.yaml""",
)

StudyFile = Annotated[Path, with_help("Study file: YAML, JSON or TOML.")]
StorePath = Annotated[
    str, with_help("Store of a study: a folder, or an address such as s3://bucket/pump.zarr.")
]
Either = Annotated[str, with_help("Store of a study, or its study file.")]
Threads = Annotated[int | None, numeric("threads", "Threads (default: one per core).")]
Scheduler = Annotated[
    str | None, with_help("Address of a dask scheduler for the computation, e.g. tcp://host:8786.")
]


@study.command(
    help_epilogue="Examples:\n  dalembert study run study.yaml\n  dalembert study run study.yaml -o pump.zarr"
)
def run(
    file: StudyFile,
    /,
    *,
    output: Annotated[str | None, output("New store (default: FILE with extension .zarr).")] = None,
    of: Changes = AS_IN_FILE,
    threads: Threads = None,
    scheduler: Scheduler = None,
) -> int:
    """Run the study in FILE, write its designs to a new store, and print a summary."""
    from dalembert.studies.store import Store
    from dalembert.studies.study_file import load_study

    store = output or str(file.with_suffix(".zarr"))
    if Store(store).exists():
        raise ModelError(
            f"{store} already exists", f"dalembert study resume {store}, or name another with -o"
        )
    return _run(load_study(file, of.changed), store, threads, scheduler)


@study.command(help_epilogue="Examples:\n  dalembert study resume pump.zarr")
def resume(
    study: Either,
    /,
    *,
    output: Annotated[
        str | None, output("Store of a study file (default: FILE with extension .zarr).")
    ] = None,
    threads: Threads = None,
    scheduler: Scheduler = None,
) -> int:
    """Resume a stopped study: missing or damaged blocks are computed, the others checked."""
    from dalembert.studies.store import Store

    store = study if _is_store(study) else output or str(Path(study).with_suffix(".zarr"))
    Store(store).open("r")
    return _run(_read(study), store, threads, scheduler)


@study.command(help_epilogue="Examples:\n  dalembert study extend pump.zarr --designs 1e6")
def extend(
    store: StorePath,
    /,
    *,
    designs: Annotated[float, with_help("Total number of designs.")],
    threads: Threads = None,
    scheduler: Scheduler = None,
) -> int:
    """Add designs to a study with random or Sobol sampling; existing designs do not change."""
    if not designs.is_integer():
        raise ModelError(f"--designs {designs} is not an integer", "give one, such as 100000 or 1e6")
    return _run(_read(store).extended(int(designs)), store, threads, scheduler)


@study.command(
    help_epilogue="Examples:\n  dalembert study show pump.zarr\n  dalembert study show pump.zarr --contributions sobol"
    "\n  dalembert study show pump.zarr --report pump.html --netcdf pump.nc"
)
def show(
    store: StorePath,
    /,
    *,
    contributions: Annotated[
        Literal["linear", "sobol"] | None,
        with_help(
            "Contribution of each number to the variance, by derivatives or by sampling, and the worst case."
        ),
    ] = None,
    unused: Annotated[bool, flag("Name numbers that do not affect any output.")] = False,
    out: LabelledOutputs = NO_LABELLED,
) -> int:
    """Print the summary: statuses, percentiles, histograms, worst and best designs, and the yield."""
    from dalembert.studies.output.study_text import contributions_text

    out.check(Path(store))
    stored = _stored(store)
    more = [contributions_text(stored.study, contributions)] if contributions else []
    if unused:
        more.append(f"Numbers that change no output: {', '.join(stored.study.idle()) or 'none'}")
    out.deliver(stored, more="\n\n".join(more))
    return 0


@study.command(help_epilogue="Examples:\n  dalembert study design pump.zarr 4711 -o design.yaml")
def design(
    study: Either,
    number: Annotated[int, numeric("design", "Number of the design, from 0.")],
    /,
    *,
    output: Annotated[
        Path | None, output("Write the design's model file, to solve, draw and report.")
    ] = None,
    force: Force = False,
) -> int:
    """Print the numbers of one design, reproduced exactly, or write its model file."""
    from dalembert.studies.output.study_text import design_text

    stored = _read(study)
    print(design_text(stored, number))
    if output is not None:
        stored.mechanism_of(number).save(output, force)
    return 0


def _is_store(path: str) -> bool:
    from dalembert.studies.object_store import is_address

    return is_address(path) or Path(path).is_dir()


def _stored(store: str) -> StudyResult:
    from dalembert.studies import StudyResult

    return StudyResult.open(store)


def _read(path: str) -> Study:
    """The study of a store, or of a file."""
    from dalembert.studies import StudyResult
    from dalembert.studies.study_file import load_study

    return StudyResult.open(path, check=False).study if _is_store(path) else load_study(path)


def _run(study: Study, store: str, threads: int | None, scheduler: str | None) -> int:
    """Run with a bar on the terminal, and show."""
    from dalembert.studies.output.study_text import summary

    if study.why_slow:
        print(f"Not compiled, design by design: {study.why_slow}.", file=sys.stderr)
    if unused := study.idle():
        print(f"Changes no output: {', '.join(unused)}.", file=sys.stderr)
    try:
        with progress("Studying", study.count) as step:
            before: list[int] = []

            def tell(done: int, _: int) -> None:
                before[:] = before or [done]
                step(done, start=before[0])

            result = study.run(store, threads=threads, scheduler=scheduler, progress=tell)
    except KeyboardInterrupt:
        print(f"Stopped. Finished blocks are kept: dalembert study resume {store}", file=sys.stderr)
        raise
    print(summary(result))
    return 0
