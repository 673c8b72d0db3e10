"""``wearsim sensitivity``: what of the input matters."""

import json

import numpy as np
import pytest

pytestmark = pytest.mark.wide

SCATTER = """\
[run]
life_tolerance = 0.05
[uncertainty]
"wear.specific_wear_rate_mm2_per_N" = {distribution = "lognormal", sigma_ln = 0.4}
"load.tension_N" = {distribution = "lognormal", sigma_ln = 0.3}
"""
K, TENSION = "wear.specific_wear_rate_mm2_per_N", "load.tension_N"


@pytest.fixture(autouse=True)
def salib():
    pytest.importorskip("SALib", reason="SALib is not installed")


@pytest.fixture
def case(drive):
    """Function that writes the test drive with a tension and more tables."""

    def write(more=SCATTER):
        path = drive()
        text = path.read_text().replace("power_kW = 3\n", "tension_N = 3000.0\n")
        path.write_text(text + more)
        return path

    return write


def answer(cli, *arguments):
    done = cli("sensitivity", *arguments, "--json")
    content = json.loads(done.out)
    return done, content, {row["key"]: row for row in content["keys"]}


def test_indices_of_a_product_are_shares_of_the_variance(cli, case):
    """On a strand ln L falls with ln k and ln F: indices are 0.16 and 0.09 of 0.25."""
    done, content, found = answer(cli, case(), "--samples", 128)
    assert done.code == 0
    for key, sigma in ((K, 0.4), (TENSION, 0.3)):
        share = sigma**2 / 0.25
        assert found[key]["total_index"] == pytest.approx(share, abs=0.03)
        assert found[key]["first_order_index"] == pytest.approx(share, abs=0.06)
        # 10 and 90 % points lie 2 * 1.2816 sigma apart.
        ratio = found[key]["low_life_hours"] / found[key]["high_life_hours"]
        assert np.log(ratio) == pytest.approx(2.0 * 1.2815516 * sigma, rel=1e-4)
        assert found[key]["value_for_double_life"] == pytest.approx(found[key]["value"] / 2, rel=5e-3)
        # Effects go over two thirds of the shares, here in steps of equal size both ways.
        assert found[key]["morris_sigma"] < 0.05 * found[key]["morris_mu_star"]
    assert found[K]["morris_mu_star"] == pytest.approx(found[TENSION]["morris_mu_star"] * 4 / 3, rel=0.01)
    assert content["life_hours"] > 0.0


def test_indices_agree_with_scipy(cli, case, tmp_path):
    """The indices of the same function by scipy's own samples and estimators."""
    from scipy.stats import sobol_indices, uniform

    from wearsim.runner.run_study import run_study
    from wearsim.runner.scatter import load_scattered
    from wearsim.runner.workers import Threads

    more = SCATTER.replace(
        'distribution = "lognormal", sigma_ln = 0.3',
        'distribution = "weibull", shape = 1.5, scale = 3000.0, low = 500.0',
    )
    path = case(more)
    scattered = load_scattered(path, [])

    def log_lives(shares):
        table = run_study(scattered.design(shares.T.clip(1e-9, 1 - 1e-9)), Threads(1))
        return np.log(table["life_hours"].to_numpy())

    rng = np.random.default_rng(1)
    exact = sobol_indices(func=log_lives, n=128, dists=[uniform(), uniform()], rng=rng)
    _, _, found = answer(cli, path, "--samples", 128)
    for index, key in enumerate(scattered.keys):
        assert found[key]["total_index"] == pytest.approx(exact.total_order[index], abs=0.05)
        assert found[key]["first_order_index"] == pytest.approx(exact.first_order[index], abs=0.08)


def test_key_that_does_nothing_and_text(cli, case):
    more = SCATTER + '"sprocket.face_width_mm" = {distribution = "uniform", low = 15.0, high = 15.001}\n'
    path = case(more)
    path.write_text(path.read_text().replace("nodes = 51", "nodes = 51\nface_width_mm = 15.0"))
    done = cli("sensitivity", path, "--samples", 32, "--trajectories", 4)
    assert done.code == 0
    (line,) = [line for line in done.out.splitlines() if "face_width_mm  " in line and "total" in line]
    assert "total  0.00" in line
    assert f"{K}  " in done.out
    assert "value that would double the life" in done.out


@pytest.mark.slow
def test_options_change_the_samples(cli, case):
    base = answer(cli, case(), "--samples", 32, "--trajectories", 4)[2][K]
    for option in (("--seed", 2), ("--trajectories", 8), ("--samples", 64)):
        options = {"--samples": 32, "--trajectories": 4} | dict([option])
        other = answer(cli, case(), *(part for pair in options.items() for part in pair))[2][K]
        assert other != base


def test_only_the_wear_coefficient_scatters(cli, case):
    """Why there is one bar, and lines that give more of them when they are put into the case."""
    path = case("")
    done = cli("sensitivity", path, "--samples", 8, "--trajectories", 4)
    assert "only wear coefficients scatter" in done.out
    assert "are poorly determined" not in done.out
    offered = done.out[done.out.index("[uncertainty]\n") :]
    # A tenth of the tension, 3 % of the speed, 2 % of the offset.
    for key, deviation in ((TENSION, 300), ("load.speed_rpm", 3), ("sprocket.evolute_offset_mm", 0.112)):
        assert f'"{key}" = {{distribution = "normal", standard_deviation = {deviation}}}' in offered
    path.write_text(path.read_text() + offered)
    done, content, found = answer(cli, path, "--samples", 8, "--trajectories", 4)
    assert {K, TENSION, "load.speed_rpm", "sprocket.evolute_offset_mm"} < set(found)
    assert not any("only wear coefficients" in text for text in content["warnings"])


def test_lives_that_are_not_known_are_refused(cli, case):
    done = cli("sensitivity", case(), "--set", "run.horizon_hours=100", "--samples", 8)
    assert (done.code, done.out) == (3, "")
    assert "met no limit within run.horizon_hours" in done.err
    done = cli("sensitivity", case(), "--samples", 12)
    assert done.code == 2
    assert "12 is not a power of two" in done.err


def test_folder(cli, case, tmp_path):
    pytest.importorskip("pyarrow", reason="pyarrow is not installed")
    out = tmp_path / "out"
    first = cli("sensitivity", case(), "--samples", 8, "--trajectories", 4, "--out", out)
    assert first.code == 0
    assert {entry.name for entry in out.iterdir()} == {
        ".wearsim",
        "cases.csv",
        "sensitivity.csv",
        "summary.md",
        "tornado.png",
        "tornado.svg",
        "study.json",
        "shards",
    }
    again = cli("sensitivity", case(), "--samples", 8, "--trajectories", 4, "--out", out)
    assert again.out == first.out


def test_nothing_that_varies(cli, case):
    path = case(SCATTER.replace("0.4", "0.0").replace("0.3", "0.0"))
    done = cli("sensitivity", path, "--samples", 8, "--trajectories", 4)
    assert (done.code, done.out) == (3, "")
    assert "none of the scattering inputs changes the life" in done.err
