"""Dead reckoning through the GPS gaps of a real log: `python tests/bench_dead_reckoning.py [LOG]`.

Victoria Park: speed of a wheel and steering at 40 Hz, GPS at 5 Hz with 41 gaps longer than 5 s, no
IMU and no compass. Both reckonings start from the same state, fitted to the minute before a gap:
one goes on with raw speed and steering, the other with the scale of the speed, gain and zero of the
steering that this minute and those before have taught (an average that forgets over ten minutes).
The error is the distance to the first fix after the gap. The last line says what constants that
nobody could know before would have reached: the limit of learning such biases on this log.
"""

import itertools
import sys
from pathlib import Path
from typing import NamedTuple

import numpy as np
from scipy.optimize import least_squares

LOG = Path(__file__).parents[2] / "shared" / "data" / "victoria_park.npz"
WHEELBASE_M, ENCODER_M = 2.83, 0.76
"""Of the car, and how far the wheel with the encoder is from its middle (published)."""
GAP_S, BEFORE_S, FORGET_S = 5.0, 60.0, 600.0
FIX_SD_M, PRIOR = 0.5, np.array([0.02, 0.05, 0.02])
"""Of a fix; and of the scale, the gain and the zero [rad] about none at all (estimated)."""
LONG_S = 15.0
CONSTANTS = np.linspace(0.97, 1.03, 5), np.linspace(0.95, 1.15, 5), np.linspace(-0.01, 0.01, 9)
RAW = np.array([1.0, 1.0, 0.0])


class Log(NamedTuple):
    """The file's arrays."""

    t: np.ndarray
    speed: np.ndarray
    steering: np.ndarray
    t_gps: np.ndarray
    gps_x: np.ndarray
    gps_y: np.ndarray


def reckon(log, begin_s, end_s, state, biases):
    """Times (n,) and poses (n, 3) from a state (3,), with scale, gain and zero (3,)."""
    scale, gain, zero = biases
    first, last = np.searchsorted(log.t, [begin_s, end_s])
    times = np.concatenate([[begin_s], log.t[first:last], [end_s]])
    speed, angle = (np.interp(times[:-1], log.t, x) for x in (log.speed, log.steering))
    slope = np.tan(gain * angle + zero)
    speed = scale * speed / (1.0 - slope * ENCODER_M / WHEELBASE_M)
    dt = np.diff(times)
    turn = speed * slope / WHEELBASE_M * dt
    heading = state[2] + np.concatenate([[0.0], np.cumsum(turn)])
    middle = heading[:-1] + 0.5 * turn
    east, north = (np.cumsum(speed * f(middle) * dt) for f in (np.cos, np.sin))
    places = [state[0] + np.append(0.0, east), state[1] + np.append(0.0, north)]
    return times, np.column_stack([*places, heading])


def learn(log, gap, known, weight):
    """State at the last fix before a gap and the biases, by a robust fit to the time before."""
    near = (log.t_gps > log.t_gps[gap] - BEFORE_S) & (log.t_gps <= log.t_gps[gap])
    t, x, y = log.t_gps[near], log.gps_x[near], log.gps_y[near]

    def residual(p):
        times, pose = reckon(log, t[0], t[-1], p[:3], p[3:])
        gaps = [np.interp(t, times, pose[:, k]) - z for k, z in enumerate((x, y))]
        return np.concatenate([*gaps, weight * (p[3:] - known) / PRIOR]) / FIX_SD_M

    course = np.arctan2(y[-1] - y[0], x[-1] - x[0])
    starts = ([x[0], y[0], course + k * np.pi / 2.0, *known] for k in range(4))
    best = min((least_squares(residual, s, loss="soft_l1") for s in starts), key=lambda s: s.cost)
    _, pose = reckon(log, t[0], t[-1], best.x[:3], best.x[3:])
    return pose[-1], best.x[3:]


def error_m(log, gap, state, biases):
    """Distance to the first fix after a gap."""
    _, pose = reckon(log, log.t_gps[gap], log.t_gps[gap + 1], state, biases)
    return float(np.hypot(pose[-1, 0] - log.gps_x[gap + 1], pose[-1, 1] - log.gps_y[gap + 1]))


def main() -> None:
    """Print the table and the limit."""
    with np.load(sys.argv[1] if len(sys.argv) > 1 else LOG) as data:
        log = Log(*(data[name] for name in Log._fields))
    gaps = np.flatnonzero(np.diff(log.t_gps) > GAP_S)
    known, learned, states, rows = RAW.copy(), 0.0, [], []
    print("gap at s   long s   raw m   ours m   scale   gain   zero rad")
    for gap in gaps:
        state, found = learn(log, gap, known, 2.0)
        share = BEFORE_S / (BEFORE_S + min(learned, FORGET_S))
        known, learned = known + share * (found - known), learned + BEFORE_S
        raw, ours = (error_m(log, gap, state, biases) for biases in (RAW, known))
        states.append((gap, state))
        rows.append((raw, ours))
        begin, long = log.t_gps[gap], log.t_gps[gap + 1] - log.t_gps[gap]
        print(f"{begin:8.1f} {long:8.1f} {raw:7.2f} {ours:8.2f} {known[0]:7.3f} {known[1]:6.3f} "
              f"{known[2]:10.4f}")  # fmt: skip
    raw, ours = np.array(rows).T
    print(f"ours is better in {np.count_nonzero(ours < raw)} of {len(gaps)} gaps; "
          f"median {np.median(ours):.2f} m, raw {np.median(raw):.2f} m; "
          f"mean {ours.mean():.2f} m, raw {raw.mean():.2f} m")  # fmt: skip
    far = np.diff(log.t_gps)[gaps] > LONG_S
    won = np.count_nonzero((ours < raw) & far)
    print(f"of gaps longer than {LONG_S:.0f} s in {won} of {np.count_nonzero(far)}; "
          f"mean {ours[far].mean():.2f} m, raw {raw[far].mean():.2f} m")  # fmt: skip
    best = max(_better(log, states, raw, np.array(b)) for b in itertools.product(*CONSTANTS))
    print(f"the best constants of all, known only afterwards: better in {best} of {len(gaps)}")


def _better(log, states, raw, biases):
    ours = [error_m(log, gap, state, biases) for gap, state in states]
    return int(np.count_nonzero(np.array(ours) < raw))


if __name__ == "__main__":
    main()
