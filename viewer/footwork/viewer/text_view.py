"""A character played in a terminal: what it does, where it is, a map seen from above; keys steer it."""

import math
import time
from collections import deque

from rich.console import Console, Group, RenderableType
from rich.live import Live
from rich.panel import Panel
from rich.progress_bar import ProgressBar
from rich.table import Table
from rich.text import Text

from footwork.protocol import messages as m
from footwork.protocol.client import Client
from footwork.protocol.curve import CurveKeys
from footwork.protocol.errors import RefusedError
from footwork.protocol.pose_arrays import root_of
from footwork.viewer.terminal_keys import TerminalKeys
from footwork.viewer.text_map import text_map
from footwork.viewer.text_steering import FIGHT_HELP, HELP, TextSteering

_CHARACTER = 0
_SHOWN_A_SECOND = 15
_FASTEST = 5.0  # metres a second that fill the bar
_TRAIL = 600
_ABOVE = "from above, + is every 5 m"
_COMMAND_SECONDS = 0.25
_SILENCE_SECONDS = 2.0


class TextView:
    """Plays one character until q or Ctrl-C.

    Args:
        address: of the server.
        curve: keys for a server that lets in only those it knows.
        console: where it is shown, the terminal where not given.
    """

    def __init__(self, address: str, curve: CurveKeys | None = None, console: Console | None = None) -> None:
        self._address, self._curve = address, curve
        self._console = console or Console()
        self._steering = TextSteering()
        self._trail: deque[tuple[float, float]] = deque(maxlen=_TRAIL)
        self._pose: m.Pose | None = None
        self._rival: m.Pose | None = None
        self._speed, self._latency = 0.0, math.nan
        self._sent: dict[int, float] = {}
        self._notice, self._tick = "", -1

    def play(self, seconds: float | None = None) -> None:
        """For so long, or until the player ends it.

        Raises:
            RefusedError: where no server answers at the start.
        """
        end = math.inf if seconds is None else time.monotonic() + seconds
        with TerminalKeys() as keys, Live(console=self._console, auto_refresh=False, screen=keys.is_terminal) as live:
            while not self._steering.ended and time.monotonic() < end:
                try:
                    self._play_session(keys, live, end)
                except RefusedError as lost:
                    if self._pose is None:
                        raise
                    self._notice = f"lost the server ({lost}); trying again"
                    live.update(Text(self._notice, style="bold yellow"), refresh=True)

    def _play_session(self, keys: TerminalKeys, live: Live, end: float) -> None:
        """Until the player ends it or the server is lost; the character begins where the last one stood."""
        with Client(self._address, name="text view", timeout=_SILENCE_SECONDS, curve=self._curve) as client:
            x, z = self._trail[-1] if self._trail else (0.0, 0.0)
            client.spawn(_CHARACTER, x=x, z=z)
            self._notice, self._tick = "", -1
            self._follow(client, keys, live, end)

    def _follow(self, client: Client, keys: TerminalKeys, live: Live, end: float) -> None:
        shown_at, commanded_at, heard_at = 0.0, 0.0, time.monotonic()
        while not self._steering.ended and (now := time.monotonic()) < end:
            if self._steering.take(keys.pressed(), client.welcome) or now - commanded_at > _COMMAND_SECONDS:
                self._command(client)
                commanded_at = now
            if self._hear(client, 1.0 / 60.0):
                heard_at = now
            if now - heard_at > _SILENCE_SECONDS:
                raise RefusedError("timeout", "it is silent")
            if now - shown_at > 1.0 / _SHOWN_A_SECOND:
                live.update(self._shown(client.welcome), refresh=True)
                shown_at = now

    def _command(self, client: Client) -> None:
        wanted = self._steering.wanted(self._bearing())
        if isinstance(wanted, m.Keys):
            sequence = client.keys(_CHARACTER, wanted)
        else:
            sequence = client.command(_CHARACTER, *wanted)
        self._sent[sequence] = time.monotonic()

    def _bearing(self) -> float:
        """The yaw at which the opponent is, 0 without one."""
        if self._pose is None or self._rival is None:
            return 0.0
        (x, _, z), (there_x, _, there_z) = root_of(self._pose), root_of(self._rival)
        return math.atan2(float(there_x - x), float(there_z - z))

    def _hear(self, client: Client, timeout: float) -> bool:
        """Take what has come; whether anything has."""
        message = client.receive(timeout)
        if message is None:
            return False
        while message is not None:
            if isinstance(message, m.Pose):
                self._take(message)
            elif isinstance(message, m.Error):
                self._notice = message.message
            elif isinstance(message, m.Bye):
                raise RefusedError(message.reason, "the server ended the session")
            message = client.receive(0.0)
        return True

    def _take(self, pose: m.Pose) -> None:
        if pose.character != _CHARACTER:
            self._rival = pose
            return
        x, _, z = (float(value) for value in root_of(pose))
        if pose.tick > self._tick:
            if self._tick >= 0:
                way = math.hypot(x - self._trail[-1][0], z - self._trail[-1][1])
                self._speed += 0.3 * (way * m.TICK_RATE / (pose.tick - self._tick) - self._speed)
            self._trail.append((x, z))
            self._pose, self._tick = pose, pose.tick
        for sequence in [one for one in self._sent if one <= pose.acknowledged]:
            self._latency = 1000.0 * (time.monotonic() - self._sent.pop(sequence))

    def _shown(self, welcome: m.Welcome) -> RenderableType:
        if self._pose is None:
            return Text("waiting for the first pose")
        width = max(20, min(self._console.width - 4, 76))
        height = max(5, self._console.height - 14)
        rivals = [] if self._rival is None else [(float(x), float(z)) for x, _, z in [root_of(self._rival)]]
        above = Panel(Text(text_map(self._trail, self._pose.facing, width, height, rivals)), title=_ABOVE)
        parts = [self._told(welcome, self._pose), above, Text(FIGHT_HELP if welcome.opponent else HELP)]
        if self._notice:
            parts.append(Text(self._notice, style="bold yellow"))
        return Group(*parts)

    def _told(self, welcome: m.Welcome, pose: m.Pose) -> Table:
        table = Table.grid(padding=(0, 2))
        x, z = self._trail[-1]
        name = welcome.behaviours[pose.behaviour] if pose.behaviour >= 0 else "other"
        mark = "  transition" if pose.transition else ""
        table.add_row("behaviour", Text(name + mark, style="bold"))
        clip = welcome.clips[pose.clip] if 0 <= pose.clip < len(welcome.clips) else "none"
        table.add_row("clip, frame", f"{clip}, {pose.source_frame}")
        table.add_row("position", f"{x:.2f}, {z:.2f} m")
        table.add_row("heading", f"{math.degrees(pose.facing) % 360.0:.0f} of 360 degrees")
        table.add_row(f"speed {self._speed:.1f} m/s", ProgressBar(total=_FASTEST, completed=self._speed, width=30))
        for who, fighter in (("you", pose), (f"{welcome.opponent} opponent", self._rival)):
            if fighter is not None and isinstance(fighter.health, float):
                bar = ProgressBar(total=1.0, completed=max(0.0, fighter.health), width=30)
                table.add_row(f"{who} {100.0 * fighter.health:.0f} % health", bar)
        late = 0.0 if math.isnan(self._latency) else self._latency
        table.add_row(f"key to pose {late:.0f} ms", ProgressBar(total=100.0, completed=late, width=30))
        return table
