"""A program as text or code: LLVM, C, CUDA, casadi; compiled and called.

In: a ``Program``. Out: functions over arrays.
Imports ``kernel``.
"""
