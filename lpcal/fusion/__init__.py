"""Views of one object to one model: registration against each other, the surface that they share, what each vertex rests on."""
