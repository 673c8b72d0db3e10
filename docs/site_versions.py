"""Build the pages as one version of a site: ``python docs/site_versions.py DIR``.

DIR/VERSION gets the pages, DIR/versions.js the list of all versions in DIR, and DIR/index.html leads to the
newest one. Any server of plain files can serve DIR.
"""

import json
import subprocess
import sys
from pathlib import Path

from packaging.version import InvalidVersion, Version

import wearsim

DOCS = Path(__file__).parent


def versions(site: Path) -> list[str]:
    """Names of the folders that hold a version, the newest first."""
    found = {}
    for page in site.glob("*/index.html"):
        try:
            found[page.parent.name] = Version(page.parent.name)
        except InvalidVersion:
            continue
    return sorted(found, key=found.__getitem__, reverse=True)


def write_root(site: Path) -> None:
    """Write what lies above the versions: their list, and the way to the newest release."""
    known = versions(site)
    newest = next((name for name in known if not Version(name).is_prerelease), known[0])
    (site / "versions.js").write_text(f"window.siteVersions = {json.dumps(known)};\n", "utf-8")
    (site / "index.html").write_text(
        '<!doctype html>\n<html lang="en">\n<meta charset="utf-8">\n<title>wearsim</title>\n'
        f'<meta http-equiv="refresh" content="0; url={newest}/index.html">\n'
        f'<p><a href="{newest}/index.html">wearsim {newest}</a></p>\n</html>\n',
        "utf-8",
    )


if __name__ == "__main__":
    site = Path(sys.argv[1])
    pages = site / wearsim.__version__
    doctrees = DOCS.parent / "build" / "doctrees"
    command = [
        sys.executable,
        "-m",
        "sphinx",
        "-q",
        "-W",
        "--keep-going",
        "-b",
        "html",
        "-d",
        doctrees,
        DOCS,
        pages,
    ]
    subprocess.run(command, check=True)
    write_root(site)
