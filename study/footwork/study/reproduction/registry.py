"""Every row there is: the ``ROW`` of each file in ``rows``."""

import pkgutil
from collections.abc import Sequence
from importlib import import_module

from footwork.errors import InputError
from footwork.study.reproduction import rows
from footwork.study.reproduction.row import Row


def all_rows() -> list[Row]:
    """The rows of all papers: by paper, then in their own order."""
    modules = [import_module(f"{rows.__name__}.{found.name}") for found in pkgutil.iter_modules(rows.__path__)]
    return sorted((module.ROW for module in modules), key=lambda row: (row.paper.year, row.paper.letter, row.order))


def chosen_rows(names: Sequence[str]) -> list[Row]:
    """The rows of these names, or whose names begin with these letters of papers; all for none.

    Raises:
        InputError: for a name that is neither.
    """
    rows_there = all_rows()
    known = {row.name.upper(): row.name for row in rows_there} | {row.paper.letter: "" for row in rows_there}
    wanted = [name.upper() for name in names]
    for name in wanted:
        if name not in known:
            there = ", ".join(known[key] or f"{key} (all of it)" for key in known)
            raise InputError(f"no row {name!r}, there are {there}", "--only")
    return [row for row in rows_there if not wanted or row.name.upper() in wanted or row.paper.letter in wanted]
