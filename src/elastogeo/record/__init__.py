"""Live acquisition from a control into files that `formats` can read. Stands on `formats` and `errors`."""
