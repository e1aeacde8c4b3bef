"""The torch engine: any module, any observation, any device."""
