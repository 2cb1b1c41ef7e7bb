"""Optimal designs for an aim, within bounds and conditions: many starts side by side in the compiled analysis.

In: a ``Mechanism``, numbers that vary with their bounds, an aim and conditions over outputs. Out: an ``Optimum`` with
the optimal mechanism. Imports ``analysis`` and ``machine`` and what these import; no pictures, no command (``cli``).

aims              the syntax of aims and conditions
design_problem    an aim and conditions within bounds: values and exact gradients for many designs
one_by_one        the same of quantities that are not compiled, and of Python functions, by differences
side_by_side      quasi-Newton steps of all starts at once, one call of the kernel for each
optimizers        those of scipy, nlopt and pymoo by name
polishing         the best of them, one at a time: minimizes t with |T_k| <= t at every position
optimizing        ``da.optimize``: starts, search, discrete steps, the best that keeps every condition
optimize_file     the same from a separate file that names the model file
least_squares     Levenberg's and Marquardt's method from many starts at once
free_timing       targets whose positions of the drive are unknown too
synthesis         ``da.synthesize``: outputs that take given values, by least squares
pareto_front      ``da.pareto``: designs between two aims
optimum           the result, before and after
"""
