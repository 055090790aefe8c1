"""What a replay costs: `python tests/bench_replay.py LOG [passes]` prints ms a simulated second.

Reading is that of the tape alone, the navigator what comes on top of it, comparing what comes on
top of both. Of all passes the least counts, in the process's own time: a busy machine adds time
and never takes any.
"""

import sys
import time
from collections.abc import Callable, Iterable
from pathlib import Path

from scenarios.processor import fix_processor


def main() -> None:
    """Print the table."""
    fix_processor()
    from scenarios.replay import navigator_of, replay
    from tape.reader import read, span_ns

    log, passes = Path(sys.argv[1]), int(sys.argv[2]) if len(sys.argv) > 2 else 3
    start_ns, end_ns = span_ns(log)
    driven_s = (end_ns - start_ns) * 1e-9
    reading = _least_s(lambda: _through(read(log)), passes)
    running = _least_s(lambda: _through(replay(log, navigator_of(log))), passes)
    whole = _least_s(lambda: _compared(log), passes)
    parts = {"reading": reading, "navigator": running - reading, "comparing": whole - running}
    for name, spent_s in (*parts.items(), ("total", whole)):
        print(f"{name:12s}{spent_s / driven_s * 1e3:8.2f} ms")
    print(f"{driven_s / whole:.0f} times real time; {driven_s:.0f} s in {whole:.1f} s")


def _through(items: Iterable[object]) -> None:
    """To the end; nothing is kept."""
    for _ in items:
        pass


def _compared(log: Path) -> None:
    from ion.replay.comparison import compare
    from scenarios.replay import navigator_of, replay, tolerance

    compare(replay(log, navigator_of(log)), tolerance(log), lambda tick: None)


def _least_s(work: Callable[[], object], passes: int) -> float:
    times: list[float] = []
    for _ in range(passes):
        start_s = time.process_time()
        work()
        times.append(time.process_time() - start_s)
    return min(times)


if __name__ == "__main__":
    main()
