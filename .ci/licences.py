"""Prints the licence of all that the container holds; fails where one does not permit use beside MIT."""

import re
import sys
from importlib import metadata
from pathlib import Path

LOCK = Path(__file__).parents[1] / "packaging" / "container.lock"

PERMITTED = re.compile(
    r"MIT|BSD|0BSD|Apache|PSF|Python Software Foundation|ISC|Zlib|CC0|HPND|MPL-2\.0|MPL 2\.0|Unlicense"
)
"""Licences that permit use beside the MIT licence, by name; the GPL and the LGPL are none of them."""


def licence(package: metadata.PackageMetadata) -> str:
    """Return the licence that a package states: expression, classifiers, or its first line of text."""
    if expression := package.get("License-Expression"):
        return expression
    classifiers = package.get_all("Classifier", [])
    named = [one.split(" :: ")[-1] for one in classifiers if one.startswith("License :: OSI Approved :: ")]
    return ", ".join(named) or next(iter((package.get("License") or "none").splitlines()), "none")


def is_permitted(stated: str) -> bool:
    """Whether each licence is permitted that must be kept: of alternatives one."""
    needed = re.split(r", | AND ", stated.replace("(", "").replace(")", ""))
    return all(any(PERMITTED.search(one) for one in each.split(" OR ")) for each in needed)


def main() -> None:
    """Print the table."""
    refused = 0
    for name in sorted(set(re.findall(r"^([\w.-]+)==", LOCK.read_text("utf-8"), re.MULTILINE))):
        try:
            package = metadata.metadata(name)
        except metadata.PackageNotFoundError:
            print(f"{name:20} not installed here")
            continue
        stated = licence(package)
        note = "" if is_permitted(stated) else "  NOT PERMITTED"
        refused += bool(note)
        print(f"{name:20} {stated}{note}")
    sys.exit(bool(refused))


if __name__ == "__main__":
    main()
