"""How long a ray takes: `python tests/bench_raycast.py` prints microseconds a ray.

A level and a tilted scan of 361 beams over gentle ground, 300 things spread over the site.
"""

import time

import numpy as np

from twin.raycast import Scene, cast
from twin.world import Obstacle

SPACING_M, POINTS = 0.5, 360
MAX_RANGE_M = 81.92
SITE_M = 400.0


def ground(rng: np.random.Generator) -> np.ndarray:
    """Heights (n, n) [m]: long swells and 2 cm of roughness."""
    x = np.arange(POINTS) * SPACING_M
    swell = 0.5 * np.sin(x / 17.0) + 0.1 * np.cos(x / 6.0)
    return swell[None, :] + 0.7 * swell[:, None] + rng.normal(0.0, 0.02, (POINTS, POINTS))


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
        start = time.perf_counter()
        for f in fans:
            cast(scene, origin, f, MAX_RANGE_M)
        best = min(best, time.perf_counter() - start)
    return best / len(fans) / 361 * 1e6, float(hits)


def main() -> None:
    """Print the table."""
    rng = np.random.default_rng(0)
    z = ground(rng)
    scene = Scene(things(rng))
    start = time.perf_counter()
    scene.set_ground(z, -90.0, -90.0, SPACING_M)
    print(f"first set_ground, with loading of compiled code: {time.perf_counter() - start:.2f} s")
    start = time.perf_counter()
    scene.set_ground(z, -90.0, -90.0, SPACING_M)
    print(f"set_ground: {(time.perf_counter() - start) * 1e3:.2f} ms")
    middle = float(z[POINTS // 2, POINTS // 2])
    for name, height_m, pitch_rad in (("level", 0.55, 0.0), ("roof", 1.9, 0.122)):
        time_us, hits = microseconds_a_ray(scene, middle + height_m, pitch_rad)
        print(f"{name}: {time_us:.3f} us a ray, {hits:.0%} hit")


if __name__ == "__main__":
    main()
