"""Studies and what runs them: discovery, identity, comparison, provenance, the runner."""
