"""Live: devices in, attitude out, to viewers and to disk."""
