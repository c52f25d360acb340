"""The tables and figures of the papers, made again from motion capture and put beside the published numbers.

A row is a table, a figure or a statement of a paper: one file in ``rows``. Adding one is adding a file.
"""
