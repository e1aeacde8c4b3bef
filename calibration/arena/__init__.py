"""What a person and the agent do to have an arena: where it lies, looked over, asked about, built, undone."""
