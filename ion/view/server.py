"""The server of a page: where it listens, and what it says of that."""

import logging
import socket
from collections.abc import Iterator
from contextlib import contextmanager, redirect_stdout
from io import StringIO

import viser

from ion.errors import UsageError
from ion.view.options import LOCAL

FIRST_PORT, TRIED = 8080, 100


@contextmanager
def opened(host: str, port: int | None) -> Iterator[viser.ViserServer]:
    """A server, as long as it is needed.

    Raises:
        UsageError: the port is taken or no port, or there is no such address.
    """
    free = free_port(host, port)
    # a browser that opens a connection and asks nothing is no error of which one wants a traceback
    logging.getLogger("websockets").setLevel(logging.CRITICAL)
    with redirect_stdout(StringIO()):  # it says more than one wants to know
        server = viser.ViserServer(host, free, verbose=False)
    try:
        yield server
    finally:
        with redirect_stdout(StringIO()):
            server.stop()


def free_port(host: str, asked: int | None) -> int:
    """The port asked for, or the first free one from 8080 on.

    Raises:
        UsageError: it is taken or no port, or there is no such address.
    """
    ports = range(FIRST_PORT, FIRST_PORT + TRIED) if asked is None else (asked,)
    said = ""
    for port in ports:
        try:
            with socket.create_server((host, port)):
                return port
        except (OSError, OverflowError) as error:
            said = getattr(error, "strerror", None) or str(error)
    raise UsageError(f"--host {host} --port {ports[0]}: cannot be opened: {said}")


def announce(server: viser.ViserServer) -> None:
    """Say where the page is, and who can see it."""
    host, port = server.get_host(), server.get_port()
    if host != LOCAL:
        print(f"open to the network: whoever reaches {host}:{port} sees this drive")
    print(f"http://{host}:{port}  (Ctrl-C ends it)", flush=True)
