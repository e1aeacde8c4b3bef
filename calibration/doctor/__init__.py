"""The doctor: checks everything that may keep an agent from playing here, and tries out what is harmless."""
