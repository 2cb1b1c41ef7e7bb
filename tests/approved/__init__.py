"""Texts that were read and found right, kept to see what a change of the program changes in them."""
