"""The hottest loops, in C: one source a topic, compiled when the package is built (tools/build_kernels.py, docs/kernels.md).

Each has a twin in numpy, which is the code to read: it stands where the kernel is called, does the same to rounding
(tests/kernels/test_kernels.py) and does the work wherever there is no compiled library. Kernels hold no state and release the
interpreter's lock.
"""
