"""Integration of normals to depth within a mask: solver, connected components, external normal maps, and meshes."""
