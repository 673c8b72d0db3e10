"""Fail on a skip or xfail of a pytest run that tests/expected_skips.txt does not name."""

import re
import sys
from pathlib import Path

log = Path(sys.argv[1]).read_text(encoding="utf-8")
expected = [
    line.split("#")[0].strip()
    for line in Path("tests/expected_skips.txt").read_text(encoding="utf-8").splitlines()
]
named = [name for name in expected if name]
found = re.findall(r"^(?:SKIPPED|XFAIL|XPASS)\b.*$", log, flags=re.MULTILINE)
silent = [line for line in found if not any(name in line for name in named)]
print("\n".join(f"unexpected: {line}" for line in silent) or f"{len(found)} skips, all expected")
sys.exit(1 if silent else 0)
