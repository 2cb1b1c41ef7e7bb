"""Options that commands share: streams by name, folders of data, settings, notation, and how a command ends."""

from __future__ import annotations

import io
import sys
import warnings
from pathlib import Path
from types import SimpleNamespace
from typing import Any

import pytest

import dalembert as da
from dalembert import cli
from dalembert.cli import describe_commands, main
from dalembert.cli.options import Changes, Style, bounded, integer, set_values, with_settings
from dalembert.cli.variants_command import _introduction, _marks
from dalembert.errors import ModelError
from dalembert.exams import exam_folder, variants
from tests.cli.conftest import Run


@pytest.mark.parametrize(
    ("arguments", "rest", "folder"),
    [
        (["solve", "a.yaml"], ["solve", "a.yaml"], ""),
        (["--data", "d", "solve", "a.yaml"], ["solve", "a.yaml"], "d"),
        (["solve", "--data", "d", "a.yaml", "-x"], ["solve", "a.yaml", "-x"], "d"),
        (["solve", "a.yaml", "--data=d/e"], ["solve", "a.yaml"], "d/e"),
        (["--data=d", "solve", "--csv"], ["solve", "--csv"], "d"),
        (["solve", "a.yaml", "--data"], ["solve", "a.yaml", "--data"], ""),
        (["solve", "a.yaml", "--data", "d"], ["solve", "a.yaml"], "d"),
    ],
)
def test_the_folder_of_data_is_taken_out_of_the_arguments(
    arguments: list[str], rest: list[str], folder: str
) -> None:
    assert cli._data_folder(arguments) == (rest, folder)


def test_a_hyphen_is_a_stream_by_the_option_before_it() -> None:
    named = cli._name_streams(
        [
            "solve",
            "-",
            "--json",
            "-",
            "--csv=-",
            "--output",
            "-",
            "-o",
            "-",
            "--output=-",
            "--at=-",
            "--at",
            "-",
            "x=-",
        ]
    )
    assert named == [
        *("solve", "/dev/stdin", "--json", "-", "--csv=-", "--output", "/dev/stdout", "-o", "/dev/stdout"),
        *("--output=/dev/stdout", "--at=-", "--at", "/dev/stdin", "x=-"),
    ]
    assert cli._name_streams(["--xlsx", "-", "--netcdf=-", "--json=a"]) == [
        "--xlsx",
        "-",
        "--netcdf=-",
        "--json=a",
    ]


def raising(error: BaseException) -> Any:
    def run(arguments: list[str]) -> int:
        raise error

    return run


def interrupted_class() -> RuntimeError:
    error = RuntimeError("a class")
    error.__cause__ = KeyboardInterrupt()
    return error


@pytest.mark.parametrize(
    ("error", "status", "said", "let_go"),
    [
        (KeyboardInterrupt(), 130, "", 0),
        (BrokenPipeError(), 0, "", 1),
        (interrupted_class(), 130, "", 0),
        (OSError(28, "No space left on device"), 2, "standard output: no space left on device\n", 1),
        (OSError("Gone Away"), 2, "standard output: gone away\n", 1),
    ],
)
def test_what_ends_a_command_has_an_exit_status(
    error: BaseException,
    status: int,
    said: str,
    let_go: int,
    monkeypatch: pytest.MonkeyPatch,
    capsys: pytest.CaptureFixture[str],
) -> None:
    gone: list[int] = []
    monkeypatch.setattr(cli, "_run", raising(error))
    monkeypatch.setattr(cli, "_let_go", lambda: gone.append(1))
    assert main(["solve"]) == status
    assert capsys.readouterr().err == said
    assert sum(gone) == let_go


