"""How a held key walks in this game, measured: which key goes which way, how far, and when it is felt and seen."""
