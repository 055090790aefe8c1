"""What `--ablate` can take away, to see whether a course is worth passing."""

LIDARS = ("lidar_bumper", "lidar_roof", "lidar_left", "lidar_right")
"""ION's; other vehicles have others."""
OTHERS = ("sonar", "gps", "imu", "compass", "odometry")


def ablations(lidars: tuple[str, ...] = LIDARS) -> dict[str, frozenset[str]]:
    """Ablation to the sensors that fall silent, for a vehicle with these scanners."""
    return {
        "blind": frozenset({*lidars, "sonar"}),
        "no-lidar": frozenset(lidars),
        **{f"no-{name.replace('_', '-')}": frozenset({name}) for name in (*lidars, *OTHERS)},
    }


def disabled_sensors(ablate: tuple[str, ...], lidars: tuple[str, ...] = LIDARS) -> frozenset[str]:
    """The sensors that are silent under these ablations.

    Raises:
        ValueError: an unknown ablation; lists those that exist.
    """
    known = ablations(lidars)
    if unknown := [name for name in ablate if name not in known]:
        raise ValueError(f"--ablate {unknown[0]}: unknown; known are {', '.join(known)}")
    return frozenset().union(*(known[name] for name in ablate))
