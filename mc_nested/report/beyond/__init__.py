"""What the paper says it could do and did not try: the results of reproduce --beyond, its claims, figure and report."""
