"""Papers and files of the marker sheet."""

PAPERS = {"a4": (210.0, 297.0), "letter": (215.9, 279.4), "a3": (297.0, 420.0), "tabloid": (279.4, 431.8)}
"""Width and height [mm]."""

PAGE_FORMATS = ("pdf", "svg", "png")
