"""``python -m poise``, and the command ``poise``."""

import sys


def main() -> None:
    """The command line; Ctrl-C while it is still being loaded ends it as quietly as later."""
    try:
        from poise.cli import main as run

        run()
    except KeyboardInterrupt:
        sys.exit(130)


if __name__ == "__main__":
    main()
