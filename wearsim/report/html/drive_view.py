"""What a page shows of a drive before it wears: a sketch to scale, and the loads of its teeth."""

from wearsim.case.model import Case
from wearsim.mechanisms.gear_pair.drive import GearDrive
from wearsim.mechanisms.strand.drive import StrandDrive
from wearsim.mechanisms.wrap.drive import WrapDrive
from wearsim.report.html.chain_sketch import strand_sketch, wrap_sketch
from wearsim.report.html.charts import Chart
from wearsim.report.html.gear_sketch import gear_sketch
from wearsim.report.html.run_charts import loads_chart
from wearsim.report.html.sketch import Sketch


def drive_sketch(case: Case) -> Sketch | None:
    """Return the drive to scale."""
    drive = case.drive
    if isinstance(drive, WrapDrive):
        return wrap_sketch(drive)
    if isinstance(drive, GearDrive):
        return gear_sketch(drive)
    return strand_sketch(drive, case.engaged_every) if isinstance(drive, StrandDrive) else None


def tooth_load_chart(case: Case) -> Chart | None:
    """Return what the teeth of a wrap carry, under a new chain and one at its limit."""
    if not isinstance(case.drive, WrapDrive):
        return None
    from wearsim.mechanisms.wrap.tooth_loads import tooth_loads  # takes 0.4 s, for its kernels

    grown = tooth_loads(case, case.drive.joint.elongation_limit)
    return loads_chart(tooth_loads(case), grown)
