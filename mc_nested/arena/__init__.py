"""The task: scenarios, designs, rules, the Game seam, and the Envs over it. No torch, no screen, no picture files."""
