"""The bridge without a browser: what a page says wrongly is answered, and what is not ours does not come in."""

import asyncio
from collections.abc import AsyncIterator, Awaitable, Callable
from contextlib import asynccontextmanager
from typing import Any

import msgspec
import pytest
from websockets.asyncio.client import ClientConnection, connect
from websockets.exceptions import ConnectionClosed, InvalidStatus

from footwork.errors import InputError
from footwork.protocol import messages as m
from footwork.protocol.codec import encode
from footwork.protocol.curve import CurveKeys, KeyPair, read_public
from footwork.runtime.key_folder import KeyFolder
from footwork.runtime.server import Server
from footwork.viewer.bridge import Bridge, Shown
from footwork.viewer.page_files import PageFile
from served import BUNDLE, serving

FILES = {"/": PageFile("text/html", b"<p>the page</p>")}
SECONDS = 20.0


def against_a_server(test: Callable[[Bridge], Awaitable[None]], **options) -> None:
    async def run(address: str) -> None:
        async with Bridge([Shown("toy", address)], FILES, **options) as bridge:
            await asyncio.wait_for(test(bridge), 2 * SECONDS)

    with serving() as server:
        asyncio.run(run(server.address))


@asynccontextmanager
async def page_of(bridge: Bridge, **headers: str) -> AsyncIterator[ClientConnection]:
    origin: Any = headers.pop("Origin", bridge.address.rstrip("/"))
    address = bridge.address.replace("http", "ws") + "socket/0"
    async with connect(address, origin=origin, additional_headers=headers, max_queue=None) as page:
        yield page


async def heard(page: ClientConnection, kind: str) -> dict[str, Any]:
    """The next message of that type."""
    while True:
        message = msgspec.msgpack.decode(await asyncio.wait_for(page.recv(decode=False), SECONDS))
        if message["type"] == kind:
            return message


async def begin(page: ClientConnection) -> None:
    await heard(page, "welcome")
    await page.send(encode(m.Spawn(sequence=1, character=0)))
    await heard(page, "pose")


async def flood(page: ClientConnection) -> None:
    while True:
        await page.send(encode(m.Ping()))
        await asyncio.sleep(0)


def test_a_page_is_a_client_like_any_other():
    async def test(bridge: Bridge) -> None:
        async with page_of(bridge) as page:
            welcome = await heard(page, "welcome")
            assert welcome["behaviours"] == ["stop", "walk", "jump"]
            assert welcome["token"] == b""
            await page.send(encode(m.Spawn(sequence=1, character=0)))
            assert (await heard(page, "event"))["kind"] == "spawned"
            await page.send(encode(m.Command(sequence=2, character=0, keys=m.Keys(view_yaw=0.0, forward=1))))
            while (await heard(page, "pose"))["acknowledged"] < 2:
                pass

    against_a_server(test)


WRONG = [
    ("text", "malformed"),
    (b"", "malformed"),
    (b"\x00\xff garbage", "malformed"),
    (encode(m.Spawn(sequence=1, character=0)) + b"x" * 2000, "too_large"),
    (msgspec.msgpack.encode({"type": "command", "sequence": 1, "character": 0, "heading": float("nan")}), "malformed"),
    (encode(m.Hello(version=1)), "state"),
    (encode(m.Bye()), "state"),
    (encode(m.Spawn(sequence=1, character=1)), "characters"),
]


def test_what_a_page_says_wrongly_is_answered_and_it_goes_on():
    async def test(bridge: Bridge) -> None:
        async with page_of(bridge) as page:
            await heard(page, "welcome")
            for wrong, code in WRONG:
                await page.send(wrong)
                assert (await heard(page, "error"))["code"] == code
                await asyncio.sleep(0.15)  # so many errors at once are answered, the others are dropped
            await page.send(encode(m.Spawn(sequence=1, character=0)))
            await heard(page, "pose")

    against_a_server(test)


def test_a_page_that_says_too_much_is_cut_and_others_play_on():
    async def test(bridge: Bridge) -> None:
        async with page_of(bridge) as calm, page_of(bridge) as loud:
            await begin(calm)
            with pytest.raises(ConnectionClosed):
                await flood(loud)
            assert loud.close_code == 1008
            await heard(calm, "pose")

    against_a_server(test)


def test_a_frame_far_too_long_ends_that_page_alone():
    async def test(bridge: Bridge) -> None:
        async with page_of(bridge) as page:
            await page.send(bytes(100_000))
            with pytest.raises(ConnectionClosed):
                await heard(page, "nothing")
        async with page_of(bridge) as page:
            await heard(page, "welcome")

    against_a_server(test)


