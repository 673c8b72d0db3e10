"""Which lines the mesh stiffness of gears with pitch errors excites, and how strongly."""

from typing import TYPE_CHECKING

from wearsim.lazy import lazy_names

if TYPE_CHECKING:
    from wearsim.handbook.stiffness_spectrum.mesh_statics import LoadedTeeth
    from wearsim.handbook.stiffness_spectrum.model import (
        SpectrumChoice,
        StiffnessSpectrum,
        ToothErrors,
        mesh_spectrum,
    )

__all__ = ["LoadedTeeth", "SpectrumChoice", "StiffnessSpectrum", "ToothErrors", "mesh_spectrum"]
__getattr__, __dir__ = lazy_names(
    __name__,
    {
        **dict.fromkeys(__all__, "wearsim.handbook.stiffness_spectrum.model"),
        "LoadedTeeth": "wearsim.handbook.stiffness_spectrum.mesh_statics",
    },
)
