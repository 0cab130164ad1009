"""Somebody else's shape functions and gradients: what they satisfy, what they are, and where they leave what they claim."""
