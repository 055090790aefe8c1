"""What `--ablate` can take away, to see whether a course is worth passing."""

LIDARS = ("lidar_bumper", "lidar_roof", "lidar_left", "lidar_right")
"""ION's; other vehicles have others."""
RADARS = ("radar",)
"""ION's; no other vehicle has one."""
OTHERS = ("sonar", "gps", "imu", "compass", "odometry")


def ablations(
    lidars: tuple[str, ...] = LIDARS, radars: tuple[str, ...] = RADARS
) -> dict[str, frozenset[str]]:
    """Ablation to the sensors that fall silent, for a vehicle with these scanners and radars."""
    names = (*lidars, *radars, *OTHERS)
    return {
        "blind": frozenset({*lidars, *radars, "sonar"}),
        "no-lidar": frozenset(lidars),
        **{f"no-{name.replace('_', '-')}": frozenset({name}) for name in names},
    }


def disabled_sensors(
    ablate: tuple[str, ...],
    lidars: tuple[str, ...] = LIDARS,
    radars: tuple[str, ...] = RADARS,
) -> frozenset[str]:
    """The sensors that are silent under these ablations.

    Raises:
        ValueError: an unknown ablation; lists those that exist.
    """
    known = ablations(lidars, radars)
    if unknown := [name for name in ablate if name not in known]:
        raise ValueError(f"--ablate {unknown[0]}: unknown; known are {', '.join(known)}")
    return frozenset().union(*(known[name] for name in ablate))
