"""Pure functions on arrays: transforms, cameras, spheres, light. Nothing here reads a file or knows a rig."""
