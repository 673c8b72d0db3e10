"""Designs whose chain ends first do not rank tooth forms, and that is said."""

from types import SimpleNamespace

import pytest

from wearsim.study.optimise.sheet import optimise_warnings


def outcome(key, stop):
    """A search over one key, whose best design ended by something."""
    best = SimpleNamespace(
        number=1, values=("iso606",), measures={"life_hours": 100.0}, stop=stop, warnings="", feasible=True,
        reached=True, error="", cost=lambda name: 1.0,
    )  # fmt: skip
    parameter = SimpleNamespace(key=key, end_of=lambda value: "")
    space = SimpleNamespace(keys=(key,), parameters=(parameter,), warnings=())
    study = SimpleNamespace(objectives=("life_hours",), space=space)
    return SimpleNamespace(study=study, front=(best,), candidates=(best,), unchanged=best, settled=True)


@pytest.mark.parametrize("stop", ["elongation_percent", "chain"])
@pytest.mark.parametrize("key", ["sprocket.profile", "sprocket.2.seat_radius_mm"])
def test_a_search_for_a_form_says_so_too(key, stop):
    assert any(
        text.startswith("the chain ends first in 1 of 1") for text in optimise_warnings(outcome(key, stop))
    )


@pytest.mark.parametrize(
    ("key", "stop"),
    [("sprocket.profile", "critical_depth_mm"), ("sprocket.teeth", "chain"), ("chain.strands", "chain")],
)
def test_a_search_for_something_else_does_not(key, stop):
    assert not any("the chain ends first" in text for text in optimise_warnings(outcome(key, stop)))
