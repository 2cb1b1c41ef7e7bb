"""The kernel against the general executor, its derivatives, reductions, lanes, threads and memory."""
