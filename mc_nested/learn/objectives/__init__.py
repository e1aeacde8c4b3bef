"""One agent for any design: the main agent chooses the next cell to build, and the nested agent gets it there."""
