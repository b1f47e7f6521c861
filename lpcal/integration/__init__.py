"""From normals to depth within a mask: the solve, what is one piece, normal maps from elsewhere, and a mesh."""