@pytest.mark.parametrize(
    "headers",
    [
        {"Origin": "http://evil.example"},
        {"Origin": "http://localhost:1"},
        {"Origin": "null"},
        {"Origin": None},
        {"Host": "evil.example"},  # beside the true one
    ],
)
def test_a_page_from_elsewhere_is_refused(headers):
    async def test(bridge: Bridge) -> None:
        with pytest.raises(InvalidStatus) as refused:
            async with page_of(bridge, **headers):
                pass
        assert refused.value.response.status_code == 403

    against_a_server(test)


def test_names_that_it_was_told_of_may_play():
    async def test(bridge: Bridge) -> None:
        async with page_of(bridge, Origin="https://game.local") as page:
            await heard(page, "welcome")

    against_a_server(test, hosts=["game.local"])


async def fetched(bridge: Bridge, path: str, host: str = "localhost") -> str:
    port = int(bridge.address.rstrip("/").rpartition(":")[2])
    reader, writer = await asyncio.open_connection("127.0.0.1", port)
    writer.write(f"GET {path} HTTP/1.1\r\nHost: {host}:{port}\r\n\r\n".encode())
    answer = await asyncio.wait_for(reader.read(), SECONDS)
    writer.close()
    return answer.decode()


def test_the_page_is_served_and_nothing_else():
    async def test(bridge: Bridge) -> None:
        page = await fetched(bridge, "/?seen")
        assert page.startswith("HTTP/1.1 200")
        assert page.endswith("<p>the page</p>")
        assert "default-src 'self'" in page
        assert (await fetched(bridge, "/about.json")).endswith('{"titles": ["toy"], "film": null}')
        assert (await fetched(bridge, "/../pyproject.toml")).startswith("HTTP/1.1 404")
        assert (await fetched(bridge, "/socket/1")).startswith("HTTP/1.1 404")
        for host in ("evil.example", "127.0.0.1.evil.example", ""):
            assert (await fetched(bridge, "/", host=host)).startswith("HTTP/1.1 403")

    against_a_server(test)


def test_each_page_has_its_own_character_until_there_are_no_more():
    async def test(bridge: Bridge) -> None:
        async with page_of(bridge) as first:
            async with page_of(bridge) as second:
                for page in (first, second):
                    await begin(page)
                async with page_of(bridge) as third:
                    notice = await heard(third, "bridge")
                    assert notice["state"] == "refused"
                    assert "2 characters" in notice["message"]
            await asyncio.sleep(0.05)
            async with page_of(bridge) as again:
                await heard(again, "welcome")

    against_a_server(test, characters=2)


def test_a_server_that_was_lost_is_found_again():
    async def test(bridge: Bridge, stop: Callable[[], None]) -> None:
        async with page_of(bridge) as page:
            await begin(page)
            stop()
            assert (await heard(page, "bridge"))["state"] == "lost"
            await page.send(encode(m.Ping()))
            assert (await heard(page, "error"))["code"] == "no_session"
            assert await asyncio.to_thread(server.wait, SECONDS)  # until it has let go of its port
            restarted = Server(BUNDLE, bind=server.address)
            running = asyncio.get_running_loop().run_in_executor(None, restarted.run)
            try:
                assert (await heard(page, "welcome"))["resumed"] is False
                await page.send(encode(m.Spawn(sequence=9, character=0)))
                assert (await heard(page, "pose"))["acknowledged"] == 9
            finally:
                restarted.stop()
                await running

    async def run() -> None:
        async with Bridge([Shown("toy", server.address)], FILES) as bridge:
            await asyncio.wait_for(test(bridge, server.stop), 3 * SECONDS)

    with serving() as server:
        asyncio.run(run())


def test_it_speaks_to_a_server_that_asks_for_keys(tmp_path):
    folder, pair = KeyFolder.create(tmp_path / "keys"), KeyPair.new()
    folder.allow("bridge", pair.public)

    async def test(address: str) -> None:
        keys = CurveKeys(pair, read_public(folder.public_file))
        async with Bridge([Shown("toy", address)], FILES, curve=keys) as bridge, page_of(bridge) as page:
            await begin(page)

    with serving(keys=folder) as server:
        asyncio.run(test(server.address))


@pytest.mark.parametrize("listen", ["127.0.0.1", "127.0.0.1:x", ":80", "127.0.0.1:99999"])
def test_where_nothing_can_listen_is_said(listen):
    with pytest.raises(InputError, match=r"127\.0\.0\.1:0"):
        Bridge([], FILES, listen=listen)


def test_a_port_in_use_is_said():
    async def test(bridge: Bridge) -> None:
        taken = bridge.address.removeprefix("http://").rstrip("/")
        with pytest.raises(InputError, match=taken):
            async with Bridge([], FILES, listen=taken):
                pass

    against_a_server(test)
