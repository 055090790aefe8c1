"""How long a ray takes: `python tests/bench_raycast.py` prints microseconds a ray.

A level and a tilted scan of 361 beams over the twin's rolling ground, 300 things spread over the
site. Counts processor time, so that a busy machine changes it less.
"""

import time

import numpy as np

from twin.raycast import Scene, cast
from twin.terrain import RollingGround
from twin.world import Obstacle

SPACING_M, POINTS = 0.5, 360
MAX_RANGE_M = 81.92
SITE_M = 400.0


def things(rng: np.random.Generator, count: int = 300) -> list[Obstacle]:
    """Boxes and cylinders, anywhere on the site but not at its middle."""
    found: list[Obstacle] = []
    while len(found) < count:
        x, y = rng.uniform(-SITE_M / 2, SITE_M / 2, 2)
        if np.hypot(x, y) > 4.0:
            shape = "box" if rng.random() < 0.5 else "cylinder"
            size = tuple(rng.uniform(0.1, 0.8, 3))
            yaw = rng.uniform(0.0, np.pi)
            quat = (np.cos(yaw / 2), 0.0, 0.0, np.sin(yaw / 2))
            found.append(Obstacle(str(len(found)), "x", shape, (x, y, 0.3), size, quat))
    return found


def fan(pitch_rad: float, yaw_rad: float) -> np.ndarray:
    """Directions (361, 3) of one scan; positive pitch looks down."""
    angle = np.linspace(-np.pi / 2, np.pi / 2, 361)
    x, y = np.cos(angle) * np.cos(pitch_rad), np.sin(angle)
    z = -np.cos(angle) * np.sin(pitch_rad)
    c, s = np.cos(yaw_rad), np.sin(yaw_rad)
    return np.ascontiguousarray(np.stack([c * x - s * y, s * x + c * y, z], axis=1))


def microseconds_a_ray(scene: Scene, height_m: float, pitch_rad: float) -> tuple[float, float]:
    """Mean time of a ray and the share of rays that hit, over scans at many headings."""
    fans = [fan(pitch_rad, yaw) for yaw in np.linspace(0.0, 2 * np.pi, 60)]
    origin = np.array([0.0, 0.0, height_m])
    hits = np.mean([cast(scene, origin, f, MAX_RANGE_M) < MAX_RANGE_M for f in fans])
    best = np.inf
    for _ in range(5):
        start = time.process_time()
        for f in fans:
            cast(scene, origin, f, MAX_RANGE_M)
        best = min(best, time.process_time() - start)
    return best / len(fans) / 361 * 1e6, float(hits)


def main() -> None:
    """Print the table."""
    rng = np.random.default_rng(0)
    x = np.arange(POINTS) * SPACING_M - 90.0
    z = RollingGround(0).height(*np.meshgrid(x, x))
    scene = Scene(things(rng))
    scene.set_ground(z, -90.0, -90.0, SPACING_M)
    start = time.process_time()
    scene.set_ground(z, -90.0, -90.0, SPACING_M)
    print(f"set_ground: {(time.process_time() - start) * 1e3:.2f} ms")
    middle = float(z[POINTS // 2, POINTS // 2])
    for name, height_m, pitch_rad in (("level", 0.55, 0.0), ("roof", 1.9, 0.122)):
        time_us, hits = microseconds_a_ray(scene, middle + height_m, pitch_rad)
        print(f"{name}: {time_us:.3f} us a ray, {hits:.0%} hit")


if __name__ == "__main__":
    main()
