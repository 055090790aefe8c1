"""What a tape's evidence comes to: the things that stood there, and the faults that there were."""

from typing import NamedTuple

import numpy as np

from ion.reconstruct.evidence import Evidence
from ion.reconstruct.failures import failures
from ion.reconstruct.obstacles import things
from ion.reconstruct.stream import Stream
from nav.messages import Floats
from scenarios.planned import Thing
from twin.faults import Fault

UNHEARD = Stream(np.zeros(0), np.zeros(0), np.zeros(0, bool))


class Rebuilt(NamedTuple):
    """What the scenario says, and what it says it of."""

    things: list[Thing]
    faults: list[Fault]
    evidence: Evidence


def rebuilt(evidence: Evidence) -> Rebuilt:
    """Things along the way, and faults of each device, in the order in which they began."""
    found = things(evidence.tally, evidence.held, evidence.way_m, evidence.cell_m)
    return Rebuilt(found, _faults(evidence), evidence)


def place_m(evidence: Evidence, time_s: float) -> Floats:
    """Where the vehicle was at a time, shape (2,); before the first estimate, at that."""
    return np.array([np.interp(time_s, evidence.time_s, axis) for axis in evidence.way_m.T])


def _faults(evidence: Evidence) -> list[Fault]:
    """Of what is fitted, and of what was heard although it need not be there (a road camera)."""
    found: list[Fault] = []
    for name in dict.fromkeys((*evidence.fitted, *evidence.streams)):
        heard = evidence.streams.get(name, UNHEARD)
        found += failures(name, heard, evidence.resets_s.get(name, ()), evidence.end_s)
    return sorted(found, key=lambda fault: fault.begins)
