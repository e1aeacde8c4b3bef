"""Completing a command line in bash, zsh, fish and PowerShell, without loading any verb: verbs.json lists them all."""
