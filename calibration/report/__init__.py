"""Keep what a calibration saw beside the profile, and make it into one page that names nobody."""
