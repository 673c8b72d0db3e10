"""``wearsim cite``: how to cite wearsim and the sources of its equations."""

import click

from wearsim.command.options import common_options


@click.command(short_help="Print how to cite wearsim and its sources.")
@click.option(
    "--format",
    "style",
    type=click.Choice(["text", "bibtex", "cff", "apa"]),
    default="text",
    show_default=True,
    help="Format of the citation: plain text, BibTeX, Citation File Format or APA.",
)
@common_options
def cite(style: str) -> None:
    """Print how to cite wearsim, and the papers whose equations it uses."""
    from wearsim import citation

    forms = {
        "text": citation.citation_text,
        "bibtex": citation.bibtex,
        "cff": citation.cff,
        "apa": citation.apa,
    }
    click.echo(forms[style](), nl=False)
