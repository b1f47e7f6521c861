"""The stages in order: read, detect, solve, write. ``run.py`` is the chain on one page."""
