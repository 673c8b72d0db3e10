"""Chains, materials and wear conditions against the standard's numbers."""

import pytest

from wearsim.catalogue.tables import chains, materials, nearest, rows, wear_conditions

# p, d1, b1 [mm] and tensile strength [kN] typed from ISO 606 (ANSI B29.1 for the A series).
ISO_606 = {
    "05B-1": (8.0, 5.0, 3.0, 4.4),
    "06B-1": (9.525, 6.35, 5.72, 8.9),
    "08B-1": (12.7, 8.51, 7.75, 17.8),
    "10B-1": (15.875, 10.16, 9.65, 22.2),
    "12B-1": (19.05, 12.07, 11.68, 28.9),
    "16B-1": (25.4, 15.88, 17.02, 60.0),
    "20B-1": (31.75, 19.05, 19.56, 95.0),
    "24B-1": (38.1, 25.4, 25.4, 160.0),
    "32B-1": (50.8, 29.21, 30.99, 250.0),
    "ANSI 25": (6.35, 3.3, 3.1, 3.5),
    "08A-1": (12.7, 7.92, 7.85, 13.9),
    "ANSI 50": (15.875, 10.16, 9.4, 21.8),
    "16A-1": (25.4, 15.88, 15.75, 55.6),
    "ANSI 240": (76.2, 47.63, 47.35, 500.0),
    "80H-1": (25.4, 15.88, 15.75, 55.6),
}


@pytest.mark.parametrize("designation", ISO_606)
def test_chain_of_the_standard(designation):
    chain = chains()[designation]
    pitch, roller, width, tensile = ISO_606[designation]
    assert (chain.pitch, chain.roller_diameter, chain.inner_width) == (pitch, roller, width)
    assert chain.tensile == pytest.approx(1000.0 * tensile)


def test_gost_names_with_strands():
    """GOST 13568: the digit before ПР counts the strands."""
    assert chains()["ПР-25,4-60"].strands == 1
    assert chains()["2ПР-25,4-114"].strands == 2
    assert chains()["3ПР-25,4-171"].strands == 3


@pytest.mark.parametrize(
    ("designation", "factor"),
    [("08B-1", 0.93), ("06B-1", 0.93), ("10B-1", 0.95), ("16B-1", 0.95)],
)
def test_face_width_of_a_single_chain(designation, factor):
    """ISO 606 rim width b_f1: 0.93 b1 up to p = 12.7 mm, 0.95 b1 above."""
    chain = chains()[designation]
    assert chain.face_width == pytest.approx(factor * ISO_606[designation][2], rel=1e-12)


@pytest.mark.parametrize(
    ("designation", "width"),
    [("2ПР-12,7-31,8", 2 * 0.91 * 7.75), ("3ПР-25,4-171", 3 * 0.93 * 15.88)],
)
def test_face_width_of_several_strands(designation, width):
    """ISO 606 for multiple chains: 0.91 b1 up to p = 12.7 mm, 0.93 b1 above, a strand each."""
    assert chains()[designation].face_width == pytest.approx(width, rel=1e-12)


@pytest.mark.parametrize("table", ["chains", "materials", "wear_conditions"])
def test_every_row_has_a_source(table):
    assert rows(table)
    assert all(row["source"].strip() for row in rows(table))


def test_no_name_stands_twice():
    names = [row["designation"] for row in rows("chains")]
    assert len(set(names)) == len(names) == 74


def test_chain_numbers_are_possible():
    for name, chain in chains().items():
        assert 0.0 < chain.roller_diameter < chain.pitch, name
        assert chain.inner_width > 0.0, name
        assert chain.tensile > 0.0, name


def test_flags_are_kept():
    assert "4.4 ISO / 5.0 DIN 8187" in chains()["05B-1"].flag
    assert chains()["10B-1"].flag == ""


def test_materials():
    assert (materials()["steel"].youngs_modulus, materials()["steel"].poissons_ratio) == (
        2.1e5,
        0.3,
    )
    assert all(-1.0 < material.poissons_ratio < 0.5 for material in materials().values())


def test_wear_conditions_are_bands_around_a_typical_value():
    assert wear_conditions()["hardened, oiled"].typical == 5e-11
    for condition in wear_conditions().values():
        assert 0.0 < condition.low < condition.typical < condition.high


@pytest.mark.parametrize(
    ("name", "hint"),
    [
        ("16B", "; did you mean '16B-1'?"),
        ("ansi 50", "; did you mean 'ANSI 50'"),
        ("completely different", ""),
        ("", ""),
    ],
)
def test_nearest_names(name, hint):
    assert nearest(name, dict(chains())).startswith(hint)
    assert bool(nearest(name, dict(chains()))) is bool(hint)
