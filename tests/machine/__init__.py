"""Machine design: shaking forces, balance, flywheels."""
