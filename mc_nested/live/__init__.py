"""The live path: from an action to timed keys, and from pixels back to a state."""
