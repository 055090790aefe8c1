"""`ion view`: a recorded drive as a web page, moment by moment."""

from ion.errors import UsageError
from ion.recorded import recorded
from ion.view.options import Options
from ion.view.page import Page
from ion.view.server import announce, opened
from ion.view.show import Show
from ion.view.timeline import Timeline


def view(options: Options) -> int:
    """Serve the page until Ctrl-C; returns the exit code.

    Raises:
        UsageError: the port is taken, or there is no such address.
        TapeError: no tape, or one that `ion drive` did not write.
    """
    if options.export:
        from ion.view.export.command import export

        return export(options, options.export)
    if options.first is not None or options.last is not None:
        raise UsageError("--from and --to: expected --export FILE with them")
    show = Show(recorded(options.log), Timeline(options.log))
    with opened(options.host, options.port) as server:
        page = Page(server, show, options.parameters)
        show.timeline.start()
        announce(server)
        try:
            page.run()
        except KeyboardInterrupt:
            print()
    return 0
