"""Every file of the corpus ends as an answer or as an error that names what is wrong, at once."""

import shutil
from pathlib import Path

import pytest

from wearsim.command.options import BAD_INPUT, FAILED

CORPUS = Path(__file__).parents[1] / "corpus"
ENDS = (0, BAD_INPUT, FAILED)

pytestmark = pytest.mark.usefixtures("not_for_ever")


def files(kind):
    return sorted((CORPUS / kind).iterdir(), key=lambda path: path.name)


def by_name(path):
    return path.name


def ends_well(done):
    assert done.code in ENDS, done.err
    assert "bug in wearsim" not in done.err
    assert "Traceback" not in done.err
    assert "Warning:" not in done.err
    assert (done.code == 0) == bool(done.out)
    assert done.code == 0 or done.err


@pytest.mark.parametrize("path", files("cases"), ids=by_name)
def test_case(cli, path):
    ends_well(cli("check", path))


@pytest.mark.parametrize("path", files("points"), ids=by_name)
def test_points(cli, drive, path):
    shutil.copy(path, drive().parent)
    kind = "dxf" if path.suffix == ".dxf" else "points"
    case = drive(profile=f'"{kind}"\n{kind}_file = "{path.name}"')
    if kind == "dxf":
        case.write_text(case.read_text().replace("evolute_offset_mm = 5.6\n", ""))
    done = cli("check", case)
    ends_well(done)
    assert done.code == 0 or f"sprocket.{kind}_file" in done.err


@pytest.mark.parametrize("path", files("readings"), ids=by_name)
def test_readings(cli, drive, path):
    ends_well(cli("calibrate", drive(), path))
