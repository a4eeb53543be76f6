"""The rules of the house as plain functions.

Each takes what it judges (a folder, a notebook) and returns a list of faults: sentences that name the file
and say what would be right. The tests in `tests/test_*.py` ask for an empty list on this repository, and
for the right sentence on small trees with one fault planted in each (`sample.py` makes the tree).
"""
