"""Which pixels of a capture are the object, its support and the wall: layers in coarse pixels, judged, and outlined in full size."""
