"""What a person does once: tell the agent where their arena and their buttons are. Reads devices, writes a Profile."""
