"""The library's face: what every command calls and what a program may call, arrays and records in, records out.

The names stand in `lpcal` itself. Nothing here sees a path but `files`, which reads and writes; nothing prints.
"""
