"""The second route: the same objects as `paper/`, vectorised in double precision, real or complex (complex step)."""
