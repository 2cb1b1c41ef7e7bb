"""Files of an answer that a command writes: which are refused, in which units and axes the others are written."""

from __future__ import annotations

from pathlib import Path
from types import SimpleNamespace
from typing import Any

import pytest

from dalembert.cli.answer_files import DrawnOutputs, LabelledOutputs, Outputs, ResultOutputs
from dalembert.errors import ModelError


def refusal(out: Outputs, kinds: tuple[str, ...] = ()) -> str:
    with pytest.raises(ModelError) as refused:
        out.check(Path("m.yaml"), kinds)
    return str(refused.value)


def test_files_that_cannot_be_written_are_refused_first(folder: Path) -> None:
    p = Path
    assert refusal(Outputs(json=p("--csv"))) == "--json needs the name of a file; or - to print it: --json -"
    assert refusal(Outputs(xlsx=p("--csv"))) == "--xlsx needs the name of a file"
    said = "--xlsx - asks for a workbook on the screen, which is not text; name a file"
    assert refusal(Outputs(xlsx=p("-"))) == said
    said = "--json - and --csv - both ask for the screen; name a file for one of them"
    assert refusal(Outputs(json=p("-"), csv=p("-"))) == said
    said = "--report b.pdf: that is the file of --output already; name another file"
    assert refusal(Outputs(output=p("b.pdf"), report=p("b.pdf"))) in (
        said, "--output b.pdf: that is the file of --report already; name another file",
    )  # fmt: skip
    said = "--output ./m.yaml: that is the model file; name another file"
    assert (
        refusal(DrawnOutputs(output=p("./m.yaml")), ("model",)).replace("--output m", "--output ./m") == said
    )
    said = "--csv a.json: that is the name of another kind of file; end it with .csv, or write --json a.json"
    assert refusal(Outputs(csv=p("a.json"))) == said
    said = "--drawing a.html: the ending names no kind of drawing; use one of .svg .pdf .png .dxf"
    assert refusal(DrawnOutputs(drawing=p("a.html"))) == said
    said = "--report a.nc: that is the name of another kind of file; end it with .pdf, or write --netcdf a.nc"
    assert refusal(Outputs(report=p("a.nc"))) == said
    said = (
        "--output a.nc: this answer cannot be written in this format; use one of .json .csv .xlsx .xls .pdf .html .tex "
        ".txt .yaml .yml .toml"
    )
    assert refusal(Outputs(output=p("a.nc")), ("model",)) == said
    (folder / "old.csv").write_text("", encoding="utf-8")
    assert "old.csv" in refusal(Outputs(csv=p("old.csv")))
    Outputs(csv=p("old.csv"), force=True).check(p("m.yaml"))
    Outputs(csv=p("-"), json=p("a.json")).check(p("m.yaml"))


def test_the_kind_of_a_file_is_that_of_its_option_or_its_ending() -> None:
    out, p = LabelledOutputs(), Path
    kinds = [
        out._written_kind("output", p(f"a{e}"), ("model",))
        for e in (".JSON", ".csv", ".xls", ".nc4", ".pdf", ".svg", ".yml")
    ]
    assert kinds == ["json", "csv", "xlsx", "netcdf", "report", "drawing", "model"]
    assert [out._written_kind(k, p("a.txt")) for k in ("json", "csv", "report")] == ["json", "csv", "report"]


@pytest.mark.parametrize(
    ("units", "printed", "program"), [(None, "file", "SI"), ("si", "SI", "SI"), ("file", "file", "file")]
)
def test_people_read_the_units_of_the_file_and_programs_si(units: Any, printed: str, program: str) -> None:
    out = Outputs(units=units, figures=6)
    assert (out.printed_units, out.program_units, out.notation.units) == (printed, program, printed)
    assert out.notation.figures == 6
    assert [DrawnOutputs(output=Path(f"a.{e}")).writes_model for e in ("yaml", "TOML", "json")] == [
        True,
        True,
        False,
    ]
    assert not Outputs(json=Path("a.yaml")).writes_model
    assert Outputs(json=Path("-")).prints_data
    assert Outputs(csv=Path("-")).prints_data
    assert not Outputs(csv=Path("a.csv")).prints_data
    assert list(Outputs(csv=Path("-"), output=Path("b")).targets) == ["csv", "output"]


class Written(SimpleNamespace):
    """An answer that keeps the calls of its writers."""

    def __getattr__(self, name: str) -> Any:
        if name.startswith("__"):
            raise AttributeError(name)

        def call(*given: Any, **more: Any) -> Any:
            self.calls.append((name, *given, *more.items()))
            return self if name in ("draw", "report") else f"as {name}"

        return call


def test_files_are_written_with_their_units_and_axes_before_anything_is_printed(
    folder: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    p, answer = Path, Written(calls=[], mechanism=Written(calls=[]))
    out = ResultOutputs(
        json=p("a.json"), csv=p("-"), netcdf=p("a.nc"), output=p("b.yaml"), axes="joint", units="si"
    )
    out.deliver(answer, others=True)
    names = [call[0] for call in answer.calls]
    assert names == ["to_json", "to_netcdf", "to_csv"]
    assert answer.calls[0][1:] == (p("a.json"), False, "SI", "joint", ("others", True))
    assert answer.calls[1][1:] == (p("a.nc"), False, "SI", "joint", ("others", True))[:4]
    assert answer.calls[2][2:] == (True, "SI", "joint")
    assert answer.mechanism.calls == [("save", p("b.yaml"), False)]
    assert capsys.readouterr().err == "Written: a.json\nWritten: a.nc\nWritten: b.yaml\n"
    answer = Written(calls=[])
    out = ResultOutputs(
        json=p("-"), xlsx=p("a.xlsx"), drawing=p("a.svg"), theme="dark", report=p("a.tex"), force=True
    )
    out.deliver(answer, others=False)
    assert [call[0] for call in answer.calls] == ["to_xlsx", "report", "save", "draw", "save", "to_json"]
    assert answer.calls[0][1:] == (p("a.xlsx"), True, "file", "ground")
    assert (answer.calls[2][1:], answer.calls[4][1:]) == ((p("a.tex"), True), (p("a.svg"), True, "dark"))
    assert answer.calls[5][2:] == (True, "SI", "ground")
    capsys.readouterr()
    answer = Written(calls=[])
    DrawnOutputs(units="si").deliver(answer, more="and this", links=True)
    assert answer.calls == [("text", "SI", ("links", True))]
    assert capsys.readouterr() == ("as text\n\nand this\n", "")
