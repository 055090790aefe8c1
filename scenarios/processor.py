"""What fixes the bits of an episode beside its seed: the processor's settings and the versions.

Imports nothing that loads numpy, because the settings must be made before.
"""

import os
import platform
from collections.abc import MutableMapping
from importlib.metadata import version

SETTINGS = {"OPENBLAS_NUM_THREADS": "1"}
"""Small products change bits with the number of threads."""
X86_SETTINGS = {
    # numpy's transcendental functions change bits with AVX-512; these are the groups that
    # numpy 2.4 dispatches to (an x86-64-v3 processor has none of them and takes no notice).
    "NPY_DISABLE_CPU_FEATURES": "X86_V4 AVX512_ICL AVX512_SPR",
    "NUMBA_CPU_NAME": "x86-64-v3",
    # OpenBLAS has kernels for each kind of processor, which add up in other orders
    "OPENBLAS_CORETYPE": "Haswell",
}
PACKAGES = ("ion-twin", "numpy", "mujoco", "numba")


def settings() -> dict[str, str]:
    """The settings for this machine."""
    x86 = platform.machine().lower() in ("x86_64", "amd64")
    return SETTINGS | X86_SETTINGS if x86 else SETTINGS


def fix_processor(environment: MutableMapping[str, str] = os.environ) -> None:
    """Make the settings where the user has not; call it before numpy is imported."""
    for name, value in settings().items():
        environment.setdefault(name, value)


def fingerprint() -> dict[str, str]:
    """Versions, kind of machine and settings: two runs with the same one have equal digests."""
    versions = {name: version(name) for name in PACKAGES}
    machine = {"python": platform.python_version(), "machine": platform.machine()}
    return machine | versions | {name: os.environ.get(name, "") for name in settings()}
