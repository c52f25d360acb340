"""How much motion there is in each set."""

from footwork.study.reproduction import zhao_safonova
from footwork.study.reproduction.motion_sets import SETS
from footwork.study.reproduction.row import OURS, PUBLISHED, Cause, Column, Result, Row, Table, judged
from footwork.study.reproduction.words import joined_words, numbered
from footwork.study.reproduction.workbench import Workbench

LIKE = 0.02  # sizes within this share of each other count as the same


def run(bench: Workbench) -> Result:
    """Count frames, clips and labels."""
    lines, numbers = [], {}
    for name in SETS:
        clips = bench.dataset(name).clips
        frames = sum(clip.frame_count for clip in clips)
        labels = sorted({str(label) for clip in clips for label in clip.labels})
        numbers[name] = {"frames": frames, "clips": len(clips), "labels": labels}
        lines.append([name, zhao_safonova.SIZES[name], frames, frames / 30.0, len(clips), joined_words(labels)])
    off = {name: abs(numbers[name]["frames"] / zhao_safonova.SIZES[name] - 1.0) for name in SETS}
    columns = [
        Column("set"),
        Column("frames", group=PUBLISHED),
        Column("frames", group=OURS),
        Column("length", "s", OURS, 1),
        Column("clips", group=OURS),
        Column("labels", group=OURS),
    ]
    worst = max(off, key=lambda name: off[name])
    return Result(
        judgements=[
            judged(
                "Our sets are of the published sizes, so that sizes and times can be compared.",
                off[worst] <= LIKE,
                f"{joined_words([numbered(numbers[name]['frames'], 'frame') for name in SETS])} at 30 Hz; "
                f"at most {100 * off[worst]:.1f} % off the published ones ({worst}).",
                Cause.DATA,
            )
        ],
        tables=[Table("Frames at 30 Hz", columns, lines)],
        numbers=numbers,
        notes=[
            "The captures of the paper are not public. Ours are of the same kinds: one walker of short to long steps, "
            "several walkers, and one person who stands, walks, turns, runs, jumps, ducks and picks up."
        ],
    )


ROW = Row(
    name="Z-T1",
    order=10,
    paper=zhao_safonova.PAPER,
    place="Table 1",
    title="The sets of motion",
    claim="Three sets of 194, 264 and 2,721 frames at 30 Hz: one walker with steps of many lengths, walkers, and one "
    "person with many behaviours.",
    published=zhao_safonova.SIZES,
    run=run,
)
