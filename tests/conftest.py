"""What tests of all folders share."""

import pytest

from wearsim.case.messages import known_keys


@pytest.fixture(scope="session")
def leaves():
    """Function that lists the dotted keys of a model that are no tables."""

    def keys(model):
        names = known_keys(model)
        return [name for name in names if not any(other.startswith(f"{name}.") for other in names)]

    return keys
