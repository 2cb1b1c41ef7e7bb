"""What notebooks show, sweeps, and the example notebooks."""
