"""Names of chains as people type them: read, or led to chains of the catalogue or to dimensions."""

import re
from functools import cache

from wearsim.catalogue.catalogues import MOST_STRANDS, Chain, catalogue_rows, chains

_INCH = 25.4


def chain_name(typed: str) -> str | None:
    """Return the name of the catalogue that a typed designation stands for.

    Examples
    --------
    >>> chain_name("08b"), chain_name("RS40"), chain_name("80-1"), chain_name("40")
    ('08B', 'ANSI 40', 'ANSI 80-1', None)
    """
    if typed in chains():
        return typed
    plain = _plain(typed)
    # A number and its strands is how ANSI writes it; no other series leaves the letter out.
    likely = (plain, f"ANSI{plain}") if re.fullmatch(r"\d{2,3}-\d", plain) else (plain,)
    return next((_spellings()[name] for name in likely if name in _spellings()), None)


def known_chain_name(typed: str) -> str:
    """Return the name of the catalogue that a typed designation stands for; raise ValueError for none."""
    name = chain_name(typed)
    if name:
        return name
    raise ValueError(f"no such chain in the catalogue{what_is_meant(typed)}")


def name_of_strands(name: str, strands: int) -> str | None:
    """Return the chain of so many strands of a single one, None where there is none.

    Examples
    --------
    >>> name_of_strands("ANSI 80", 4), name_of_strands("ПР-25,4-60", 2), name_of_strands("16B", 4)
    ('ANSI 80-4', '2ПР-25,4-114', None)
    """
    several = f"{name.removesuffix('-1')}-{strands}"
    if several in chains():
        return several
    single = chains()[name]
    same = (
        chain.designation
        for chain in chains().values()
        if chain.strands == strands and chain.series == single.series
        if (chain.pitch, chain.inner_width) == (single.pitch, single.inner_width)
    )
    return next(same, None)


def strands_there_are(name: str, wanted: int) -> str:
    """Return how many strands the catalogue has of a single chain, and what to give for more.

    Examples
    --------
    >>> strands_there_are("16B", 4)[:56]
    '16B has up to 3 strands there. In [chain] of a case give'
    """
    single = chains()[name]
    most = max(count for count in range(1, MOST_STRANDS + 1) if name_of_strands(name, count))
    has = f"{_short(single)} has {'one strand' if most == 1 else f'up to {most} strands'} there"
    if wanted > MOST_STRANDS:
        return f"{has}, and the ratings know up to {MOST_STRANDS}"
    return f"{has}. {_dimensions(_sizes(single, single.pitch))}, and strands = {wanted}"


_OWN = "pitch_mm, roller_diameter_mm and inner_width_mm"


def what_is_meant(typed: str) -> str:
    """Return what a name that is none may stand for, and what to give.

    Examples
    --------
    >>> what_is_meant("520")[:76]
    ': 520 is a motorcycle chain. In [chain] of a case give pitch_mm = 15.875, ro'
    >>> what_is_meant("16B-4")[:76]
    ': 16B has up to 3 strands there. In [chain] of a case give pitch_mm = 25.4, '
    """
    plain = _plain(typed)
    told = _trade_chain(plain) or _double_pitch(plain) or _more_strands(plain)
    if told:
        return f": {told}"
    other = f"for another chain give {_OWN} in [chain] of a case in place of the designation"
    return f"{nearest_chain(typed)} (wearsim list chains shows them all; {other})"


def nearest_chain(typed: str) -> str:
    """Return a hint at the chains that a designation that is none may mean: by its spelling, or its pitch.

    Examples
    --------
    >>> nearest_chain("8B")
    "; did you mean '08B' (pitch 12.7 mm)?"
    >>> nearest_chain("16X")
    "; did you mean '16B' or '16A' or '80H' (pitch 25.4 mm)?"
    """
    by_pitch: dict[float, list[str]] = {}
    for name in _spelled_alike(_plain(typed)) or _of_its_pitch(_plain(typed)):
        by_pitch.setdefault(chains()[name].pitch, []).append(repr(name))
    shown = (f"{' or '.join(names)} (pitch {pitch:g} mm)" for pitch, names in by_pitch.items())
    return f"; did you mean {' or '.join(shown)}?" if by_pitch else ""


@cache
def _spellings() -> dict[str, str]:
    return {_plain(name): name for name in chains()}


_PREFIXES = (
    (r"^(ISO[\s-]*606|DIN[\s-]*818[78]|GOST[\s-]*13568|ГОСТ[\s-]*13568)[\s:,-]+(?=.)", ""),
    (r"^(ANSI|ASA|RS)?[\s-]*(#|№|NO\.?)\s*(?=\d)", "ANSI"),
    (r"^(ASA|RS)[\s-]*(?=\d)", "ANSI"),
    (r"^ANSI[\s-]*(?=\d+[\s-]*H)", ""),
)
"""What stands before a number, and what for: `RS` is how makers write the chains of ANSI."""


