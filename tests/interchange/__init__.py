"""Files of other programs, and mechanisms that run in them."""
