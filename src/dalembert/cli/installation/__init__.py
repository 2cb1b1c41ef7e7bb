"""`dalembert doctor` and `completion`: the installation itself.

In: a command line. Out: text, an exit status. Imports what ``cli`` does.
"""
