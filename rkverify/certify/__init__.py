"""Independent routes, enclosures and proofs by machine algebra that the studies' statements rest on."""
