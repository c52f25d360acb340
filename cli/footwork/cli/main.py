"""The ``footwork`` command: one file a subcommand, errors as one line, an exit status that means something."""

import sys
from collections.abc import Sequence
from importlib.metadata import version

from cyclopts import App
from cyclopts.exceptions import CycloptsError

from footwork.cli.build import build
from footwork.cli.data import data
from footwork.cli.demo import demo
from footwork.cli.export import export
from footwork.cli.fight import fight
from footwork.cli.inspect import inspect
from footwork.cli.keys import keys
from footwork.cli.play import play
from footwork.cli.replay import replay
from footwork.cli.reproduce import reproduce
from footwork.cli.score import score
from footwork.cli.serve import serve
from footwork.errors import FootworkError

BAD_INPUT = 2
INTERRUPTED = 130

# interrupts are told by main, below
app = App(
    name="footwork",
    version=version("footwork"),
    help="Motion capture to a character that responds.",
    suppress_keyboard_interrupt=False,
)
app.command(demo)
app.command(build)
app.command(inspect)
app.command(serve)
app.command(play)
app.command(fight)
app.command(keys)
app.command(replay)
app.command(export)
app.command(data)
app.command(score)
app.command(reproduce)


def main(arguments: Sequence[str] | None = None) -> int:
    """Run one subcommand and return its exit status: 0 done, 1 done in part, 2 bad input, 130 interrupted."""
    try:
        status = app(arguments, exit_on_error=False, print_error=False, result_action="return_value")
    except (FootworkError, CycloptsError) as error:
        return _complain(str(error))
    except OSError as error:
        return _complain(f"{error.filename or 'file'}: {error.strerror or error}")
    except KeyboardInterrupt:
        print("footwork: interrupted", file=sys.stderr)
        return INTERRUPTED
    return status or 0


def _complain(message: str) -> int:
    print("footwork:", " ".join(message.split()), file=sys.stderr)
    return BAD_INPUT


if __name__ == "__main__":
    sys.exit(main())
