"""How well `wearsim scan` measures rendered photographs: writes reports/reference/scan.md.

Call it with the number of pictures; each has a seed of its own, so that more of them begin with the same.
"""

import math
import sys
import tempfile
import time
from collections import Counter
from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any

import numpy as np

import wearsim
from wearsim.report.flank_view import flanks

ROOT = Path(__file__).resolve().parents[1]
sys.path.insert(0, str(ROOT / "tests"))

from photographs import (  # noqa: E402
    Camera,
    Points,
    chain_on,
    new_gap,
    picture,
    random_camera,
    wheel,
    with_pocket,
    with_worn_tips,
)

PAGE = ROOT / "reports" / "reference" / "scan.md"
SEEDS, EVERY = 500, 10
FORMS = (
    ("08B", 12.7, 8.51, "iso606"),
    ("ANSI 40", 12.7, 7.92, "ansi_b29"),
    ("16B", 25.4, 15.88, "iso606"),
    ("ПР-25,4-60", 25.4, 15.88, "gost591"),
)
LEAST_WIDTH, PIXELS_A_TOOTH = 700, 30
CASE = "08b-19t-wrap"
POCKET, BY_WEARSIM, CHAIN, EVOLUTE, BOTH, TIPS, CUT = (
    "a pocket in a standard form",
    f"worn by wearsim (`{CASE}`)",
    "a chain on a part of the rim",
    "a pocket in an evolute form, asymmetric",
    "both flanks worn",
    "worn tips too",
    "cut off by the picture",
)
KINDS_OF = (CHAIN, EVOLUTE, BOTH, TIPS, BY_WEARSIM, CUT, *[POCKET] * 3, BY_WEARSIM)
KINDS_OF += (*[POCKET] * 4, BY_WEARSIM) * 2
"""Of 20 pictures."""


@dataclass(frozen=True)
class Trial:
    """A picture, and what `wearsim scan` said of it."""

    camera: Camera
    depth: float  # true one [mm]
    left: bool  # whether the flank that faces clockwise in the picture is worn
    kind: str
    refusal: str = ""
    counted: bool = True  # whether the teeth were
    found: float = math.nan  # [mm]
    error: float = math.nan  # its standard error [mm]
    scale: float = math.nan  # [px/mm]
    side: bool = True  # whether the worn flank was found
    warned: bool = False
    seconds: float = math.nan

    @property
    def off(self) -> float:
        """Error of the depth [px]."""
        return (self.found - self.depth) * self.scale

    @property
    def over(self) -> float:
        """Error of the depth over its standard error."""
        return (self.found - self.depth) / self.error


def pocketed(rng: np.random.Generator, new: Points, pitch: float, kind: str) -> tuple[Points, float]:
    """Return a gap whose left side is worn, and often a little its right one, with the depth [mm]."""
    depth = 0.0 if rng.random() < 0.1 else pitch * rng.uniform(0.003, 0.04)
    gap = with_pocket(new, depth, rng.uniform(0.62, 0.8), 0.17)
    other = rng.uniform(0.6, 0.9) if kind == BOTH else 0.15
    if kind == BOTH or rng.random() < 0.6:
        gap = with_pocket(mirrored(gap), other * depth, 0.7, 0.17 if kind == BOTH else 0.1)
        gap = mirrored(gap)
    return with_worn_tips(gap, rng.uniform(0.01, 0.04) * pitch) if kind == TIPS else gap, depth


def mirrored(gap: Points) -> Points:
    """Return a gap as it is seen from the other side of the wheel."""
    return gap[::-1] * [-1.0, 1.0]


def evolute_wheel(teeth: int) -> tuple[wearsim.Case, Points]:
    """Return a case with an asymmetric form, and its gap [mm]."""
    settings = {"sprocket.profile": "evolute", "sprocket.teeth": teeth}
    case = wearsim.load_case(ROOT / "cases" / f"{CASE}.toml").with_(settings)
    return case, np.column_stack([case.drive.outline.x, case.drive.outline.y])


