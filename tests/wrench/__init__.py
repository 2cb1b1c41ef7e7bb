"""Force systems: laws on random ones, problems of books, messages, drawings."""
