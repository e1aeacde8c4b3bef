"""Moving and placing: from a cell to timed key holds, and from the screen back to the agent's state."""
