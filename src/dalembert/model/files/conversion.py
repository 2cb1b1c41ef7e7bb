"""A model file in another format."""

from __future__ import annotations

import os

FilePath = str | os.PathLike[str]


def convert(path: FilePath, target: FilePath, overwrite: bool = False) -> None:
    """Write a model file in another format, keeping the user's units, texts and order of keys.

    The mechanism is read first, so that a wrong file is not converted. Comments are not kept.
    """
    from dalembert.model.description import mechanism
    from dalembert.model.files.model_files import read_file, save_tree
    from dalembert.model.files.rewriting import in_folder

    tree, source = read_file(path)
    tree = in_folder(mechanism(tree, source), tree, os.path.dirname(target))
    save_tree({key: value for key, value in tree.items() if value is not None}, target, overwrite)
