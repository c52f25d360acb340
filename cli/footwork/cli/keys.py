"""``footwork keys``: the CURVE keys of servers and clients."""

from pathlib import Path
from typing import Annotated

from cyclopts import App, Parameter

from footwork.cli.output import emit

Json = Annotated[bool, Parameter(negative=())]

keys = App(name="keys", help="Make, allow and list the CURVE keys of a server and its clients.")


@keys.command
def server(folder: Path, /, *, json: Json = False) -> None:
    """Make a server's pair of keys, in a folder that also says which clients are let in: nobody yet.

    Example: footwork keys server keys

    Args:
        folder: The folder to make, for `footwork serve --curve`. Clients need its server.key.
        json: Print one JSON object.
    """
    from footwork.runtime.key_folder import KeyFolder

    made = KeyFolder.create(folder)
    emit({"for_clients": str(made.public_file), "public_key": made.pair.public.decode()}, json, str(folder))


@keys.command
def client(name: str, /, *, out: Path = Path(), json: Json = False) -> None:
    """Make a client's pair of keys: NAME.key_secret for the client alone, NAME.key for the server to allow.

    Example: footwork keys client alice --out players

    Args:
        name: Whose keys they are.
        out: The folder to write to.
        json: Print one JSON object.
    """
    from footwork.protocol.curve import KeyPair

    pair = KeyPair.new()
    public, secret = pair.write(out, name)
    report = {"for_the_server": str(public), "secret": str(secret), "public_key": pair.public.decode()}
    emit(report, json, name)


@keys.command
def allow(folder: Path, public: str, /, *, name: str | None = None, json: Json = False) -> None:
    """Let a client in, from its next connection on.

    Example: footwork keys allow keys players/alice.key

    Args:
        folder: The server's folder of keys.
        public: The client's NAME.key file, or its public key itself.
        name: What to call it, for a public key given itself or to rename one.
        json: Print one JSON object.
    """
    from footwork.errors import InputError
    from footwork.protocol.curve import is_key, read_public
    from footwork.runtime.key_folder import KeyFolder

    key = public.encode() if is_key(public) else read_public(public)
    if name is None and is_key(public):
        raise InputError("a key has no name by itself, give it one", "--name")
    path = KeyFolder(folder).allow(Path(public).stem if name is None else name, key)
    emit({"allowed": path.stem, "public_key": key.decode()}, json, str(folder))


@keys.command
def revoke(folder: Path, name: str, /, *, json: Json = False) -> None:
    """Let a client in no more; a session that it has goes on until it ends.

    Example: footwork keys revoke keys alice

    Args:
        folder: The server's folder of keys.
        name: What the list calls it.
        json: Print one JSON object.
    """
    from footwork.runtime.key_folder import KeyFolder

    KeyFolder(folder).revoke(name)
    emit({"revoked": name}, json, str(folder))


@keys.command(name="list")
def list_keys(folder: Path, /, *, json: Json = False) -> None:
    """Say which clients a server lets in.

    Example: footwork keys list keys

    Args:
        folder: The server's folder of keys.
        json: Print one JSON object.
    """
    from footwork.runtime.key_folder import KeyFolder

    listed = KeyFolder(folder)
    clients = [{"name": name, "public_key": key.decode()} for key, name in listed.allowed().items()]
    emit({"server": listed.pair.public.decode(), "clients": clients}, json, str(folder))
