"""A program as text or code: LLVM, C, CUDA, casadi, WebAssembly; compiled and called.

In: a ``Program``. Out: functions over arrays.
Imports ``kernel``.
"""
