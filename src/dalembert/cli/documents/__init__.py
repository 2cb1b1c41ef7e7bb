"""`dalembert draw`, `report`, `page` and `studio`, and the option `--at` by which they, and `solve`, name a position.

In: a command line. Out: drawings, documents, an exit status. Imports what ``cli`` does.
"""
