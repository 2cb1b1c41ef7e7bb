"""Tests of machine elements.

In: cases of `element_cases.json`, machines drawn at random. Out: nothing. Imports ``dalembert`` and the other tests.
"""
