"""The rig of the 67 lubricants: its blocks, what the law of lubrication gives for them, how it was read.

Growth is in parts of the allowance, 0.5 % of the chain's length. Coefficients are in allowances that
well lubricated, clean joints wear in an hour; the run of the shipped case says what that is in
mm3/(N m).
"""

from dataclasses import dataclass
from pathlib import Path

import numpy as np
import pandas as pd

import wearsim

ROOT = Path(__file__).parent.parent
DATA = ROOT / "tests" / "validation" / "data"
CASE = ROOT / "cases" / "bicycle-17t-road.toml"
RIG = (
    "sprocket.teeth=22",
    "drive.links=112",
    "load.power_kW=250 W",
    f"load.speed_rpm={100 * 50 / 22!r}",
    "mechanism.phases=2",
    "run.horizon_hours=210",
    "wear.specific_wear_rate_mm2_per_N=1e-14",
)
"""50/22 teeth are assumed; the teeth of the cog do not wear, so that only the joints count."""

KM_PER_HOUR = 1000.0 / 34.5
"""Speed at which 1000 km take the hours of the mean block."""

STEP = 1.0 / 350.0
"""Step of the readings, found in them: 0.01 mm at seven places of 0.5 mm each would give it."""

READING = 0.01 * (2.0 * 7.0 / 12.0) ** 0.5 / 3.5
"""Standard deviation of a block's reading by rounding alone: two sums over seven places to 0.01 mm."""


@dataclass(frozen=True)
class Block:
    """1000 km: relubrications evenly, the first at the begin, contaminations in the middle of parts."""

    hours: float
    relubrications: int
    contaminations: int
    environment: str  # clean, dust, wet, extreme

    def stretches(self) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
        """Parts of the block, relubrications up to each, and since the last contamination (-1: none)."""
        relubricated = [(i / self.relubrications, 0) for i in range(self.relubrications)]
        dirtied = [((i + 0.5) / self.contaminations, 1) for i in range(self.contaminations)]
        events = sorted([*relubricated, *dirtied])
        ends = [time for time, _ in events[1:]] + [1.0]
        parts, before, since = [], [], []
        relubrications, fresh = 0, -1
        for (time, dirt), end in zip(events, ends, strict=True):
            relubrications += not dirt
            fresh = 0 if dirt else fresh + (fresh >= 0)
            parts.append(end - time)
            before.append(relubrications)
            since.append(fresh)
        return np.array(parts), np.array(before), np.array(since)


BLOCKS = (
    Block(35.0, 3, 0, "clean"),
    Block(37.0, 6, 7, "dust"),
    Block(31.0, 3, 0, "clean"),
    Block(37.0, 6, 7, "wet"),
    Block(30.0, 3, 0, "clean"),
    Block(37.0, 6, 14, "extreme"),
)
HOURS = np.array([block.hours for block in BLOCKS])
_STRETCHES = tuple(block.stretches() for block in BLOCKS)


def growth(clean, running_in, dirt, removed):
    """Growth in each of the six blocks by the law of lubrication, for arrays of coefficients.

    ``clean`` is the coefficient k, ``running_in`` the growth that running-in adds, (f - 1) N_r k, ``dirt``
    what contamination adds to k, k (phi - 1), by environment, and ``removed`` the part of it that a
    relubrication takes away. A maximum goes through the decay, so what is left of earlier dirt and
    what the block's own leaves are followed each for itself.
    """
    kept = (1.0 - np.asarray(removed))[..., None] ** np.arange(7)
    left = np.zeros(np.shape(clean))
    grown = []
    for block, (parts, before, since) in zip(BLOCKS, _STRETCHES, strict=True):
        dirty = left[..., None] * kept[..., before]
        if block.contaminations:
            own = dirt[block.environment][..., None] * kept[..., np.maximum(since, 0)] * (since >= 0)
            dirty = np.maximum(dirty, own)
        left = dirty[..., -1]
        grown.append(block.hours * (clean + dirty @ parts))
    grown[0] = grown[0] + running_in
    return np.stack(grown, axis=-1)


def coefficient_of_rate(trial: float = 1e-8) -> float:
    """Coefficient of the joints [mm3/(N m)] that wears one allowance in an hour, by a run of the case."""
    joints = f"joint.specific_wear_rate_mm2_per_N={trial!r}"
    result = wearsim.simulate(wearsim.load_case(CASE, [*RIG, joints]))
    return 1e3 * trial * result.parts["chain"].hours_run


def blocks_read() -> pd.DataFrame:
    """The lubricants with their blocks; the chain without lubricant is none of them."""
    table = pd.read_csv(DATA / "lubricant_blocks.csv", comment="#")
    return table[~table.note.fillna("").str.contains("no_lubricant")].reset_index(drop=True)


def kinds(category: pd.Series) -> tuple[np.ndarray, int]:
    """Categories as numbers: waxes that melt, waxes that drip or are rubbed on, oils, others."""
    order = {"immersive_wax": 0, "wax_drip": 1, "rub_on_wax": 1, "wet_drip": 2, "other": 3}
    return category.map(order).to_numpy(), 4


def mid_quantiles(draws: np.ndarray, parts) -> np.ndarray:
    """Quantiles of draws by the middle of the jumps of their distribution, between them linear.

    Where readings come in steps, plain quantiles make bands that hold more than they say, since
    whole steps lie on their edges. Without ties these are the plain ones.
    """
    values, counts = np.unique(draws, return_counts=True)
    middle = (np.cumsum(counts) - 0.5 * counts) / counts.sum()
    return np.interp(parts, middle, values)
