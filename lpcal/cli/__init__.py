"""One module a command; ``main.py`` holds the table of commands and the one error boundary."""
