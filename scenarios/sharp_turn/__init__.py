"""A turn that no forward path can take."""
