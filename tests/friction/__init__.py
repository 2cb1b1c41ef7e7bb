"""Dry friction: exact figures, laws on random mechanisms, an oracle of its own, messages."""
