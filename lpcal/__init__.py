"""lpcal: calibrates a camera-and-light panel and rebuilds surfaces with it.

Read the chain in the file list of ``lpcal/chain``, the frames in README.md. Inside lpcal: metres, radians, seconds;
``H_AB`` (4x4) takes coordinates in B to coordinates in A.
"""

__version__ = "0.1.0"
