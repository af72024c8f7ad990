"""One self-contained HTML page of a run or a study. Takes datasets, tables and arrays.

A page is a value (``blocks``) that ``page.write_page`` writes; ``run_page`` and ``study_page`` make
one from what a run or a study has found.
"""
