"""The task: scenarios, rules, the Game seam and the Env over it. Pure: no files drawn, no torch, no screen."""