def worn_by_wearsim() -> Callable[[np.random.Generator], tuple[Points, float]]:
    """Return what draws a gap of a life of `08b-19t-wrap` at any time."""
    result = wearsim.simulate(wearsim.load_case(ROOT / "cases" / "08b-19t-wrap.toml"))
    last = result.flank_columns["cycles"]
    count = np.unique(last).size

    def drawn(rng: np.random.Generator) -> tuple[Points, float]:
        columns = flanks(result, int(rng.integers(1, count)))
        return np.column_stack([columns["x_mm"], columns["y_mm"]]), float(columns["depth_mm"].max())

    return drawn


def trial(seed: int, of_wearsim: Callable[[np.random.Generator], tuple[Points, float]]) -> Trial:
    """Photograph a wheel and measure it."""
    rng = np.random.default_rng(seed)
    chain, pitch, roller, form = FORMS[(seed + seed // len(KINDS_OF)) % len(FORMS)]
    teeth, kind = int(rng.integers(9, 61)), KINDS_OF[seed % len(KINDS_OF)]
    form_of: dict[str, Any] = {"chain": chain, "profile": form}
    if kind == BY_WEARSIM:
        teeth, form_of = 19, {"chain": FORMS[0][0], "profile": FORMS[0][3]}
        gap, depth = of_wearsim(rng)
    elif kind == EVOLUTE:
        pitch, teeth = FORMS[0][1], int(rng.integers(15, 31))
        case, new = evolute_wheel(teeth)
        form_of = {"case": case}
        gap, depth = pocketed(rng, new, pitch, kind)
    else:
        gap, depth = pocketed(rng, new_gap(pitch, roller, teeth, form), pitch, kind)
    left = bool(rng.integers(2))
    gap = gap if left else mirrored(gap)
    width = max(LEAST_WIDTH, PIXELS_A_TOOTH * teeth)
    camera = random_camera(rng, (width, 3 * width // 4))
    if kind == CUT:
        camera = replace(camera, centre=(0.5, rng.uniform(0.0, 0.48 * camera.wheel)))
    links = int(rng.integers(2, max(3, teeth // 2)))
    on_it = chain_on(pitch, roller, teeth, links) if kind == CHAIN else ()
    start = Trial(camera, depth, left != camera.mirror, kind)
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder) / "wheel.png"
        picture(wheel([gap] * teeth), camera, on_it).save(path)
        return measured(start, path, form_of, teeth)


def measured(start: Trial, path: Path, form_of: dict[str, Any], teeth: int) -> Trial:
    """Return what is said of a picture."""
    begin = time.process_time()
    try:
        found = wearsim.scan(path, **form_of)
    except wearsim.CaseError as error:
        return replace(start, refusal=str(error).partition(": ")[2].partition(",")[0])
    depths, content = found.found.depths, found.summary()
    return replace(
        start,
        counted=content["teeth"] == teeth,
        found=found.depth,
        error=found.depth_error,
        scale=content["scale_px_per_mm"],
        side=not content["is_worn"] or start.left == (depths.facing == "clockwise"),
        warned=bool(found.warnings),
        seconds=time.process_time() - begin,
    )


def row(name: str, trials: Sequence[Trial]) -> str:
    """Return the row of a group of pictures."""
    held = [one for one in trials if not one.refusal and one.counted]
    if not held:
        return f"| {name} | {len(trials)} | 0 | {len(trials)} | | | | | | | | |"
    off, over = np.array([one.off for one in held]), np.array([one.over for one in held])
    silent = sum(not one.warned and (abs(one.over) > 3.0 or not one.side) for one in held)
    cells = (
        name,
        len(trials),
        len(held),
        sum(bool(one.refusal) for one in trials),
        f"{np.sqrt(np.mean(off**2)):.3f}",
        f"{np.sqrt(np.mean([(one.found - one.depth) ** 2 for one in held])):.4f}",
        f"{off.mean():+.3f}",
        f"{np.abs(off).max():.2f}",
        f"{100 * np.mean(np.abs(over) < 1.0):.0f} %",
        f"{100 * np.mean(np.abs(over) < 1.96):.0f} %",
        sum(one.warned for one in held),
        silent,
    )
    return "| " + " | ".join(map(str, cells)) + " |"


def page(trials: Sequence[Trial]) -> str:
    """Return the page."""
    wrong = sum(not one.counted for one in trials)
    groups = {
        "all": trials,
        "all without a warning": [one for one in trials if not one.warned],
        **{kind: [one for one in trials if one.kind == kind] for kind in dict.fromkeys(KINDS_OF)},
        "not worn": [one for one in trials if one.depth == 0.0],
        "coded as sRGB": [one for one in trials if not one.camera.gamma],
        "tone curve of an exponent below 2.2": [
            one for one in trials if 0.0 < (one.camera.gamma or 0.0) < 2.2
        ],
        "tone curve of an exponent above 2.2": [one for one in trials if (one.camera.gamma or 0.0) >= 2.2],
        "light uneven by less than 20 %": [one for one in trials if one.camera.uneven < 0.2],
        "light uneven by 20 to 40 %": [one for one in trials if one.camera.uneven >= 0.2],
        "blur below 1.3 px": [one for one in trials if one.camera.blur < 1.3],
        "blur from 1.3 to 2 px": [one for one in trials if one.camera.blur >= 1.3],
        "tilted by less than 3 degrees": [one for one in trials if abs(one.camera.tilt) < math.radians(3.0)],
        "tilted by more": [one for one in trials if abs(one.camera.tilt) >= math.radians(3.0)],
        "with a bright rim": [one for one in trials if one.camera.shine],
    }
    refusals = Counter(one.refusal for one in trials if one.refusal)
    seconds = np.nanmedian([one.seconds for one in trials])
    lines = [
        "# wearsim scan on rendered photographs",
        "",
        f"{len(trials)} random pictures, by `python research/scan_photographs.py {len(trials)}`: ISO 606,",
        "ANSI B29.1 and GOST 591, 9 to 60 teeth, 700 to 1800 pixels wide, with tilt, perspective, a lens,",
        "blur, noise, JPEG, uneven light, dirt, bright rims, mirrored. The renderer, `tests/photographs.py`,",
        "shares no code with the scan. Errors are those of the depth, in pixels of the picture and in mm (of",
        "pictures with 20 to 80 pixels to a pitch); their mean is the bias. A silent one is off by more than",
        "three standard errors, or on the wrong flank, without a warning. Of both worn flanks the deeper",
        "counts.",
        "",
        f"Teeth counted wrong: {wrong}. Median time: {seconds:.1f} s on one core.",
        "",
        "| pictures | number | measured | refused | rms, px | rms, mm | mean, px | largest, px "
        "| within 1 se (68 %) | within 1.96 se (95 %) | warned | silent |",
        "|---|---|---|---|---|---|---|---|---|---|---|---|",
        *(row(name, group) for name, group in groups.items()),
        "",
        "Refused:",
        "",
        *(f"- {count} times: {text}" for text, count in refusals.most_common()),
    ]
    return "\n".join(lines) + "\n"


def main() -> None:
    """Run the pictures, and write the page every now and then."""
    count = int(sys.argv[1]) if len(sys.argv) > 1 else SEEDS
    of_wearsim, trials = worn_by_wearsim(), []
    for seed in range(count):
        trials.append(trial(seed, of_wearsim))
        if (seed + 1) % EVERY == 0 or seed + 1 == count:
            PAGE.write_text(page(trials), encoding="utf-8", newline="\n")


if __name__ == "__main__":
    main()
