"""The task: scenarios, rules, the Game seam and the Env over it. Pure: no picture files, no torch, no screen."""