def test_another_fault_of_the_program_is_not_hidden(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(cli, "_run", raising(RuntimeError("a fault")))
    with pytest.raises(RuntimeError, match="a fault"):
        main(["solve"])


def test_arguments_of_the_process_are_taken_where_none_are_given(
    monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    begun: list[str] = []
    monkeypatch.setattr(cli, "_spare_the_collector", lambda: begun.append("collector"))
    monkeypatch.setattr(cli, "_write_any_text", lambda: begun.append("text"))
    monkeypatch.setattr(sys, "argv", ["dalembert", "--version"])
    assert (main(), capsys.readouterr().out) == (0, f"{da.__version__}\n")
    assert begun == ["collector", "text"]
    assert main(["--version"]) == 0
    assert begun == ["collector", "text"]


def test_pipes_take_any_letter(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.delenv("PYTHONIOENCODING", raising=False)
    for asked in ("", "ascii"):
        out, other = io.TextIOWrapper(io.BytesIO(), encoding="ascii"), io.StringIO()
        monkeypatch.setattr(sys, "stdout", out)
        monkeypatch.setattr(sys, "stderr", other)
        if asked:
            monkeypatch.setenv("PYTHONIOENCODING", asked)
        cli._write_any_text()
        assert (out.encoding, out.errors) == (("ascii", "backslashreplace") if asked else ("utf-8", "strict"))
    error = io.TextIOWrapper(io.BytesIO(), encoding="ascii")
    monkeypatch.delenv("PYTHONIOENCODING")
    monkeypatch.setattr(sys, "stderr", error)
    monkeypatch.setattr(sys, "stdout", io.StringIO())
    cli._write_any_text()
    assert error.encoding == "utf-8"


def test_warnings_of_a_command_are_notes(
    monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    def warned(*_: Any, **options: Any) -> int:
        assert options == {"exit_on_error": False, "print_error": False, "result_action": "return_value"}
        warnings.simplefilter("default")
        warnings.warn("a colour is not kept", stacklevel=1)
        return 3

    monkeypatch.setattr("dalembert.cli.app.command_line", lambda first: warned)
    shown = warnings.showwarning
    assert main(["solve"]) == 3
    assert capsys.readouterr() == ("", "note: a colour is not kept\n")
    assert warnings.showwarning is shown


@pytest.mark.parametrize(
    ("error", "status", "said"),
    [
        (da.AnalysisError("it jams"), 1, "it jams\n"),
        (ModelError("a link is missing", "add it"), 2, "a link is missing; add it\n"),
        (
            FileNotFoundError(2, "No such file or directory", "a.yaml"),
            2,
            "a.yaml: no such file or directory\n",
        ),
        (OSError(28, "No Space"), 2, "standard output: no space\n"),
    ],
)
def test_errors_of_a_command_are_one_line(
    error: Exception,
    status: int,
    said: str,
    monkeypatch: pytest.MonkeyPatch,
    capsys: pytest.CaptureFixture[str],
) -> None:
    monkeypatch.setattr("dalembert.cli.app.command_line", lambda first: lambda *a, **b: raising(error)([]))
    monkeypatch.setattr(cli, "_let_go", lambda: None)
    assert main(["solve"]) == status
    assert capsys.readouterr() == ("", said)


# options


def test_readers_of_numbers_keep_their_limits() -> None:
    token = lambda text: [SimpleNamespace(value=text)]  # noqa: E731
    read, both = integer(2), integer(2, 5)
    assert [read(None, token(t)) for t in ("2", "3", "999999999999999")] == [2, 3, 999_999_999_999_999]
    assert [both(None, token(t)) for t in ("2", "5")] == [2, 5]
    for text in ("1", "-3", "2.5", "", "٣", "9999999999999999"):
        with pytest.raises(ValueError, match=rf"^'{text}' is not an integer of 2 or more$"):
            read(None, token(text))
    for text in ("1", "6"):
        with pytest.raises(ValueError, match=rf"^'{text}' is not an integer from 2 to 5$"):
            both(None, token(text))
    assert bounded("instants")(None, token("7")) == 7
    assert bounded("step error")(None, token("1e-3")) == 1e-3
    for key, text in (
        ("instants", "7.5"),
        ("instants", "many"),
        ("step error", "small"),
        ("step error", "-1"),
    ):
        with pytest.raises(ValueError, match=rf"^'{text}' is not allowed; "):
            bounded(key)(None, token(text))


def test_settings_are_names_with_values() -> None:
    assert set_values([" r = 50 mm ", "a.b=true", "c=false", "d=x=y"]) == {
        "r": "50 mm", "a.b": True, "c": False, "d": "x=y",
    }  # fmt: skip
    for setting in ("r", "r=", "=5", " = 5"):
        with pytest.raises(ModelError) as refused:
            set_values(["a=1", setting])
        assert (
            str(refused.value) == f"--set {setting} has no value; write NAME=VALUE, for example --set r=50mm"
        )
    with pytest.raises(ModelError, match=r"^--set gives 'r' twice; leave one of them out$"):
        set_values(["r=1", "s=2", "r = 3"])
    m = da.four_bar()
    assert with_settings(m, ()) is m
    assert with_settings(m, ["links.crank.mass=7 kg"]).mass("crank") == 7
    with pytest.raises(ModelError, match=r"^--set links.crank.mass=2 --set nothing=3: "):
        with_settings(m, ["links.crank.mass=2", "nothing=3"])
    assert Changes(no_friction=True).changed(m).to_tree()["friction"]["enabled"] is False
    assert "friction" not in Changes().changed(m).to_tree()


def test_a_style_is_the_notation_of_a_solution() -> None:
    n = Style().notation()
    assert (n.links, n.order, n.letter, n.units, n.figures, n.decimals, n.torque, n.axes) == (
        "number", "by-on", "F", "file", 4, None, 1, "ground",
    )  # fmt: skip
    n = Style("si", "link", True, True, "G", 6, 2, True).notation()
    assert (n.links, n.order, n.letter, n.units, n.figures, n.decimals, n.torque, n.axes) == (
        "name", "on-by", "G", "SI", 6, 2, -1, "link",
    )  # fmt: skip
    assert Style("file").notation().units == "file"


# variants and descriptions


def test_marks_and_an_introduction_are_read(folder: Path) -> None:
    assert [_marks(t) for t in ("effort=4", " reaction.A = 2.5")] == [("effort", 4.0), ("reaction.A", 2.5)]
    for text in ("effort", "effort=many"):
        with pytest.raises(ModelError) as refused:
            _marks(text)
        assert str(refused.value) == f"--marks {text}: no number of marks; write --marks effort=4"
    (folder / "intro.txt").write_text("\nRead this.\n\n", encoding="utf-8")
    assert (_introduction("@intro.txt"), _introduction("in words"), _introduction("")) == (
        "Read this.",
        "in words",
        "",
    )


def test_variants_are_drawn_and_saved_as_the_options_say(run: Run, monkeypatch: pytest.MonkeyPatch) -> None:
    asked: list[Any] = []
    path = "loads.T_4.value"

    class Exam(list[Any]):
        seed = 41

        def save(self, *given: Any) -> None:
            asked.append(given)

    def drawn(m: Any, *given: Any) -> Exam:
        asked.append(given)
        return Exam(SimpleNamespace(name=f"0{k}", values={path: f"{100 + k} lbf*in"}) for k in (1, 2))

    monkeypatch.setattr(variants, "variants", drawn)
    monkeypatch.setattr(exam_folder, "check_folder", lambda *given: asked.append(given))
    ran = run("variants", "four_bar.yaml", "--vary", f"{path}=100..140", "-o", "exam")
    assert ran.status == 0
    assert ran.err == "Written: exam; --seed 41 draws the same again.\n"
    lines = ran.out.splitlines()
    assert lines[0].split() == ["variant", path]
    assert [line.split()[:2] for line in lines[2:4]] == [["01", "101"], ["02", "102"]]
    checked, given, saved = asked
    assert checked == (Path("exam"), False)
    assert list(given[0]) == [path]
    assert given[1:] == (30, None, (), None, False, "")
    assert saved == (Path("exam"), False, "", "", {})
    more = [
        "--count",
        "3",
        "--ask",
        "effort.O2",
        "--seed",
        "5",
        "--at",
        "2",
        "--tolerance",
        "3 %",
        "--static",
    ]
    more += ["--course", "ME", "--text", "Go.", "--marks", "effort=4", "--force"]
    run("variants", "four_bar.yaml", "--vary", f"{path}=100..140", "-o", "exam", *more)
    assert asked[3] == (Path("exam"), True)
    assert asked[4][1:] == (3, 5, ["effort.O2"], "2", True, "3 %")
    assert asked[5] == (Path("exam"), True, "ME", "Go.", {"effort": 4.0})


def test_titles_are_read_from_the_top_of_a_file(folder: Path) -> None:
    for text, title in (
        ("dalembert: 1\ntitle: 'A press'\n", "A press"),
        ('title: "B"\ntitle: C\n', "B"),
        ("x: 1\n", ""),
    ):
        (folder / "m.yaml").write_text(text, encoding="utf-8")
        assert describe_commands._title(folder / "m.yaml") == title


def test_what_a_description_is_written_to(folder: Path, capsys: pytest.CaptureFixture[str]) -> None:
    write = describe_commands.write_or_print
    for screen in (None, Path("-"), Path("/dev/stdout")):
        assert describe_commands.is_screen(screen)
        assert write("a\nb\n\n", screen, False) == 0
        assert capsys.readouterr().out == "a\nb\n"
    assert not describe_commands.is_screen(Path("a.yaml"))
    assert write("a\n\n", Path("a.yaml"), False) == 0
    assert (folder / "a.yaml").read_text(encoding="utf-8") == "a\n\n"
    assert capsys.readouterr().out == "Written: a.yaml\n"
    with pytest.raises(da.DalembertError, match=r"a\.yaml"):
        write("b", Path("a.yaml"), False)
    write("b", Path("a.yaml"), True)
    assert (folder / "a.yaml").read_text(encoding="utf-8") == "b"
    said = "a.json is not named like YAML, which this is; end its name with .yaml; `dalembert convert` writes JSON "
    said += "and TOML"
    with pytest.raises(ModelError) as refused:
        describe_commands._model_file("x", Path("a.json"), True)
    assert str(refused.value) == said
