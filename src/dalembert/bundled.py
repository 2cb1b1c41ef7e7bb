"""Location of the examples and the published cases: beside the sources in a checkout, inside the package in a wheel."""

from __future__ import annotations

from pathlib import Path

_PACKAGE = Path(__file__).resolve().parent
_CHECKOUT = _PACKAGE.parents[1]


def folder(name: str) -> Path:
    """The folder `examples` or `cases` of this installation.

    >>> folder("examples").name
    'examples'
    """
    in_checkout = (_CHECKOUT / "pyproject.toml").is_file() and (_CHECKOUT / name).is_dir()
    return (_CHECKOUT if in_checkout else _PACKAGE) / name


def examples() -> dict[str, Path]:
    """Name -> file of every bundled example.

    >>> examples()["four_bar"].name
    'four_bar.yaml'
    """
    return _files("examples")


def cases() -> dict[str, Path]:
    """Name -> file of every bundled published problem (a model file with `answers`)."""
    return _files("cases")


def _files(name: str) -> dict[str, Path]:
    root = folder(name)
    return {path.relative_to(root).with_suffix("").as_posix(): path for path in sorted(root.rglob("*.yaml"))}
