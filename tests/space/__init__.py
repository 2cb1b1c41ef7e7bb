"""Space: pairs, laws, lifted plane mechanisms, overconstrained linkages."""
