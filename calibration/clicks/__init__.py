"""Places to click in the menus: found by their labels, recorded by hand, shown."""
