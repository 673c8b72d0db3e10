"""What is said of the sprockets of a drive, each once with the names of those that it is about."""

from collections.abc import Mapping, Sequence

from wearsim.drive.wheels import DriveWheel
from wearsim.quantities import kind_of_text, with_ranges


def said_of_sprockets(texts: Mapping[str, Sequence[str]], wheels: Sequence[DriveWheel]) -> tuple[str, ...]:
    """Return texts about single sprockets, by their names, with those names but where it is all of them.

    What cogs of one cassette differ in by numbers alone is one text, with the range of these numbers.
    """
    found: dict[str, list[str]] = {}
    about: dict[str, int] = {}
    for wheel in wheels:
        for text, parts in _of_wheel([part for part in wheel.parts if part in texts], texts):
            found.setdefault(text, []).append(_called(wheel, parts))
            about[text] = about.get(text, 0) + len(parts)
    return tuple(
        text if about[text] == len(texts) else f"{', '.join(names)}: {text}" for text, names in found.items()
    )


def _of_wheel(parts: Sequence[str], texts: Mapping[str, Sequence[str]]) -> list[tuple[str, list[str]]]:
    """Return what is said of a wheel, with the parts of it that it is said of."""
    kinds: dict[tuple[str, int], list[tuple[str, str]]] = {}
    for part in parts:
        count: dict[str, int] = {}
        for text in texts[part]:
            kind = kind_of_text(text)
            count[kind] = count.get(kind, 0) + 1
            kinds.setdefault((kind, count[kind]), []).append((part, text))
    return [(with_ranges([text for _, text in said]), [part for part, _ in said]) for said in kinds.values()]


def _called(wheel: DriveWheel, parts: Sequence[str]) -> str:
    """Return the name of a wheel, with the cogs of a cassette where it is not all of them."""
    if len(parts) == len(wheel.parts):
        return wheel.name
    return f"{wheel.name} {', '.join(part.removeprefix(f'{wheel.name} ') for part in parts)}"
