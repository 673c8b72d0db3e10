"""A sweep on a Dask cluster of this machine whose parts speak to each other by TLS."""

import os
import re
import shutil
import subprocess
import sys
import time
from pathlib import Path

import pytest

pytestmark = pytest.mark.slow

WEARSIM = str(Path(sys.executable).parent / "wearsim")
DASK = str(Path(sys.executable).parent / "dask")
CASE = """\
format_version = 1
[chain]
designation = "16B-1"
[sprocket]
teeth = 20
profile = "evolute"
nodes = 101
[load]
tension_N = 3000.0
speed_rpm = 100
[wear]
specific_wear_rate_mm2_per_N = 5e-11
[run]
horizon_hours = 1e6
"""
STUDY = """\
format_version = 1
title = "Tension"
case = "case.toml"
[grid]
"load.tension_N" = {from = 2000.0, to = 4000.0, count = 600}
"""
NEW_KEY = "-newkey ec -pkeyopt ec_paramgen_curve:prime256v1 -nodes"


def certified(folder):
    """Make an authority and a key with its certificate, and return the options that name them."""
    folder.mkdir()
    for command in (
        f"req -x509 {NEW_KEY} -days 2 -subj /CN=authority -keyout ca.key -out ca.pem",
        f"req {NEW_KEY} -subj /CN=own -keyout own.key -out own.csr",
        "x509 -req -in own.csr -CA ca.pem -CAkey ca.key -CAcreateserial -days 2 -out own.pem",
    ):
        subprocess.run(["openssl", *command.split()], cwd=folder, check=True, capture_output=True)
    names = {"--tls-ca-file": "ca.pem", "--tls-cert": "own.pem", "--tls-key": "own.key"}
    return [part for option, name in names.items() for part in (option, str(folder / name))]


@pytest.fixture(scope="module")
def place(tmp_path_factory):
    """Folder with a sweep, where there is what certificates and clusters are made by."""
    pytest.importorskip("distributed", reason="distributed is not installed")
    if shutil.which("openssl") is None:
        pytest.skip("openssl is not installed")
    folder = tmp_path_factory.mktemp("tls")
    (folder / "case.toml").write_text(CASE)
    (folder / "study.toml").write_text(STUDY)
    return folder


@pytest.fixture(scope="module")
def tls(place):
    """Options of both sides of the cluster."""
    return certified(place / "own")


@pytest.fixture(scope="module")
def scheduler(place, tls):
    """File of a scheduler with TLS and one worker."""
    file = place / "scheduler.json"
    environment = {**os.environ, "DASK_TEMPORARY_DIRECTORY": str(place)}
    common = {"env": environment, "cwd": place}
    with (place / "cluster.log").open("w") as log:
        running = [
            subprocess.Popen(
                [
                    DASK,
                    "scheduler",
                    "--host",
                    "127.0.0.1",
                    "--protocol",
                    "tls",
                    "--port",
                    "0",
                    "--no-dashboard",
                    "--scheduler-file",
                    str(file),
                    *tls,
                ],
                stdout=log,
                stderr=log,
                **common,
            )
        ]
        try:
            end = time.monotonic() + 60
            while not file.exists():
                assert time.monotonic() < end, (place / "cluster.log").read_text()
                time.sleep(0.02)
            running.append(
                subprocess.Popen(
                    [
                        DASK,
                        "worker",
                        "--scheduler-file",
                        str(file),
                        "--nthreads",
                        "1",
                        "--no-dashboard",
                        "--no-nanny",
                        "--local-directory",
                        str(place),
                        *tls,
                    ],
                    stdout=log,
                    stderr=log,
                    **common,
                )
            )
            yield file
        finally:
            for process in running:
                process.kill()
                process.wait()


@pytest.fixture(scope="module")
def address(scheduler):
    (found,) = re.findall(r'"address": "(tls://127\.0\.0\.1:\d+)"', scheduler.read_text())
    return found


def swept(place, *options):
    command = [WEARSIM, "sweep", str(place / "study.toml"), "--json", *map(str, options)]
    return subprocess.run(command, capture_output=True, text=True, timeout=200)


def refused(place, *options):
    """Message of a sweep that ends at once with exit code 3 and prints nothing else."""
    start = time.monotonic()
    done = swept(place, *options)
    assert (done.returncode, done.stdout) == (3, ""), done.stderr
    assert "Traceback" not in done.stderr
    assert time.monotonic() - start < 50.0
    return done.stderr


def test_the_same_lives_by_tls(place, tls, scheduler, address):
    threads = swept(place)
    assert threads.returncode == 0, threads.stderr
    assert threads.stdout.count('"life_hours"') == 600
    for where in (("--scheduler-file", scheduler), ("--scheduler", address)):
        done = swept(place, *where, *tls)
        assert done.returncode == 0, done.stderr
        assert done.stdout == threads.stdout


def test_certificates_must_be_given(place, tls, scheduler, address):
    for options in ((), tls[:2]):
        for where in (("--scheduler-file", scheduler), ("--scheduler", address)):
            text = refused(place, *where, *options)
            assert f"must be reached by TLS, as its address is {address}" in text
            assert "give --tls-ca-file, --tls-cert and --tls-key" in text


def test_address_without_tls(place, tls, address):
    plain = address.replace("tls://", "tcp://")
    assert "must be a scheduler with TLS" in refused(place, "--scheduler", plain, *tls)
    assert "must be a Dask scheduler that answers" in refused(place, "--scheduler", plain)


def test_certificates_of_another_authority(place, tls, address):
    other = certified(place / "other")
    assert "must be a Dask scheduler that answers" in refused(place, "--scheduler", address, *other)
    mixed = [*tls[:4], *other[4:]]
    text = refused(place, "--scheduler", address, *mixed)
    assert "must be reached with certificates and a key that belong together" in text
