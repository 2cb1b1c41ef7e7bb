"""Answers of kept programs beside those of the careful path."""
