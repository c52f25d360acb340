"""What a person reads: tables that fit the terminal, and a line where one has to wait."""

import time

import pytest

from footwork.cli import output

WIDE = [{"file": f"player{number}.csv", **{f"measure_{k}": 0.1234 * k for k in range(12)}} for number in range(2)]


@pytest.mark.parametrize("columns", ["60", "400"])
def test_records_with_many_fields_lie_down_where_they_would_not_fit(monkeypatch, capsys, columns):
    monkeypatch.setenv("COLUMNS", columns)
    output.emit({"total": 0.5, "traces": WIDE}, False, "score")
    lines = capsys.readouterr().out.splitlines()
    assert max(map(len, lines)) <= int(columns)
    (head,) = [line for line in lines if "file" in line]
    assert ("player1.csv" in head) == (columns == "60")
    assert not any("…" in line for line in lines)


def test_a_wait_is_explained_only_where_there_is_one(monkeypatch):
    monkeypatch.setattr(output, "_SOON_SECONDS", 0.05)
    said: list[str] = []
    with output.compiling(said.append):
        pass
    time.sleep(0.2)
    assert not said
    with output.compiling(said.append):
        for _ in range(400):
            if said:
                break
            time.sleep(0.05)
    assert "compiling" in said[0]
