"""Numbers only: constraints, poses, motion, equilibrium, over arrays with leading axes (design, position)."""
