"""``wearsim completion``: the script that teaches a shell to complete wearsim's words."""

import click

from wearsim.command.options import common_options

_VARIABLE = "_WEARSIM_COMPLETE"

_HELP = """Print the completion script for SHELL: commands, options, cases, chains and keys.

\b
bash   wearsim completion bash > ~/.local/share/bash-completion/completions/wearsim
zsh    wearsim completion zsh > ~/.zfunc/_wearsim     (a folder of $fpath)
fish   wearsim completion fish > ~/.config/fish/completions/wearsim.fish
"""

_OFFER = "            COMPREPLY+=($value)\n"
_OFFER_OPEN = _OFFER + "            [[ $value == *= ]] && compopt -o nospace\n"
"""The line of click's script that offers a word, without a blank after ``key=``."""


def use_own_bash() -> None:
    """Make click complete ``key=value`` in bash, which hands over its parts one by one."""
    from click.shell_completion import BashComplete, CompletionItem, add_completion_class

    class _Bash(BashComplete):
        source_template = BashComplete.source_template.replace(_OFFER, _OFFER_OPEN)
        _lead = ""

        def get_completion_args(self) -> tuple[list[str], str]:
            words, incomplete = super().get_completion_args()
            joined = _joined([*words, incomplete])
            if joined[-1] != incomplete:
                self._lead = joined[-1].removesuffix("" if incomplete == "=" else incomplete)
            if self._lead.startswith("--"):
                self._lead = self._lead.partition("=")[2]
            return joined[:-1], joined[-1]

        def format_completion(self, item: "CompletionItem[str]") -> str:
            if self._lead and item.type == "plain":
                return f"plain,{item.value.removeprefix(self._lead)}"
            return super().format_completion(item)

    add_completion_class(_Bash)


def _joined(words: list[str]) -> list[str]:
    """Join words that bash has taken apart at ``=``."""
    found: list[str] = []
    for word in words:
        if found and (word == "=" or found[-1].endswith("=")):
            found[-1] += word
        else:
            found.append(word)
    return found


@click.command(help=_HELP, short_help="Print the completion script for bash, zsh or fish.")
@click.argument("shell", type=click.Choice(["bash", "zsh", "fish"]))
@common_options
def completion(shell: str) -> None:
    """Print the completion script of SHELL."""
    from click.shell_completion import get_completion_class

    use_own_bash()
    kind = get_completion_class(shell)
    assert kind is not None
    root = click.get_current_context().find_root().command
    click.echo(kind(root, {}, "wearsim", _VARIABLE).source(), nl=False)
