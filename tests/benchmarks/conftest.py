"""The reference run as the kernels take it, and C sources compiled on the spot."""

import ctypes
import os
import shlex
import subprocess
from pathlib import Path
from types import SimpleNamespace

import numpy as np
import pytest

from wearsim.contact.hertz import contact_modulus
from wearsim.geometry.evolute import Strand, evolute_flank
from wearsim.mechanisms.strand import StrandMechanism
from wearsim.wear.law import archard

PITCH, TEETH, OFFSET, ROLLER_RADIUS = 25.4, 20, 5.5, 7.94
CONTACT_END, CONTACT_START = 4.0, 30.67
DEPTH = 0.2
FLAGS = {
    "plain": ["-O3", "-march=native"],
    "fast-math": ["-O3", "-march=native", "-ffast-math"],
    "fissioned": ["-O3", "-march=native", "-fno-math-errno", "-ffinite-math-only",
                  "-fno-signed-zeros"],
}  # fmt: skip


@pytest.fixture
def reference_contact():
    """Contact of the reference run (5000 N on 17 mm, 100 rpm) on so many nodes, and its law."""

    def build(nodes):
        strand = Strand(PITCH * TEETH / (2.0 * np.pi), ROLLER_RADIUS, OFFSET)
        mechanism = StrandMechanism(
            strand=strand,
            profile=evolute_flank(strand, CONTACT_END, CONTACT_START, nodes).profile,
            contact_end=CONTACT_END,
            contact_start=CONTACT_START,
            pitch=PITCH,
            pull_per_width=5000.0 / 17.0,
            angular_speed=2.0 * np.pi * 100.0 / 60.0,
            slip_fraction=1.0,
            modulus=contact_modulus((2.1e5, 2.1e5), (0.3, 0.3)),
        )
        return mechanism.contact, archard(1e-8)

    return build


@pytest.fixture
def start():
    """Fresh copies of the flank of a contact: x, y, depth, a table to work in, updates done."""

    def build(contact):
        x, y = contact.profile.x.copy(), contact.profile.y.copy()
        return SimpleNamespace(
            x=x, y=y, depth=np.zeros(x.size), work=np.zeros((10, x.size)), done=np.zeros(1)
        )

    return build


@pytest.fixture(scope="session")
def c_run_cycles(tmp_path_factory):
    """The C cycle loop compiled with one of the sets of flags."""
    folder = tmp_path_factory.mktemp("c")

    def build(kind):
        name = "fissioned" if kind == "fissioned" else "plain"
        source, library = Path(__file__).with_name(f"strand_{name}.c"), folder / f"{kind}.so"
        compiler = shlex.split(os.environ.get("CC", "gcc"))
        subprocess.run(
            [*compiler, *FLAGS[kind], "-shared", "-fPIC", str(source), "-o", str(library), "-lm"],
            check=True,
        )
        function = ctypes.CDLL(str(library)).run_cycles
        vector = np.ctypeslib.ndpointer(dtype=np.float64, flags="C_CONTIGUOUS")
        number, count = ctypes.c_double, ctypes.c_long
        function.argtypes = [vector, vector, vector, count, vector, vector,
                             number, number, number, number, count, vector]  # fmt: skip
        return function

    return build
