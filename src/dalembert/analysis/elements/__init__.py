"""Answers of a result about its machine elements: speeds of turning frames, power through gear trains.

In: a result, or the forces of some positions. Out: arrays and answers. Imports core, model and analysis.
"""
