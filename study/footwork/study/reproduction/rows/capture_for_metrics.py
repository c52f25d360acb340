"""How much motion there is for comparing metrics, and what taking it at 30 Hz does."""

from footwork.motion.tick import TICK_RATE
from footwork.study.reproduction import matsunaga_zordan
from footwork.study.reproduction.compared_metrics import MAIN, RESAMPLED, MetricSet, clips_of, none_there, sets_of
from footwork.study.reproduction.row import OURS, PUBLISHED, Cause, Cell, Column, Result, Row, Table, judged
from footwork.study.reproduction.words import joined_words
from footwork.study.reproduction.workbench import Workbench

LIKE = 0.1  # lengths within this share of each other count as the same
CLAIM = "Our sets for comparing metrics last as long as the published ones."


def run(bench: Workbench) -> Result:
    """Count frames, seconds and angles."""
    sets = sets_of(bench)
    if not sets:
        return none_there(CLAIM)
    counted = {one: _counted(bench, one) for one in sets}
    theirs = matsunaga_zordan.SIZES
    off = {one: counted[one]["seconds"] / theirs[one.like]["seconds"] - 1.0 for one in sets if one in MAIN}
    columns = [Column("set"), Column("frames", "", PUBLISHED), Column("length", "s", PUBLISHED, 0)]
    columns += [Column("clips", "", OURS), Column("frames", "", OURS), Column("length", "s", OURS, 1)]
    columns += [Column("taken from", "Hz", OURS)]
    lines: list[list[Cell]] = [
        [one.name, *_published(one), *(counted[one][key] for key in ("clips", "frames", "seconds", "rates"))]
        for one in sets
    ]
    return Result(
        judgements=[
            judged(
                CLAIM,
                all(abs(share) <= LIKE for share in off.values()),
                joined_words([f"{one.name} {100 * share:+.1f} %" for one, share in off.items()]) + " in length.",
                Cause.DATA,
            )
        ],
        tables=[Table("Frames: the paper's at the rate of the capture, ours at 30 Hz", columns, lines)],
        numbers={one.name: counted[one] for one in sets},
        notes=[
            RESAMPLED + " The published frames are 120 a second: 4,145 in 34 s, 3,720 in 31 s.",
            f"The paper's body has {theirs['degrees_of_freedom']} degrees of freedom; ours has 21 joints that "
            "turn freely.",
            "The captures of the paper, fights and people who are hit and fall, are not public. Ours are one person's "
            "karate, and voluntary dives, rolls and abrupt stops of two people from two sources.",
            "M-F4 and M-T1 compare the single sequence at full rate too: every captured frame with every other.",
        ],
    )


def _published(one: MetricSet) -> list[Cell]:
    return [matsunaga_zordan.SIZES[one.like][key] for key in ("frames", "seconds")]


def _counted(bench: Workbench, one: MetricSet) -> dict[str, Cell]:
    clips = clips_of(bench, one)
    frames = sum(clip.frame_count for clip in clips)
    files = bench.dataset(one.folder, whole=one.whole).files
    rates = sorted({float(file["source_fps"]) for file in files if file["file"].endswith(one.ending)})
    return {
        "clips": len(clips),
        "frames": frames,
        "seconds": frames / TICK_RATE,
        "rates": joined_words([f"{rate:g}" for rate in rates]),
    }


ROW = Row(
    name="M-D",
    order=10,
    paper=matsunaga_zordan.PAPER,
    place="text",
    title="The sets of motion for comparing metrics",
    claim="Fighting of 4,145 frames (34 s) and reactions of 3,720 frames (31 s) of a body of 45 degrees of freedom.",
    published=matsunaga_zordan.SIZES,
    run=run,
)
