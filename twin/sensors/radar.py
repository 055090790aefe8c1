"""Eaton VORAD EVT-300: tracks of what stands ahead, by range, bearing and range rate."""

import numpy as np
from numba import njit

from nav.messages import RadarTracks
from twin.raycast import cast_hits
from twin.sensors.parameters import MountingParameters, RadarParameters
from twin.sensors.sensor import Bools, Floats, Ints, View, draw_mounting, generator, schedule
from twin.sensors.sight import ByKind, Sight
from twin.world import SOFT


class Radar:
    """One track for each thing in view: its nearest point; the nearest things first.

    It is a Doppler unit: it tells things apart by their range rate, and what neither comes nor goes
    it does not hear. So a vehicle at a stand has no tracks. Its clutter filter is taken to reject
    all that ground sends back, and what lies as flat on it; whatever else stands there is heard,
    of hay as of steel, and brush lets the beam pass (all estimated). Tracks are of one instant:
    the unit's smoothing over time is left out.
    """

    name = "radar"

    def __init__(
        self, sight: Sight, seed: int, p: RadarParameters, mounting: MountingParameters
    ) -> None:
        self.schedule = schedule(p)
        self._p = p
        self._scene = sight.solid
        self._heard = ByKind(sight, dict.fromkeys(SOFT, False), True, False, False)
        self._rng = generator(seed, self.name)
        self._mounting = draw_mounting(self._rng, mounting)
        self._beam = _beam(p)
        self._bounds = (
            np.array([p.range_error_m, p.azimuth_error_rad, 0.0]),
            np.array([p.range_error_share, 0.0, p.rate_error_share]),
        )

    def measure(self, view: View, time_ns: int) -> RadarTracks:
        """The tracks of this instant."""
        p, (position, rotation) = self._p, self._mounting.pose(view, self.name)
        origin, turn = position[None], rotation[None]
        range_m, what = cast_hits(self._scene, origin, self._beam, p.max_range_m, turn)
        velocity, heard = view.site_velocity(self.name)[0] @ rotation, self._heard.of(what[0])
        true = _tracks(
            range_m[0], what[0], heard, self._beam, velocity, p.min_rate_mps, p.max_tracks
        )
        draws = self._rng.standard_normal((3, p.max_tracks))  # as many for none as for all
        return RadarTracks(time_ns, *_blurred(true, draws / p.bound_sigmas, *self._bounds))


@njit(cache=True)
def _tracks(
    range_m: Floats, what: Ints, heard: Bools, beam: Floats, velocity: Floats, min_rate_mps: float,
    most: int,
) -> Floats:  # fmt: skip
    """Range, azimuth and rate, shape (3, k), of the k nearest things, one by one the nearest.

    Args:
        range_m: of n rays, shape (n,), as are the next two.
        what: index of the thing that each ray meets.
        heard: whether it can be a track; used up.
        beam: directions of the rays, shape (n, 3).
        velocity: of the radar in its own frame, shape (3,), [m/s].
        min_rate_mps: what comes or goes more slowly is no track.
        most: so many at most.
    """
    rate_mps = -(beam * velocity).sum(axis=1)
    heard &= np.abs(rate_mps) >= min_rate_mps
    found = np.empty((3, most))
    for k in range(most):
        if not heard.any():
            return found[:, :k]
        ray = np.argmin(np.where(heard, range_m, np.inf))
        found[0, k] = range_m[ray]
        found[1, k] = np.arctan2(beam[ray, 1], beam[ray, 0])
        found[2, k] = rate_mps[ray]
        heard &= what != what[ray]
    return found


@njit(cache=True)
def _blurred(true: Floats, errors: Floats, bound: Floats, share: Floats) -> Floats:
    """True values (3, k) with errors (3, k or more), which are shares of their bounds: the larger
    of `bound` and of a `share` (3,) of the value. No range is negative."""
    said = true.copy()
    for i in range(3):
        for k in range(true.shape[1]):
            error = min(max(errors[i, k], -1.0), 1.0)
            said[i, k] += error * max(bound[i], share[i] * abs(true[i, k]))
    said[0] = np.maximum(said[0], 0.0)
    return said


def _beam(p: RadarParameters) -> Floats:
    """Unit directions (n, 3) about x, in rows one above the other."""
    azimuth, elevation = np.meshgrid(
        np.linspace(-p.half_beam_rad, p.half_beam_rad, p.rays), p.rows_rad
    )
    level = np.cos(elevation)
    beam = level * np.cos(azimuth), level * np.sin(azimuth), np.sin(elevation)
    return np.stack(beam, axis=-1).reshape(-1, 3)
