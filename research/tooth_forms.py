"""Which tooth form lives longest: the worked drives with every form, and on both pictures.

Run from a checkout with ``python research/tooth_forms.py`` (some minutes); it writes
reports/reference/tooth_forms.md.
"""

import math
import sys
from concurrent.futures import ProcessPoolExecutor
from datetime import date
from pathlib import Path

import wearsim
from wearsim.drive.load_case import load_single
from wearsim.mechanisms.wrap.tooth_loads import tooth_loads
from wearsim.result import Life, WearResult

ROOT = Path(__file__).parent.parent
DRIVES = {
    "A": "a140-17t-starved",
    "B": "a50-20t-drip",
    "C": "a80-20t-oilbath",
    "D": "pr254-27t-greased",
    "E": "a40-19t-rating",
    "F": "d6-crawler-27t-wrap",
    "G": "520-15t-wrap",
}
FORMS = {
    "evolute": {"profile": "evolute"},
    "ISO 606 min": {"profile": "iso606", "form": "min"},
    "ISO 606 max": {"profile": "iso606", "form": "max"},
    "ANSI B29.1": {"profile": "ansi_b29"},
    "GOST 591": {"profile": "gost591"},
}
DEPTH_PER_PITCH = 0.02
"""Same critical depth for all forms of a drive, over the pitch."""


def tables(name: str, sprocket: dict[str, object]) -> dict[str, object]:
    """A drive with another tooth form, its chain by dimensions so that no standard objects."""
    case = load_single(ROOT / "cases" / f"{name}.toml")
    chain = case.drive.chain
    inputs = {key: dict(value) if isinstance(value, dict) else value for key, value in case.inputs.items()}
    keep = ("teeth", "role", "engaged_every", "face_width_mm")
    inputs["sprocket"] = {key: inputs["sprocket"][key] for key in keep if key in inputs["sprocket"]}
    inputs["sprocket"] |= sprocket
    inputs["chain"] = {
        "pitch_mm": chain.pitch,
        "roller_diameter_mm": chain.roller_diameter,
        "inner_width_mm": chain.inner_width * chain.strands,
        "pin_diameter_mm": chain.pin_diameter,
        "bearing_area_mm2": chain.bearing_area,
        "mass_kg_per_m": 1e6 * chain.mass_per_length,
    }
    depth = float(f"{DEPTH_PER_PITCH * chain.pitch:.3g}")
    inputs["stop"] = {**inputs.get("stop", {}), "critical_depth_mm": depth}
    inputs["stop"].pop("min_tip_land_mm", None)
    inputs["run"] = {"horizon_hours": 1e6}
    inputs.pop("maintenance", None)
    return inputs


def hours(life: object) -> str:
    return f"{life.hours:,.0f}".replace(",", " ") if isinstance(life, Life) else "> 1 000 000"


def one(job: tuple[str, str]) -> tuple[str, str, list[str]]:
    """A row of the table of one drive and form."""
    letter, form = job
    try:
        case = load_single(tables(DRIVES[letter], FORMS[form]))
        result = wearsim.simulate(case)
        loads = [tooth_loads(case, eps).loads for eps in (0.0, case.drive.joint.elongation_limit)]
    except wearsim.WearsimError as error:
        return letter, form, [str(error).split("\n")[0][:140]]
    return letter, form, cells(result, loads)


def cells(result: WearResult, loads: list) -> list[str]:
    history = result.history_columns
    chains = int(history["chain"][-1])
    return [
        hours(result.parts["sprocket"]),
        str(chains),
        result.stop,
        f"{float(history['removed_area_mm2'][-1]):.3g}",
        " / ".join(f"{load.force[0] / load.tension[0]:.2f}" for load in loads),
        " / ".join(f"{math.degrees(load.pressure_angle[0]):.1f}" for load in loads),
        f"{result.initial_peak_pressure:.0f} -> {result.final_peak_pressure:.0f}",
        f"{100 * result.numerical_error:.1g} %",
    ]


def pictures() -> list[str]:
    """Lives of drive E with an evolute flank on the strand and on the wrap."""
    base = tables(DRIVES["E"], FORMS["evolute"])
    rows = []
    for kind, slip in (("strand", 1.0), ("strand", 0.1), ("wrap", 0.1)):
        case = {**base, "mechanism": {"kind": kind, "roller_slip_fraction": slip}}
        case["load"] = {"power_kW": 4.6, "speed_rpm": 1000}
        if kind == "strand":
            case["sprocket"] = {k: v for k, v in base["sprocket"].items() if k != "role"}
            case["stop"] = {"critical_depth_mm": base["stop"]["critical_depth_mm"]}
            case["chain"] = {
                k: base["chain"][k] for k in ("pitch_mm", "roller_diameter_mm", "inner_width_mm")
            }
            case = {k: v for k, v in case.items() if k not in ("drive", "joint")}
        result = wearsim.simulate(load_single(case))
        life = result.parts.get("sprocket", result.life)
        area = float(result.history_columns["removed_area_mm2"][-1])
        rows.append(
            f"| {kind} | {slip:g} | {hours(life)} | {result.initial_peak_pressure:.0f} -> "
            f"{result.final_peak_pressure:.0f} | {area:.3g} |"
        )
    return rows


def main() -> None:
    jobs = [(letter, form) for letter in sys.argv[1:] or DRIVES for form in FORMS]
    with ProcessPoolExecutor() as pool:
        found = list(pool.map(one, jobs))
    text = Path(__file__).with_name("tooth_forms_head.md").read_text("utf-8")
    lines = [text.rstrip(), "", f"Made on {date.today()} with `python research/tooth_forms.py`.", ""]
    head = (
        "tooth form",
        "sprocket life, h",
        "chains used",
        "what ends the drive first",
        "area worn off, mm2",
        "force on tooth 1 over T_t, new / stretched chain",
        "pressure angle, deg",
        "peak pressure, MPa",
        "numerical error",
    )
    for letter in dict.fromkeys(letter for letter, _, _ in found):
        lines += [
            f"### Drive {letter} ({DRIVES[letter]})",
            "",
            f"| {' | '.join(head)} |",
            "|" + "---|" * len(head),
        ]
        lines += [
            f"| {form} | {' | '.join(row)} |" + " |" * (len(head) - 1 - len(row))
            for key, form, row in found
            if key == letter
        ]
        lines.append("")
    lines += [
        "## Drive E with an evolute flank on the strand and on the wrap",
        "",
        "| picture | roller slip fraction | sprocket life, h | peak pressure, MPa | area worn off, mm2 |",
        "|---|---|---|---|---|",
        *pictures(),
        "",
    ]
    (ROOT / "reports/reference/tooth_forms.md").write_text("\n".join(lines), "utf-8")


if __name__ == "__main__":
    main()
