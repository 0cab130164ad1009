"""The ledger: every equation, figure and claim of the paper, and what the studies' statements make of it."""
