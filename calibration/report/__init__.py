"""What a calibration saw, kept beside the profile, and made one page of that names nobody."""
