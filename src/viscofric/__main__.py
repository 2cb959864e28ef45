"""``python -m viscofric``: the command line."""

from viscofric.cli import main

if __name__ == "__main__":
    main()
