"""Words of users in figures."""


def literal(text: str) -> str:
    r"""Return a text that a figure shows as it is.

    Examples
    --------
    >>> print(literal("3 $ an hour"))
    3 \$ an hour
    """
    return text.replace("$", r"\$")
