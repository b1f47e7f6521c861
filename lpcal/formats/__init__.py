"""One module a file format, reading and writing only."""
