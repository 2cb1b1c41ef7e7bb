"""A program as a WebAssembly module, for a page or any other host of such modules, without a compiler.

In: a program. Out: bytes, and the first free address. May import the kernel's graph, program and constants.
"""
