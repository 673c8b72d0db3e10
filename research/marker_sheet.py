"""How well `wearsim scan` measures on its marker sheet: writes reports/reference/marker_sheet.md.

A chain lies beside each wheel. Call it with the number of rendered pictures; each has a seed of its own.
"""

import math
import sys
import tempfile
from collections import Counter
from concurrent.futures import ProcessPoolExecutor
from dataclasses import dataclass
from pathlib import Path

import numpy as np
from PIL import ExifTags, Image

import wearsim
from wearsim.scanning.marker_page import marker_page

ROOT = Path(__file__).resolve().parents[1]
sys.path.insert(0, str(ROOT / "tests"))

import photographs  # noqa: E402
from photographs import Camera, Print, new_gap, photographed, picture, wheel, with_pocket  # noqa: E402

PAGE = ROOT / "reports" / "reference" / "marker_sheet.md"
PITCH, ROLLER, THICKNESS = 12.7, 8.51, 7.2
SIZE, SCALE = (1050, 1200), 3.9
ORIGIN = np.array([105.0, 175.0])
PLATE, WIDTH = 11.8, 17.0
"""Height of the plates of a chain 08B and its width over the pins [mm]."""


@dataclass(frozen=True)
class Trial:
    """Errors of a picture, each over the truth or its standard error."""

    noted: bool  # whether the picture holds the focal length
    tilt: float  # [degrees]
    refusal: str = ""
    warned: bool = False
    scale: float = math.nan  # relative
    scale_over: float = math.nan
    tilt_off: float = math.nan  # [degrees]
    tilt_over: float = math.nan
    height: float = math.nan  # relative
    height_over: float = math.nan
    depth: float = math.nan  # [px]
    depth_over: float = math.nan
    chain: float = math.nan  # [% of elongation]
    chain_over: float = math.nan
    without: str = ""  # why the chain is not measured


def trial(seed: int, sheet: Path) -> Trial:
    """Photograph a wheel on the sheet and measure it."""
    rng = np.random.default_rng(seed)
    teeth, depth = int(rng.integers(11, 32)), 0.0 if seed % 10 == 0 else rng.uniform(0.05, 0.4)
    outline = wheel([with_pocket(new_gap(PITCH, ROLLER, teeth), depth)] * teeth)
    radius = float(np.hypot(*outline.T).max())
    away, chamfer = rng.uniform(400.0, 1200.0), rng.uniform(0.0, 0.25) * THICKNESS
    stretch = 1.0 + 0.002 * rng.standard_normal()
    printed = Print.of(
        sheet, stretch, at=tuple(ORIGIN + rng.uniform(-5.0, 5.0, 2)), turn=rng.uniform(-0.3, 0.3)
    )
    camera = Camera(
        size=SIZE,
        wheel=2.0 * radius * SCALE / min(SIZE),
        distance=away / (2.0 * radius),
        edges=(chamfer, THICKNESS - chamfer),
        printed=printed,
        tilt=math.radians(rng.uniform(0.0, 12.0)),
        tilt_direction=rng.uniform(0.0, math.tau),
        turn=rng.uniform(0.0, math.tau),
        distortion=rng.normal(0.0, 0.015),
        wheel_light=rng.uniform(0.02, 0.15),
        ground_light=rng.uniform(0.45, 0.85),
        blur=rng.uniform(0.6, 1.4),
        noise=rng.uniform(0.002, 0.02),
        uneven=rng.uniform(0.0, 0.4),
        gamma=rng.uniform(1.8, 2.6) if rng.random() < 0.3 else None,
        seed=seed,
    )
    exif = Image.Exif()
    if noted := seed % 2 == 0:
        full_frame = SCALE * away * math.hypot(24.0, 36.0) / math.hypot(*SIZE)
        exif[ExifTags.IFD.Exif] = {ExifTags.Base.FocalLengthIn35mmFilm: round(full_frame)}
    path = sheet.parent / f"wheel{seed}.jpg"
    quality, links, elongation = int(rng.integers(80, 98)), int(rng.choice([8, 12])), rng.uniform(0.0, 3.5)
    # As it lies on the page, whichever way the wheel is turned on it.
    start = np.array([rng.uniform(-112.0, -104.0), -84.0])
    cos, sin = math.cos(camera.turn), math.sin(camera.turn)
    start = np.array([[cos, sin], [-sin, cos]]) @ start
    upright = 0.5 * math.pi + rng.normal(0.0, 0.02) - camera.turn
    faces, pins = photographs.chain_beside(
        PITCH, PLATE, WIDTH, links + 3, tuple(start), upright, elongation, rng.normal(0.0, 0.5)
    )
    ends, _ = photographed(pins[[1, -3]], radius, camera, 0.95 * WIDTH)
    ends = ends + rng.normal(0.0, 2.5, ends.shape)
    picture(outline, camera, beside=faces).save(path, exif=exif, quality=quality)
    width = WIDTH + rng.normal(0.0, 0.1)
    found = measured(path, camera, radius, depth, noted, ((*ends.ravel(), links), width, elongation))
    path.unlink()
    return found


