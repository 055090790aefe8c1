"""`ion view`: a recorded drive as a web page, moment by moment."""

import socket
from contextlib import redirect_stdout
from io import StringIO

import viser

from ion.errors import UsageError
from ion.recorded import recorded
from ion.view.options import LOCAL, Options
from ion.view.page import Page
from ion.view.timeline import Timeline
from nav.parameters import parameters_from

FIRST_PORT, TRIED = 8080, 100


def view(options: Options) -> int:
    """Serve the page until Ctrl-C; returns the exit code.

    Raises:
        UsageError: the port is taken, or there is no such address.
        TapeError: no tape, or one that `ion drive` did not write.
    """
    found = recorded(options.log)
    timeline = Timeline(options.log)
    port = free_port(options.host, options.port)
    course = found.course()
    with redirect_stdout(StringIO()):  # it says more than one wants to know
        server = viser.ViserServer(options.host, port, verbose=False)
    parameters = parameters_from(found.files, course.vehicle)
    page = Page(server, found, course, parameters, timeline, options.parameters)
    timeline.start()
    _tell(options.host, server.get_port())
    try:
        page.run()
    except KeyboardInterrupt:
        print()
    finally:
        with redirect_stdout(StringIO()):
            server.stop()
    return 0


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


def _tell(host: str, port: int) -> None:
    if host != LOCAL:
        print(f"open to the network: whoever reaches {host}:{port} sees this drive")
    print(f"http://{host}:{port}  (Ctrl-C ends it)", flush=True)
