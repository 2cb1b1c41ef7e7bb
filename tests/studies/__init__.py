"""Studies: many designs drawn, stored, resumed."""
