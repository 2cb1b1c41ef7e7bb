"""Mechanisms that run in other programs without Python: functional mock-up units, plain C, WebAssembly with a loader.

In: a ``Kernel``, or a mechanism that is compiled first. Out: bytes of a file. Its C sources are data in ``sources``.
"""
