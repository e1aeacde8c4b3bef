"""``python -m mc_nested.cli``, if no ``mc-nested`` is on the path."""

from mc_nested.cli import main

main()
