"""``wearsim init``: a commented case to start from."""

from pathlib import Path

import click

from wearsim.cli.standard import standard
from wearsim.errors import CaseError, Fault

_TEMPLATE = """\
# A case for wearsim. Commented keys show their default or an example; wearsim list
# quantities explains every key, wearsim schema lets an editor check this file.
format_version = 1
title = "Evolute sprocket, {chain} chain, {teeth} teeth"

[chain]
designation = "{chain}"                  # wearsim list chains; or give pitch_mm, roller_diameter_mm and inner_width_mm

[sprocket]
teeth = {teeth}
profile = "evolute"                      # or "points" with points_file = "flank.csv" (x_mm,y_mm from root to tip)
# face_width_mm = {width:g}                  # the standard width for the chain
# contact_start_mm = {start:.6g}             # where a roller starts to touch, before the pole line
# contact_end_mm = {end:.6g}                # where it leaves the flank
# evolute_offset_mm = {offset:.4g}             # how far the chain runs inside the centrode
# nodes = 201

[mechanism]
kind = "strand"                          # or "prescribed" with table_file = "run.csv"
roller_slip_fraction = 1.0               # 1: the roller does not turn (bush chain, track); about 0.1: free roller

[load]                                   # one of tension_N, torque_N_m and power_kW
power_kW = {power:g}
speed_rpm = {speed:g}

[wear]
condition = "hardened, oiled"            # wearsim list wear-conditions; or specific_wear_rate_mm2_per_N

[stop]
# critical_depth_mm = {depth:.4g}           # 10 % of the tooth thickness at the pitch line

[run]
# horizon_hours = 50000
"""


@click.command(short_help="A commented case to start from.")
@click.option("--chain", default="16B-1", show_default=True, metavar="DESIGNATION")
@click.option("--teeth", type=int, default=20, show_default=True)
@click.option(
    "--out", type=click.Path(path_type=Path, allow_dash=True), default="-", show_default=True,
    help="New file; - is stdout.",
)  # fmt: skip
@click.option("--force", is_flag=True, help="Replace the file.")
@standard
def init(chain: str, teeth: int, out: Path, force: bool) -> None:
    """Write a working case for a chain and a number of teeth, every key explained."""
    from wearsim.case.load import load_case
    from wearsim.output import check_free, write_file

    if str(out) != "-":
        check_free(out, force)
    # A chain speed of 1 m/s and a tenth of what the chain's strength allows.
    seed = {
        "format_version": 1,
        "chain": {"designation": chain},
        "sprocket": {"teeth": teeth, "profile": "evolute"},
        "load": {"tension_N": 1.0, "speed_rpm": 1.0},
        "wear": {"condition": "hardened, oiled"},
    }
    try:
        case = load_case(seed)
    except CaseError as error:
        options = {"chain.designation": "--chain"}
        raise CaseError(
            [Fault(fault.message, "", options.get(fault.key, "--teeth")) for fault in error.faults]
        ) from None
    speed = float(f"{60_000.0 / (case.chain.pitch * teeth):.2g}")
    power = float(f"{case.chain.tensile / 10.0 * case.chain.pitch * teeth * speed / 6e7:.2g}")
    sprocket, stop = case.inputs["sprocket"], case.inputs["stop"]
    text = _TEMPLATE.format(
        chain=chain,
        teeth=teeth,
        width=sprocket["face_width_mm"],
        start=sprocket["contact_start_mm"],
        end=sprocket["contact_end_mm"],
        offset=sprocket["evolute_offset_mm"],
        depth=stop["critical_depth_mm"],
        power=power,
        speed=speed,
    )
    if str(out) == "-":
        click.echo(text, nl=False)
    else:
        write_file(out, text, force)
