"""Tests: oracles, laws on random mechanisms, books."""
