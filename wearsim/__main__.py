"""``python -m wearsim`` is the command ``wearsim``."""

from wearsim.cli import main

if __name__ == "__main__":
    main()
