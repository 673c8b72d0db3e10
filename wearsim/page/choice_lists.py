"""Lists of words to choose from; a long one is narrowed by typing, and takes words that it does not hold."""

from collections.abc import Sequence

from nicegui import ui

from wearsim.page.field_words import choice_words

_LONG = 20
"""Words from which a list is narrowed by typing."""

_TEXT = "(event) => emit(event.target.value ?? '')"


def choice_list(name: str, words: Sequence[str], value: str, label: str) -> ui.select:
    """Add a list of the words that a key takes, each with its meaning."""
    options = _options(name, words, value)
    if len(words) <= _LONG:
        return ui.select(options, label=label, value=value or None, clearable=True)

    def _word(typed: str) -> str:
        # The key Tab hands over what the field shows: a word with its meaning.
        shown = _options(name, words, "")
        return next((word for word, meaning in shown.items() if typed.strip() == meaning), typed.strip())

    def _show(value: str) -> None:
        """Show a value, and the list without what was typed before."""
        element.set_options(_options(name, words, value), value=value or None)

    element = ui.select(
        options, label=label, value=value or None, clearable=True, new_value_mode="add", key_generator=_word
    )
    element.props("autocomplete=off spellcheck=false")
    element.on_value_change(lambda event: _show(event.value or ""))
    # Else what is typed and not chosen would be lost as the field is left.
    element.on("blur", lambda event: _show(_word(event.args) or element.value or ""), js_handler=_TEXT)
    return element


def fill_list(element: ui.select, name: str, words: Sequence[str], value: str) -> None:
    """Show another value, which may be none of the words."""
    element.set_options(_options(name, words, value), value=value or None)


def _options(name: str, words: Sequence[str], value: str) -> dict[str, str]:
    """Return the words with their meanings, and a value that is none of them but stands in the source."""
    return {word: choice_words(name, word) for word in (*words, *([value] if value else ()))}
