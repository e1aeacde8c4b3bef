"""Studies: many trainings that differ in one thing, as arms, jobs, a table and a report; a file declares each.

study.py says what a declaration is, arm.py what an arm; claims/ judges what the paper says.
"""
