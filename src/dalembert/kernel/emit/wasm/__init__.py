"""A program as a WebAssembly module, for a page or any other place that runs such modules; no compiler is needed.

In: a program. Out: bytes, and the first free address. May import the kernel's graph, program and constants.
"""
