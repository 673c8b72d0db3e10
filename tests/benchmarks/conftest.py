"""The reference run as the kernels take it, and C sources compiled on the spot."""

import ctypes
import functools
import os
import shlex
import subprocess
from pathlib import Path
from types import SimpleNamespace

import numpy as np
import pytest

from wearsim.contact.hertz import contact_modulus
from wearsim.geometry.forms.evolute import Strand, evolute_flank
from wearsim.kernels.per_cycle_loop import CYCLES_ROWS
from wearsim.mechanisms.strand.contact import StrandMechanism
from wearsim.wear.law import archard

PITCH, TEETH, OFFSET, ROLLER_RADIUS = 25.4, 20, 5.5, 7.94
CONTACT_END, CONTACT_START = 4.0, 30.67
DEPTH = 0.2
FLAGS = {
    "plain": ["-O3", "-march=native"],
    "fast-math": ["-O3", "-march=native", "-ffast-math"],
    "fissioned": ["-O3", "-march=native", "-fno-math-errno", "-ffinite-math-only", "-fno-signed-zeros"],
}


@pytest.fixture(scope="session")
def rounds(pytestconfig):
    """How often what takes seconds is timed: the rounds that the command line asks for."""
    return pytestconfig.getoption("benchmark_min_rounds")


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
            x=x, y=y, depth=np.zeros(x.size), work=np.zeros((CYCLES_ROWS, x.size)), done=np.zeros(1)
        )

    return build


TYPES = {
    "v": np.ctypeslib.ndpointer(dtype=np.float64, flags="C_CONTIGUOUS"),
    "d": ctypes.c_double,
    "l": ctypes.c_long,
}


@pytest.fixture(scope="session")
def c_function(tmp_path_factory):
    """A C function compiled with one of the sets of flags: source, flags, name, types of arguments."""
    folder = tmp_path_factory.mktemp("c")

    @functools.cache
    def build(source, kind, name, arguments):
        file = Path(__file__).with_name(f"{source}.c")
        library = folder / f"{source}-{kind}.so"
        compiler = shlex.split(os.environ.get("CC", "gcc"))
        subprocess.run(
            [*compiler, *FLAGS[kind], "-shared", "-fPIC", str(file), "-o", str(library), "-lm"], check=True
        )
        function = getattr(ctypes.CDLL(str(library)), name)
        function.argtypes = [TYPES[letter] for letter in arguments]
        return function

    return build


@pytest.fixture(scope="session")
def c_run_cycles(c_function):
    """The C cycle loop of the strand compiled with one of the sets of flags."""

    def build(kind):
        source = "strand_fissioned" if kind == "fissioned" else "strand_plain"
        return c_function(source, kind, "run_cycles", "vvvlvvdddlv")

    return build
