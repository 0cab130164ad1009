"""The paper's equations, transcribed literally: slow, obvious, generic over the arithmetic."""
