"""Checks of whole bodies: patch tests, manufactured solutions, long motions, separation. They give tables, studies judge them."""
