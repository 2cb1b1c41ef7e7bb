"""Laws of mechanics, stated as tests on random mechanisms."""
