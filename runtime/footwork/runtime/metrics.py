"""A server's counters in Prometheus' text format."""

from collections.abc import Iterator
from typing import TYPE_CHECKING

from footwork.errors import InputError
from footwork.runtime.server import Server

if TYPE_CHECKING:
    from prometheus_client import Metric

# name -> what it counts; all are in Server.summary()
_COUNTED = {
    "ticks": "ticks made",
    "late_ticks": "ticks whose first poses left more than a frame after their deadline",
    "skipped_frames": "frames given up after a stall",
    "resumed": "sessions resumed after their connection broke",
    "refused": "messages refused",
    "dropped": "poses dropped for clients that read too slowly",
    "cut": "connections cut for being silent, too many or never ending a message",
    "denied": "clients turned away for their key",
    "bytes_in": "bytes of messages from clients",
    "bytes_out": "bytes of messages to clients",
}
# the same of each bundle, under its name; all are in Server.by_bundle()
_COUNTED_OF_BUNDLES = {
    "sessions": "sessions begun",
    "reloads": "bundles put in place of others",
}
_PRESENT_OF_BUNDLES = {
    "open_sessions": "sessions with a connection",
    "characters": "characters in the world",
}


def exposition(server: Server) -> tuple[str, bytes]:
    """Content type and text of all counters, with those of the process (memory, processor time).

    Raises:
        InputError: without the package prometheus-client.
    """
    try:
        from prometheus_client import CONTENT_TYPE_LATEST, CollectorRegistry, generate_latest
        from prometheus_client.process_collector import ProcessCollector
    except ImportError:
        raise InputError("needs the package prometheus-client: pip install 'footwork[metrics]'", "metrics") from None

    registry = CollectorRegistry()
    ProcessCollector(registry=registry)
    registry.register(_Counters(server))
    return CONTENT_TYPE_LATEST, generate_latest(registry)


class _Counters:
    def __init__(self, server: Server) -> None:
        self._server = server

    def collect(self) -> "Iterator[Metric]":
        from prometheus_client.core import CounterMetricFamily, GaugeMetricFamily, HistogramMetricFamily

        counted, present = self._server.summary(), self._server.population()
        yield GaugeMetricFamily(
            "footwork_connections", "connections, with and without a session", value=present["connections"]
        )
        for name, said in _COUNTED.items():
            yield CounterMetricFamily(f"footwork_{name}", said, value=counted[name])
        by_bundle = self._server.by_bundle()
        for kind, names in ((CounterMetricFamily, _COUNTED_OF_BUNDLES), (GaugeMetricFamily, _PRESENT_OF_BUNDLES)):
            for name, said in names.items():
                family = kind(f"footwork_{name}", said, labels=["bundle"])
                for bundle, figures in by_bundle.items():
                    family.add_metric([bundle], figures[name])
                yield family
        seconds = self._server.tick_seconds
        buckets = [("+Inf" if bound == float("inf") else str(bound), count) for bound, count in seconds.up_to()]
        yield HistogramMetricFamily(
            "footwork_tick_seconds", "time that a tick and its poses took", buckets=buckets, sum_value=seconds.total
        )
