"""What memory is left is what the machine has to give, within the limits of the control groups around the process."""

import pytest

from footwork.errors import InputError
from footwork.training import memory
from footwork.training.memory import available_bytes, machine_bytes
from footwork.training.room import require_room

GIB = 1 << 30


@pytest.fixture
def machine(tmp_path, monkeypatch):
    """A machine with 8 GiB left to give and no limits, whose files can be written."""
    monkeypatch.setattr(memory, "_MEMINFO", tmp_path / "meminfo")
    monkeypatch.setattr(memory, "_CGROUPS", tmp_path / "cgroup")
    monkeypatch.setattr(memory, "_MOUNT", tmp_path / "groups")
    (tmp_path / "meminfo").write_text(f"MemTotal: 9999 kB\nMemAvailable:    {8 * GIB // 1024} kB\nHugePages_Total: 0\n")
    return tmp_path


def limit(group, version: int, most: object, used: int, droppable: int) -> None:
    names = {1: ("limit_in_bytes", "usage_in_bytes", "total_inactive_file"), 2: ("max", "current", "inactive_file")}
    group.mkdir(parents=True, exist_ok=True)
    for name, value in zip(names[version], (most, used), strict=False):
        (group / f"memory.{name}").write_text(f"{value}\n")
    (group / "memory.stat").write_text(f"anon 12\n{names[version][2]} {droppable}\n")


def test_this_machine_has_some_left_and_no_more_than_it_has():
    assert 0 < available_bytes() <= machine_bytes()


def test_without_limits_it_is_what_the_machine_has_to_give(machine):
    assert available_bytes() == 8 * GIB


def test_a_limit_of_the_group_counts_less_what_is_used_and_cannot_be_dropped(machine):
    (machine / "cgroup").write_text("1:name=systemd:/x\n0::/jobs/mine\n")
    limit(machine / "groups" / "jobs" / "mine", 2, 5 * GIB, 3 * GIB, GIB)
    assert available_bytes() == 3 * GIB


def test_a_limit_of_a_group_around_it_counts_too(machine):
    (machine / "cgroup").write_text("0::/jobs/mine\n")
    limit(machine / "groups" / "jobs" / "mine", 2, "max", GIB, 0)
    limit(machine / "groups" / "jobs", 2, 4 * GIB, 2 * GIB, 0)
    assert available_bytes() == 2 * GIB


def test_inside_a_container_the_group_is_the_mount(machine):
    (machine / "cgroup").write_text("0::/docker/0123\n")
    limit(machine / "groups", 2, GIB, GIB // 2, 0)
    assert available_bytes() == GIB // 2


def test_groups_of_the_first_version_are_known(machine):
    (machine / "cgroup").write_text("9:cpu,cpuacct:/a\n4:memory:/b\n0::/\n")
    limit(machine / "groups" / "memory" / "b", 1, 2 * GIB, GIB, 0)
    assert available_bytes() == GIB


def test_more_used_than_allowed_leaves_nothing(machine):
    (machine / "cgroup").write_text("0::/\n")
    limit(machine / "groups", 2, GIB, 2 * GIB, 0)
    assert available_bytes() == 0


def test_a_system_without_such_files_is_taken_to_have_it_all(machine):
    (machine / "meminfo").unlink()
    assert available_bytes() == machine_bytes()
    (machine / "cgroup").write_text("what is this\n")
    assert available_bytes() == machine_bytes()


def test_what_fits_passes_and_what_does_not_is_refused_with_the_figures(machine):
    require_room(8 * GIB, "7 frames", "use fewer")
    with pytest.raises(
        InputError,
        match=r"motions: 7 frames need about 9.7 GB of memory where 8.6 GB are left, expected less: use fewer",
    ):
        require_room(9 * GIB, "7 frames", "use fewer")
