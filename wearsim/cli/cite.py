"""``wearsim cite``: how to cite wearsim and the sources of its equations."""

import click

from wearsim.command.options import standard


@click.command(short_help="How to cite wearsim and the sources of its equations.")
@click.option(
    "--format",
    "style",
    type=click.Choice(["text", "bibtex", "cff", "apa"]),
    default="text",
    show_default=True,
    help="Plain words, BibTeX, Citation File Format or APA style.",
)
@standard
def cite(style: str) -> None:
    """Print how to cite wearsim, and the papers whose equations it uses."""
    from wearsim import citation

    forms = {"text": citation.text, "bibtex": citation.bibtex, "cff": citation.cff, "apa": citation.apa}
    click.echo(forms[style](), nl=False)
