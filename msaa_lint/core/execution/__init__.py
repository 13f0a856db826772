"""Tasks that several processes do at the same time, on this machine or on a cluster, and the
results as they finish.
"""