def measured(
    path: Path,
    camera: Camera,
    radius: float,
    depth: float,
    noted: bool,
    beside_it: tuple[tuple[float, ...], float, float],
) -> Trial:
    """Return what is said of a picture."""
    degrees = math.degrees(camera.tilt)
    beside, width, elongation = beside_it
    without = ""
    try:
        try:
            answer = wearsim.scan(path, chain="08B", chain_beside=beside, chain_width=width)
        except (wearsim.CaseError, wearsim.GeometryError) as error:
            without = str(error).partition(": ")[2].partition(",")[0]
            answer = wearsim.scan(path, chain="08B")
    except wearsim.CaseError as error:
        return Trial(noted, degrees, str(error).partition(": ")[2].partition(",")[0])
    place, sheet = answer.found.depths.place, answer.found.sheet
    if sheet is None or place.known is None:
        return Trial(noted, degrees, "no sheet found")
    ends = 0.1 * np.array([[0.0, 0.0], [1.0, 0.0], [0.0, 1.0]])
    seen, _ = photographed(ends, radius, camera, 0.5 * THICKNESS)
    chain = answer.found.chain
    longer = math.nan if chain is None else chain.elongation - elongation
    true = 10.0 * math.sqrt(abs(np.linalg.det(seen[1:] - seen[0])))
    away = 2.0 * radius * camera.distance * math.cos(camera.tilt)
    return Trial(
        noted,
        degrees,
        warned=bool(answer.warnings),
        scale=place.known.scale / true - 1.0,
        scale_over=(place.known.scale / true - 1.0) / place.known.error,
        tilt_off=math.degrees(sheet.camera.tilt) - degrees,
        tilt_over=(sheet.camera.tilt - camera.tilt) / sheet.camera.tilt_error,
        height=sheet.height / away - 1.0,
        height_over=math.log(sheet.height / away) / sheet.camera.height_error,
        depth=(answer.depth - depth) * place.scale,
        depth_over=(answer.depth - depth) / answer.depth_error,
        chain=longer,
        chain_over=math.nan if chain is None else longer / chain.elongation_error,
        without=without,
    )


QUANTITIES = {
    "scale, %": ("scale", 100.0),
    "tilt, degrees": ("tilt_off", 1.0),
    "height, %": ("height", 100.0),
    "depth, px": ("depth", 1.0),
    "elongation, %": ("chain", 1.0),
}


def rows(name: str, trials: list[Trial]) -> list[str]:
    """Return the rows of a group of pictures."""
    found = []
    for quantity, (key, factor) in QUANTITIES.items():
        off = factor * np.array([getattr(one, key) for one in trials])
        over = np.abs([getattr(one, f"{key.removesuffix('_off')}_over") for one in trials])
        off, over = off[np.isfinite(off)], over[np.isfinite(off)]
        if not off.size:
            continue
        cells = (
            name,
            off.size,
            quantity,
            f"{np.sqrt(np.mean(off**2)):.3f}",
            f"{off.mean():+.3f}",
            f"{np.abs(off).max():.3f}",
            f"{100 * np.mean(over < 1.0):.0f} %",
            f"{100 * np.mean(over < 1.96):.0f} %",
        )
        found.append("| " + " | ".join(map(str, cells)) + " |")
    return found


def page(trials: list[Trial]) -> str:
    """Return the page."""
    held = [one for one in trials if not one.refusal]
    groups = {
        "all": held,
        "focal length in the file": [one for one in held if one.noted],
        "not in the file": [one for one in held if not one.noted],
        "tilted by less than 6 degrees": [one for one in held if one.tilt < 6.0],
        "by 6 to 12 degrees": [one for one in held if one.tilt >= 6.0],
    }
    refusals = Counter(one.refusal for one in trials if one.refusal)
    chains = Counter(one.without for one in held if one.without)
    silent = sum(not one.warned and (abs(one.depth_over) > 3.0 or abs(one.chain_over) > 3.0) for one in held)
    lines = [
        "# wearsim scan on its marker sheet",
        "",
        f"{len(trials)} random pictures, by `python research/marker_sheet.py {len(trials)}`:",
        "sprockets for 08B of 11 to 31 teeth, 7.2 mm thick with chamfers of up to a quarter, on the A4 sheet",
        "as its PNG file shows it, stretched by 0.2 % (standard deviation); 1050 x 1200 pixels, 400 to 1200",
        "mm away, tilted by up to 12 degrees, with a lens, blur, noise, JPEG and uneven light. Beside each",
        "lies a chain 08B, 17 mm wide over the pins (given to 0.1 mm); 8 or 12 links of it are measured.",
        "The renderer is `tests/photographs.py`.",
        "",
        f"Measured: {len(held)}. Depths or elongations off by more than three standard errors without a",
        f"warning: {silent}.",
        "",
        "| pictures | number | error of | rms | mean | largest | within 1 se (68 %) | in 1.96 se (95 %) |",
        "|---|---|---|---|---|---|---|---|",
        *(line for name, group in groups.items() if group for line in rows(name, group)),
        *(f"\nRefused {count} times: {text}" for text, count in refusals.most_common()),
        *(f"\nChain not measured {count} times: {text}" for text, count in chains.most_common()),
    ]
    return "\n".join(lines) + "\n"


def main() -> None:
    """Run the pictures, and write the page."""
    count = int(sys.argv[1]) if len(sys.argv) > 1 else 100
    with tempfile.TemporaryDirectory() as folder:
        sheet = Path(folder) / "sheet.png"
        sheet.write_bytes(marker_page("a4", "png"))
        with ProcessPoolExecutor() as pool:
            trials = list(pool.map(trial, range(count), [sheet] * count))
    for seed, one in enumerate(trials):
        if abs(one.depth_over) > 3.0 or abs(one.chain_over) > 3.0:
            print(seed, one)
    PAGE.write_text(page(trials), encoding="utf-8", newline="\n")


if __name__ == "__main__":
    main()
