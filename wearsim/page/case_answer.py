"""The answer to a case of one sprocket, from its first estimate to its pictures."""

from collections.abc import Callable, Mapping
from typing import Any

from wearsim.case.model import Case
from wearsim.page.answer_panel import AnswerPanel
from wearsim.page.answers import edited_case, estimate, is_slow, pictures
from wearsim.page.chart_colours import Palette
from wearsim.page.edited_input import EditedInput
from wearsim.page.header import Header
from wearsim.report.answer import headline
from wearsim.report.html.run_charts import tooth_load_chart
from wearsim.result import Life, LowerBound, WearResult
from wearsim.simulation import simulate


class CaseAnswer:
    """The answer in the place where it is made."""

    def __init__(
        self, header: Header, on_sound: Callable[[Mapping[str, Any]], None], palette: Palette
    ) -> None:
        self._header, self._on_sound = header, on_sound
        self.panel = AnswerPanel(palette)
        self.lives: Mapping[str, Life | LowerBound] = {}

    async def find(self, edited: EditedInput) -> dict[str, tuple[Case, WearResult]]:
        """Find the answer and show it step by step; return case and result of the only wheel."""
        case = await edited.step(lambda: edited_case(edited.source, edited.file))
        if is_slow(case):
            await self._show_first(edited, case)
        edited.check()
        result = await edited.step(lambda: simulate(case, edited.watch))
        self.lives = {"life": result.life}
        self._show_sound(case)
        self._header.show_life(headline(result))
        self._header.show_state("drawing", "up to date, drawing")
        self.panel.show_life(result)
        if not is_slow(case):
            self.panel.show_loads(None)
        self.panel.show_pictures(await edited.step(lambda: pictures(case, result)))
        self._header.show_state("current", "up to date")
        return {case.name: (case, result)}

    async def _show_first(self, edited: EditedInput, case: Case) -> None:
        """Show what is known before a life that takes long: loads, and about how long it is."""
        loads = await edited.step(lambda: tooth_load_chart(case))
        self._show_sound(case)
        self.panel.show_loads(loads)
        rough = await edited.step(lambda: estimate(edited.source, case, edited.check))
        if rough is not None:
            self._header.show_life(f"about {headline(rough)}")
            self._header.show_state("estimate", "first estimate, computing")

    def _show_sound(self, case: Case) -> None:
        self._on_sound({**case.inputs, "title": case.title})
