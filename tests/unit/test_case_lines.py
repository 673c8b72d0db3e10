"""Where a key stands in a TOML text; the expected lines are counted by hand."""

import pytest

from wearsim.input.faults import line_of

TABLES = """\
# comment
format_version = 1

[chain]   # comment
# designation = "no"
designation = "16B-1"
[material.sprocket]
name = "steel"
[load]

# power_kW = 1
speed_rpm = [
  1,
  2,
]
power_kW = 3
[material.roller]

name = "bronze"
"""

DOTTED = """\
title = '''
chain.designation = 0
'''
chain.designation = "16B-1"
load = { speed_rpm = 1, power_kW = 3 } # power_kW
"sprocket".'teeth' = 20
"""

EMPTY_AND_ARRAYS = """\
format_version = 1
[load]
# nothing
[[chain]]
designation = "16B-1"
[sprocket]
teeth = 20
"""


@pytest.mark.parametrize(
    ("text", "key", "line"),
    [
        (TABLES, "format_version", 2),
        (TABLES, "chain.designation", 6),
        (TABLES, "material.sprocket.name", 8),
        (TABLES, "material.roller.name", 19),
        (TABLES, "load.speed_rpm", 12),
        (TABLES, "load.power_kW", 16),
        (TABLES, "load.tension_N", 12),
        (TABLES, "material.roller.poissons_ratio", 19),
        (TABLES, "wear", 0),
        (TABLES, "wear.law", 0),
        (DOTTED, "chain.designation", 4),
        (DOTTED, "chain.pitch_mm", 4),
        (DOTTED, "load.power_kW", 5),
        (DOTTED, "load", 5),
        (DOTTED, "sprocket.teeth", 6),
        (EMPTY_AND_ARRAYS, "load", 2),
        (EMPTY_AND_ARRAYS, "load.speed_rpm", 2),
        (EMPTY_AND_ARRAYS, "chain", 4),
        (EMPTY_AND_ARRAYS, "sprocket.profile", 7),
        ("", "chain", 0),
    ],
)
def test_line_of_a_key(text, key, line):
    assert line_of(text, key) == line