def _plain(name: str) -> str:
    """Return a designation in capitals, its parts apart only where digits meet."""
    text = name.strip().upper()
    for before, meant in _PREFIXES:
        text = re.sub(before, meant, text)
    text = re.sub(r"[\s\u2010-\u2015/-]+", "-", text.replace(".", ","))
    return re.sub(r"(?<!\d)-|-(?!\d)", "", text)


def _spelled_alike(plain: str) -> list[str]:
    """Return the chains whose names differ by no more than a zero, the letter of the series or ANSI."""
    number = plain.removeprefix("ANSI")
    likely = [f"ANSI{number}"]
    likely += [f"{zero}{number}{series}" for zero in ("", "0") for series in ("", *"ABCH")]
    return [_spellings()[name] for name in likely if name in _spellings()]


def _of_its_pitch(plain: str) -> list[str]:
    """Return the chains of the pitch that a number stands for, by the rules of GOST, ISO 606 and ANSI."""
    gost = "ПР" in plain
    strands = re.match(r"(\d)ПР", plain) if gost else re.search(r"(?:-|[A-Z])([2-6])$", plain)
    count = int(strands[1]) if strands else 1
    every = {chain.designation: chain for chain in chains().values() if chain.strands == count}
    for pitch in _pitches(plain):
        found = [
            _short(chain)
            for chain in every.values()
            if abs(chain.pitch - pitch) < 0.01 and gost == (chain.series == "GOST13568")
        ]
        if found:
            return found
    return []


def _short(chain: Chain) -> str:
    return chain.designation if chain.series == "GOST13568" else chain.designation.removesuffix("-1")


def _pitches(plain: str) -> list[float]:
    """Return the pitches that the first number of a designation may stand for [mm]."""
    number = re.search(r"\d+(,\d+)?", re.sub(r"^\dПР", "ПР", plain))
    if number is None:
        return []
    if "ПР" in plain or "," in number[0]:
        return [float(number[0].replace(",", "."))]
    sixteenths, eighths = int(number[0]), int(number[0]) // 10
    return [_INCH * sixteenths / 16.0, _INCH * eighths / 8.0] if sixteenths > _METRIC else []


_METRIC = 5
"""Number of the largest chain whose pitch is in whole millimetres: 05B has 8 mm."""


def _more_strands(plain: str) -> str:
    """Return what to give for more strands than the catalogue has of a chain; empty for another name."""
    parts = re.fullmatch(r"(.+?)-?([2-9])", plain)
    base = parts and (chain_name(parts[1]) or chain_name(f"ANSI{parts[1]}"))
    if not parts or not base or chains()[base].strands > 1 or chains()[base].series == "GOST13568":
        return ""
    return strands_there_are(base, int(parts[2]))


def _trade_chain(plain: str) -> str:
    """Return what to give for a chain of motorcycles and karts; empty for another name."""
    number = re.fullmatch(r"[A-Z]{0,4}(\d{3})([A-Z].*)?", plain)
    for row in catalogue_rows("trade_chains"):
        if number and row["name"] == number[1]:
            return f"{row['name']} is a {row['kind']} chain. {_dimensions(row)}"
    return ""


def _sizes(chain: Chain, pitch: float) -> dict[str, str]:
    return {
        "pitch_mm": f"{pitch:g}",
        "roller_diameter_mm": f"{chain.roller_diameter:g}",
        "inner_width_mm": f"{chain.inner_width:g}",
    }


def _dimensions(row: dict[str, str]) -> str:
    """Return which dimensions to give in place of a designation, with those that are known."""
    keys = ("pitch_mm", "roller_diameter_mm", "inner_width_mm")
    known = [f"{key} = {row[key]}" for key in keys if row[key]]
    rest = [key for key in keys if not row[key]]
    maker = f", and {' and '.join(rest)} as its maker has," if rest else " (or what its maker has)"
    return f"In [chain] of a case give {', '.join(known)}{maker} in place of the designation"


_DOUBLE_ANSI = re.compile(r"(?:ANSI)?[A-Z]{0,2}2(\d\d)([02])H?")
_DOUBLE_ISO = re.compile(r"C?2(\d\d[AB])(L?)H?(L?)")


def _double_pitch(plain: str) -> str:
    """Return what to give for a chain of double pitch; empty for another name.

    ISO 1275: pins, bushes, rollers and inner width of the chain of ISO 606, links of twice its pitch.
    """
    plain = re.sub(r"(?<=[A-Z])1$|-1$", "", plain)
    if found := _DOUBLE_ANSI.fullmatch(plain):
        base, large = f"ANSI {int(found[1])}0", found[2] == "2"
    elif found := _DOUBLE_ISO.fullmatch(plain):
        base, large = found[1], bool(found[2] or found[3])
    else:
        return ""
    if base not in chains():
        return ""
    row = _sizes(chains()[base], 2.0 * chains()[base].pitch)
    if large:
        row["roller_diameter_mm"] = ""
    rollers = ", with large rollers" if large else ""
    return (
        f"{plain} is the double-pitch chain of {base} (ISO 1275), no chain of ISO 606{rollers}. "
        f"{_dimensions(row)}; its sprockets have the teeth of ISO 1275"
    )
