"""What a calibration saw, kept beside the profile and made into one page that names nobody."""
