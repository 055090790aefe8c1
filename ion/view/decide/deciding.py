"""The part of the page that says why, and what would be: asked of other processes."""

from pathlib import Path

import viser

from ion.view.canvas import Canvas
from ion.view.decide.plot import DecisionPlot
from ion.view.decide.words import told
from ion.view.decide.worker import Question, Reply, Worker
from ion.view.show import Show
from ion.view.timeline import Moment
from ion.view.tune import went_on
from ion.view.tune.folder import TuneFolder
from ion.view.tune.rest import RestOfRun
from ion.view.tune.tuning import Tuning


class Deciding:
    """Built into what is open when it is made.

    Args:
        server: of the page.
        show: what is shown.
        folder: where tuned parameter files go.
    """

    def __init__(self, server: viser.ViserServer, show: Show, folder: Path) -> None:
        gui, recorded = server.gui, show.recorded
        self._show = show
        self._canvas = Canvas(server.scene, (went_on.TRACK,))
        self._worker, self._rest = Worker(recorded.log), RestOfRun(recorded.log)
        self._tuning = Tuning(recorded.files, recorded.said["vehicle"])
        self._words = gui.add_markdown("")
        self._plot = DecisionPlot(gui)
        self._folder = TuneFolder(
            gui, self._tuning, self._rest, folder, show.wake, lambda: show.player.time_s
        )
        self._started, self._drawn = False, Reply(None, None, "", -1.0)

    def refresh(self, moment: Moment) -> None:
        """Ask about a moment, and show what has come meanwhile."""
        if not self._started and self._show.timeline.complete:
            self._worker.start()
            self._started = True
        self._worker.look()
        if moment.decision:
            at_s = moment.decision.time_ns * 1e-9
            self._worker.ask(Question(at_s, self._tuning.changed()))
        self._answer(moment)
        if self._rest.look():
            went_on.draw(self._canvas, self._rest.told)
            outcome = str(self._show.recorded.figures.get("outcome", ""))
            self._folder.tell(went_on.words(self._rest, self._show.timeline, outcome))

    def _answer(self, moment: Moment) -> None:
        reply = self._worker.reply
        if reply and reply is not self._drawn:
            self._drawn = reply
            if reply.found:
                self._plot.show(reply.found)
            self._words.content = told(reply.found) if reply.found else reply.trouble
        elif self._waits(reply):
            reached_s, end_s = self._worker.reached_s, self._show.timeline.end_s
            far = f"replaying, {reached_s:.0f} of {end_s:.0f} s"
            doing = far if moment.time_s > reached_s else "working"
            self._words.content = f"**{moment.time_s:.1f} s:** {doing} ..."

    def _waits(self, reply: Reply | None) -> bool:
        """Whether people wait for an answer; while it plays, the last one will do."""
        if not self._started or (reply and reply.trouble and not reply.question):
            return False
        return not self._worker.answered and not self._show.player.playing
