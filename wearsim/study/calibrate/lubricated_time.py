"""Running hours, and hours of well lubricated contacts that wear as much."""

from dataclasses import dataclass

import numpy as np

from wearsim.case.model import Case
from wearsim.drive.drive_case import DriveCase
from wearsim.drive.part_life import case_clock
from wearsim.readings.relubrications import RelubricationLog, relubricated
from wearsim.wear.mate_clock import LubricatedClock


@dataclass(frozen=True)
class LubricatedTime:
    """The clock of the lubricant in hours: as logged, and then at the mean interval of the log.

    Coefficients are fitted over lubricated hours, in which life times coefficient is constant.
    """

    clock: LubricatedClock
    cycles_per_hour: float
    log: RelubricationLog

    @classmethod
    def of(cls, case: Case | DriveCase, log: RelubricationLog) -> "LubricatedTime":
        """Return that of a case; without a log by the schedule of the case."""
        as_logged = relubricated(case, log)
        return cls(case_clock(as_logged), as_logged.cycles_per_hour, log)

    def lubricated(self, hours: float) -> float:
        """Return the lubricated hours that wear as much as those run."""
        if self.clock.is_steady:
            return hours
        return self.clock.steady_cycles(hours * self.cycles_per_hour) / self.cycles_per_hour

    def running(self, lubricated: float) -> float:
        """Return the hours run that wear as much as lubricated ones."""
        if self.clock.is_steady:
            return lubricated
        cycles = np.array([lubricated * self.cycles_per_hour])
        return float(self.clock.running_cycles(cycles)[0]) / self.cycles_per_hour
